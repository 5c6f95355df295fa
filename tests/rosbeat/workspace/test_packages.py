import shutil

from rosbeat.workspace.packages import find_packages, read_package
from rosbeat.workspace.stages import NODES, PACKAGE


def test_the_finished_one(root, package):
    found = read_package(package, root)
    assert found.name == PACKAGE
    assert found.manifest.build_type == "ament_python"
    assert found.scripts_are_found
    assert found.has_marker
    assert found.has_init
    assert found.modules == NODES
    assert found.flaws == ()
    assert found.installed is None
    assert found.module_with_syntax_error() is None


def test_an_empty_folder(root):
    found = read_package(root / "src", root)
    assert found.name == "src"
    assert found.manifest.problem
    assert found.setup.problem
    assert [found.has_marker, found.has_init, found.scripts_are_found] == [False] * 3
    assert found.modules == found.tests == found.flaws == ()


def test_what_is_missing_or_broken(root, package):
    (package / "setup.cfg").write_text("[install\nnonsense")
    (package / "resource" / PACKAGE).unlink()
    (package / PACKAGE / "__init__.py").unlink()
    (package / PACKAGE / "broken.py").write_text("def f(:\n")
    (package / "test").mkdir()
    (package / "test" / "test_a.py").touch()
    found = read_package(package, root)
    assert [found.has_marker, found.has_init, found.scripts_are_found] == [False] * 3
    assert found.module_with_syntax_error() == ("broken", 1)
    assert found.tests == ("test_a.py",)


def test_packages_are_found_where_colcon_finds_them(root, package):
    shutil.copytree(package, root / "docs" / "copy")
    shutil.copytree(package, root / "kept" / "copy")
    (root / "kept" / "COLCON_IGNORE").touch()
    shutil.copytree(package, root / ".hidden" / "copy")
    shutil.copytree(package, package / "inner")
    assert find_packages(root) == [root / "docs" / "copy", package]


def test_entry_points_in_setup_cfg(root, package):
    path = package / "setup.cfg"
    path.write_text(path.read_text() + "[options.entry_points]\nconsole_scripts =\n  a = b:c\n")
    # setuptools reads them only if setup.py has none of its own.
    assert "a" not in [one.executable for one in read_package(package, root).setup.entry_points]
    setup = package / "setup.py"
    setup.write_text("from setuptools import setup\nsetup(packages=['sensor_simulator'])\n")
    found = read_package(package, root)
    assert [(one.text, one.file) for one in found.setup.entry_points] == [("a = b:c", "setup.cfg")]
    assert [flaw.kind for flaw in found.flaws] == ["no-module"]
    assert found.setup.groups == ("console_scripts",)
    assert found.scripts_are_found


def test_packages_that_setup_cfg_names(root, package):
    (package / "setup.py").write_text("from setuptools import setup\nsetup()\n")
    assert not read_package(package, root).setup.installs("sensor_simulator")
    (package / "setup.cfg").write_text("[options]\npackages = find:\n")
    assert read_package(package, root).setup.installs("sensor_simulator")

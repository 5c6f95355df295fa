import shutil

import pytest

from rosbeat.workspace.stages import PACKAGE, finished

FINE = """Starting >>> sensor_simulator
Finished <<< sensor_simulator [2.03s]

Summary: 1 package finished [2.41s]
"""
NEVER_CALLED = """Starting >>> sensor_simulator
RuntimeError: 'distutils.core.setup()' was never called -- perhaps 'setup.py' is not a Distutils
Failed   <<< sensor_simulator [0.30s, exited with code 1]

Summary: 0 packages finished [0.60s]
  1 package failed: sensor_simulator
"""
NONE = "\nSummary: 0 packages finished [0.30s]\n"
ENTRY = f"{PACKAGE}.temperature_publisher:main"


@pytest.fixture
def edit(package):
    """Replace a text in a file of the package."""

    def edit(name, old, new):
        path = package / name
        assert old in path.read_text()
        path.write_text(path.read_text().replace(old, new))

    return edit


def test_a_good_build(meaning, package):
    assert meaning("colcon build", FINE, 0) is None


@pytest.mark.parametrize(
    ("old", "new", "code", "output", "texts"),
    [
        (ENTRY, ENTRY.replace("publisher:", "publishr:"), 0, FINE, ["Did you mean", "not notice"]),
        (ENTRY, ENTRY.replace(":", ".py:"), 0, FINE, ["no `.py` at its end"]),
        (ENTRY, ENTRY + "e", 0, FINE, ["function maine", "Did you mean main?"]),
        (ENTRY, ENTRY.removesuffix(":main"), 0, FINE, ["behind a colon"]),
        (ENTRY, ENTRY.replace(".", "/"), 1, NEVER_CALLED, ["`/`", "a build before"]),
        (f"{ENTRY}',", f"{ENTRY}'", 1, NEVER_CALLED, ["A comma is missing", "a build before"]),
        (f"{ENTRY}',", f"{ENTRY},", 1, "SyntaxError", ["cannot read setup.py", "a quote"]),
    ],
)
def test_entry_points(meaning, edit, old, new, code, output, texts):
    edit("setup.py", old, new)
    said = meaning("colcon build", output, code)
    assert [text for text in texts if text not in said] == []


def test_two_entry_points_for_one_function_are_fine(meaning, edit):
    edit("setup.py", f"{PACKAGE}.temperature_subscriber:main", ENTRY)
    assert meaning("colcon build", FINE, 0) is None


@pytest.mark.parametrize("name", ["temperature_publisher", "another"])
def test_a_syntax_error_in_a_file(meaning, package, name):
    (package / PACKAGE / f"{name}.py").write_text("x = 1\ndef f(:\n")
    said = meaning("colcon build --packages-select sensor_simulator", FINE, 0)
    assert f"{PACKAGE}/{name}.py" in said
    assert "line 2" in said


def test_only_the_selected_package_is_spoken_about(meaning, root, package):
    other = root / "src" / "other"
    (other / "other").mkdir(parents=True)
    (other / "other" / "__init__.py").touch()
    (other / "package.xml").write_text(finished("package.xml").replace(f">{PACKAGE}<", ">other<"))
    (other / "setup.py").write_text("from setuptools import setup\nsetup(name='other')\n")
    (other / "setup.cfg").write_text("[install]\ninstall-scripts=$base/lib/other\n")
    (package / PACKAGE / "temperature_publisher.py").write_text("def f(:\n")
    assert "temperature_publisher" in meaning("colcon build", FINE, 0)
    assert meaning("colcon build --packages-select other", FINE, 0) is None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("setup.cfg", "$base/lib/sensor_simulator"),
        (f"{PACKAGE}/__init__.py", "touch src/sensor_simulator/sensor_simulator/__init__.py"),
        ("setup.py", "no setup.py"),
    ],
)
def test_a_part_of_the_package_is_gone(meaning, package, name, text):
    (package / name).unlink()
    assert text in meaning("colcon build", FINE, 0)


def test_the_marker_is_gone(meaning, package):
    (package / "resource" / PACKAGE).unlink()
    output = "error: can't copy 'resource/sensor_simulator': doesn't exist or not a regular file"
    assert "touch resource/sensor_simulator" in meaning("colcon build", output, 1)
    assert meaning("colcon build", FINE, 0) is None


def test_a_python_package_of_another_name_is_fine(meaning, package):
    (package / PACKAGE).rename(package / "nodes")
    path = package / "setup.py"
    path.write_text(path.read_text().replace(f"= {PACKAGE}.", "= nodes."))
    assert meaning("colcon build", FINE, 0) is None


def test_inside_src(meaning, root, package):
    for name in ("build", "install", "log"):
        (root / "src" / name).mkdir()
    assert "You built inside the folder src" in meaning("colcon build", FINE, 0, root / "src")
    assert "inside the folder src" in meaning("cd src; colcon build", FINE, 0, root)
    assert meaning("colcon build", FINE, 0, root) is None
    assert meaning("cd .. && colcon build", FINE, 0, root / "src") is None


def test_packages_that_are_not_there(meaning, root, package):
    output = f"WARNING: ignoring unknown package 'sensor_simulatr' in --packages-select\n{NONE}"
    said = meaning("colcon build --packages-select sensor_simulatr", output, 0)
    assert "Did you mean sensor_simulator?" in said


def test_nothing_to_build(meaning, root):
    assert "holds a package.xml" in meaning("colcon build", NONE, 0)


def test_nothing_to_build_here(meaning, root, package, tmp_path):
    assert "Go to the workspace" in meaning("colcon build", NONE, 0, tmp_path)


def test_two_packages_of_one_name(meaning, root, package):
    shutil.copytree(package, root / "docs" / "copy")
    output = """[0.5s] ERROR:colcon:colcon build: Duplicate package names not supported:
- sensor_simulator:
  - docs/copy
  - src/sensor_simulator
"""
    said = meaning("colcon build", output, 1)
    assert "docs/copy and src/sensor_simulator" in said


def test_a_failure_that_is_not_known(meaning, package):
    assert meaning("colcon build", "Failed <<< sensor_simulator [1.0s]", 1) is None


def test_other_verbs_of_colcon_are_left_alone(meaning, edit):
    edit("setup.py", ENTRY, "nonsense:main")
    assert meaning("colcon list", "sensor_simulator\tsrc/sensor_simulator\n", 0) is None


def test_tests_of_a_package_that_is_not_there(meaning, root, package):
    output = f"WARNING: ignoring unknown package 'nosuch' in --packages-select\n{NONE}"
    assert "so it tested nothing" in meaning("colcon test --packages-select nosuch", output, 0)
    assert meaning("cat log/latest", output, 0) is None


@pytest.mark.parametrize(
    "new",
    [
        f"'{{}} = {ENTRY}'.format('temperature_publisher'),",
        f"'%s = {ENTRY}' % 'temperature_publisher',",
        f"*['temperature_publisher = {ENTRY}'],",
    ],
)
def test_a_list_that_is_computed_is_not_blamed(meaning, edit, new):
    edit("setup.py", f"'temperature_publisher = {ENTRY}',", new)
    assert meaning("colcon build", FINE, 0) is None


def test_two_equals_signs(meaning, edit):
    edit("setup.py", "temperature_publisher = ", "temperature_publisher == ")
    said = meaning("colcon build", FINE, 0)
    assert "more than one `=`" in said
    assert "comma" not in said

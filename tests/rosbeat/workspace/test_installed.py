from rosbeat.workspace.installed import read_installed
from rosbeat.workspace.stages import NODES, PACKAGE


def look(root, package):
    return read_installed(PACKAGE, package, root)


def test_never_built(root, package):
    assert look(root, package) is None


def test_built_and_not_edited(root, package, installed):
    found = look(root, package)
    assert found.prefix == installed
    assert found.executables == NODES
    assert not found.linked
    assert found.changed == ()


def test_edited_since(root, package, installed):
    path = package / PACKAGE / f"{NODES[0]}.py"
    path.write_text(path.read_text() + "# more\n")
    assert look(root, package).changed == (f"{PACKAGE}/{NODES[0]}.py",)


def test_a_new_file_is_not_installed_yet(root, package, installed):
    (package / PACKAGE / "other.py").write_text("x = 1\n")
    assert look(root, package).changed == (f"{PACKAGE}/other.py",)


def test_built_with_links(root, package, installed):
    (installed / "lib/python3.11/site-packages/sensor-simulator.egg-link").write_text("")
    (package / PACKAGE / "other.py").write_text("x = 1\n")
    found = look(root, package)
    assert found.linked
    assert found.changed == ()


def test_without_the_right_to_run_it_is_no_executable(root, package, installed):
    (installed / "lib" / PACKAGE / NODES[0]).chmod(0o644)
    assert look(root, package).executables == (NODES[1],)

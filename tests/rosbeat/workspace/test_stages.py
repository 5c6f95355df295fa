import shutil

import pytest

from rosbeat.workspace import stages
from rosbeat.workspace.packages import read_package
from rosbeat.workspace.stages import NODES, PACKAGE, InTheWay, finished

# What `ros2 pkg create` writes.
EMPTY = """from setuptools import find_packages, setup

package_name = 'sensor_simulator'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='you',
    maintainer_email='you@todo.todo',
    description='TODO: Package description',
    license='TODO: License declaration',
    tests_require=['pytest'],
    entry_points={
        'console_scripts': [
        ],
    },
)
"""


def tree(folder):
    return {one: one.read_bytes() for one in folder.rglob("*") if one.is_file()}


def test_folders_only_where_they_are_missing(root):
    (root / "docs").mkdir()
    assert stages.folders(root) == "the folders scripts and resources/images (page 01)"
    assert stages.folders(root) == ""


def test_the_real_command_makes_the_package(root):
    assert stages.package(root) == f"the package {PACKAGE} (page 02)"
    made = read_package(root / "src" / PACKAGE, root)
    wanted = stages.parse_manifest(finished("package.xml").encode())
    assert made.manifest.build_type == "ament_python"
    assert {"rclpy", "std_msgs"} <= set(made.manifest.depends)
    assert (made.manifest.description, made.manifest.license) == (
        wanted.description,
        wanted.license,
    )
    assert made.has_init
    assert made.has_marker
    assert made.scripts_are_found
    assert "test_flake8.py" in made.tests
    assert "TODO" not in (root / "src" / PACKAGE / "setup.py").read_text()
    assert [one for one in root.iterdir() if one.name.startswith(".")] == []
    before = tree(root)
    assert stages.package(root) == ""
    assert tree(root) == before


def cmake(folder):
    path = folder / "package.xml"
    path.write_text(path.read_text().replace("ament_python", "ament_cmake"))


def nested(folder):
    shutil.move(folder, folder.parent / "x")
    folder.mkdir()
    shutil.move(folder.parent / "x", folder / PACKAGE)


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (cmake, "--build-type ament_python"),
        (nested, "second package"),
        (lambda folder: shutil.move(folder, folder.parents[1]), f"mv {PACKAGE} src/"),
        (lambda folder: shutil.copytree(folder, folder.parents[1] / "docs/a"), "in docs/a"),
        (lambda folder: (folder / "package.xml").write_text("<"), "cannot be read"),
        (lambda folder: (folder / "package.xml").unlink(), "no package.xml"),
        (lambda folder: [shutil.rmtree(folder), folder.mkdir()], "rmdir"),
        (lambda folder: [shutil.rmtree(folder), folder.touch()], "is a file"),
    ],
)
def test_what_is_half_made_is_said_and_not_touched(root, package, spoil, says):
    spoil(package)
    before = tree(root)
    with pytest.raises(InTheWay, match=says):
        stages.package(root)
    assert tree(root) == before


def test_a_command_that_fails_leaves_nothing(root, monkeypatch):
    monkeypatch.setattr(stages, "run_command", lambda *_: (1, "one\nsome error: why\nlast\n"))
    with pytest.raises(InTheWay, match="some error: why"):
        stages.package(root)
    assert list((root / "src").iterdir()) == []


def test_a_node_s_file_is_made_once(root, package):
    path = package / PACKAGE / f"{NODES[0]}.py"
    path.unlink()
    stage = stages.node(NODES[0], "03")
    assert stage(root) == f"{PACKAGE}/{NODES[0]}.py (page 03)"
    assert path.read_text() == finished(f"{PACKAGE}/{NODES[0]}.py")
    path.write_text("mine\n")
    assert stage(root) == ""
    assert path.read_text() == "mine\n"


@pytest.mark.parametrize("text", [EMPTY, "# mine\n" + EMPTY.replace("[\n        ]", "[]")])
def test_entry_points_go_into_an_empty_list(root, package, text):
    (package / "setup.py").write_text(text)
    assert stages.entry_points(root) == "the entry points in setup.py (page 05)"
    found = read_package(package, root)
    assert [one.executable for one in found.setup.entry_points] == list(NODES)
    assert found.flaws == ()
    assert (root / f"kept/src/{PACKAGE}/setup.py-1").read_text() == text
    assert (package / "setup.py").read_text().startswith(text[:60])
    assert stages.entry_points(root) == ""


def test_nothing_else_in_the_file_changes(root, package):
    (package / "setup.py").write_text(EMPTY)
    stages.entry_points(root)
    lines = (package / "setup.py").read_text().splitlines(keepends=True)
    added = [line for line in lines if "temperature_" in line]
    assert "".join(line for line in lines if line not in added) == EMPTY
    assert [len(line) - len(line.lstrip()) for line in added] == [12, 12]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (finished("setup.py").replace("temperature_subscriber = ", "monitor = "), "subscriber"),
        (EMPTY.replace("'console_scripts': [", "'console_scripts': "), "cannot be read"),
        ("from setuptools import setup\nsetup(name='a')\n", "page 05"),
        (EMPTY.replace("[\n        ]", "()"), "I see no entry point"),
        (EMPTY.replace("[\n        ]", "names()"), "I see no entry point"),
        ("x = 1\n", r"it does not call setup\(\)\."),
    ],
)
def test_a_setup_py_of_one_s_own_stays(root, package, text, says):
    (package / "setup.py").write_text(text)
    with pytest.raises(InTheWay, match=says):
        stages.entry_points(root)
    assert (package / "setup.py").read_text() == text


def test_what_is_built_is_not_built_again(root, installed, monkeypatch):
    monkeypatch.setattr(stages, "run_command", lambda *_: pytest.fail("it was built"))
    assert stages.build(root) == ""


def test_a_build_that_fails_says_why(root, package, monkeypatch, capsys):
    output = "Starting\nRuntimeError: boom.\nSummary: 0 packages\n"
    monkeypatch.setattr(stages, "run_command", lambda *_: (1, output))
    with pytest.raises(InTheWay, match="RuntimeError: boom"):
        stages.build(root)
    assert "Building" in capsys.readouterr().out


def test_a_setup_py_that_is_not_there(root, package):
    (package / "setup.py").unlink()
    with pytest.raises(InTheWay, match="is not there"):
        stages.entry_points(root)


def test_a_setup_py_keeps_its_encoding_and_its_line_ends(root, package):
    text = "# -*- coding: latin-1 -*-\n# é\n" + EMPTY
    data = text.replace("\n", "\r\n").encode("latin-1")
    (package / "setup.py").write_bytes(data)
    assert stages.entry_points(root)
    after = (package / "setup.py").read_bytes()
    assert after.startswith(data[:60])
    assert after.count(b"\n") == after.count(b"\r\n") == data.count(b"\n") + 2
    assert (root / f"kept/src/{PACKAGE}/setup.py-1").read_bytes() == data


def test_another_page_makes_the_package_at_the_same_time(root, monkeypatch):
    def slow(command, folder, seconds):
        for place in (folder / PACKAGE, root / "src" / PACKAGE):
            place.mkdir()
            for name in ("package.xml", "setup.py"):
                (place / name).write_text(finished(name))
        return 0, ""

    monkeypatch.setattr(stages, "run_command", slow)
    with pytest.raises(InTheWay, match="another page has just made the package: run the cell"):
        stages.package(root)
    assert [one for one in root.iterdir() if one.name.startswith(".")] == []

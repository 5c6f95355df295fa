"""`catch_up` makes what earlier pages leave, and touches nothing that is there."""

import shutil
import sys
from types import SimpleNamespace

import pytest

from rosbeat.errors import WorkspaceError
from rosbeat.workspace import catch_up, prerequisites
from rosbeat.workspace.packages import read_package
from rosbeat.workspace.prerequisites import NODES, PACKAGE, finished
from rosbeat.workspace.terminals import terminals_of

# What `ros2 pkg create` writes, as far as it matters here.
EMPTY = """from setuptools import find_packages, setup

package_name = 'sensor_simulator'

setup(
    name=package_name,
    packages=find_packages(exclude=['test']),
    entry_points={
        'console_scripts': [
        ],
    },
)
"""


def tree(folder):
    return {one: one.read_bytes() for one in folder.rglob("*") if one.is_file()}


@pytest.fixture
def furnished(root, package):
    """The workspace as page 05 finds it."""
    catch_up("05")
    return root


@pytest.mark.timeout(300)  # a build, while other tests keep the machine busy
def test_the_whole_course_from_nothing_and_it_can_be_built(root, capsys):
    report = catch_up("07")
    assert report.complete
    assert [one.split("(")[1][:7] for one in report.made] == [
        f"page 0{page}" for page in range(1, 7)
    ]
    found = read_package(root / "src" / PACKAGE, root)
    assert found.installed.executables == NODES
    assert found.installed.changed == ()
    assert found.flaws == ()
    assert "Building" in capsys.readouterr().out
    assert repr(catch_up("07")) == "Everything that this page needs exists."
    assert capsys.readouterr().out == ""


def test_only_what_comes_before_the_page(root):
    assert catch_up("01").made == ()
    (root / "docs").mkdir()
    assert catch_up("02").made == ("the folders scripts and resources/images (page 01)",)
    assert list((root / "src").iterdir()) == []


def test_the_real_command_makes_the_package(root):
    assert str(catch_up("03")).endswith(f"the package {PACKAGE} (page 02).")
    made = read_package(root / "src" / PACKAGE, root)
    assert made.manifest.build_type == "ament_python"
    assert {"rclpy", "std_msgs"} <= set(made.manifest.depends)
    assert made.has_init
    assert made.has_marker
    assert made.scripts_are_found
    for name in ("package.xml", "setup.py"):
        assert "TODO" not in (root / "src" / PACKAGE / name).read_text()
    before = tree(root)
    assert catch_up("03").made == ()
    assert tree(root) == before


def test_what_is_there_stays(root, package):
    mine = package / PACKAGE / f"{NODES[0]}.py"
    mine.write_text("mine\n")
    (package / PACKAGE / f"{NODES[1]}.py").unlink()
    assert f"{PACKAGE}/{NODES[1]}.py (page 04)" in catch_up("05").made
    assert mine.read_text() == "mine\n"
    assert (package / "setup.py").read_text() == finished("setup.py")


def cmake(folder):
    path = folder / "package.xml"
    path.write_text(path.read_text().replace("ament_python", "ament_cmake"))


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (cmake, "--build-type ament_python"),
        (lambda folder: shutil.move(folder, folder.parents[1]), f"mv {PACKAGE} src/"),
        (lambda folder: shutil.copytree(folder, folder.parents[1] / "docs/a"), "in docs/a"),
        (lambda folder: (folder / "package.xml").write_text("<"), "is not a package"),
        (lambda folder: [shutil.rmtree(folder), folder.mkdir()], "is not a package"),
        (lambda folder: [shutil.rmtree(folder), folder.touch()], "is not a package"),
    ],
)
def test_what_is_half_made_is_said_and_not_touched(furnished, package, spoil, says):
    spoil(package)
    before = tree(furnished)
    report = catch_up("06")
    assert not report.complete
    shown = str(report)
    assert all(len(line) <= 100 for line in shown.splitlines())
    assert says in " ".join(shown.split())
    assert tree(furnished) == before


@pytest.mark.parametrize("page", ["03", "07"])
def test_a_command_that_fails_says_why_and_leaves_nothing(root, package, monkeypatch, page):
    if page == "03":
        shutil.rmtree(package)
    monkeypatch.setattr(
        prerequisites, "run_command", lambda *_: (1, "one\nsome error: why\nlast\n")
    )
    assert "some error: why" in str(catch_up(page))
    assert package.exists() == (page != "03")


@pytest.mark.parametrize(
    "text",
    [
        EMPTY,
        "# mine\n" + EMPTY.replace("[\n        ]", "[]"),
        EMPTY.replace("        ],\n    },", "            # mine\n        ],\n    },"),
    ],
)
def test_entry_points_go_into_an_empty_list_and_nothing_else_changes(furnished, package, text):
    (package / "setup.py").write_text(text)
    assert catch_up("06").made == ("the entry points in setup.py (page 05)",)
    found = read_package(package, furnished)
    assert [one.executable for one in found.setup.entry_points] == list(NODES)
    assert found.flaws == ()
    assert (furnished / f"kept/src/{PACKAGE}/setup.py-1").read_text() == text
    after = (package / "setup.py").read_text()
    kept = [line for line in after.splitlines() if "            'temperature_" not in line]
    assert "".join("".join(kept).split()) == "".join(text.split())


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (finished("setup.py").replace("temperature_subscriber = ", "monitor = "), "subscriber"),
        (EMPTY.replace("'console_scripts': [", "'console_scripts': "), "cannot be read"),
        ("from setuptools import setup\nsetup(name='a')\n", "page 05"),
        (EMPTY.replace("[\n        ]", "names()"), "has no entry point"),
        ("x = 1\n", "it does not call setup()."),
        (None, "cannot be read: No such file"),
    ],
)
def test_a_setup_py_of_one_s_own_stays(furnished, package, text, says):
    path = package / "setup.py"
    path.unlink() if text is None else path.write_text(text)
    assert says in " ".join(str(catch_up("06")).split())
    assert (path.read_text() if path.exists() else None) == text


@pytest.mark.parametrize("page", ["", "setup", None])
def test_no_such_page(root, says, page):
    with pytest.raises(WorkspaceError) as caught:
        catch_up(page)
    says(caught.value)


def test_a_program_that_is_not_installed_or_does_not_end(root, says, monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    with pytest.raises(WorkspaceError) as caught:
        catch_up("03")
    says(caught.value, "ros2", "not installed")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "ros2").write_text("#!/bin/sh\nexec sleep 100\n")
    (tmp_path / "bin" / "ros2").chmod(0o755)
    monkeypatch.setattr(prerequisites, "_MAKING", 0.1)
    with pytest.raises(WorkspaceError) as caught:
        catch_up("03")
    says(caught.value, "did not finish within 0.1 seconds")


@pytest.fixture
def page(root, monkeypatch):
    """The kernel of a page, whose terminals are closed afterwards."""
    space = {}
    held = SimpleNamespace(user_ns=space)
    monkeypatch.setattr("IPython.get_ipython", lambda: held)
    monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
    monkeypatch.chdir(root)
    yield held
    terminals_of(held).close()


def by_server(_, monkeypatch, __):
    monkeypatch.setenv("JPY_SESSION_NAME", "/home/ana/my_course/02_create_a_package.ipynb")


def by_vs_code(page, _, __):
    page.user_ns["__vsc_ipynb_file__"] = "/home/ana/my_course/02_create_a_package.ipynb"


def by_folder(_, __, root):
    (root / "02_create_a_package.ipynb").touch()
    (root / "notes.ipynb").touch()


@pytest.mark.parametrize("named", [by_server, by_vs_code, by_folder])
def test_the_first_terminal_of_a_page_catches_up_once_and_says_so(
    page, root, monkeypatch, capsys, named
):
    named(page, monkeypatch, root)
    for name in ("build", "other"):
        terminals_of(page).get(name)
    (said, rest) = capsys.readouterr().out.split("\n", 1)
    assert said.startswith("Created for you, because it did not exist yet: the folders docs,")
    assert rest.count("\n") <= 1  # one sentence
    assert (root / "scripts").is_dir()


@pytest.mark.parametrize("pages", [(), ("12_beyond_topics",), ("02_a", "05_b")])
def test_a_page_that_needs_nothing_or_is_not_known_makes_nothing(page, root, capsys, pages):
    for name in pages:
        (root / f"{name}.ipynb").touch()
    terminals_of(page).get("build")
    assert capsys.readouterr().out == ""
    assert not (root / "docs").exists()


def test_what_stands_in_the_way_is_said(page, root, monkeypatch, capsys):
    by_server(page, monkeypatch, root)
    (root / "docs").write_text("")
    terminals_of(page).get("build")
    assert "Please check: docs is a file" in capsys.readouterr().out

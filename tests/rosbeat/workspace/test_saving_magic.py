"""`%%save` in a shell of IPython, with the package in place unless a test says otherwise."""

import linecache
import shutil
import sys

import pytest

from rosbeat import Session
from rosbeat.workspace.catching_up import PACKAGE, finished
from rosbeat.workspace.saving_magic import with_body

PUBLISHER = f"src/{PACKAGE}/{PACKAGE}/temperature_publisher.py"
MODULE = f"{PACKAGE}.temperature_publisher"


@pytest.fixture
def run(shell, package, capsys):
    """Run a cell; returns whether it went well, the exception, and what the page shows."""

    def run(cell):
        result = shell.run_cell(cell, store_history=True)
        return result, capsys.readouterr().out

    return run


def test_a_module_is_saved_and_runs_and_main_does_not(run, root, shell):
    text = finished(f"{PACKAGE}/temperature_publisher.py")
    result, shown = run(f"%%save {PUBLISHER}\n{text}")
    assert result.success
    assert shown == f"saved {PUBLISHER}\n"
    assert (root / PUBLISHER).read_text() == text
    assert shell.user_ns["TemperatureSensor"].__module__ == MODULE


def test_the_page_is_itself_again_afterwards(run, shell):
    names = "import sys\nname, file, page = __name__, __file__, sys.modules[__name__].__dict__"
    run(f"%%save {PUBLISHER}\n{names}\nseen = page is globals()\n")
    assert shell.user_ns["name"] == MODULE
    assert shell.user_ns["file"].endswith(PUBLISHER)
    assert shell.user_ns["seen"] is True
    assert shell.user_ns["__name__"] == "__main__"
    assert "__file__" not in shell.user_ns
    assert MODULE not in sys.modules


@pytest.mark.parametrize("raises", ["1 / 0", "raise SystemExit", "raise KeyboardInterrupt", "def"])
def test_it_is_itself_after_an_error_too(run, root, shell, raises):
    result, _ = run(f"%%save {PUBLISHER}\nx = 1\n{raises}\n")
    assert not result.success
    assert shell.user_ns["__name__"] == "__main__"
    assert MODULE not in sys.modules
    assert (root / PUBLISHER).read_text() == f"x = 1\n{raises}\n"


def test_a_dataclass_with_texts_for_types_works_as_in_a_file(run):
    result, _ = run(f"""%%save {PUBLISHER}
from __future__ import annotations
from dataclasses import dataclass

@dataclass
class Reading:
    celsius: float
""")
    assert result.success


def test_an_error_shows_the_cell_s_own_lines_and_none_of_ours(run):
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\n\nprint(missing)\n")
    assert isinstance(result.error_in_exec, NameError)
    assert "Cell In[1], line 4" in shown
    assert "----> 4 print(missing)" in shown
    assert "rosbeat" not in shown
    assert "run_cell_magic" not in shown


def test_an_error_in_a_later_cell_names_the_cell_that_was_saved(run):
    run(f"%%save {PUBLISHER}\ndef divide():\n    return 1 / 0\n")
    _, shown = run("divide()")
    assert "Cell In[1], line 3, in divide()" in shown
    assert "----> 3     return 1 / 0" in shown


def test_a_syntax_error_is_shown_as_in_any_cell_and_the_work_is_saved(run, root):
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\ndef f(:\n    pass\n")
    assert not result.success
    assert type(result.error_in_exec).__name__ == "SyntaxError"
    assert "Cell In[1], line 3" in shown
    assert "    def f(:" in shown
    assert "rosbeat" not in shown
    assert (root / PUBLISHER).read_text() == "x = 1\ndef f(:\n    pass\n"


@pytest.mark.parametrize("line", ["%time 3", "!ls", "x = !ls", "print?", "%%time"])
def test_commands_of_the_notebook_are_no_part_of_a_file(run, root, line):
    before = (root / PUBLISHER).read_text()
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\n{line}\n")
    assert not result.success
    assert "line 2" in shown
    assert "a cell of its own" in shown
    assert (root / PUBLISHER).read_text() == before


def test_percent_signs_of_python_are_fine(run):
    assert run(f'%%save {PUBLISHER}\nx = 7\ny = (x\n  % 2)\nz = """\n%time\n"""\n')[0].success


def test_a_blank_is_not_saved_and_the_page_goes_on(run, root, shell):
    before = (root / PUBLISHER).read_text()
    result, shown = run(f"%%save {PUBLISHER}\ndef f():\n    return ____\n")
    assert result.success
    assert shown == "not saved: there is still a blank in line 2 of temperature_publisher.py\n"
    assert (root / PUBLISHER).read_text() == before
    assert "f" in shell.user_ns


def test_a_name_with_underscores_is_no_blank(run):
    assert run(f"%%save {PUBLISHER}\n__all__ = ['____init____']\n")[1].startswith("saved")


@pytest.mark.parametrize("name", ["setup.py", "setup.cfg", "test/test_more.py", "package.xml"])
def test_other_files_are_only_saved(run, root, name):
    result, shown = run(f"%%save src/{PACKAGE}/{name}\nthis is = no code: at all\n")
    assert result.success
    assert shown.startswith(f"saved src/{PACKAGE}/{name}")
    assert (root / "src" / PACKAGE / name).read_text() == "this is = no code: at all\n"


def test_the_same_cell_again_says_nothing_about_copies(run, root):
    (root / PUBLISHER).unlink()
    for _ in range(3):
        assert run(f"%%save {PUBLISHER}\nx = 1\n")[1] == f"saved {PUBLISHER}\n"
    assert not (root / "kept").exists()


@pytest.mark.parametrize(
    ("path", "name"),
    [
        (f"src/{PACKAGE}/{PACKAGE}/deep/node.py", f"{PACKAGE}.deep.node"),
        (f"src/{PACKAGE}/{PACKAGE}/__init__.py", PACKAGE),
        (f"src/{PACKAGE}/second/a.py", "second.a"),
        (f"src/{PACKAGE}/{PACKAGE}/a-b.py", None),
        (f"src/{PACKAGE}/no_package/a.py", None),
        (f"src/{PACKAGE}/test/test_a.py", None),
        ("scripts/a.py", None),
    ],
)
def test_which_files_are_modules(run, shell, package, path, name):
    (package / "second").mkdir()
    (package / "second" / "__init__.py").touch()
    assert run(f"%%save {path}\nseen = __name__\n")[0].success
    assert shell.user_ns.get("seen") == name


def test_what_is_there_may_be_saved_again(run, package):
    (package / "tool.py").touch()
    assert run(f"%%save src/{PACKAGE}/tool.py\nx = 1\n")[0].success


def test_a_module_that_is_imported_stays_the_imported_one(run, package):
    import json

    (package / "json").mkdir()
    (package / "json" / "__init__.py").touch()
    run(f"%%save src/{PACKAGE}/json/__init__.py\nseen = __name__\n")
    assert sys.modules["json"] is json


def test_dollars_and_braces_in_a_path_stay(run, root):
    run("x = 'no'")
    run("%%save docs/{x}$x.md\nhello\n")
    assert (root / "docs/{x}$x.md").exists()


@pytest.mark.parametrize("line", ["", "../a.py", "src/sensor_simulater/a.py"])
def test_a_bad_path_is_an_error_in_three_parts(run, line):
    result, shown = run(f"%%save {line}\nx = 1\n")
    assert not result.success
    assert "What it means" in shown
    assert "What to try" in shown


def test_a_misspelt_package_gets_the_right_name(run):
    assert "Did you mean sensor_simulator?" in run("%%save src/sensor_simulater/a.py\nx\n")[1]


def test_a_missing_package_is_made_and_that_is_said(run, root, package):
    shutil.rmtree(package)
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\n")
    assert result.success
    assert "Made for you" in shown
    assert f"saved {PUBLISHER}" in shown
    assert (root / PUBLISHER).read_text() == "x = 1\n"


def test_a_package_that_is_half_made_is_not_filled(run, package):
    shutil.rmtree(package)
    package.mkdir()
    result, shown = run(f"%%save {PUBLISHER}\nx = 1\n")
    assert not result.success
    assert "rmdir" in shown
    assert list(package.iterdir()) == []


@pytest.mark.ros
def test_a_fault_of_a_saved_class_points_at_the_cell_s_line(run, shell):
    text = finished(f"{PACKAGE}/temperature_publisher.py").replace("msg.data =", "msg.value =")
    result, _ = run(f"%%save {PUBLISHER}\n{text}")
    assert result.success
    line = [number for number, one in enumerate(text.splitlines(), 2) if "msg.value" in one]
    with Session(seed=1) as ros:
        ros.add(shell.user_ns["TemperatureSensor"])
        ros.run(1, quiet=True)
        (fault,) = ros.observation().faults
    assert [fault.line] == line
    assert fault.code == "msg.value = self.temperature"
    linecache.checkcache()


@pytest.mark.parametrize("body", ["", "\n", "\n\n  \n"])
def test_a_cell_without_a_body_says_what_is_missing(run, root, body):
    before = (root / PUBLISHER).read_text()
    result, shown = run(f"%%save {PUBLISHER}{body}")
    assert not result.success
    assert "there is nothing to save" in shown
    assert "line magic" not in shown
    assert (root / PUBLISHER).read_text() == before


def test_other_cells_of_one_line_stay_as_they_are():
    for line in ("x = 1\n", "%%saved a\n", "%save a\n"):
        assert with_body([line]) == [line]
    assert with_body(["%%save a"]) == ["%%save a\n", "\n"]


@pytest.mark.parametrize(
    ("typed", "text"),
    [
        (f"{PUBLISHER} # my file", f"Leave the comment out:  {PUBLISHER}"),
        (PUBLISHER.replace("/", "\\"), PUBLISHER),
        (f"{PACKAGE}/temperature_publisher.py", f"Did you mean {PUBLISHER}?"),
        (f"{PACKAGE}/{PACKAGE}/temperature_publisher.py", f"Did you mean {PUBLISHER}?"),
        (f"src/{PACKAGE}/temperature_publisher.py", f"Did you mean {PUBLISHER}?"),
        (f"{PACKAGE}/setup.py", f"Did you mean src/{PACKAGE}/setup.py?"),
        (f"ROS2_and_RL_Tutorials/{PUBLISHER}", f"Leave the first part out:  {PUBLISHER}"),
        ("other/other/a.py", "Did you mean src/other/other/a.py?"),
        ("other/a.py", "Did you mean src/other/other/a.py?"),
        ("src/other/a.py", "Did you mean src/other/other/a.py?"),
        ("linked/a.py", "kept is not for files of yours"),
    ],
)
def test_a_path_that_is_not_quite_one(run, root, typed, text):
    (root / "src" / "other" / "other").mkdir(parents=True)
    (root / "src" / "other" / "package.xml").touch()
    (root / "kept").mkdir()
    (root / "linked").symlink_to("kept")
    before = sorted(root.rglob("*"))
    result, shown = run(f"%%save {typed}\nx = 1\n")
    assert not result.success
    assert text in shown
    assert sorted(root.rglob("*")) == before

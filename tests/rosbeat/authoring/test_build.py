"""What `rosbeat build` compares, writes, keeps and removes."""

from __future__ import annotations

import os
import stat

import nbformat
import pytest

from rosbeat.authoring import build as builder
from rosbeat.authoring.build import compare, package_files, write
from rosbeat.errors import LessonError

BODY = "# %%\nprint('hello')"
EXERCISE = """
# %% exercise="00a"
def f():
    # --- answer
    return 17 + 4
    # --- blank
    # return ____
    # --- end
"""
CHECK = """
# %% check="00a"
f
"""


@pytest.fixture
def told():
    return []


@pytest.fixture
def build(checkout, told):
    """Build the checkout and return the kind of each change by the file's name."""

    def run(**plan):
        found = builder.build(checkout.course, builder.Plan(**plan), told.append)
        return {change.path.name: change.kind for change in found}

    return run


def contents(checkout):
    return {path: path.read_bytes() for path in checkout.course.root.rglob("*.ipynb")}


def test_a_check_writes_nothing_and_a_second_build_changes_not_one_byte(checkout, told, build):
    checkout.write(BODY)
    assert build(check=True, run=False) == {"00_hear_it.ipynb": "new"}
    assert contents(checkout) == {}
    assert build() == {"00_hear_it.ipynb": "new"}
    before = contents(checkout)
    assert len(before) == 2
    assert build() == {}
    assert contents(checkout) == before
    assert told[-1] == "same     solutions/00_hear_it.ipynb"


def test_a_page_without_a_lesson_goes_if_it_is_ours(checkout, build):
    path = checkout.write(BODY)
    build(run=False)
    path.unlink()
    checkout.write(BODY, name="00_say_it", title="Say it")
    theirs = checkout.course.notebooks / "theirs.ipynb"
    theirs.write_text('{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}')
    wanted = {"00_say_it.ipynb": "new", "00_hear_it.ipynb": "stale"}
    assert build(run=False, check=True) == wanted
    assert build(run=False) == wanted
    assert sorted(path.name for path in contents(checkout)) == ["00_say_it.ipynb", theirs.name]


def test_a_broken_rule_stops_the_build_before_anything_is_written(checkout, build):
    checkout.write("# %%\nreturn ____")
    with pytest.raises(LessonError, match="stray-blank") as caught:
        build()
    assert "nothing was built" in caught.value.means
    assert contents(checkout) == {}


# Several pages run at once, each in a process of its own.


def test_pages_that_run_together_are_the_pages_that_run_alone(checkout, build):
    for number, name in enumerate(["00_hear_it", "01_hear_it"]):
        checkout.write(f"# %%\nprint({number} + 10)", name=name)
    build()
    together = contents(checkout)
    assert b'"11\\n"' in together[checkout.course.solutions / "01_hear_it.ipynb"]
    assert build(names=("01_hear_it",), fresh=True) == {}
    assert contents(checkout) == together


def test_an_error_comes_from_the_other_process_with_all_three_parts(checkout, build):
    for name, code in {"00_hear_it": "1", "01_hear_it": "1 / 0"}.items():
        checkout.write(f"# %%\n{code}", name=name)
    with pytest.raises(LessonError, match="ZeroDivisionError") as caught:
        build()
    assert "does not run to the bottom" in caught.value.means
    assert caught.value.to_try


# A learner's work is kept.


@pytest.fixture
def page(checkout, build):
    """A learner's page, as it was built."""
    checkout.write(BODY)
    build(run=False)
    return checkout.course.notebooks / "00_hear_it.ipynb"


def worked_in(page, count=1, source="x = 1"):
    notebook = nbformat.read(page, as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    code[-1].update(execution_count=count, source=source)
    nbformat.write(notebook, page)
    return page.read_text()


def test_work_is_copied_aside_whole_and_never_overwritten(page, told, build):
    works = []
    for number in (1, 2):
        works.append(worked_in(page, source=f"x = {number}"))
        assert build(run=False, check=True) == {page.name: "changed"}
        assert page.read_text() == works[-1]
        build(run=False)
        assert "x = " not in page.read_text()
    kept = page.parent / "kept"
    assert [(kept / f"00_hear_it-{n}.ipynb").read_text() for n in (1, 2)] == works
    assert "kept     notebooks/kept/00_hear_it-1.ipynb: somebody had worked in this page" in told


def test_a_page_that_goes_is_kept_and_one_that_nobody_ran_is_not(page, checkout, build):
    checkout.write(BODY + "\n# changed")
    build(run=False)
    assert not (page.parent / "kept").exists()
    worked_in(page)
    (checkout.course.sources / "00_hear_it.py").unlink()
    assert build(run=False) == {page.name: "stale"}
    assert [path.name for path in contents(checkout)] == ["00_hear_it-1.ipynb"]


# What counts as a difference.


@pytest.mark.parametrize(
    "text",
    [
        b'{"image/png": "%s", "text/plain": "a node"}',
        b'{"text/html": ["<img alt=\\"a node\\"\\n", "src=\\"data:image/png;base64,%s\\">"]}',
    ],
)
def test_other_pixels_alone_do_not_matter_and_words_do(tmp_path, text):
    path = tmp_path / "a.ipynb"
    path.write_bytes(text % b"iVBOR/+==")
    change = compare(path, text % b"AAAA")
    assert (change.kind, change.matters) == ("pictures", False)
    assert compare(path, (text % b"AAAA").replace(b"a node", b"two")).matters
    assert compare(path, b"{}").matters


def test_a_long_difference_is_cut(tmp_path):
    path = tmp_path / "a.ipynb"
    path.write_text("old\n" * 100)
    change = compare(path, b"new\n" * 100)
    assert (change.kind, change.matters) == ("changed", True)
    assert change.diff.startswith("--- on disk\n+++ from source\n")
    assert "more lines" in change.diff
    assert len(change.diff.splitlines()) < 50


# Writing.


def test_a_write_that_fails_leaves_the_old_page_and_no_rest(tmp_path, monkeypatch):
    path = tmp_path / "a.ipynb"
    write(path, b"old")
    assert stat.S_IMODE(path.stat().st_mode) == 0o644

    def refuse(*_):
        raise OSError("no")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OSError, match="no"):
        write(path, b"new")
    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.ipynb"]


# The answers that `hint` gives last.

ANSWERS = (
    EXERCISE
    + EXERCISE.replace("def f", "def g").replace("17", "f()")
    + CHECK
    + """
# %% terminal="one" exercise="00b"
# --- answer
# cd ../images
# --- blank
# # cd ____
# --- end

# %% check="00b"
f
"""
)


def test_answers_are_written_checked_and_removed_when_stale(checkout, build):
    folder = checkout.course.root / "src/rosbeat/exercises/solved"
    folder.parent.mkdir(parents=True)
    checkout.write(ANSWERS)

    def changes(**plan):
        return {name: kind for name, kind in build(run=False, **plan).items() if ".txt" in name}

    assert changes(check=True) == {"00a.txt": "new", "00b.txt": "new"}
    assert not folder.exists()
    changes()
    assert {path.name: path.read_text() for path in folder.iterdir()} == {
        "00a.txt": "def f():\n    return 17 + 4\n\n\ndef g():\n    return f() + 4\n",
        "00b.txt": "%%terminal one\ncd ../images\n",
    }
    assert changes(check=True) == {}
    (folder / "00a.txt").write_text("something else")
    (folder / "00z.txt").write_text("nobody makes it")
    for check in (True, False):
        assert changes(check=check) == {"00a.txt": "changed", "00z.txt": "stale"}
    assert sorted(path.name for path in folder.iterdir()) == ["00a.txt", "00b.txt"]


def test_a_course_without_the_package_has_no_place_for_answers(checkout, build):
    checkout.write(ANSWERS)
    assert build(run=False) == {"00_hear_it.ipynb": "new"}


# The finished package.

SAVES = """
    # %% save="src/sensor_simulator/sensor_simulator/node.py"
    print("the first version")

    # %% save="src/sensor_simulator/sensor_simulator/node.py" exercise="00a"
    def main():
        # --- answer
        print("the answer")
        # --- blank
        # ____
        # --- end

    # %% check="00a"
    check("00a")

    # %% save="src/other/file.txt"
    # not of this package
"""
NODE = "sensor_simulator/node.py"


def test_the_package_is_what_the_command_makes_what_pages_save_and_what_is_by_hand(checkout):
    by_hand = checkout.course.sources / "sensor_simulator" / "test" / "test_it.py"
    by_hand.parent.mkdir(parents=True)
    by_hand.write_text("def test_it():\n    pass\n")
    course = checkout.course
    files = package_files(course, [checkout.lesson(SAVES)])
    home = course.solutions / "sensor_simulator"
    assert b"Apache-2.0" in files[home / "package.xml"]
    assert files[home / "resource/sensor_simulator"] == b""
    assert files[home / "test/test_it.py"] == by_hand.read_bytes()
    assert files[home / NODE] == b'def main():\n    print("the answer")\n'
    assert files[home / NODE] == files[course.root / "src/rosbeat/workspace/finished" / NODE]
    assert home / "test/test_copyright.py" not in files
    assert not [path for path in files if path.name == "file.txt"]
    assert files == package_files(course, [checkout.lesson(SAVES)])


def test_files_of_the_package_that_nothing_makes_any_more_go(checkout, build):
    checkout.write(SAVES)
    build(run=False)
    home = checkout.course.solutions / "sensor_simulator"
    (home / "__pycache__").mkdir()
    for name in ("gone.py", "__pycache__/node.pyc"):
        (home / name).touch()
    assert build(run=False) == {"gone.py": "stale"}
    assert (home / "package.xml").exists()
    assert not (home / "gone.py").exists()


def test_without_the_command_the_builder_says_so(checkout, monkeypatch):
    monkeypatch.setattr("sys.executable", "/nowhere/bin/python")
    with pytest.raises(LessonError, match="ros2 pkg create failed"):
        package_files(checkout.course, [checkout.lesson(SAVES)])

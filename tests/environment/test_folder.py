"""The learner's own folder: copies, work of earlier versions, `reset` and `update`."""

import errno
import json
import os
import subprocess

import pytest

from course_tool import cli, folder, installing
from course_tool.layout import Layout
from course_tool.problems import Problem

BLANK, ANSWER = "class Sensor: ____", "class Sensor: pass"


def cell(source, exercise="", outputs=(), **more):
    about = {"rosbeat": {"exercise": exercise}} if exercise else {}
    code = {"cell_type": "code", "metadata": about, "execution_count": None}
    return {**code, "source": source, "outputs": list(outputs), **more}


def page(*cells):
    about = {"kernelspec": {"name": "python3", "display_name": "Python 3 (ipykernel)"}}
    whole = {"cells": list(cells), "metadata": about, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(whole).encode()


def sources(path):
    return ["".join(one["source"]) for one in json.loads(path.read_bytes())["cells"]]


SHIPPED = page(cell("import rosbeat"), cell(BLANK, "03a"), cell("____", "03b"))
NEW = page(cell("import rosbeat  # newer"), cell(BLANK, "03a"), cell("____ # newer", "03b"))
WORKED = page(
    cell("import rosbeat", execution_count=1), cell(ANSWER, "03a", execution_count=2),
    cell("mine", "03b"),
)  # fmt: skip
TYPED = page(cell("import rosbeat"), cell(ANSWER, "03a"), cell("____", "03b"))
NAME = "03_write.ipynb"


@pytest.fixture
def course(layout, monkeypatch):
    """A course of two pages, a solution and its package; no git."""
    monkeypatch.delenv("ROSBEAT_WORKSPACE_IN", raising=False)
    monkeypatch.setattr(cli, "of_this_checkout", lambda: layout)
    for name, content in {
        "notebooks/00_hear.ipynb": page(cell("print(1)")),
        "notebooks/home.ipynb": page(cell("progress()")),
        "docs/glossary.md": b"A node: [page 00](../notebooks/00_hear.ipynb).",
        f"notebooks/{NAME}": SHIPPED,
        f"solutions/{NAME}": page(cell(ANSWER, "03a", outputs=[{"output_type": "stream"}])),
        "solutions/sensor_simulator/setup.py": b"setup()",
    }.items():
        path = layout.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return layout


@pytest.fixture
def committed(course):
    """The same as a clone."""
    git(course, "init", "-q")
    commit(course)
    return course


def git(course, *arguments):
    own = ["-c", "user.name=ada", "-c", "user.email=ada@example.org", "-C", course.root]
    subprocess.run(["git", *own, *arguments], check=True, capture_output=True)


def commit(course):
    git(course, "add", "notebooks")
    git(course, "commit", "-qm", "All pages")


def listed(place):
    return sorted(path.name for path in place.iterdir() if not path.name.startswith("."))


def test_it_has_what_a_learner_needs_and_nothing_else(course, capsys):
    folder.make(course)
    found = ["00_hear.ipynb", NAME, "COLCON_IGNORE", "docs", "home.ipynb", "solutions"]
    assert listed(course.learner) == found
    assert capsys.readouterr().out == "Your own pages are in the folder my_course.\n"
    assert sources(course.learner / NAME) == ["import rosbeat", BLANK, "____"]
    about = json.loads((course.learner / NAME).read_bytes())["metadata"]  # as JupyterLab saves it
    assert about["kernelspec"]["display_name"] == installing.KERNEL
    assert about["kernelspec"]["name"] == "python3"


def test_copies_are_made_once(course, capsys):
    folder.make(course)
    (course.learner / NAME).write_bytes(WORKED)
    (course.learner / "00_hear.ipynb").unlink()
    capsys.readouterr()
    folder.make(course)
    assert (course.learner / NAME).read_bytes() == WORKED
    assert not (course.learner / "00_hear.ipynb").exists()
    assert capsys.readouterr().out == ""


def test_notes_on_the_home_page_stay_and_are_kept_beside_a_newer_one(course, capsys):
    folder.make(course)
    home, notes = course.learner / "home.ipynb", page(cell("progress()"), cell("my notes"))
    home.write_bytes(notes)
    folder.make(course)
    assert home.read_bytes() == notes
    (course.shipped / "home.ipynb").write_bytes(page(cell("progress()  # newer")))
    capsys.readouterr()
    folder.make(course)
    assert sources(home) == ["progress()  # newer"]
    assert (course.learner / "home-kept-1.ipynb").read_bytes() == notes
    assert "yours is kept as my_course/home-kept-1.ipynb" in capsys.readouterr().out
    folder.make(course)
    assert not (course.learner / "home-kept-2.ipynb").exists()


def test_something_else_has_the_name_of_the_folder(course, capsys):
    course.learner.symlink_to(course.root / "gone")
    assert cli.main(["update"]) == 1
    assert "What happened:       my_course is not a folder" in capsys.readouterr().err
    assert course.learner.is_symlink()


def test_a_page_that_is_added_to_the_course_comes_too(course):
    folder.make(course)
    (course.shipped / "04_listen.ipynb").write_bytes(SHIPPED)
    folder.make(course)
    assert (course.learner / "04_listen.ipynb").exists()


# Work in the pages of the course itself.


@pytest.mark.parametrize("page", [WORKED, TYPED])
def test_answers_in_the_courses_own_pages_come_along(committed, page):
    (committed.shipped / NAME).write_bytes(page)
    folder.make(committed)
    assert not folder.is_newer(committed, committed.shipped / NAME)
    (committed.shipped / NAME).write_bytes(NEW)
    folder.update(committed, [])
    assert sources(committed.learner / NAME)[1] == ANSWER
    (committed.shipped / NAME).write_bytes(WORKED)
    assert cli.main(["reset", "03"]) == 0
    assert sources(committed.learner / NAME)[1] == BLANK


def test_without_git_what_a_page_was_is_what_the_learner_got(course):
    folder.make(course)
    (course.shipped / NAME).write_bytes(WORKED)
    (course.learner / NAME).write_bytes(WORKED)
    assert not folder.is_newer(course, course.shipped / NAME)
    assert cli.main(["reset", "03"]) == 0
    assert sources(course.learner / NAME)[1] == BLANK
    assert (course.learner / "03_write-kept-1.ipynb").read_bytes() == WORKED


def test_without_git_answers_in_the_courses_own_pages_are_not_lost(course):
    """A page that was worked in before there was a copy is not known as it was shipped."""
    (course.shipped / NAME).write_bytes(WORKED)
    folder.make(course)
    (course.shipped / NAME).write_bytes(NEW)
    for names in ([], ["03"]):
        folder.update(course, names)
        assert sources(course.learner / NAME)[1] == ANSWER


def test_a_page_of_the_course_that_cannot_be_read_is_no_new_version(course):
    folder.make(course)
    before = (course.learner / NAME).read_bytes()
    (course.shipped / NAME).write_text("<<<<<<< HEAD")
    for command in (["update"], ["update", "03"], ["reset", "03"]):
        assert cli.main(command) == 0
        assert (course.learner / NAME).read_bytes() == before


# The solutions.


def test_solutions_say_what_they_are_and_cannot_be_changed(course):
    folder.make(course)
    path = course.learner / "solutions" / NAME
    banner, *cells = json.loads(path.read_bytes())["cells"]
    assert "This is a solution" in banner["source"]
    assert f"(../{NAME})" in banner["source"]
    assert all(one["metadata"]["editable"] is False for one in (banner, *cells))
    assert cells[0]["outputs"] == [{"output_type": "stream"}]
    package = course.learner / "solutions" / "sensor_simulator" / "setup.py"
    assert {one.stat().st_mode & 0o777 for one in (path, package)} == {0o444}
    assert package.read_text() == "setup()"


def test_docs_link_to_the_pages_and_follow_the_bytes_of_the_course(course):
    folder.make(course)
    source, copy = course.root / "docs" / "glossary.md", course.learner / "docs" / "glossary.md"
    assert copy.read_text() == "A node: [page 00](../00_hear.ipynb)."
    before, time = copy.stat().st_ino, source.stat().st_mtime_ns
    folder.make(course)
    assert copy.stat().st_ino == before  # nothing to do
    source.write_text("A topic.")
    os.utime(source, ns=(time, time))
    folder.make(course)
    assert copy.read_text() == "A topic."
    assert copy.stat().st_mode & 0o777 == 0o444


# A release: an instructor's class works in `notebooks`.


def test_in_a_release_the_pages_are_the_learners_own(course):
    (course.root / ".rosbeat-release.json").touch()
    folder.make(course)
    assert course.learner == course.shipped
    found = ["00_hear.ipynb", NAME, "COLCON_IGNORE", "docs", "home.ipynb"]
    assert listed(course.shipped) == found
    assert not (course.root / "my_course").exists()


def test_a_release_has_no_other_copy_to_bring_back(course, capsys):
    (course.root / ".rosbeat-release.json").touch()
    assert cli.main(["reset", "03"]) == 1
    assert "Ask whoever gave you the folder" in capsys.readouterr().err


# `course reset`.


@pytest.mark.parametrize("name", ["03", "3", NAME, f"my_course/{NAME}", "03_write"])
def test_reset_brings_a_page_back_and_keeps_the_old_one(course, name, capsys):
    folder.make(course)
    (course.learner / NAME).write_bytes(WORKED)
    assert cli.main(["reset", name]) == 0
    assert sources(course.learner / NAME) == ["import rosbeat", BLANK, "____"]
    assert (course.learner / "03_write-kept-1.ipynb").read_bytes() == WORKED
    assert "yours is kept as my_course/03_write-kept-1.ipynb" in capsys.readouterr().out


def test_a_page_stays_under_its_name_if_the_new_one_cannot_be_written(course, monkeypatch):
    folder.make(course)
    (course.learner / NAME).write_bytes(WORKED)
    write = folder._write

    def full(path, content, *mode):
        if path == course.learner / NAME:
            raise OSError(errno.ENOSPC, "No space left on device", str(path))
        write(path, content, *mode)

    monkeypatch.setattr(folder, "_write", full)
    with pytest.raises(OSError, match="No space"):
        folder.reset(course, ["03"])
    assert (course.learner / NAME).read_bytes() == WORKED


@pytest.mark.parametrize(("names", "said"), [
    ([], "not named"), (["99"], "no page '99'"), ([""], "no page ''"), (["."], "no page '.'"),
])  # fmt: skip
def test_reset_has_to_know_which_page(course, names, said, capsys):
    assert cli.main(["reset", *names]) == 1
    assert said in capsys.readouterr().err


# `course update`.


def test_update_replaces_what_nobody_has_worked_in(course, capsys):
    folder.make(course)
    run = page(cell("import rosbeat", execution_count=4), cell(BLANK, "03a"), cell("____", "03b"))
    (course.learner / NAME).write_bytes(run)
    (course.shipped / NAME).write_bytes(NEW)
    assert folder.is_newer(course, course.shipped / NAME)
    assert cli.main(["update"]) == 0
    assert sources(course.learner / NAME)[0] == "import rosbeat  # newer"
    out = capsys.readouterr().out
    assert f"updated  {NAME}" in out
    assert "File, Reload Notebook from Disk" in out
    assert [one.read_bytes() for one in (course.notes / "before").iterdir()] == [run]
    assert not folder.is_newer(course, course.shipped / NAME)
    assert cli.main(["update"]) == 0
    assert capsys.readouterr().out == "Your pages are those of the course.\n"


def test_update_leaves_work_alone_and_offers_to_carry_it_over(course, capsys):
    folder.make(course)
    (course.learner / NAME).write_bytes(WORKED)
    (course.shipped / NAME).write_bytes(NEW)
    assert cli.main(["update"]) == 0
    assert (course.learner / NAME).read_bytes() == WORKED
    out = capsys.readouterr().out
    assert "./environment/course update 03" in out
    assert "Reload" not in out


def test_update_by_name_carries_over_the_answers_that_fit(course, capsys):
    folder.make(course)
    (course.learner / NAME).write_bytes(WORKED)
    (course.shipped / NAME).write_bytes(NEW)
    assert cli.main(["update", "03"]) == 0
    assert sources(course.learner / NAME) == ["import rosbeat  # newer", ANSWER, "____ # newer"]
    assert (course.learner / "03_write-kept-1.ipynb").read_bytes() == WORKED
    said = "your answers to 03a are in it; 03b changed, so your answer is only in the old one"
    assert said in capsys.readouterr().out
    assert not folder.is_newer(course, course.shipped / NAME)


def test_parts_of_an_exercise_are_told_apart_by_their_ids():
    parts = [cell("____ 1", "04a", id="a"), cell("____ 2", "04a", id="b")]
    mine = page(cell("two", "04a", id="b"))
    after, fit, others = folder.carried(mine, page(*parts), page(*parts))
    found = [one["source"] for one in json.loads(after)["cells"]]
    assert (found, fit, others) == (["____ 1", "two"], ["04a"], [])


def test_an_exercise_that_is_gone_stays_in_the_old_page():
    _, fit, others = folder.carried(WORKED, SHIPPED, page(cell("nothing to fill in")))
    assert (fit, others) == ([], ["03a", "03b"])


def test_an_answer_that_was_split_into_two_cells_is_not_carried_in_half():
    mine = page(
        cell("class Sensor:", "03a", id="a"), cell("    pass", "03a", id="b"),
        cell("mine", "03b", id="c"),
    )  # fmt: skip
    shipped = page(cell(BLANK, "03a", id="a"), cell("____", "03b", id="c"))
    after, fit, others = folder.carried(mine, shipped, shipped)
    found = [one["source"] for one in json.loads(after)["cells"]]
    assert (found, fit, others) == ([BLANK, "mine"], ["03b"], ["03a"])


# Many learners share one checkout, which they cannot write.


@pytest.fixture
def shared(committed, tmp_path, monkeypatch):
    """A learner's folder outside of the checkout; the test fails if the checkout changes."""
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.setenv("ROSBEAT_MY_COURSE", str(home / "my_course"))
    before = all_files(committed.root)
    yield committed
    assert all_files(committed.root) == before


def all_files(place):
    return {path: path.read_bytes() for path in place.rglob("*") if path.is_file()}


def test_a_learners_folder_that_no_list_of_folders_can_name_is_not_made(tmp_path):
    with pytest.raises(Problem, match="There is a : in the path"):
        folder.make(Layout(tmp_path, own=tmp_path / "a:b"))
    assert not (tmp_path / "a:b").exists()


def test_nothing_of_a_shared_checkout_moves_into_a_learners_folder(
    committed, tmp_path, monkeypatch
):
    """Neither a workspace there, nor a page that somebody ran, nor the pages of a release."""
    (committed.root / "ROS2_and_RL_Tutorials" / "src").mkdir(parents=True)
    (committed.root / "notebooks" / NAME).write_bytes(WORKED)
    (committed.root / ".rosbeat-release.json").touch()
    before = all_files(committed.root)
    monkeypatch.setenv("ROSBEAT_MY_COURSE", str(tmp_path / "my_course"))
    folder.make(committed)
    assert all_files(committed.root) == before
    assert not (tmp_path / "my_course" / "ROS2_and_RL_Tutorials").exists()
    assert (tmp_path / "my_course" / NAME).exists()


def test_reset_and_update_work_in_a_learners_folder(shared, tmp_path, capsys):
    folder.make(shared)
    mine = tmp_path / "home" / "my_course" / NAME
    mine.write_bytes(WORKED)
    assert folder.update(shared, []) == 0
    assert mine.read_bytes() == WORKED
    assert folder.reset(shared, ["03"]) == 0
    assert sources(mine) == ["import rosbeat", BLANK, "____"]
    kept = "yours is kept as my_course/03_write-kept-1.ipynb"
    assert kept in capsys.readouterr().out


@pytest.mark.parametrize("name", [f"solutions/{NAME}", "docs/glossary.md"])
def test_a_file_of_ones_own_is_kept_beside_what_is_shown(course, name, capsys):
    own = course.learner / name
    own.parent.mkdir(parents=True)
    own.write_text("mine")
    folder.make(course)
    assert own.read_text() != "mine"
    kept = own.with_name(f"{own.stem}-kept-1{own.suffix}")
    assert kept.read_text() == "mine"
    assert f"is kept as {kept.relative_to(course.root)}" in capsys.readouterr().out
    folder.make(course)
    assert kept.read_text() == "mine"  # it can be written to, so it is not the course's

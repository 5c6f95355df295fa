"""From a page that was handed in to what has to be observed."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from grading_files import BLANK, DONE, cell, notebook, page
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.course_pages import course_pages
from rosbeat.grading.notebook import read_notebook
from rosbeat.grading.tasks import imports_of, is_replayed, subject_of, tasks_of

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def course():
    return {one.number: one for one in course_pages(ROOT / "notebooks")}


@pytest.fixture
def tasks(pages):
    """The tasks of the small course's page 03, from cells or the text of a page."""

    def find(*cells, text=""):
        made = text or notebook(*cells, lesson="03_write")
        return tasks_of(pages[0], read_notebook(made.encode()).cells)

    return find


def test_an_answer_becomes_a_job(tasks):
    (task,) = tasks(text=page(source=DONE))
    assert (task.exercise, task.touched, task.reasons, task.repairs) == ("03a", True, (), ())
    assert (task.job.answer, task.job.subject, task.job.replay) == (DONE, "Beat", ())
    assert json.loads(task.job.given) == EXERCISES["03a"].given()


@pytest.mark.parametrize("source", [BLANK, f"\n{BLANK}\n", "", "  \n"])
def test_what_nobody_has_touched_is_not_observed(tasks, source):
    (task,) = tasks(text=page(source=source))
    assert (task.job, task.touched, task.reasons) == (None, False, ())


def test_a_page_without_the_cell_says_so(tasks):
    (task,) = tasks(cell("a = 1"))
    assert (task.job, task.touched) == (None, False)
    assert "not on the page" in " ".join(task.repairs)


def test_an_exercise_behind_the_end_of_its_file_is_lost(pages):
    (course,) = pages[:1]
    before = course.cells[:2]
    (task,) = tasks_of(course, before, cut=True)
    assert (task.cut, task.job, task.reasons, task.repairs) == (True, None, (), ())
    (task,) = tasks_of(course, before)
    assert not task.cut


def test_an_exercise_before_the_end_of_its_file_is_there_or_not(pages):
    (course,) = pages[:1]
    (task,) = tasks_of(course, read_notebook(page(source=DONE).encode()).cells[:3], cut=True)
    assert (task.cut, task.job is None) == (False, False)
    taken_out = (*course.cells[:2], *course.cells[3:])
    (task,) = tasks_of(course, taken_out, cut=True)
    assert not task.cut
    assert "not on the page" in task.repairs[0]


def test_a_cell_that_is_merely_alike_is_no_answer_where_the_file_breaks_off(pages):
    (course,) = pages[:1]
    scratch = cell("class Beat(Node):\n    pass")
    made = read_notebook(notebook(scratch).encode()).cells
    given = tuple(replace(one, place=one.place + 1) for one in course.cells[:2])
    (task,) = tasks_of(course, (*made, *given), cut=True)
    assert task.cut
    (task,) = tasks_of(course, made, cut=True)  # of a page without any ids nothing is known
    assert not task.cut


def test_what_a_person_has_to_look_at_is_kept(tasks):
    (task,) = tasks(text=page(source=f"import os\n{DONE}"))
    assert task.source == f"import os\n{DONE}"


def test_what_reaches_further_is_not_observed(tasks):
    (task,) = tasks(text=page(source=f"x = 1\nimport os\n{DONE}"))
    assert task.job is None
    assert [one.line for one in task.reasons] == [2]


@pytest.mark.parametrize(
    ("source", "words"),
    [("!ls", "a command of IPython, !ls"), ("x = 1\n%matplotlib inline", "%matplotlib"),
     ("%%bash\nls", "uses %%bash"), ("%%terminal a\nls", "uses %%terminal"),
     ("%%save x\nls", "uses %%save")],
)  # fmt: skip
def test_commands_of_ipython_are_for_a_person(tasks, source, words):
    (task,) = tasks(text=page(source=source))
    assert task.job is None
    assert any(words in one.text for one in task.reasons), task.reasons


def test_a_text_that_is_no_python_is_observed_all_the_same(tasks):
    (task,) = tasks(text=page(source="class Beat(Node:\n    pass"))
    assert task.job is not None


def test_what_the_check_cell_was_changed_to_does_not_count(tasks):
    made = (cell(DONE, id="03a-cell", exercise="03a"), cell('check("03a", Cheat)', check="03a"))
    (task,) = tasks(*made)
    assert task.job.subject == "Beat"


def test_earlier_cells_are_the_learners_first_then_the_courses(tasks):
    (task,) = tasks(
        cell("FIRST = 1"),
        cell("words", "markdown"),
        cell("%%terminal a\nls"),
        cell("SECOND = 2"),
        cell(DONE, id="03a-cell", exercise="03a"),
        cell("BELOW = 3"),
    )
    assert task.job.earlier[:2] == ("SECOND = 2", "FIRST = 1")
    assert "import rclpy" in task.job.earlier
    assert not any("BELOW" in one or "%%" in one or "words" in one for one in task.job.earlier)


def test_what_an_answer_needs_from_another_cell_is_looked_at_too(tasks):
    made = cell(DONE.replace("1.0", "PERIOD"), id="03a-cell", exercise="03a")
    (plain,) = tasks(cell("PERIOD = 1.0"), made)
    (sly,) = tasks(cell("PERIOD = eval('1.0')"), made)
    (beside,) = tasks(cell("x = eval('1.0')"), cell("PERIOD = 1.0"), made)
    assert (plain.reasons, beside.reasons) == ((), ())
    assert sly.job is None
    assert "from another cell uses eval" in sly.reasons[0].text


def test_equal_answers_are_equal_jobs_wherever_they_stand(tasks):
    (one,) = tasks(text=page(source=DONE))
    (other,) = tasks(text=page(source=DONE))
    assert one == other


def test_the_whole_course_has_a_job_for_each_exercise(course):
    for number, page_of_course in course.items():
        done = read_notebook((ROOT / f"solutions/{page_of_course.lesson}.ipynb").read_bytes())
        found = tasks_of(page_of_course, done.cells)
        wanted = [name for name in EXERCISES if name[:2] == number]
        assert [one.exercise for one in found] == wanted
        for task in found:
            assert task.job is not None, task
            assert task.job.subject != "None"
            is_typed = number in ("01", "02", "05", "06") and task.exercise != "05b"
            assert bool(task.job.replay) == is_typed


def test_a_blank_page_of_the_course_has_no_job(course):
    for page_of_course in course.values():
        tasks = tasks_of(page_of_course, page_of_course.cells)
        assert {(one.job, one.touched, one.repairs) for one in tasks} <= {(None, False, ())}


def test_an_exercise_of_several_cells_is_one_task(course):
    page_13 = course["13"]
    ids = [one.id for one in page_13.wanted if one.exercise == "13b"]
    cells = [
        replace(one, source=f"x = '{one.id}'") if one.id in ids else one for one in page_13.cells
    ]
    (task,) = (one for one in tasks_of(page_13, cells) if one.exercise == "13b")
    assert len(ids) > 1
    assert (*task.job.parts, task.job.answer) == tuple(f"x = '{one}'" for one in ids)


def test_a_replay_has_this_answer_and_blanks_for_the_others(course):
    page_01 = course["01"]
    first, second = page_01.wanted[:2]
    typed = "%%terminal two\nmkdir -p x"
    cells = [
        replace(one, source=typed) if one.id in (first.id, second.id) else one
        for one in page_01.cells
    ]
    task = tasks_of(page_01, cells)[1]
    assert task.job.replay.count(typed) == 1
    assert task.job.page == "01"
    assert not any("import check" in one for one in task.job.replay)


def test_what_is_read_of_the_course(course):
    assert subject_of(course["03"], "03a") == "HumiditySensor"
    assert subject_of(course["03"], "99z") == "None"
    assert "from rosbeat import" in imports_of(course["03"])
    assert "Session(" not in imports_of(course["03"])
    found = {one.exercise: is_replayed(course["05"], one) for one in course["05"].wanted}
    assert found == {"05a": True, "05b": False}

"""A sample of a class runs in a kernel, too; where the two differ, a remark says so."""

from dataclasses import replace

import pytest

from bank.graded import ANSWERS, course
from grading_class import filled, hand_in, pages_of
from rosbeat.grading.grade_class import Plan, grade
from rosbeat.grading.jobs import Observed
from rosbeat.grading.judging import CRASH, LEFT
from rosbeat.grading.ledger import FILE, Ledger
from rosbeat.grading.notebook import read_notebook
from rosbeat.grading.pool import Pool
from rosbeat.grading.results import to_results
from rosbeat.grading.sampling import (
    Candidate,
    Sampled,
    choose,
    disagreements,
    in_a_kernel,
    stands_alone,
)
from rosbeat.grading.tasks import tasks_of
from rosbeat.grading.weights import Points
from rosbeat.records import Outcome


def text_of(exercise, status, turn=0):
    named = [one for one in ANSWERS if one.exercise == exercise and not one.handed]
    return [one.text for one in named if one.status == status][turn]


RIGHT, WRONG = text_of("03a", "passed"), text_of("03a", "failed")
PASSED = Outcome("03a", "passed", "10 readings", points=1)
FAILED = Outcome("03a", "failed", "9 \x1b readings\nmore", mistake="wrong-rate")


def candidates(answers, path="a.ipynb", number="03"):
    page = course()[number]
    cells = read_notebook(filled(page, answers).encode()).cells
    tasks = tasks_of(page, cells)
    return [Candidate(path, page, cells, task.job) for task in tasks if task.job]


def many():
    texts = {
        **{name: text_of(name, "passed") for name in ("03a", "03b", "03c")},
    }
    return [one for n in range(5) for one in candidates(texts, f"learner_{n}/a.ipynb")]


def test_the_choice_is_the_same_whatever_the_order():
    found = many()
    assert choose(found, 4) == choose(reversed(found), 4)
    assert len(choose(found, 4)) == 4


def test_different_exercises_come_first():
    chosen = choose(many(), 4)
    assert {one.fast.exercise for one in chosen[:3]} == {"03a", "03b", "03c"}
    assert len({(one.path, one.fast.exercise) for one in chosen}) == 4


@pytest.mark.parametrize("number", [0, -1])
def test_none_if_none_are_asked_for(number):
    assert choose(many(), number) == ()


def test_pages_with_terminals_are_left_out():
    alone = {number for number, page in course().items() if stands_alone(page)}
    assert alone == {"00", "03", "04", "10", "11", "13"}
    (one,) = candidates({"03a": RIGHT})
    assert choose([replace(one, page=course()["02"])], 1) == ()
    assert choose([replace(one, job=replace(one.job, replay=("x",)))], 1) == ()


def test_what_a_kernel_gets_is_the_page_up_to_the_answer():
    (one,) = candidates({"03a": RIGHT})
    job = in_a_kernel(one)
    assert (replace(job, kernel=()), job.kernel[-1]) == (one.job, RIGHT)
    assert "from rosbeat import" in job.kernel[0]
    assert not any("check(" in cell for cell in job.kernel)


def judged(fast, slow):
    (one,) = candidates({"03a": RIGHT})
    sampled = Sampled("a\u202e.ipynb", one.job, in_a_kernel(one))
    return disagreements([sampled], {sampled.fast: fast, sampled.slow: slow}.get)


def test_a_disagreement_is_told():
    (remark,) = judged(PASSED, FAILED)
    assert (remark.about, remark.path) == ("sample", "a\u202e.ipynb")
    assert "03a was graded as passed with 1 of 1 points (10 readings)" in remark.text
    assert "failed with 0 of 1 points, wrong-rate (9 \\u001b readings)" in remark.text


@pytest.mark.parametrize(
    ("fast", "slow", "count"),
    [
        (PASSED, replace(PASSED, evidence="11 readings", remarks=("r",)), 0),
        (PASSED, replace(PASSED, points=0), 1),
        (FAILED, replace(FAILED, mistake="new-to-me"), 1),
        (FAILED, replace(FAILED, mistake=LEFT), 1),
        (replace(FAILED, mistake=CRASH), replace(FAILED, mistake=LEFT), 0),
        (PASSED, None, 0),
    ],
)
def test_what_counts_is_status_points_and_mistake(fast, slow, count):
    assert len(judged(fast, slow)) == count


POINTS = Points({f"03{letter}": 0.0 for letter in "bc"})


def graded(folder, sample, observe):
    """A class of two, whose outcomes may be known from an earlier run."""
    pages = pages_of("03")
    collection = hand_in(folder / "class", pages, [{"03a": RIGHT}, {"03a": WRONG}])
    with Ledger(folder / FILE) as ledger:
        plan = Plan(pages, "v", POINTS, sample)
        return to_results(grade(collection, plan, ledger, observe, lambda *_: None))


def observe_here(jobs):
    with Pool(2) as pool:
        yield from pool.observe(jobs)


def nobody(jobs):
    raise AssertionError([job.exercise for _, job in jobs])


@pytest.mark.ros
def test_a_class_agrees_and_its_results_do_not_depend_on_the_sample(tmp_path):
    without = graded(tmp_path / "without", 0, observe_here)
    found = graded(tmp_path / "with", 2, observe_here)
    assert found == without
    assert '"about": "sample"' not in found
    assert graded(tmp_path / "with", 2, nobody) == found
    assert graded(tmp_path / "with", 0, nobody) == found


@pytest.mark.ros
def test_a_kernel_that_dies_is_told_and_stops_nothing(tmp_path):
    def kernels_die(jobs):
        jobs = list(jobs)
        yield from ((key, Observed("exit", 3)) for key, job in jobs if job.kernel)
        yield from observe_here((key, job) for key, job in jobs if not job.kernel)

    found = graded(tmp_path, 1, kernels_die)
    assert found.count('"about": "sample"') == 1
    assert found.count('"status": "passed"') == 1
    assert graded(tmp_path, 1, nobody) == found
    marks = graded(tmp_path, 0, nobody)
    assert marks == graded(tmp_path / "without", 0, observe_here)

"""A page in a real kernel shows what a prepared process shows."""

import json
from dataclasses import replace

import nbformat
import pytest

from bank.graded import ANSWERS, task_of
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.inside.kernel import kernel_files, page_of
from rosbeat.grading.jobs import Job
from rosbeat.grading.judging import LEFT, judge
from rosbeat.grading.pool import Pool

RIGHT = next(one for one in ANSWERS if one.exercise == "03a" and one.status == "passed")
#: The cell itself raises, in its second line.
RAISES = "import math\nHumiditySensor = math.nothing\n"


@pytest.fixture(scope="module")
def pool():
    with Pool(1) as found:
        yield found


@pytest.fixture
def observed(pool):
    """What comes out of a sandbox for an answer to 03a, in a kernel or not."""

    def observe(answer, kernel):
        job = replace(task_of(RIGHT).job, answer=answer)
        page = ("unknown_name", "%timeit -n1 -r1 pass", job.imports, answer)
        ((_, found),) = pool.observe([("", replace(job, kernel=page if kernel else ()))])
        return found

    return observe


def without_lines(outcome):
    return replace(outcome, evidence="")


@pytest.mark.ros
def test_a_right_answer(observed):
    fast, slow = observed(RIGHT.text, False), observed(RIGHT.text, True)
    assert judge(EXERCISES["03a"], slow) == judge(EXERCISES["03a"], fast)
    assert judge(EXERCISES["03a"], slow).status == "passed"


@pytest.mark.ros
@pytest.mark.parametrize(
    "answer", [RAISES, "class HumiditySensor(Node)\n    pass\n", "OtherSensor = Node\n"]
)
def test_a_cell_that_cannot_be_run(observed, answer):
    fast, slow = observed(answer, False), observed(answer, True)
    assert fast.raised
    assert (slow.how, slow.raised, slow.line, slow.code) == (
        *(fast.how, fast.raised),
        *(fast.line, fast.code),
    )
    assert judge(EXERCISES["03a"], slow) == judge(EXERCISES["03a"], fast)


@pytest.mark.ros
def test_a_kernel_that_dies(observed):
    found = observed("import os\nos._exit(0)\n", True)
    assert (found.how, found.evidence, found.output.splitlines()[-1]) == (
        *("exit", ""),
        "the kernel has died",
    )
    assert judge(EXERCISES["03a"], found).mistake == LEFT


def test_the_page_is_a_notebook_with_the_cells_between_two_of_the_courses():
    job = Job("03a", "Beat", "b", kernel=("a", "b"))
    page = nbformat.reads(page_of(job, "/tmp/x"), as_version=4)
    nbformat.validate(page)
    assert [one.source for one in page.cells[1:-1]] == ["a", "b"]
    assert "(\nBeat\n)" in page.cells[-1].source
    json.loads(page_of(replace(job, kernel=("\ud800",)), "/tmp/x"))


def test_a_kernel_gets_no_judge():
    names = set(kernel_files())
    assert {"jobs.py", "inside/on_page.py", "inside/drive.py"} <= names
    assert all(name == "jobs.py" or name.startswith("inside/") for name in names)

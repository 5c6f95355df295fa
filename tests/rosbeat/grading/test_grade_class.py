"""A class from what was handed in to its gradebook; answers are observed by somebody made up."""

import pytest

from grading_files import BLANK, DONE, PAGE_03, PAGE_04, cell, notebook, page
from rosbeat.errors import GradingError
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.grade_class import Plan, all_tasks, cause_of, grade, told
from rosbeat.grading.inspecting import Reason
from rosbeat.grading.jobs import LOST, Observed
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.submissions import collect
from rosbeat.grading.weights import Points
from rosbeat.records import Outcome, Part

OTHER_03 = page(source=DONE.replace("1.0", "2.0"))
RAISES = Observed("ended", raised="ZeroDivisionError", text="division by zero", line=3)


class Observer:
    """Says the same of every answer, and keeps what it was asked."""

    def __init__(self, seen=RAISES, after=None):
        self.seen, self.after, self.jobs = seen, after, []

    def __call__(self, jobs):
        for key, job in jobs:
            if len(self.jobs) == self.after:
                raise KeyboardInterrupt
            self.jobs.append(job)
            yield key, self.seen


@pytest.fixture
def graded(pages, handed_in, tmp_path):
    """Grade files, with a ledger that stays for the next time."""

    def run(files, observer, points=None, version="1", tell=lambda done, total: None):
        plan = Plan(pages, version, points or Points())
        with Ledger(tmp_path / "ledger") as ledger:
            return grade(collect(handed_in(files), pages), plan, ledger, observer, tell)

    return run


def rows(book):
    return [
        (one.learner, mark.exercise, mark.status) for one in book.learners for mark in one.marks
    ]


def test_every_exercise_of_every_learner_has_a_mark(graded):
    files = {"ana/03.ipynb": PAGE_03, "ana/04.ipynb": PAGE_04, "ben/03.ipynb": page()}
    book = graded(files, Observer())
    assert rows(book) == [
        ("ana", "03a", "failed"), ("ana", "04a", "failed"),
        ("ben", "03a", "not attempted"), ("ben", "04a", "missing"),
    ]  # fmt: skip
    first = book.learners[0].marks[0]
    assert (first.mistake, first.page, first.points) == ("division-by-zero", "03_write", 0.0)
    assert first.out_of == EXERCISES["03a"].points
    assert all(mark.cause for one in book.learners for mark in one.marks)


def test_equal_answers_are_observed_once(graded):
    observer = Observer()
    book = graded({f"{name}/03.ipynb": PAGE_03 for name in "abcdef"}, observer)
    assert len(observer.jobs) == 1
    assert len({one.marks for one in book.learners}) == 1


def test_what_is_unchanged_is_not_observed_again_and_gives_the_same_book(graded):
    files = {"ana/03.ipynb": PAGE_03, "ben/03.ipynb": OTHER_03, "ben/04.ipynb": PAGE_04}
    first, second = Observer(), Observer()
    assert graded(files, first) == graded(files, second)
    assert (len(first.jobs), len(second.jobs)) == (3, 0)


def test_one_changed_answer_is_observed_alone(graded):
    files = {"ana/03.ipynb": PAGE_03, "ben/03.ipynb": PAGE_03, "ben/04.ipynb": PAGE_04}
    graded(files, Observer())
    observer = Observer()
    graded(files | {"ben/03.ipynb": OTHER_03}, observer)
    assert [job.exercise for job in observer.jobs] == ["03a"]
    assert "2.0" in observer.jobs[0].answer


def test_another_version_of_the_course_judges_anew(graded):
    graded({"ana/03.ipynb": PAGE_03}, Observer())
    observer = Observer()
    assert graded({"ana/03.ipynb": PAGE_03}, observer, version="2").course == "2"
    assert len(observer.jobs) == 1


def test_who_is_stopped_in_the_middle_goes_on_there(graded):
    files = {f"{n}/03.ipynb": page(source=DONE.replace("1.0", f"{n}.0")) for n in range(9)}
    with pytest.raises(KeyboardInterrupt):
        graded(files, Observer(after=5))
    rest = Observer()
    book = graded(files, rest)
    assert len(rest.jobs) == 4
    assert {status for _, _, status in rows(book)} >= {"failed"}
    assert "not attempted" not in {status for _, name, status in rows(book) if name == "03a"}


def test_an_answer_whose_worker_was_lost_is_tried_again_next_time(graded):
    book = graded({"ana/03.ipynb": PAGE_03}, Observer(Observed(LOST)))
    mark = book.learners[0].marks[0]
    assert "was lost" in mark.evidence
    assert (mark.status, mark.points, mark.mistake) == (
        "held",
        0.0,
        "",
    )  # nobody knows what it does
    assert mark.answer == DONE
    again = Observer()
    assert graded({"ana/03.ipynb": PAGE_03}, again).learners[0].marks[0].mistake != "crashed"
    assert len(again.jobs) == 1


def test_no_sandbox_is_not_somebodys_mark(graded):
    def refuses(jobs):
        raise GradingError("No sandbox.", "m", "t")
        yield

    with pytest.raises(GradingError):
        graded({"ana/03.ipynb": PAGE_03}, refuses)


def test_what_reaches_too_far_is_held_and_not_observed(graded):
    observer = Observer()
    source = "import os\n" + DONE
    book = graded({"ana/03.ipynb": page(source=source), "ben/03.ipynb": PAGE_03}, observer)
    held = book.learners[0].marks[0]
    assert (held.status, held.points) == ("held", 0.0)
    assert "line 1 imports os" in held.cause
    assert (held.answer, held.file) == (source, "ana/03.ipynb")
    assert all("import os" not in job.answer for job in observer.jobs)
    assert book.learners[1].marks[0].status == "failed"


def test_what_lies_behind_the_end_of_a_file_has_no_points_yet(graded):
    whole, observer = PAGE_03, Observer()
    files = {
        "ana/03.ipynb": whole[: whole.index("class Beat")],
        "ben/03_write.ipynb": '{"cells": [{',
    }
    book = graded(files, observer)
    assert [row for row in rows(book) if row[1] == "03a"] == [
        ("ana", "03a", "held"), ("ben", "03a", "held"),
    ]  # fmt: skip
    for one in book.learners:
        mark = one.marks[0]
        assert (
            mark.cause == mark.evidence == "The file stops before this exercise: hand it in again."
        )
        assert mark.waits_for_its_file
        assert not one.is_settled
    assert observer.jobs == []


def test_a_cell_that_was_taken_out_is_said_to_be_missing(graded):
    book = graded(
        {"ana/03.ipynb": notebook(cell("# Write", "markdown"), lesson="03_write")}, Observer()
    )
    mark = book.learners[0].marks[0]
    assert (mark.status, mark.evidence) == ("not attempted", "Its cell is not on the page.")
    assert mark.cause == "Its cell is not on the page."


def test_points_are_those_of_the_file_and_none_means_not_graded(graded):
    observer = Observer(Observed("ended"))
    files = {"ana/03.ipynb": PAGE_03, "ana/04.ipynb": PAGE_04}
    book = graded(files, observer, Points({"03a": 10.0, "04a": 0.0}))
    (mark,) = book.learners[0].marks
    assert (mark.exercise, mark.out_of) == ("03a", 10.0)
    assert [job.exercise for job in observer.jobs] == ["03a"]


def test_it_is_told_how_far_it_is(graded):
    told_so_far = []
    files = {"ana/03.ipynb": PAGE_03, "ben/03.ipynb": OTHER_03}
    graded(files, Observer(), tell=lambda *said: told_so_far.append(said))
    assert told_so_far == [(0, 2), (1, 2), (2, 2)]
    graded(files, Observer(), tell=lambda *said: told_so_far.append(said))
    assert told_so_far[3:] == [(2, 2)]


def test_what_was_done_to_find_an_answer_is_in_its_mark(graded):
    lost = notebook(cell(DONE, id="other", exercise="03a"), lesson="03_write")
    book = graded({"ana/03.ipynb": lost}, Observer())
    assert "another id" in " ".join(book.learners[0].marks[0].repairs)


def test_files_of_nobody_are_in_the_book(graded):
    book = graded({"ana/03.ipynb": PAGE_03, "ana/notes.docx": "x"}, Observer())
    assert [one.about for one in book.learners[0].remarks if one.about == "left-out"]


def test_a_class_of_nobody_has_an_empty_book(graded, handed_in):
    handed_in({"readme.txt": "x"})
    assert graded({}, Observer()).learners == ()


def test_tasks_are_there_for_pages_that_count_only(pages, handed_in):
    found = collect(handed_in({"ana/03.ipynb": PAGE_03, "ana/04.ipynb": PAGE_04}), pages)
    tasks = all_tasks(found, Plan(pages[:1], "1"))
    assert list(tasks) == [("ana", "03_write")]


PARTS = (Part("R1", "t", True), Part("R2", "t", False))


@pytest.mark.parametrize(
    ("outcome", "words"),
    [
        (Outcome("03a", "passed"), "It does what is asked."),
        (Outcome("03a", "not attempted"), "Nothing was tried yet."),
        (Outcome("03a", "failed", "One.\nTwo.", mistake="new-to-me"), "One."),
        (Outcome("03a", "failed", "One.", mistake="crashed"), "A process that died: One."),
        (Outcome("13b", "failed", "One.", parts=PARTS), "1 of 2 requirements are met."),
        (Outcome("03a", "failed", "a\x1b[31m\u202eb"), "a\\u001b[31m\\u202eb"),
    ],
)
def test_a_cause_is_one_sentence(outcome, words):
    assert words in cause_of(outcome)
    assert len(cause_of(outcome)) <= 400


def test_of_many_reasons_three_are_told():
    said = told([Reason(line, f"imports x{line}\x07") for line in range(1, 9)])
    assert said.startswith("line 1 imports x1")
    assert "x4" not in said
    assert said.isprintable()


def test_nothing_was_tried_on_a_page_without_the_cell(graded):
    files = {"ana/03.ipynb": notebook(cell("# Write", "markdown"), lesson="03_write")}
    mark = graded(files, Observer()).learners[0].marks[0]
    assert (mark.status, mark.repairs) == ("not attempted", ("Its cell is not on the page.",))
    assert BLANK not in mark.evidence

"""What exercises are worth, and what the files say about marks: unreadable, late, missing."""

import os
from datetime import datetime, timezone

import pytest

from grading_files import PAGE_03
from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import FAILED, PASSED
from rosbeat.grading import run
from rosbeat.grading.deadlines import LateRule, mark_late, read_due, read_late_rule
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.marks import Points, read_points, scaled
from rosbeat.grading.submissions import Collection, Submission, collect
from rosbeat.page_runs.jobs import Evidence, PageEvidence
from rosbeat.records import Outcome


@pytest.fixture
def read(tmp_path):
    def read(text):
        path = tmp_path / "points.csv"
        path.write_text(text)
        return read_points(path).by_exercise

    return read


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("exercise,points\n03a,4\n", {"03a": 4}),
        ("03a,4\nsystem,0\n", {"03a": 4, "system": 0}),
        ("\ufeffExercise,Points\r\n 3A , 4 \r\n", {"03a": 4}),
        ("exercise,points\n03,16\n", {"03a": 4, "03b": 4, "03c": 8}),
        ("exercise,points\n3,16\n03c,0\n", {"03a": 8, "03b": 8, "03c": 0}),
        ("03_write_a_publisher,10\n03a,1\n03b,1\n03c,3\n", {"03a": 2, "03b": 2, "03c": 6}),
        ("03,0\n", {"03a": 0, "03b": 0, "03c": 0}),
        ("03,1\n03b,0\n03c,1\n", {"03a": 0.67, "03b": 0, "03c": 0.33}),
        ("03,7.77\n", {"03a": 1.94, "03b": 1.94, "03c": 3.89}),
    ],
)
def test_points_are_read_and_a_page_s_are_shared_in_hundredths(read, text, wanted):
    assert read(text) == wanted


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("exercise,points\n03x,4\n", "line 2: there is no exercise or page '03x'"),
        ("exercise,points\n03a,4\n03a,5\n", "line 3: 03a is there a second time"),
        ("exercise,points\n03a,-1\n", "line 2: points are 0, or from 0.01 to"),
        ("exercise,points\n03a,0.001\n", "line 2: points are 0, or from 0.01 to"),
        ("exercise,points\n03a,nan\n", "line 2: points are 0, or from 0.01 to"),
        ("exercise,points\n03a,four\n", "line 2: 'four' is not a number"),
        ("exercise,points\n03,0.02\n", "too few points for all exercises of page 03"),
        ("03a,0\n03b,0\n03c,0\n03,10\n", "none of the exercises of page 03"),
        ("exercise,weight\n03a,4\n", "line 1: there is no column points"),
        ("exercise,points\n\x1b[31m,4\n", "\\\\u001b[31m"),
    ],
)
def test_points_that_cannot_be_used_are_refused_with_their_line(read, text, said, says):
    with pytest.raises(GradingError) as caught:
        read(text)
    says(caught.value, said, "Correct the line")


@pytest.mark.parametrize(
    ("status", "points", "out_of", "worth", "wanted"),
    [
        (PASSED, 2, 2, 5.0, 5.0),
        (FAILED, 5, 20, 10.0, 2.5),
        (FAILED, 1, 3, 1.0, 0.33),
        (PASSED, 25, 20, 10.0, 10.0),
        (FAILED, -3, 20, 10.0, 0.0),
        (PASSED, 0, 0, 3.0, 3.0),
        (FAILED, 0, 0, 3.0, 0.0),
    ],
)
def test_part_of_the_points_stays_the_same_part(status, points, out_of, worth, wanted):
    outcome = Outcome("03a", status, points=points, out_of=out_of)
    assert scaled(outcome, worth) == wanted


# Deadlines.


def test_a_day_ends_at_midnight_and_a_time_is_of_this_computer_or_names_its_zone():
    last = datetime(2026, 11, 30, 23, 59, 59).timestamp()
    assert last < read_due("2026-11-30") < datetime(2026, 12, 1).timestamp()
    assert read_due(" 2026-11-30 18:00 ") == datetime(2026, 11, 30, 18).timestamp()
    assert read_due("2026-11-30T18:00:30") == datetime(2026, 11, 30, 18, 0, 30).timestamp()
    moment = datetime(2026, 11, 30, 17, tzinfo=timezone.utc).timestamp()
    assert read_due("2026-11-30 18:00+01:00") == moment
    assert read_due("2026-11-30T17:00Z") == moment


@pytest.mark.parametrize("text", ["", "30.11.2026", "2026-13-01", "\x1b[31m", "Z"])
def test_what_is_not_a_deadline_is_refused(text, says):
    with pytest.raises(GradingError) as caught:
        read_due(text)
    says(caught.value, "2026-11-30 18:00")
    assert "\x1b" not in str(caught.value)


DAY = 86_400


@pytest.mark.parametrize(
    ("text", "late_by", "off"),
    [
        ("10%/day", 1, 0.1),
        ("10%/day", DAY, 0.1),
        ("10%/day", DAY + 1, 0.2),
        ("10%/day", 30 * DAY, 1.0),
        ("10 % / day", 3 * DAY, 0.3),
        ("1%/hour", 5 * 3600, 0.05),
        ("20%", 9 * DAY, 0.2),
        ("10%/day, at most 50%", 9 * DAY, 0.5),
        ("12.5%/Day at most 25%", 2 * DAY, 0.25),
    ],
)
def test_a_rule_says_what_is_taken_off(text, late_by, off):
    assert read_late_rule(text).off(late_by) == pytest.approx(off)


@pytest.mark.parametrize("text", ["", "10", "-10%/day", "110%", "10%/week", "\x1b"])
def test_what_is_no_rule_is_refused(text, says):
    with pytest.raises(GradingError) as caught:
        read_late_rule(text)
    says(caught.value, '--late "10%/day"')
    assert "\x1b" not in str(caught.value)


# What the files say about marks.


@pytest.fixture
def settled(handed_in, pages, tmp_path, monkeypatch):
    """Grade files of which every answer is right, for 3 of 3 points."""
    right = Outcome("03a", PASSED, points=2, out_of=2)
    monkeypatch.setattr(run, "judge_and_trace", lambda *_: (right, ""))

    def observe(jobs):
        for key, job in (one for pages in jobs for one in pages):
            yield key, PageEvidence(dict.fromkeys(job.subjects, Evidence("ended")))

    def settle_files(files, rule=None, due=0.0, empty=False, modified=1.0, absent=()):
        root = handed_in(files)
        for path in root.rglob("*.ipynb"):
            os.utime(path, (modified, modified))
        found = collect(root, pages)
        more = tuple(Submission(one, one, "folder") for one in absent)
        found = mark_late(
            Collection((*found.submissions, *more), found.remarks), lambda one: due, rule
        )
        plan = run.Plan(pages, "1", Points({"03a": 3.0, "04a": 3.0}), excuses=empty)
        with Ledger(tmp_path / "ledger") as ledger:
            book = run.grade(found, plan, ledger, observe, lambda *_: None)
        return {one.learner: one for one in book.learners}

    return settle_files


def told(graded):
    return [(mark.exercise, mark.status, mark.points) for mark in graded.marks]


def test_a_page_that_cannot_be_read_waits_for_a_person_and_says_why(settled):
    found = settled({"ana/03_write.ipynb": "", "ben/03_write.ipynb": PAGE_03})
    assert told(found["ana"]) == [("03a", "held", 0.0), ("04a", "missing", 0.0)]
    mark = found["ana"].marks[0]
    assert mark.cause == "The page cannot be read. The file is empty."
    assert (mark.file, mark.hint) == ("ana/03_write.ipynb", "Hand the page in again.")
    assert found["ana"].grade is None
    assert told(found["ben"])[0] == ("03a", PASSED, 3.0)


def test_a_file_that_may_be_any_page_holds_those_that_are_missing(settled):
    files = {"ana/all.rar": "Rar!", "ana/03_write.ipynb": PAGE_03}
    found = settled(files)
    assert told(found["ana"]) == [("03a", PASSED, 3.0), ("04a", "held", 0.0)]
    assert "It may be in ana/all.rar." in found["ana"].marks[1].cause


def test_points_are_taken_off_late_pages_and_the_remark_says_it_once(settled):
    found = settled({"ana/03_write.ipynb": PAGE_03}, LateRule(0.1, DAY), modified=1.5 * DAY)["ana"]
    mark = found.marks[0]
    assert (mark.points, mark.judged, mark.late) == (2.4, 3.0, True)
    (said,) = [one.text for one in found.remarks]
    assert "is 1 d 12 h after the deadline. 20% of the points of this page are taken off." in said


def test_canvas_dates_its_files_at_the_download_so_only_its_mark_makes_them_late(settled):
    files = {"a_LATE_1_9_03_write.ipynb": PAGE_03, "b_2_9_03_write.ipynb": PAGE_03}
    found = settled(files, LateRule(0.5))
    assert (found["1"].points, found["2"].points) == (1.5, 3.0)
    found = settled(files)  # without a rule, late is only a word
    assert (found["1"].points, [one.about for one in found["1"].remarks]) == (3.0, ["late"])


def test_where_it_is_not_known_how_late_a_page_is_a_person_decides(settled):
    found = settled({"a_LATE_1_9_03_write.ipynb": PAGE_03}, LateRule(0.1, DAY))["1"]
    assert found.marks[0].points == 3.0
    assert "How late is not known, so nothing is taken off" in found.remarks[0].text


@pytest.mark.parametrize(("empty", "grade"), [(False, 0.0), (True, None)])
def test_who_handed_in_nothing_has_0_points_or_no_grade(settled, empty, grade):
    found = settled({"ana/03_write.ipynb": PAGE_03}, empty=empty, absent=["ben"])
    assert told(found["ben"]) == [("03a", "missing", 0.0), ("04a", "missing", 0.0)]
    assert (found["ben"].grade, found["ben"].excused) == (grade, empty)
    assert (found["ana"].grade, found["ana"].excused) == (3.0, False)

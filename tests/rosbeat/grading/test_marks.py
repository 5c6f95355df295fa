"""What exercises are worth, and what the files say about marks: unreadable, late, missing."""

import os
from dataclasses import dataclass
from datetime import datetime, timezone

import pytest

from grading_files import PAGE_03
from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import FAILED, PASSED
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.deadlines import LateRule, mark_late, read_due, read_late_rule
from rosbeat.grading.marks import Gradebook, Graded, Mark, settle
from rosbeat.grading.notebook import Notebook
from rosbeat.grading.submissions import Collection, HandedIn, Submission, collect
from rosbeat.grading.weights import Points, read_points, scaled, without_effect
from rosbeat.records import Outcome


@dataclass(frozen=True)
class Exercise:
    id: str
    points: int


@dataclass(frozen=True)
class Page:
    number: str
    exercises: tuple


PAGES = (
    Page("03", (Exercise("03a", 2), Exercise("03b", 2), Exercise("03c", 4))),
    Page("04", (Exercise("04a", 1),)),
    Page("", (Exercise("system", 5),)),
)


@pytest.fixture
def read(tmp_path):
    def read(text):
        path = tmp_path / "points.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_points(path, PAGES).by_exercise

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
        ("exercise,points\n", {}),
    ],
)  # fmt: skip
def test_points_are_read(read, text, wanted):
    assert read(text) == wanted


@pytest.mark.parametrize("whole", ["7.77", "0.05", "9999.99"])
def test_shares_of_a_page_are_hundredths_and_add_up(read, whole):
    shares = read(f"03,{whole}\n").values()
    assert all(round(one, 2) == one for one in shares)
    assert round(sum(shares), 6) == float(whole)


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("exercise,points\n03x,4\n", 2, "no exercise or page '03x'; did you mean 03"),
        ("exercise,points\n03a,4\n03a,5\n", 3, "03a is in line 2 already"),
        ("exercise,points\n03a,-1\n", 2, "from 0 to"),
        ("exercise,points\n03a,0.001\n", 2, "at least 0.01"),
        ("exercise,points\n03,0.02\n", 2, "too few points for all exercises of 03"),
        ("exercise,points\n03a,nan\n", 2, "from 0 to"),
        ("exercise,points\n03a,four\n", 2, "'four' is not a number"),
        ("exercise,points\n,4\n", 2, "names no exercise"),
        ("exercise,weight\n03a,4\n", 1, "no column points"),
        ("03a,0\n03b,0\n03c,0\n03,10\n", 4, "none of the exercises of 03"),
        ("exercise,points\n\x1b[31m,4\n", 2, "\\u001b[31m"),
        ("exercise,points\n" + "x" * 10_000 + ",4\n", 2, "xxx..."),
    ],
)
def test_what_cannot_be_used_is_refused_with_its_line(read, text, line, said):
    with pytest.raises(GradingError) as caught:
        read(text)
    told = str(caught.value)
    assert said in told
    assert f"line {line}: " in told
    assert caught.value.means
    assert caught.value.to_try
    assert "\x1b" not in told


def test_all_slips_are_told_at_once_but_not_a_hundred(read):
    with pytest.raises(GradingError) as caught:
        read("exercise,points\n" + "03a,x\n" * 100)
    assert "line 2: " in caught.value.what
    assert "line 6: " in caught.value.what
    assert "line 7: " not in caught.value.what
    assert "and 95 more" in caught.value.what


def test_the_course_s_own_exercises_and_pages_are_known(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("".join(f"{name},{one.points}\n" for name, one in EXERCISES.items()))
    points = read_points(path)
    assert points.by_exercise == {name: one.points for name, one in EXERCISES.items()}


@pytest.mark.parametrize(
    ("status", "points", "out_of", "worth", "wanted"),
    [
        (PASSED, 2, 2, 5.0, 5.0),
        (FAILED, 5, 20, 10.0, 2.5),
        (FAILED, 1, 3, 1.0, 0.33),
        (PASSED, 20, 20, 0.0, 0.0),
        (PASSED, 25, 20, 10.0, 10.0),
        (FAILED, -3, 20, 10.0, 0.0),
        (PASSED, 0, 0, 3.0, 3.0),
        (FAILED, 0, 0, 3.0, 0.0),
    ],
)
def test_part_of_the_points_stays_the_same_part(status, points, out_of, worth, wanted):
    outcome = Outcome("03a", status, points=points, out_of=out_of)
    assert scaled(outcome, worth) == wanted


def test_points_of_pages_that_are_not_graded_are_told():
    points = Points({"03a": 1.0, "04a": 2.0})
    assert without_effect(points, ["03", "04"], PAGES) == ""
    said = without_effect(points, ["03"], PAGES)
    assert said.startswith("The points for page 04 change nothing: graded are the pages 03.")
    assert "pages 03, 04 change nothing" in without_effect(points, [], PAGES)


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
def settled(handed_in, pages):
    """Settle marks: all that is on a page of these files was judged to be right, 3 of 3 points."""

    def settle_files(files, rule=None, due=0.0, empty=False, modified=1.0, absent=()):
        root = handed_in(files)
        for path in root.rglob("*.ipynb"):
            os.utime(path, (modified, modified))
        found = collect(root, pages)
        more = tuple(Submission(one, one, "folder") for one in absent)
        found = Collection((*found.submissions, *more), found.remarks)
        found = mark_late(found, lambda one: due, rule)
        learners = tuple(_judged(one, pages) for one in found.submissions)
        book = settle(Gradebook("1", learners), found, empty)
        return {one.learner: one for one in book.learners}

    return settle_files


def _judged(one, pages):
    handed = {page.page for page in one.pages}
    marks = []
    for page in pages:
        status, points = (PASSED, 3.0) if page.lesson in handed else ("missing", 0.0)
        for wanted in page.wanted:
            marks.append(Mark(wanted.exercise, "t", page.lesson, status, points, 3.0, "c",
                              judged=points))  # fmt: skip
    return Graded(one.learner, one.name, one.system, tuple(marks), one.remarks)


def told(graded):
    return [(mark.exercise, mark.status, mark.points) for mark in graded.marks]


def test_a_page_that_cannot_be_read_waits_for_a_person_and_says_why(settled):
    found = settled({"ana/03_write.ipynb": "", "ben/03_write.ipynb": PAGE_03})
    assert told(found["ana"]) == [("03a", "held", 0.0), ("04a", "missing", 0.0)]
    mark = found["ana"].marks[0]
    assert mark.cause == "The page cannot be read. The file is empty."
    assert (mark.file, mark.hint) == ("ana/03_write.ipynb", "Hand the page in again.")
    assert mark.waits_for_its_file
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
    assert (mark.points, mark.judged, mark.late) == (2.4, 3.0, False)
    assert mark.cause == "c"
    (said,) = [one.text for one in found.remarks]
    assert "is 1 day 12 h after the deadline. 20% of the points of this page are taken off." in said


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


def test_a_date_beyond_all_calendars_is_late_and_stops_nothing():
    page = HandedIn("03_write", "ana/03_write.ipynb", Notebook(), False, 1e18)
    found = Collection((Submission("ana", "ana", "folder", (page,)),))
    (one,) = mark_late(found, lambda _: 0.0, LateRule(0.1, DAY)).submissions
    assert (one.pages[0].late, one.pages[0].off) == (True, 1.0)
    assert "far in the future" in one.remarks[0].text


@pytest.mark.parametrize(("empty", "grade"), [(False, 0.0), (True, None)])
def test_who_handed_in_nothing_has_0_points_or_no_grade(settled, empty, grade):
    found = settled({"ana/03_write.ipynb": PAGE_03}, empty=empty, absent=["ben"])
    assert told(found["ben"]) == [("03a", "missing", 0.0), ("04a", "missing", 0.0)]
    assert (found["ben"].grade, found["ben"].excused) == (grade, empty)
    assert (found["ana"].grade, found["ana"].excused) == (3.0, False)

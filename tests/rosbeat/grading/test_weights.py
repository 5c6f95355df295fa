"""What exercises are worth."""

from dataclasses import dataclass

import pytest

from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.registry import EXERCISES
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
        ("exercise;points\n03a;1,5\n", {"03a": 1.5}),
        ("03a,4\nsystem,0\n", {"03a": 4, "system": 0}),
        ("\ufeffExercise,Points\r\n 3A , 4 \r\n", {"03a": 4}),
        ("exercise,points\n03,16\n", {"03a": 4, "03b": 4, "03c": 8}),
        ("exercise,points\n3,16\n03c,0\n", {"03a": 8, "03b": 8, "03c": 0}),
        ("03_write_a_publisher,10\n03a,1\n03b,1\n03c,3\n", {"03a": 2, "03b": 2, "03c": 6}),
        ("04,10\n", {"04a": 10}),
        ("03,0\n", {"03a": 0, "03b": 0, "03c": 0}),
        ("03,1\n03b,0\n03c,1\n", {"03a": 0.67, "03b": 0, "03c": 0.33}),
        ("03a,-0\n", {"03a": 0}),
        ("exercise,points\n", {}),
        ("", {}),
        ("exercise,why,points\n03a,\"so, yes\",4\n", {"03a": 4}),
    ],
)  # fmt: skip
def test_points_are_read(read, text, wanted):
    assert read(text) == wanted


@pytest.mark.parametrize("whole", ["10", "7.77", "0.05", "9999.99", "1", "33.34"])
def test_shares_of_a_page_are_hundredths_and_add_up(read, whole):
    shares = read(f"03,{whole}\n").values()
    assert all(round(one, 2) == one for one in shares)
    assert round(sum(shares), 6) == float(whole)


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("exercise,points\n03x,4\n", 2, "no exercise or page '03x'; did you mean 03"),
        ("exercise,points\n03a,4\n03a,5\n", 3, "03a stands in line 2 already"),
        ("exercise,points\n03a,4\n3a,5\n", 3, "line 2 already"),
        ("exercise,points\n03a,-1\n", 2, "from 0 to"),
        ("exercise,points\n03a,0.001\n", 2, "at least 0.01"),
        ("exercise,points\n03,0.02\n", 2, "too few points for all exercises of 03"),
        ("exercise,points\n03a,nan\n", 2, "from 0 to"),
        ("exercise,points\n03a,inf\n", 2, "from 0 to"),
        ("exercise,points\n03a,1e300\n", 2, "from 0 to"),
        ("exercise,points\n03a,four\n", 2, "'four' is no number"),
        ("exercise,points\n03a,\n", 2, "no number"),
        ("exercise,points\n03a\n", 2, "no number"),
        ("exercise,points\n,4\n", 2, "names no exercise"),
        ("exercise,weight\n03a,4\n", 1, "no column points"),
        ("03a,0\n03b,0\n03c,0\n03,10\n", 4, "none of the exercises of 03"),
        ('exercise,points\n03a,"4\n', 2, "quotation mark"),
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


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(GradingError, match="cannot be read") as caught:
        read_points(tmp_path / "no\x1b.csv")
    assert "\x1b" not in str(caught.value)


def test_the_course_s_own_exercises_and_pages_are_known(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("".join(f"{name},{one.points}\n" for name, one in EXERCISES.items()))
    points = read_points(path)
    assert points.by_exercise == {name: one.points for name, one in EXERCISES.items()}


def test_what_is_not_named_keeps_its_points():
    points = Points({"03a": 4.5, "03b": 0.0})
    assert points.of("03a", 2) == 4.5
    assert points.of("03b", 2) == 0
    assert points.of("04a", 1) == 1
    assert Points().of("04a", 3) == 3


@pytest.mark.parametrize(
    ("status", "points", "out_of", "worth", "wanted"),
    [
        (PASSED, 2, 2, 5.0, 5.0),
        (PASSED, 2, 2, 2.0, 2.0),
        (FAILED, 0, 2, 5.0, 0.0),
        (FAILED, 5, 20, 10.0, 2.5),
        (FAILED, 1, 3, 1.0, 0.33),
        (PASSED, 20, 20, 0.0, 0.0),
        (NOT_ATTEMPTED, 0, 4, 8.0, 0.0),
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

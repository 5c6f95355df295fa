from __future__ import annotations

import pytest

from rosbeat.errors import RecordError
from rosbeat.exercises.exercise import failed, not_attempted, passed
from rosbeat.exercises.progress import Standing, parse_standing
from rosbeat.records import Outcome


def after(*outcomes):
    standing = Standing()
    for outcome in outcomes:
        standing = standing.after(outcome)
    return standing


def test_nothing_tried_is_no_attempt():
    standing = after(not_attempted(), not_attempted())
    assert (standing.attempts, standing.status) == (0, "not attempted")


def test_attempts_are_counted_and_the_last_mistake_is_kept():
    standing = after(failed("03a", "", "", "depth-missing"), failed("03a", "", "", "wrong-rate"))
    assert (standing.attempts, standing.status, standing.mistake) == (2, "failed", "wrong-rate")


def test_who_has_passed_once_has_passed():
    standing = after(passed(""), failed("03a", "", ""), not_attempted())
    assert (standing.status, standing.outcome, standing.attempts) == ("passed", "not attempted", 2)


def test_the_most_points_count():
    points = [Outcome("03c", "failed", points=number, out_of=4) for number in (1, 3, 2)]
    assert after(*points).points == 3


def test_the_last_mistake_stays_after_passing():
    assert after(failed("03a", "", "", "wrong-rate"), passed("")).mistake == "wrong-rate"


def test_a_standing_comes_back_from_its_data():
    standing = Standing("failed", False, 1, 2, 3, True, "wrong-rate")
    assert parse_standing(standing.as_dict()) == standing
    assert parse_standing({**standing.as_dict(), "colour": "blue"}) == standing
    assert parse_standing({}) == Standing()


@pytest.mark.parametrize(
    "data",
    [None, 3, [], "passed", {"points": "2"}, {"points": -1}, {"passed": 1}, {"attempts": True},
     {"mistake": None}, {"outcome": []}],
)  # fmt: skip
def test_anything_else_is_refused(data, says):
    with pytest.raises(RecordError) as caught:
        parse_standing(data)
    says(caught.value)

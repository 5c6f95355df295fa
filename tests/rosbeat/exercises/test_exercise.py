"""Points: all or nothing, or for each requirement."""

import pytest

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import Exercise, passed
from rosbeat.records import Outcome, Part

MET, MISSED = Part("R1", "It opens.", True, "", 3), Part("R2", "It closes.", False, "No.", 2)
EXTRA = Part("R3", "It is calm.", False, "No.", 1, optional=True)


def judged(outcome):
    found = Exercise("13b", lambda answer: answer, lambda seen: outcome, points=6).judged(None)
    return found.points, found.out_of


@pytest.mark.parametrize(
    ("outcome", "points"),
    [
        (passed("Good."), 6),
        (Diagnosis("new-to-me", "No.", "Look."), 0),
        (Outcome("13b", "failed", "No.", parts=(MET, MISSED, EXTRA)), 3),
        (Outcome("13b", "passed", "Good.", parts=(MET, EXTRA)), 3),
    ],
)
def test_points_are_given_once_or_for_each_requirement(outcome, points):
    assert judged(outcome) == (points, 6)


def test_a_part_that_is_missed_gives_nothing():
    assert [part.points for part in (MET, MISSED, EXTRA)] == [3, 0, 0]

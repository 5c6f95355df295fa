"""What a class did, counted."""

import pytest

from graded_classes import a_class, mark
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.tally import (
    empty_handed,
    held,
    nameless,
    tally_exercises,
    tally_mistakes,
    tally_points,
)


def learner(name, *marks):
    return Graded(name, name, "folder", marks)


def wrong(exercise, mistake, hint="h", evidence="e"):
    return mark(exercise, "failed", mistake=mistake, hint=hint, evidence=evidence)


BOOK = Gradebook(
    "1",
    (
        learner("ana", mark("03a"), wrong("04a", "boundary", "one")),
        learner("ben", wrong("03a", "boundary", "two"), wrong("04a", "boundary", "two")),
        learner("cy", mark("03a", "held"), wrong("04a", "new-to-me")),
        learner("di", mark("03a", "missing"), mark("04a", "missing")),
    ),
)


def test_exercises_are_counted_in_the_order_of_the_course():
    found = tally_exercises(BOOK)
    assert [one.exercise for one in found] == ["03a", "04a"]
    assert found[0].counts == {"passed": 1, "failed": 1, "held": 1, "missing": 1}
    assert found[1].counts == {"failed": 3, "missing": 1}
    assert {one.learners for one in found} == {4}


def test_mistakes_come_most_frequent_first_with_their_places_and_hint():
    first, second = tally_mistakes(BOOK)
    assert (first.mistake, first.count, first.learners) == ("boundary", 3, 2)
    assert first.places == (("04a", 2), ("03a", 1))
    assert first.hint == "two"
    assert (second.mistake, second.count) == ("new-to-me", 1)


def test_points_are_sorted_into_steps():
    found = tally_points(BOOK)
    assert dict(found.steps)["50 to 59 %"] == 1
    assert dict(found.steps)["0 to 9 %"] == 3
    assert (found.median, found.mean) == (0.0, 12.5)
    assert found.highest == 3
    assert (found.range[0][0], found.range[-1][0]) == ("0 to 9 %", "50 to 59 %")


@pytest.mark.parametrize(
    ("points", "step"),
    [(0, "0 to 9 %"), (0.999, "90 to 99 %"), (1, "100 %"), (2, "100 %"), (-1, "0 to 9 %")],
)
def test_each_share_has_its_step(points, step):
    found = tally_points(Gradebook("1", (learner("ana", mark(points=points)),)))
    assert [name for name, many in found.steps if many] == [step]


def test_without_points_nothing_is_counted():
    for book in (Gradebook("1", ()), Gradebook("1", (learner("ana"),))):
        found = tally_points(book)
        assert (found.highest, found.range, found.median) == (0, (), 0.0)


def test_who_has_to_be_looked_at():
    assert [(one.name, found.exercise) for one, found in held(BOOK)] == [("cy", "03a")]
    assert [(one.name, found.exercise) for one, found in nameless(BOOK)] == [("cy", "04a")]
    assert [one.name for one in empty_handed(BOOK)] == ["di"]


def test_a_class_adds_up():
    book = a_class(120)
    assert all(one.learners == 120 for one in tally_exercises(book))
    failed = sum(one.counts.get("failed", 0) for one in tally_exercises(book))
    assert sum(one.count for one in tally_mistakes(book)) == failed
    assert sum(many for _, many in tally_points(book).steps) == 120

"""Every answer gets its verdict, and its mistake a true name; and the bank is wide enough."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from bank import examples
from bank.pages import NODE_EXERCISES
from bank.reading import answers, hidden, parse
from bank.running import ENDLESS, told
from distributions import IS_KILTED
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.exercises.registry import EXERCISES

ANSWERS = answers()
BANK = Path(__file__).parent / "answers"
#: The whole system is checked by tests of its own.
ON_PAGES = sorted(set(EXERCISES) - {"system"})
#: Rows of the table of mistakes that a cell with a node class can show. The others belong to
#: terminals and files (20 to 29), or need a program of their own or a second one.
ROWS = {*range(1, 17), 17, 19, 30}


#: What answers get in Kilted whose rclpy says something else about them: status and mistakes.
ON_KILTED = {
    ("03a", "rclpy.init in a with statement"): ("passed", ()),
    # It takes arguments by position, and the history is the first.
    ("08a", "a depth without its name"): ("failed", ("depth-missing",)),
}


def on_this_ros(answer):
    """Return an answer with what it gets on the distribution that the tests run on."""
    if not IS_KILTED or (answer.exercise, answer.name) not in ON_KILTED:
        return answer
    status, mistakes = ON_KILTED[answer.exercise, answer.name]
    return replace(answer, status=status, mistakes=mistakes)


def assert_told(answer, workspace):
    """Check the verdict on an answer, the mistake that is named, and what else is said."""
    found = told(answer, workspace)
    assert found.status == answer.status, found
    assert found.mistake in (answer.mistakes or ("",)), found
    assert found.evidence
    assert bool(found.hint) == (answer.status == "failed"), found
    assert not leaks(answer.exercise, found.hint), found
    assert {part.id for part in found.parts if not part.met} == answer.misses
    if answer.status == "passed":
        assert found.points == found.out_of - len(answer.misses)
    if answer.points is not None:
        assert found.points == answer.points, found
    assert is_shown_as(answer, found), (
        f"run: PYTHONPATH=tests .venv/bin/python -m bank.examples {answer.exercise}"
    )


def is_shown_as(answer, found):
    """Return whether `rosbeat class` says the same of this answer, if it is among its examples.

    Where an endless answer was depends on the machine, and the words of an error on Python and on
    rclpy.
    """
    said = examples.shown().get((answer.exercise, examples.digest(answer), found.mistake))
    if said is None or found.mistake in ENDLESS:
        return True
    seen, hint = examples.words(found)
    return said[1] == hint and (IS_KILTED or "Error" in seen or said[0] == seen)


def leaks(exercise, hint):
    """Return the pieces of the answer that a hint gives away."""
    text = re.sub(r"\s", "", hint)
    return [piece for piece in hidden(exercise) if re.sub(r"\s", "", piece) in text]


@pytest.mark.ros
@pytest.mark.parametrize("answer", ANSWERS, ids=lambda one: one.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer, workspace):
    assert_told(on_this_ros(answer), workspace)


def assert_sound(found):
    """Check that names are unique, and that each wrong answer has mistakes of the catalogue."""
    assert len({one.id for one in found}) == len(found)
    assert {name for one in found for name in one.mistakes} <= {UNKNOWN, *MISTAKES}
    assert all(bool(one.mistakes) == (one.status == "failed") for one in found)


def test_names_are_unique_and_mistakes_are_known():
    assert_sound(ANSWERS)


def least(exercise):
    """Return how many answers of each kind an exercise has at least; docs/exercises.md says so."""
    wrong, several = (8, 1) if exercise < "07" else (12, 3)
    if exercise in NODE_EXERCISES:  # everybody meets these first
        wrong, several = 30, 5
    untried = exercise < "07" and exercise not in NODE_EXERCISES
    return {
        "`=== right | ...`": 6,
        "`=== wrong a-mistake | ...`, with one mistake": wrong,
        "`=== wrong a-mistake or another | ...`, with several": several,
        "`=== untried | ...`": int(untried),
        "`hidden: ...`, a piece of the answer that no hint may hold": 1,
    }


@pytest.mark.parametrize("exercise", ON_PAGES)
def test_an_exercise_has_enough_answers(exercise):
    file = BANK / f"{exercise}.txt"
    assert file.exists(), f"Write answers to {exercise} into {file}: {least(exercise)}"
    mine = [one for one in ANSWERS if one.exercise == exercise]
    counts = (
        sum(one.status == "passed" for one in mine),
        sum(len(one.mistakes) == 1 for one in mine),
        sum(len(one.mistakes) > 1 for one in mine),
        sum(one.status == "not attempted" for one in mine),
        len(hidden(exercise)),
    )
    missing = [
        f"{wanted - count} more of {kind} (there are {count}, of {wanted})"
        for count, (kind, wanted) in zip(counts, least(exercise).items(), strict=True)
        if count < wanted
    ]
    assert not missing, f"{file.name} needs " + "; ".join(missing)


def test_every_row_of_the_table_is_made_that_can_be_made():
    cells = [one for one in ANSWERS if one.exercise in NODE_EXERCISES]
    names = {name for one in cells for name in one.mistakes} & set(MISTAKES)
    assert {MISTAKES[name].row for name in names} >= ROWS


def test_optional_requirements_are_met_by_some_right_answers_and_missed_by_others():
    missed = {one.misses for one in ANSWERS if (one.exercise, one.status) == ("13b", "passed")}
    assert {frozenset(), frozenset({"R10", "R11"})} <= missed
    assert frozenset().union(*missed) == {"R10", "R11"}


def test_most_mistakes_of_the_bank_can_be_shown_to_a_class():
    there_are = examples.candidates()
    shown = {(exercise, name) for exercise, _, name in examples.shown()}
    assert shown <= set(there_are)
    assert len(shown) >= 0.9 * len(there_are)  # of two names for one mistake, a check says one


def test_single_mistakes_have_names():
    single = [one.mistakes[0] for one in ANSWERS if len(one.mistakes) == 1]
    assert single.count(UNKNOWN) <= 0.05 * len(single)


@pytest.mark.parametrize("exercise", ON_PAGES)
def test_hints_go_from_general_to_exact_and_hold_no_answer(exercise):
    assert EXERCISES[exercise].title
    hints = EXERCISES[exercise].hints
    assert 2 <= len(set(hints)) == len(hints) <= 4
    # One hint of 04c shows how the end of a list is written.
    assert not [one for one in hints if leaks(exercise, one)] or exercise == "04c"


def test_a_hint_that_gives_the_answer_is_noticed():
    assert leaks("03b", "Write max( 18.0, ...).") == ["max(18"]
    assert leaks("03b", "Which function cuts off what is below?") == []


# How the bank is written.

SOLUTION = """class A(Node):
    low = 1
    high = 2

    def look(self):
        return self.low
"""


def only(text):
    """Return the only answer of a text."""
    (found,) = parse("03a", text, SOLUTION)
    return found


def test_an_entry_that_is_changed_is_a_whole_one():
    head = "=== right | b\nlow = 1 => low = 2\n=== right | c | from b\n"
    for change in ("low = 2 => low = 3\n", "x = 1\n"):
        with pytest.raises(ValueError, match="03a c: it has to change a whole entry"):
            parse("03a", head + change, SOLUTION)
    with pytest.raises(ValueError, match="03a: without a name"):
        parse("03a", "=== right\nx = 1\n", SOLUTION)


@pytest.mark.parametrize(
    "entry",
    [
        "low => high",
        "nothing => high",
        "-    mid = 2",
        "     low = 1\n-    low = 2",
        " => a",
    ],
)
def test_a_change_has_to_find_its_place(entry):
    with pytest.raises(ValueError, match=r"03a edited: \d places to change, and not one"):
        only(f"=== right | edited\n{entry}\n")

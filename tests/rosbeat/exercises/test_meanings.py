"""What was recognised where an answer ran, in the words of a judge."""

from rosbeat.exercises.scenarios import CommandMeaning

from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN, Diagnosis
from rosbeat.exercises.meanings import diagnosis_of


def test_a_known_mistake_keeps_its_name():
    known = diagnosis_of(CommandMeaning("folder-not-found", "There is none.", "Look."))
    assert known == Diagnosis("folder-not-found", "There is none.", "Look.")
    assert known.mistake in MISTAKES


def test_a_name_that_nobody_has_given_is_unknown():
    assert diagnosis_of(CommandMeaning("passed", "a", "b")) == Diagnosis(UNKNOWN, "a", "b")


def test_nothing_recognised_is_nothing():
    assert diagnosis_of(None) is None

"""What a command has led to, in the words of a judge."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN, Diagnosis
from rosbeat.exercises.scenarios import CommandMeaning


def diagnosis_of(meaning: CommandMeaning | None) -> Diagnosis | None:
    """Take what was recognised on the spot as a diagnosis.

    Evidence comes from where a stranger's code has run, so a mistake that nobody knows by its name
    is an unknown one.

    Args:
        meaning: What the evidence says of a command.
    """
    if meaning is None:
        return None
    mistake = meaning.mistake if meaning.mistake in MISTAKES else UNKNOWN
    return Diagnosis(mistake, meaning.evidence, meaning.hint)

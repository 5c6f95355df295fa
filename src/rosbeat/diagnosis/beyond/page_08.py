"""Mistakes in the exercises of page 08, tune quality of service."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    Mistake("not-kept", "a last word that is not kept for those who come late"),
    Mistake("old-words-too", "more kept for those who come late than asked for"),
    Mistake("change-missing", "a change that nobody is told about"),
    Mistake("lifespan-too-short", "a lifespan that throws messages away too early"),
    Mistake("queue-too-short", "a queue too short for the pause"),
    Mistake("heard-twice", "the same message heard by two subscriptions"),
    Mistake("no-deadline", "a silence that nothing measures"),
    Mistake("deadline-unheard", "a deadline that nobody is told about"),
    Mistake("deadline-wrong-side", "a deadline where nothing is waited for"),
    Mistake("wrong-deadline", "another deadline than asked for"),
)

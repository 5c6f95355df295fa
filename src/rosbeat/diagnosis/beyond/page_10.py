"""Mistakes in the exercises of page 10, find the fault."""

from __future__ import annotations

from rosbeat.diagnosis.mistake import Mistake

MISTAKES: tuple[Mistake, ...] = (
    # What a patient may have.
    Mistake("wrong-namespace", "a topic's name in another namespace"),
    Mistake("two-sources", "two publishers where one was ordered"),
    Mistake("depth-too-small", "a queue too short for what comes at once"),
    # What a diagnosis may be.
    Mistake("contradicted", "a diagnosis that the instruments contradict"),
    Mistake("other-place", "the right kind of fault at another place"),
    Mistake("no-such-diagnosis", "a diagnosis that the clinic does not know"),
    Mistake("no-such-place", "a place that the patient does not have"),
    Mistake("no-diagnosis-yet", "a patient without a diagnosis"),
    Mistake("half-a-diagnosis", "one diagnosis where there are two faults"),
    Mistake("no-diagnoses", "a result that holds no diagnoses"),
)

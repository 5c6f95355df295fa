"""Whether commands are given as agreed: when they change, and so that latecomers know (R7, R10)."""

from __future__ import annotations

from itertools import pairwise

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.reading import Switch, silent, stamp, switch
from rosbeat.exercises.greenhouse.trials import LATE_PUMP, LATE_VENT, Trials
from rosbeat.records import Observation

_ACTUATORS = ("/vent", "/pump")


def judge_calm(trials: Trials) -> Diagnosis | None:
    """R7: no command twice in a row."""
    for topic in _ACTUATORS:
        wrong = silent(trials.plain, topic) or repeated(switch(trials.plain, topic), topic)
        if wrong:
            return wrong
    return None


def repeated(commands: Switch, topic: str) -> Diagnosis | None:
    """The first command that was given twice in a row.

    Args:
        commands: What was said.
        topic: Where.
    """
    said = commands.commands
    for (first, was), (second, now) in pairwise(said):
        if was == now:
            evidence = f"{topic} got {now} at {stamp(first)}, and again at {stamp(second)}."
            hint = "Remember the last command, and publish only another one."
            return Diagnosis("status-repeated", evidence, hint)
    if any(on for _, on in said):
        return None
    evidence = f"{topic} never got True, so nothing can be said of changes."
    return Diagnosis("never-switched-on", evidence, "Let the actuator work first.")


def judge_latecomers(trials: Trials) -> Diagnosis | None:
    """R10: who joins late learns how things stand."""
    seen = trials.plain
    for topic, node in zip(_ACTUATORS, (LATE_VENT, LATE_PUMP), strict=True):
        quiet = silent(seen, topic)
        if quiet:
            return quiet
        wanted = str(switch(seen, topic).at(seen.time))
        if _heard(seen, node)[-1:] != [wanted]:
            (end, *_) = seen.graph.on(topic, "publisher")
            evidence = (
                f"A display that joined at the end did not hear that {topic} is {wanted}. "
                f"{end.node} offers {end.qos.durability}, with a depth of {end.qos.depth}."
            )
            hint = "A publisher that keeps its last message for latecomers has another durability."
            return Diagnosis("first-messages-lost", evidence, hint)
    return None


def _heard(seen: Observation, node: str) -> list[str]:
    return [line.text for line in seen.logs if line.name == node]

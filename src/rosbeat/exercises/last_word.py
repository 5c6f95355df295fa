"""The last word waits: what a mode keeper published, and what displays heard that came late.

Pure functions from an observation to an outcome. A display is a node that logs what it hears.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.qos import POLICY_ALONE, incompatible, rule
from rosbeat.diagnosis.qos import words as said_of
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_08_scenarios as page_08
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.page_08_scenarios import Display
from rosbeat.records import Endpoint, Observation, Outcome

MODE = Wire(page_08.MODE, page_08.STRING)
COMMAND = Wire(page_08.COMMAND, page_08.STRING)
#: The mode before the first command.
START = "idle"
#: Seconds that a node may take to say its first mode.
_AT_ONCE = 0.4
_KEEP = "The publisher has to keep what it said for those who come late. Which policy says so?"


def judge_last_word(
    exercise: str,
    observation: Observation,
    commands: Sequence[tuple[float, str]],
    displays: Iterable[Display],
) -> Outcome:
    """Judge a node whose last word waits for those who come late.

    Args:
        exercise: The exercise's id.
        observation: What the node did, and what the displays heard.
        commands: When which mode was commanded.
        displays: Who listened.
    """
    modes = _modes(commands)
    wrong = _published(observation, commands, modes)
    if wrong:
        return failed_by(exercise, wrong)
    everybody = list(displays)
    for display in everybody:
        wrong = _heard(observation, display, modes)
        if wrong:
            return failed_by(exercise, wrong)
    return passed(
        exercise,
        f"{len(everybody)} displays came at different times. Each one that asked for it got the "
        "mode of that moment, and only that one.",
    )


def _modes(commands: Sequence[tuple[float, str]]) -> list[tuple[float, str]]:
    """When which mode begins; a command for the mode that there is changes nothing."""
    found = [(0.0, START)]
    for at, word in commands:
        if word != found[-1][1]:
            found.append((at, word))
    return found


# What was published.


def _published(
    observation: Observation,
    commands: Sequence[tuple[float, str]],
    modes: Sequence[tuple[float, str]],
) -> Diagnosis | None:
    said = [one for one in observation.samples if one.topic == MODE.topic]
    if not said:
        return why_not_published(observation, MODE) or Diagnosis(
            "never-published",
            "Nothing was published on /mode.",
            "The first mode is published at once, in the constructor.",
        )
    if said[0].type_name != MODE.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on /mode are of type {said[0].type_name}.",
            "A mode is a String, as the command is.",
        )
    words = [(one.time, str(one.value)) for one in said]
    return _start(words) or _changes(observation, words, commands, modes)


def _start(words: Sequence[tuple[float, str]]) -> Diagnosis | None:
    at, word = words[0]
    if at <= _AT_ONCE and word == START:
        return None
    evidence = (
        f"The first mode was {word!r}, at {at:g} s."
        if word != START
        else f"{START!r} was published at {at:g} s, and until then nobody could know the mode."
    )
    hint = f"Publish {START!r} as soon as there is something to publish with."
    return Diagnosis("wrong-start", evidence, hint)


def _changes(
    observation: Observation,
    words: Sequence[tuple[float, str]],
    commands: Sequence[tuple[float, str]],
    modes: Sequence[tuple[float, str]],
) -> Diagnosis | None:
    if words[1:] == modes[1:]:
        return None
    if len(words) == 1 and not _obeyed(observation):
        return why_not_heard(observation, COMMAND) or Diagnosis(
            UNKNOWN,
            f"{len(commands)} commands came, and no callback ran for them.",
            "Does the node listen to /command?",
        )
    return _strange(words, commands) or _again(words) or _missed(words, modes)


def _obeyed(observation: Observation) -> bool:
    return any(
        (one.node, one.source) == (observation.subject, COMMAND.topic)
        for one in observation.callbacks
    )


def _again(words: Sequence[tuple[float, str]]) -> Diagnosis | None:
    for (_, before), (at, word) in pairwise(words):
        if word == before:
            return Diagnosis(
                "status-repeated",
                f"At {at:g} s {word!r} was published, and it was the mode already.",
                "A command for the mode that there is changes nothing: nobody need hear of it.",
            )
    return None


def _strange(
    words: Sequence[tuple[float, str]], commands: Sequence[tuple[float, str]]
) -> Diagnosis | None:
    known = {word for _, word in commands} | {START}
    strange = next(((at, word) for at, word in words if word not in known), None)
    if not strange:
        return None
    return Diagnosis(
        "wrong-values",
        f"At {strange[0]:g} s {strange[1]!r} was published. The commands were "
        f"{', '.join(repr(word) for _, word in commands)}.",
        "The mode is the command's text, unchanged.",
    )


def _missed(
    words: Sequence[tuple[float, str]], modes: Sequence[tuple[float, str]]
) -> Diagnosis | None:
    missing = next((one for one in modes[1:] if one not in words), None)
    if missing:
        return Diagnosis(
            "change-missing",
            f"At {missing[0]:g} s the command was {missing[1]!r}, and /mode did not say so then.",
            "Each command that is not the mode already is a new mode. Is it kept, and published?",
        )
    extra = next(one for one in words[1:] if one not in modes)
    evidence = f"At {extra[0]:g} s {extra[1]!r} was published, and no command asked for it then."
    return Diagnosis("wrong-values", evidence, "Publish when a command comes, and only then.")


# What was heard.


def _heard(
    observation: Observation, display: Display, modes: Sequence[tuple[float, str]]
) -> Diagnosis | None:
    name = display.name
    heard = [log.text for log in observation.logs if log.name == name]
    after = [word for at, word in modes if at > display.joins]
    before = [word for at, word in modes if at <= display.joins]
    keeps = display.qos.durability == "TRANSIENT_LOCAL"
    wanted = [*before[-1:], *after] if keeps else after
    if heard == wanted:
        return None
    if not after or heard[-len(after) :] != after:
        unfit = _unfit(observation, display)
        if unfit:
            return unfit
    if len(heard) > len(wanted) and heard[-len(wanted) :] == wanted:
        return _old(display, heard, wanted)
    if heard == after:
        return _not_kept(display, before[-1])
    return Diagnosis(
        UNKNOWN,
        f"A display that came at {display.joins:g} s heard {_listed(heard)}, and it should hear "
        f"{_listed(wanted)}.",
        "Compare what the publisher offers with what such a display asks for.",
    )


def _ends(observation: Observation, name: str, kind: str) -> list[Endpoint]:
    return [end for end in observation.graph.on(MODE.topic, kind) if end.node == name]


def _unfit(observation: Observation, display: Display) -> Diagnosis | None:
    for end in _ends(observation, observation.subject, "publisher"):
        clash = incompatible(end.qos, display.qos)
        if clash == ("durability",):
            return _cut_off(display, end)
        for policy in clash:
            return Diagnosis(
                "qos-mismatch",
                f"A display asks for {said_of(display.qos, policy)} and the node offers "
                f"{said_of(end.qos, policy)}, so the display heard nothing at all.",
                f"The rule of {policy}: {rule(policy)}.",
            )
    return None


def _cut_off(display: Display, end: Endpoint) -> Diagnosis:
    alone = f" {POLICY_ALONE}" if end.qos.depth == 1 else ""  # the number of TRANSIENT_LOCAL
    return Diagnosis(
        "not-kept",
        f"A display came at {display.joins:g} s and asked for TRANSIENT_LOCAL. The node offers "
        "VOLATILE, so they are not connected: it heard neither the old mode nor any new one.",
        _KEEP + alone,
    )


def _not_kept(display: Display, word: str) -> Diagnosis:
    return Diagnosis(
        "not-kept",
        f"A display came at {display.joins:g} s and asked for what is kept. It did not get "
        f"{word!r}.",
        _KEEP,
    )


def _old(display: Display, heard: Sequence[str], wanted: Sequence[str]) -> Diagnosis:
    old = heard[: len(heard) - len(wanted)]
    return Diagnosis(
        "old-words-too",
        f"A display came at {display.joins:g} s and got {_listed(old)} first. That was over by "
        f"then; the mode was {wanted[0]!r}.",
        "The publisher keeps as many messages as its queue is long. How many of them are still "
        "true?",
    )


def _listed(words: Sequence[str]) -> str:
    return ", ".join(map(repr, words)) or "nothing"

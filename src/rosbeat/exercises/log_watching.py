"""A node that listens to log lines: pure functions from what it did to an outcome."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_07_scenarios as page_07
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.page_07_scenarios import DEBUG, ERROR, FATAL, INFO, LINES, WARN, Line
from rosbeat.records import Observation, Outcome, Sample

ROSOUT = Wire(page_07.ROSOUT, page_07.LOG)
WARNINGS = Wire("/warnings", "std_msgs/msg/String")

_LEVELS = {DEBUG: "DEBUG", INFO: "INFO", WARN: "WARN", ERROR: "ERROR", FATAL: "FATAL"}


def counts(line: Line) -> bool:
    """Whether a line is a warning, or worse."""
    return line.level >= WARN


def judge_log_watcher(exercise: str, observation: Observation) -> Outcome:
    """Judge a node that was fed with log lines.

    Args:
        exercise: The exercise's id.
        observation: What it did.
    """
    wrong = _missing(observation) or _names(observation)
    if wrong:
        return failed_by(exercise, wrong)
    count = sum(counts(line) for line in LINES)
    return passed(exercise, f"{len(LINES)} log lines, {count} warnings or worse, each one named.")


def _said(observation: Observation) -> list[Sample]:
    return [sample for sample in observation.samples if sample.topic == WARNINGS.topic]


def _missing(observation: Observation) -> Diagnosis | None:
    # What was done to the node is a callback of another kind, and names the topic, too.
    heard = [one for one in observation.callbacks if one.kind == "subscription"]
    if not any(one.source == ROSOUT.topic for one in heard):
        return why_not_heard(observation, ROSOUT) or Diagnosis(
            "new-to-me",
            f"{len(LINES)} log lines came over /rosout, and the node got none.",
            "Does it call create_subscription, with the topic /rosout?",
        )
    said = _said(observation)
    if not said:
        return why_not_published(observation, WARNINGS) or Diagnosis(
            "never-published",
            "There were warnings, and nothing was published on /warnings.",
            "Does the callback come to the line that publishes?",
        )
    if said[0].type_name == WARNINGS.type_name:
        return None
    return Diagnosis(
        "type-mismatch",
        f"The messages on /warnings are of type {said[0].type_name}.",
        "A name is a text: which message type carries one?",
    )


# Which lines count.


def _names(observation: Observation) -> Diagnosis | None:
    at = {float(second): line for second, line in enumerate(LINES, 1)}
    said = _said(observation)
    stray = [one for one in said if one.time not in at]
    if stray:
        evidence = f"Something was published at {stray[0].time:g} s, and no log line came then."
        return Diagnosis("alert-too-many", evidence, "Publish in the callback of /rosout.")
    counted = {one.time for one in said}
    wrong = _extra(counted, at) or _left_out(counted, at)
    if wrong:
        return wrong
    for one in said:
        found = _other_than_the_name(str(one.value).strip(), at[one.time], observation)
        if found:
            return found
    return _twice(said)


def _twice(said: list[Sample]) -> Diagnosis | None:
    if len(said) == len({one.time for one in said}):
        return None
    evidence = f"{len(said)} names for {sum(counts(line) for line in LINES)} lines."
    return Diagnosis("alert-too-many", evidence, "One name for each line is enough.")


def _extra(counted: set[float], at: dict[float, Line]) -> Diagnosis | None:
    extra = [at[second] for second in sorted(counted) if not counts(at[second])]
    if not extra:
        return None
    one = extra[0]
    return Diagnosis(
        "level-too-low",
        f"{one.name} was named for a line of level {_LEVELS[one.level]}: {one.msg!r}.",
        "A number in the message says how bad it is, whatever the text says. Compare with the "
        "number of a warning.",
    )


def _left_out(counted: set[float], at: dict[float, Line]) -> Diagnosis | None:
    wanted = {second: line for second, line in at.items() if counts(line)}
    missed = {second: line for second, line in wanted.items() if second not in counted}
    if not missed:
        return None
    first = min(missed)
    line = missed[first]
    evidence = f"Nothing was published for a line of level {_LEVELS[line.level]}: {line.msg!r}."
    heard = {one.level for second, one in wanted.items() if second in counted}
    if line.level in heard:
        return Diagnosis("said-once", evidence, "Each line counts, also of a node named before.")
    if line.level == WARN:
        return Diagnosis(
            "boundary", evidence, "A warning itself counts, and so does what is worse."
        )
    return Diagnosis("level-missed", evidence, "What is worse than a warning counts, too.")


# What is said of them.


def _other_than_the_name(text: str, line: Line, observation: Observation) -> Diagnosis | None:
    if text == line.name:
        return None
    own = observation.subject.strip("/").replace("/", ".")
    evidence = f"For a line of {line.name}, {text!r} was published."
    if text == line.msg:
        return Diagnosis(
            "text-for-name", evidence, "That is what it says. Which field says who says it?"
        )
    if text in (own, f"/{own}"):
        hint = "That is the node that listens. Who speaks stands in the message."
        return Diagnosis("own-name", evidence, hint)
    if line.name in text:
        return Diagnosis("stray-characters", evidence, "Publish the name, and nothing around it.")
    hint = "Which field of the message holds the name? ros2 interface show lists them all."
    return Diagnosis("wrong-values", evidence, hint)

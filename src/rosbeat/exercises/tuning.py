"""A monitor whose limits are parameters, and change while it runs.

Pure functions from what a node did in the run of page 07 to an outcome.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_07_scenarios as page_07
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.page_07_scenarios import CHANGES, READINGS
from rosbeat.records import Observation, Outcome, Sample

TEMPERATURE = Wire(page_07.TEMPERATURE, page_07.FLOAT)
STATUS = Wire("/status", "std_msgs/msg/String")

#: The values before anything is set.
DEFAULTS = {"low": 20.0, "high": 26.0}
_WORDS = ("High", "Low", "Normal")
_FIRST = CHANGES[0][0]


@dataclass(frozen=True)
class _Limits:
    low: float
    high: float

    def word(self, value: float) -> str:
        return "High" if value > self.high else "Low" if value < self.low else "Normal"


def judge_tuning(exercise: str, observation: Observation) -> Outcome:
    """Judge a monitor that was run through the plan.

    Args:
        exercise: The exercise's id.
        observation: What it did.
    """
    wrong = _missing(observation) or _unset(observation)
    said = {sample.time: str(sample.value).strip() for sample in _statuses(observation)}
    wrong = wrong or _count(observation, said) or _words(said) or _values(said)
    if wrong:
        return failed_by(exercise, wrong)
    changes = sum(len(values) for _, values in CHANGES)
    return passed(exercise, f"{len(READINGS)} readings, {changes} changes of a parameter, no slip.")


def _statuses(observation: Observation) -> list[Sample]:
    return [sample for sample in observation.samples if sample.topic == STATUS.topic]


def _missing(observation: Observation) -> Diagnosis | None:
    if not any(one.source == TEMPERATURE.topic for one in observation.callbacks):
        found = why_not_heard(observation, TEMPERATURE)
        if found:
            return found
    statuses = _statuses(observation)
    if not statuses:
        return why_not_published(observation, STATUS) or Diagnosis(
            "never-published",
            "Readings arrived, and nothing was published on /status.",
            "Does the callback come to the line that publishes?",
        )
    if statuses[0].type_name == STATUS.type_name:
        return None
    return Diagnosis(
        "type-mismatch",
        f"The messages on /status are of type {statuses[0].type_name}.",
        "A status is a String: the first argument of create_publisher, and what you publish.",
    )


# The parameters.


def _unset(observation: Observation) -> Diagnosis | None:
    """A parameter that could not be set."""
    steps = [one.source for one in observation.callbacks if one.name == "SetParameter"]
    refused = [one for one in steps if not one.endswith(": accepted")]
    if not refused:
        return None
    name, _, why = refused[0].partition(": ")
    if "not declared" in why:
        return Diagnosis(
            "parameter-undeclared",
            f"`ros2 param set` was refused: the node has no parameter {name}.",
            "Which call in the constructor makes a parameter? Its name has to be this one, letter "
            "by letter.",
        )
    if "type" in why.lower():
        return Diagnosis(
            "parameter-type",
            f"`ros2 param set` with a decimal number was refused for {name}: {_after(why)}.",
            "The first value that declare_parameter gets decides about the type: 3 is a whole "
            "number, 3.0 is a decimal one.",
        )
    return Diagnosis(
        "parameter-refused",
        f"`ros2 param set` was refused for {name}: {_after(why)}.",
        "Each number is a good limit here. Who says no, and when?",
    )


def _after(why: str) -> str:
    return why.partition(", ")[2].rstrip(".") or "without a reason"


# The statuses.


def _count(observation: Observation, said: dict[float, str]) -> Diagnosis | None:
    times = [float(second) for second in range(1, len(READINGS) + 1)]
    if sorted(said) == times and len(_statuses(observation)) == len(times):
        return None
    return Diagnosis(
        "wrong-rate",
        f"{len(times)} readings arrived, and {len(_statuses(observation))} statuses came.",
        "Publish one status for each reading, when it comes, whether it has changed or not.",
    )


def _words(said: dict[float, str]) -> Diagnosis | None:
    strange = next((word for word in said.values() if word not in _WORDS), None)
    if strange is None:
        return None
    return Diagnosis(
        "wrong-word",
        f"On /status appeared {strange!r}.",
        f"The words are {', '.join(_WORDS)}, and nothing else.",
    )


def _asked(lag: int = 0) -> list[_Limits]:
    """The limits at each reading, or those that held so many readings before."""
    limits, found = _Limits(**DEFAULTS), []
    changes = dict(CHANGES)
    for number in range(1, len(READINGS) + 1):
        limits = replace(limits, **changes.get(number - lag, {}))
        found.append(limits)
    return found


def _model(limits: Sequence[_Limits]) -> list[str]:
    return [one.word(value) for one, value in zip(limits, READINGS, strict=True)]


def _values(said: dict[float, str]) -> Diagnosis | None:
    found = [said[at] for at in sorted(said)]
    wanted = _model(_asked())
    off = next(
        (n for n, pair in enumerate(zip(found, wanted, strict=True)) if len({*pair}) > 1), -1
    )
    if off < 0:
        return None
    return _known(found) or _by_place(found, wanted, off)


def _known(found: list[str]) -> Diagnosis | None:
    """A mistake that explains every status."""
    asked, start = _asked(), _Limits(**DEFAULTS)
    frozen = {
        "low and high are": [start] * len(asked),
        "low is": [replace(one, low=start.low) for one in asked],
        "high is": [replace(one, high=start.high) for one in asked],
    }
    for who, limits in frozen.items():
        if found == _model(limits):
            return Diagnosis(
                "parameter-frozen",
                f"What was set while the node ran never counted: {who} always as at the start.",
                "Where is the value asked for: once, or each time that a reading comes?",
            )
    if found == _model(_asked(lag=1)):
        return Diagnosis(
            "parameter-late",
            "A value that was set counted one reading too late.",
            "Ask for the value first, and then decide.",
        )
    swapped = [_Limits(low=one.high, high=one.low) for one in asked]
    if found == _model(swapped):
        return Diagnosis(
            "parameters-swapped",
            "High came above the lower limit, and Low below the upper one.",
            "Which of the two values belongs to which name, and to which comparison?",
        )
    return None


def _by_place(found: list[str], wanted: list[str], off: int) -> Diagnosis:
    limits, value = _asked()[off], READINGS[off]
    evidence = (
        f"With low at {limits.low:g} and high at {limits.high:g}, a reading of {value:g} was "
        f"{found[off]}."
    )
    wrong = [n for n, pair in enumerate(zip(found, wanted, strict=True)) if len({*pair}) > 1]
    if all(READINGS[n] in (_asked()[n].low, _asked()[n].high) for n in wrong):
        hint = "Exactly at a limit all is Normal: > and < leave the limit itself out."
        return Diagnosis("boundary", evidence, hint)
    if off < _FIRST - 1 and found[CHANGES[-1][0] - 1 :] == wanted[CHANGES[-1][0] - 1 :]:
        evidence = f"Before anything was set, a reading of {value:g} was {found[off]}."
        return Diagnosis("other-default", evidence, "Low begins at 20.0, and high at 26.0.")
    return Diagnosis("wrong-state", evidence, "Which of your conditions is true there?")

"""Page 12, beyond topics: a threshold behind a service, checked parameters, an action."""

from __future__ import annotations

from typing import Any

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.silence import difference, nearest
from rosbeat.exercises import adjusting, heating
from rosbeat.exercises.adjusting import Answer, Limits, phases
from rosbeat.exercises.exercise import Exercise, failed_by, passed
from rosbeat.exercises.page_12_scenarios import BASIC, BY_PARAMETER, BY_SERVICE, SCENARIOS, SERVICE
from rosbeat.records import Observation, Outcome

#: What holds when, and which requests make sense: from 10 to 40; and low below high.
_BY_SERVICE = phases(Limits(26.0), BY_SERVICE, lambda limits: 10 <= limits.high <= 40)
_BY_PARAMETER = phases(Limits(26.0, 20.0), BY_PARAMETER, lambda limits: limits.low < limits.high)


# 12a: a service.


def _judge_service(observation: Observation) -> Outcome:
    words = adjusting.words_of(observation, _BY_SERVICE)
    found = (
        adjusting.deaf_or_dumb(observation)
        or adjusting.wrong_at_first(_BY_SERVICE[0], words[0])
        or _no_server(observation, "server", SERVICE, BASIC)
    )
    replies = adjusting.replies_to(observation, "response", SERVICE)
    if not found and not replies:
        found = Diagnosis(
            "response-missing",
            f"{SERVICE} was called {len(_BY_SERVICE) - 1} times, and never answered.",
            "Does the callback come to its return?",
        )
    answers = [
        Answer(one.data["bool_value"], one.data["string_value"]) if one else Answer(None)
        for one in (replies.get(number) for number in range(1, len(_BY_SERVICE)))
    ]
    found = found or adjusting.judge_answers(_BY_SERVICE, answers, words)
    if found:
        return failed_by("12a", found)
    refused = sum(not one.good for one in _BY_SERVICE)
    return passed(
        "12a",
        f"{len(answers)} calls: {len(answers) - refused} values kept, {refused} refused with a "
        "reason, NaN among them.",
    )


def _no_server(observation: Observation, kind: str, name: str, type_name: str) -> Diagnosis | None:
    """Why nobody can answer; None if a server of that name and type is there."""
    ends = [end for end in observation.graph.endpoints if end.node == observation.subject]
    here = [end for end in ends if end.kind == kind and end.name == name]
    what = "service" if kind == "server" else "action"
    if here and here[0].type_name != type_name:
        return Diagnosis(
            "type-mismatch",
            f"{name} is of type {here[0].type_name}; it is called as {type_name}.",
            f"Both sides of {what}s have to name the same type, as with topics.",
        )
    if here:
        return None
    names = [end.name for end in ends if end.kind == kind and _is_own(end.name, end.node)]
    near = nearest(name, names) or (names[0] if len(names) == 1 else "")
    if near:
        return Diagnosis(
            "service-misspelled",
            f"The node offers {near}, and {name} is called: {difference(near, name)}.",
            "Who calls has nothing but the name, as with topics.",
        )
    return Diagnosis(
        f"no-{what}",
        f"{name} was called, and the node has no {what} of that name.",
        f"Something has to be made in the constructor that names the {what} and its callback.",
    )


def _is_own(name: str, node: str) -> bool:
    return not name.startswith(f"{node}/") and "/_action/" not in name


# 12b: parameters.


def _judge_parameters(observation: Observation) -> Outcome:
    words = adjusting.words_of(observation, _BY_PARAMETER)
    found = adjusting.deaf_or_dumb(observation)
    found = found or adjusting.wrong_at_first(_BY_PARAMETER[0], words[0])
    replies = adjusting.replies_to(observation, "parameters", observation.subject)
    data = [replies[number].data for number in sorted(replies)]
    answers = [Answer(one["successful"], one["reason"]) for one in data]
    found = found or _never_validated(answers, words)
    found = found or adjusting.judge_answers(_BY_PARAMETER, answers, words)
    if found:
        return failed_by("12b", found)
    refused = sum(not one.good for one in _BY_PARAMETER)
    return passed(
        "12b",
        f"{len(answers)} changes: {len(answers) - refused} made, two of them of both at once, and "
        f"{refused} refused with a reason, NaN among them.",
    )


def _never_validated(answers: list[Answer], words: list[list[str]]) -> Diagnosis | None:
    if any("invalid type" in one.reason for one in answers):
        return Diagnosis(
            "result-of-another-kind",
            "The callback gave back something else than a SetParametersResult, so ROS refused "
            "every change.",
            "ROS wants an object with two fields, whether you accept or refuse: which class is it?",
        )
    if any("not declared" in one.reason for one in answers):
        return Diagnosis(
            "parameter-undeclared",
            "A parameter was to be set that the node has not declared: low or high.",
            "Both were declared in what you were given, under these names.",
        )
    if all(one.said for one in answers):
        return Diagnosis(
            "not-validated",
            "Every value was accepted, a high of 19 with a low of 20, too.",
            "Is the callback registered? And is there a way on which it refuses?",
        )
    return None


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "12a",
        SCENARIOS["12a"],
        _judge_service,
        "a threshold behind a service",
        2,
        (
            "A service is made like a subscription: a type, a name, a callback. The callback is "
            "handed a request and an empty response, fills the response, and gives it back.",
            "Look before you keep: only a value that makes sense may become self.high.",
            "Ask whether the value is good, and not whether it is bad: NaN is neither above nor "
            "below anything.",
        ),
    ),
    Exercise(
        "12b",
        SCENARIOS["12b"],
        _judge_parameters,
        "parameters that are checked",
        3,
        (
            "The callback is handed a list of parameters, each with a name and a value. Not every "
            "one has to be in the list: the others stay as they are.",
            "Begin with the two limits as they are, put the new ones over them, and compare then.",
            "The result has two fields: successful and reason.",
        ),
    ),
    Exercise(
        "12c",
        SCENARIOS["12c"],
        heating.judge,
        "heat to a target",
        4,
        (
            "Compare with the window: what it counts in seconds, the thermostat reads in degrees.",
            "`await self.reading` gives the next temperature. Read, report, look whether somebody "
            "has canceled, and go on while it is too cold.",
            "Whatever ends the work, the heater has to be off afterwards: one line behind the "
            "loop does it for both ways.",
            "A goal ends with one of two calls, and then the result is given back in any case.",
        ),
    ),
)

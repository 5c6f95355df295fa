"""Page 12, beyond topics: a threshold behind a service, checked parameters, an action.

The monitors of 12a and 12b are judged one request at a time, and the thermostats of 12c to 12e one
goal at a time. A suspect is right up to the point that it is about; what follows from its mistake
is left open, and stands as `...` in its track.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import partial
from itertools import accumulate, chain, count
from math import inf, isnan, nan
from typing import Any

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.findings import difference, nearest
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    Mismatch,
    Model,
    Suspect,
    Track,
    agree,
    diagnose,
    samples_on,
    status_of,
    tells_apart,
    track,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, Value, feeder, observe
from rosbeat.records import Observation

_TEMPERATURE = Wire("/temperature", "std_msgs/msg/Float32")
_STATUS = Wire("/status", "std_msgs/msg/String")
_HEATER = Wire("/heater", "std_msgs/msg/Bool")


def same(done: object, model: object) -> bool:
    """Return whether two values agree; `...` agrees with everything."""
    return done is ... or model is ... or done == model


def in_turn(right: Model, suspects: Iterable[Suspect]) -> tuple[Model, tuple[Suspect, ...]]:
    """Return a right model and suspects of one request or goal as models of one after the other."""

    def each(model: Model) -> Model:
        return lambda fed: {
            (number, at): done for number, one in enumerate(fed) for at, done in model(one).items()
        }

    return each(right), tuple(replace(one, model=each(one.model)) for one in suspects)


def _no_server(seen: Observation, kind: str, name: str, type_name: str) -> Diagnosis | None:
    """Say why no node answers; None if there is a server of that name and type."""
    what = "service" if kind == "server" else "action"
    ends = [end for end in seen.graph.endpoints if end.node == seen.subject and end.kind == kind]
    here = next((end for end in ends if end.name == name), None)
    if here and here.type_name == type_name:
        return None
    if here:
        return Diagnosis(
            "type-mismatch",
            f"{name} is of type {here.type_name}; the client uses {type_name}.",
            f"Both sides of {what}s have to name the same type, as with topics.",
        )
    # Every node brings services for its parameters, and every action some for its goals.
    names = [end.name for end in ends if not end.name.startswith(f"{end.node}/")]
    names = [one for one in names if "/_action/" not in one]
    near = nearest(name, names) or (names[0] if len(names) == 1 else "")
    if near:
        return Diagnosis(
            "service-misspelled",
            f"The node offers {near}, and the client asks for {name}: {difference(near, name)}.",
            "A client knows nothing but the name, as with topics.",
        )
    return Diagnosis(
        f"no-{what}",
        f"A client asked for {name}, and the node has no {what} of that name.",
        f"Something has to be made in the constructor that names the {what} and its callback.",
    )


# 12a and 12b: a monitor whose limits change while it runs.


@dataclass(frozen=True)
class Limits:
    """Hold the limits that a monitor judges by."""

    high: float
    low: float = -inf

    def status(self, reading: float) -> str:
        """Return the status of a reading."""
        return status_of(reading, self.low, self.high)


@dataclass(frozen=True)
class Request:
    """Hold a request for other limits, and what is fed after it.

    Attributes:
        values: The limits that are asked for, by name; empty at the beginning.
        readings: The readings until the next request.
        before: The limits until then.
        is_good: Whether the new limits make sense.
    """

    values: dict[str, float]
    readings: tuple[float, ...]
    before: Limits
    is_good: bool

    @property
    def asked(self) -> Limits:
        """Return the limits that an accepted request leads to."""
        return replace(self.before, **self.values)

    @property
    def after(self) -> Limits:
        """Return the limits that hold afterwards."""
        return self.asked if self.is_good else self.before

    @property
    def text(self) -> str:
        """Return the request in words."""
        return " and ".join(f"{name} = {value:g}" for name, value in self.values.items())


#: The limits that are asked for, by name, and the readings after that.
_Asked = tuple[dict[str, float], tuple[float, ...]]
_Requests = Sequence[Request]


def _requests(
    draw: Draw, limits: Limits, is_good: Callable[[Limits], bool], asked: Iterable[_Asked]
) -> _Requests:
    """Return requests with the limits that hold before each, and readings in an order drawn."""
    found = []
    for some, readings in asked:
        values = dict(draw.shuffled(tuple(some.items())))
        good = is_good(replace(limits, **values))
        found.append(Request(values, draw.shuffled(readings), limits, good))
        limits = found[-1].after
    return tuple(found)


def draw_service(draw: Draw) -> _Requests:
    """Draw thresholds within their range, at its ends and beyond, and readings around them.

    One that is kept already is asked for again, and one that was refused.
    """

    def asked() -> Iterable[_Asked]:
        one, last = draw.number(24.0, 20.25, 25.5, 0.25), draw.whole(22, 13, 37) + 15 / 32
        far, below = draw.number(60.0, 41.0, 90.0), draw.number(-20.0, -40.0, -11.0)
        groups = (
            (
                ({"high": one}, (one + 1, one, one - 1)),
                ({"high": one}, (one - 1, one + 1)),
                *draw.shuffled(
                    (
                        ({"high": far}, (one + 1, one - 1)),
                        ({"high": far}, (one - 1, one + 1)),
                        ({"high": nan}, (one + 1, one - 1)),
                        ({"high": below}, (one - 1, one + 1)),
                    )
                ),
            ),
            (({"high": 10.0}, (11.0, 9.5)),),
            (
                ({"high": 40.0}, (39.0, 41.0)),
                *draw.shuffled(
                    (
                        ({"high": 40.25}, (40.125, 39.0)),
                        ({"high": 9.75}, (40.125, 39.0)),
                        ({"high": inf}, (41.0, 39.0)),
                    )
                ),
            ),
            (({"high": last}, (last + 1 / 64, last - 1 / 64)),),
        )
        return (({}, (25.0, 26.5, 26.0)), *chain(*draw.shuffled(groups)))

    return draw.until(
        lambda: _requests(draw, Limits(26.0), lambda one: 10 <= one.high <= 40, asked()),
        lambda requests: tells_apart(requests, *SERVICE_MODELS, same),
    )


def draw_parameters(draw: Draw) -> _Requests:
    """Draw limits, one or both at once, in the right order or not, and readings around them.

    One that is kept already is asked for again, and one that was refused.
    """

    def asked() -> Iterable[_Asked]:
        low, high = draw.number(22.0, 21.25, 22.75, 0.25), draw.number(24.0, 23.25, 24.75, 0.25)
        up, down = draw.whole(0, -3, 9), draw.whole(0, -3, 6)
        groups = (
            (({"low": 28.0 + up, "high": 30.0 + up}, (27.0 + up, 29.0 + up, 31.0 + up)),),
            (
                ({"high": 8.0 + down, "low": 5.0 + down}, (9.0 + down, 7.0 + down, 4.0 + down)),
                *draw.shuffled(
                    (
                        (
                            {"low": 9.0 + down, "high": 6.0 + down},
                            (7.0 + down, 10.0 + down, 4.0 + down),
                        ),
                        ({"high": 5.5 + down}, (5.25 + down, 5.75 + down, 4.0 + down)),
                        ({"high": nan}, (5.25 + down, 5.75 + down)),
                        ({"low": nan, "high": 9.0 + down}, (8.5 + down, 4.0 + down)),
                        ({"low": 4.0 + down, "high": nan}, (4.5 + down, 8.5 + down)),
                        ({"low": 7.0 + down, "high": 7.0 + down}, (6.0 + down, 8.5 + down)),
                        ({"high": 0.0}, (5.5 + down, 7.0 + down)),
                    )
                ),
            ),
        )
        # Limits may be below 0, far up, and close together.
        extremes = (
            (({"low": -12.25}, (-11.0, -13.0)), ({"high": -12.0}, (-12.125, -11.0, -13.0))),
            (({"high": 60.25}, (61.0, 59.0)), ({"low": 60.0}, (60.125, 61.0, 59.0))),
        )
        return (
            ({}, (25.0, 26.5, 19.5)),
            ({"high": high}, (25.0, 23.0, 19.5)),
            ({"high": high}, (23.0, 25.0)),
            *draw.shuffled(
                (
                    ({"high": draw.number(19.0, 12.0, 19.75)}, (22.0, 25.0, 19.5)),
                    ({"high": 20.0}, (22.0, 25.0)),
                    ({"high": 20.0}, (25.0, 22.0)),
                    ({"low": high + 0.5}, (high + 0.25, 22.0, 19.5)),
                    ({"low": high}, (23.0, 25.0)),
                    ({"low": nan}, (22.0, 25.0, 19.5)),
                )
            ),
            ({"low": low}, (21.0, 23.0, 25.0)),
            *chain(*draw.shuffled((*groups, *extremes))),
        )

    return draw.until(
        lambda: _requests(draw, Limits(26.0, 20.0), lambda one: one.low < one.high, asked()),
        lambda requests: tells_apart(requests, *PARAMETER_MODELS, same),
    )


_SERVICE, _BASIC = "/set_high", "test_msgs/srv/BasicTypes"


def observe_service(answer: Answer, requests: _Requests) -> Observation:
    """Run a monitor, and call its service between the readings."""
    from rosbeat.ros.scenario import Call

    def call(at: float, values: dict[str, float]) -> Call:
        value = {"float32_value": values["high"]}
        return Call(at, service="set_high", type_name=_BASIC, values=value)

    return _observe_requests(answer, requests, call)


def observe_parameters(answer: Answer, requests: _Requests) -> Observation:
    """Run a monitor, and set its parameters between the readings."""
    from rosbeat.ros.scenario import SetParameters

    return _observe_requests(answer, requests, lambda at, values: SetParameters(at, values=values))


def _observe_requests(
    answer: Answer,
    requests: _Requests,
    step: Callable[[float, dict[str, float]], Any],
) -> Observation:
    """Feed a reading each second, and make each request half a second before its first reading."""
    readings: list[float] = []
    steps = []
    for request in requests:
        if request.values:
            steps.append(step(len(readings) + 0.5, request.values))
        readings += request.readings
    sensor = feeder("temperature_sensor", _TEMPERATURE, readings)
    return observe(answer, len(readings) + 1, others=[sensor], steps=steps)


class Reaction(IntEnum):
    """List the reactions of a monitor to a request, in the order in which they are judged."""

    ACCEPTED = 0
    STATUSES = 1
    REASON = 2


def _reaction(
    request: Request,
    accepted: bool | None,
    limits: Limits | None = None,
    reason: Value = ...,  # a truth, or `...`
) -> Track:
    """Return what a monitor does that judges the next readings by these limits, or by any."""
    statuses = tuple(limits.status(one) if limits else ... for one in request.readings)
    track: dict[int, tuple[Any, ...]] = {Reaction.STATUSES: statuses}
    if request.values:
        track |= {Reaction.ACCEPTED: (accepted,), Reaction.REASON: (reason,)}
    return track


def right_monitor(request: Request) -> Track:
    """Return what a right monitor does. A text may stand beside an acceptance, too."""
    reason = ... if request.is_good else True
    return _reaction(request, request.is_good, request.after, reason)


def _suspect(
    mistake: str, hint: str, when: Callable[[Request], bool], then: Callable[[Request], Track]
) -> Suspect:
    """Return a monitor that is right, except about some requests."""
    return Suspect(mistake, hint, lambda one: then(one) if when(one) else right_monitor(one))


def _is_nan(request: Request) -> bool:
    return any(map(isnan, request.values.values()))


def _is_nonsense(request: Request) -> bool:
    return bool(request.values) and not request.is_good


#: Monitors that react to every request in this way.
NOT_FILLED = Suspect(
    "response-not-filled",
    "A field that is never filled holds False. Where does the client read that you accepted?",
    lambda one: _reaction(one, False, one.after),
)
NOT_VALIDATED = Suspect(
    "not-validated",
    "Is the callback registered? And does it ever refuse?",
    lambda one: _reaction(one, True),
)
#: Monitors that are wrong about the first request at which they are not right.
MONITORS = (
    _suspect("validated-one-by-one",
        "Both new values are in the list. Which of your comparisons still uses an old one?",
        lambda one: one.is_good and len(one.values) > 1,
        lambda one: _reaction(one, False)),
    _suspect("good-value-refused",
        "Which of your conditions is true for this value? Are the limits themselves fine, and a "
        "value that is kept already?",
        lambda one: one.is_good and len(one.values) == 1,
        lambda one: _reaction(one, False)),
    _suspect("nan-accepted",
        "With NaN, <, > and == are always False, so a test for bad values lets it pass. What would "
        "a test for good values look like?",
        _is_nan,
        lambda one: _reaction(one, True)),
    _suspect("nonsense-accepted",
        "Print the values just before you compare them. If they are the new ones, look at the "
        "comparison. If they are not, check where each value comes from, and by which name.",
        lambda one: _is_nonsense(one) and not _is_nan(one),
        lambda one: _reaction(one, True)),
    _suspect("accepted-and-lost",
        "Where do you keep the new value, and from where does the callback take it?",
        lambda one: one.is_good and bool(one.values),
        lambda one: _reaction(one, True, one.before)),
    _suspect("other-limits",
        "The value that is kept has to be exactly the one that was asked for. Is it made a whole "
        "number on the way?",
        lambda one: one.is_good and bool(one.values),
        lambda one: _reaction(one, True, Limits(one.asked.high // 1, one.asked.low // 1))),
    _suspect("refused-and-kept",
        "Check first, store afterwards: a refused value must not change anything.",
        _is_nonsense,
        lambda one: _reaction(one, False, one.asked)),
    _suspect("reason-missing",
        "A client needs to know why it was refused: the response has a field for the reason.",
        _is_nonsense,
        lambda one: _reaction(one, False, one.before, False)),
)  # fmt: skip

# One after the other is a misunderstanding of two limits in one request.
SERVICE_MODELS = in_turn(
    right_monitor, (one for one in MONITORS if one.mistake != "validated-one-by-one")
)
PARAMETER_MODELS = in_turn(right_monitor, MONITORS)


@dataclass(frozen=True)
class _Answer:
    """Hold a monitor's answer to a request; `accepted` is None if there was none."""

    accepted: bool | None = None
    reason: str = ""


def _wrong_monitor(
    seen: Observation,
    requests: _Requests,
    answers: Sequence[_Answer] = (),
    whole: Sequence[Suspect] = (),
) -> Diagnosis | None:
    """Name the mistake of a monitor.

    Args:
        seen: What it did.
        requests: What was asked, and fed; nothing is asked first.
        answers: Its answers to the others.
        whole: Suspects that react to all requests alike.
    """
    did = []
    for request, answer, statuses in zip(
        requests, [_Answer(), *answers], _statuses(seen, requests), strict=True
    ):
        reaction = dict(_reaction(request, answer.accepted, reason=bool(answer.reason.strip())))
        did.append((request, answer, reaction | {Reaction.STATUSES: statuses}))
    always = [
        suspect
        for suspect in whole
        if all(agree(suspect.model(request), done, same) for request, _, done in did[1:])
    ]
    found = (
        diagnose(
            request,
            done,
            right_monitor(request),
            (request.values and always) or MONITORS,
            partial(_describe, request, answer),
            same,
        )
        for request, answer, done in did
    )
    return next(filter(None, found), None)


def _statuses(seen: Observation, requests: _Requests) -> Iterator[tuple[str, ...]]:
    """Yield the statuses of each request's readings; `-` for none, or for more than one."""
    said = track(seen, _STATUS, lambda value: str(value).strip())
    second = 0
    for request in requests:
        here = [said.get(second + place, ()) for place in range(1, len(request.readings) + 1)]
        second += len(request.readings)
        yield tuple(one[0] if len(one) == 1 else "-" for one in here)


def _describe(request: Request, answer: _Answer, mismatch: Mismatch) -> Diagnosis:
    """Say what was right and what was done; the name is for what no suspect reproduces."""
    name, hint = "refused-and-kept", "A refused value must not change anything. Does any line?"
    if request.is_good:
        name, hint = "other-limits", "Is the value that is kept exactly the one in the request?"
    if not request.values:
        name, hint = "wrong-state", "What does your code compare for this reading, and with what?"
    if mismatch.at is not Reaction.STATUSES:
        return Diagnosis(name, _describe_answer(request, answer, mismatch), hint)
    pairs = zip(request.readings, mismatch.done, mismatch.right, strict=True)
    reading, word, right = next(one for one in pairs if not same(*one[1:]))
    word = "nothing, or more than one thing" if word == "-" else word
    when = f"After {request.text} was {'accepted' if answer.accepted else 'refused'}"
    when = when if request.values else "Before any change"
    said = f"{when}, the status for {reading:g} was {word}; it should be {right}."
    return Diagnosis(name, said, hint)


def _describe_answer(request: Request, answer: _Answer, mismatch: Mismatch) -> str:
    task = f"The request for {request.text} was"
    if mismatch.at is Reaction.REASON:
        return f"{task} refused without a reason."
    if answer.accepted is None:
        return f"{task} never answered."
    new = request.asked
    limits = f", since low is then {new.low:g} and high is {new.high:g}" if new.low > -inf else ""
    if answer.accepted:
        return f"{task} accepted, and should be refused{limits}."
    reason = f" with the reason {answer.reason!r}" if answer.reason.strip() else ""
    return f"{task} refused{reason}, and should be accepted{limits}."


def _diagnose_given(seen: Observation, requests: _Requests) -> Diagnosis | None:
    """Say what is wrong before anything is asked: what is given comes before what is asked for."""
    return (
        diagnose_unheard(seen, _TEMPERATURE)
        or diagnose_unpublished(seen, _STATUS)
        or _wrong_monitor(seen, requests[:1])
    )


def _judge_service(seen: Observation, requests: _Requests) -> Verdict:
    found = _diagnose_given(seen, requests) or _no_server(seen, "server", _SERVICE, _BASIC)
    replies = {
        one.number: _Answer(one.data["bool_value"], one.data["string_value"])
        for one in seen.replies
        if (one.word, one.name) == ("response", _SERVICE)
    }
    if not found and not replies:
        found = Diagnosis(
            "response-missing",
            f"{_SERVICE} was called {len(requests) - 1} times, and never answered.",
            "Does the callback reach its return?",
        )
    answers = [replies.get(number, _Answer()) for number in range(1, len(requests))]
    found = found or _wrong_monitor(seen, requests, answers, [NOT_FILLED])
    return found or passed(_all_right("calls", "values kept,", requests))


def _judge_parameters(seen: Observation, requests: _Requests) -> Verdict:
    answers = [
        _Answer(one.data["successful"], one.data["reason"])
        for one in sorted(seen.replies, key=lambda one: one.number)
        if (one.word, one.name) == ("parameters", seen.subject)
    ]
    return (
        _diagnose_given(seen, requests)
        or _refused_by_ros(answers)
        or _wrong_monitor(seen, requests, answers, [NOT_FILLED, NOT_VALIDATED])
        or passed(_all_right("changes", "made, two of them of both at once, and", requests))
    )


def _all_right(what: str, kept: str, requests: _Requests) -> str:
    asked, refused = len(requests) - 1, sum(not one.is_good for one in requests)
    return (
        f"{asked} {what}: {asked - refused} {kept} {refused} refused with a reason, NaN among them."
    )


def _refused_by_ros(answers: Iterable[_Answer]) -> Diagnosis | None:
    """Name what rclpy itself says in the place of a reason; no model of a monitor would."""
    reasons = [one.reason for one in answers]
    if any("invalid type" in one for one in reasons):
        return Diagnosis(
            "result-of-another-kind",
            "The callback returned something other than a SetParametersResult, so ROS refused "
            "every change.",
            "ROS wants an object with two fields, whether you accept or refuse: which class is it?",
        )
    if any("not declared" in one for one in reasons):
        return Diagnosis(
            "parameter-undeclared",
            "A parameter was to be set that the node has not declared: low or high.",
            "Both were declared in what you were given, under these names.",
        )
    return None


# 12c, 12d, 12e: a thermostat that accepts or rejects, heats and reports, and can be stopped.


@dataclass(frozen=True)
class Goal:
    """Hold a goal that the thermostat is sent.

    Attributes:
        number: Its place among the goals, from 1 on.
        at: When.
        order: The target.
        cancel_after: When it is canceled; None for never.
        is_early: Whether it is sent while the work for the goal before it goes on.
    """

    number: int
    at: float
    order: int
    cancel_after: float | None = None
    is_early: bool = False

    @property
    def is_good(self) -> bool:
        """Return whether the thermostat has to accept it."""
        return 10 <= self.order <= 26

    @property
    def is_canceled(self) -> bool:
        """Return whether it is canceled."""
        return self.cancel_after is not None

    @property
    def is_reached(self) -> bool:
        """Return whether the room is warm enough before it is sent: no room gets as cold."""
        return self.order == 10


@dataclass(frozen=True)
class Heating:
    """Hold what a thermostat goes through.

    Attributes:
        start: The temperature of the room at first.
        goals: The goals that it is sent.
        seconds: How long it takes.
    """

    start: int
    goals: tuple[Goal, ...]
    seconds: float


def draw_heating(draw: Draw) -> Heating:
    """Draw goals: reached, canceled, out of reach or reached before they are sent, and one more.

    A goal is over at least a second before the next is sent, and one that is canceled is far from
    its target then. Only one that is rejected comes while the thermostat works for another one.
    """
    start = draw.whole(18, 16, 18)
    first = draw.whole(22, start + 3, 22)
    others = draw.shuffled((draw.whole(99, 28, 120), 9, 27, 10))
    pauses = (
        *(draw.whole(2, 2, 5), draw.whole(8, 10, 12), draw.whole(6, 5, 7)),
        *(draw.whole(2, 2, 4) for _ in others[1:]),
        draw.whole(5, 4, 6),
    )
    cancels = (None, draw.one_of(2.0, 1.0), *[None] * 5)
    times = (0.5 + pause for pause in accumulate(pauses))
    sent = zip(count(1), times, (first, 26, *others, 26), cancels, strict=False)
    first_sent, *later = (Goal(*one) for one in sent)
    early = Goal(0, first_sent.at + 1, draw.whole(40, 28, 120), is_early=True)
    goals = _numbered((first_sent, early, *later))
    # A room that was cold at first takes longer in the end.
    return Heating(start, goals, goals[-1].at + 10.5 + draw.whole(0, 4, 5))


def draw_decisions(draw: Draw) -> Heating:
    """Draw goals at both limits and on both sides of them, one a second.

    The first one is far from both limits: a node that rejects everything is no matter of limits.
    """
    good = (26, 10, draw.whole(15, 11, 17), draw.whole(19, 11, 25), draw.whole(12, 11, 25))
    bad = (27, 9, draw.whole(99, 28, 120), draw.whole(-15, -26, -10), draw.whole(5, 0, 8))
    others = draw.shuffled([one for pair in zip(good, bad, strict=True) for one in pair])
    orders = (draw.whole(22, 18, 25), *others)
    goals = tuple(Goal(number, 0.5 + number, order) for number, order in enumerate(orders, 1))
    return Heating(18, goals, goals[-1].at + 1)


def draw_goals(draw: Draw) -> Heating:
    """Draw the goals of a thermostat that cannot be canceled yet."""
    fed = draw_heating(draw)
    return replace(fed, goals=_numbered(one for one in fed.goals if not one.is_canceled))


def _numbered(goals: Iterable[Goal]) -> tuple[Goal, ...]:
    return tuple(replace(one, number=number) for number, one in enumerate(goals, 1))


_HEAT, _FIBONACCI = "/heat", "test_msgs/action/Fibonacci"


def observe_heating(answer: Answer, fed: Heating) -> Observation:
    """Run a thermostat in a room, and send it goals."""
    from rosbeat.ros.scenario import SendGoal
    from rosbeat.ros.test_nodes import Room

    steps = [
        SendGoal(
            one.at, action="heat", type_name=_FIBONACCI, goal={"order": one.order},
            cancel_after=one.cancel_after,
        )
        for one in fed.goals
    ]  # fmt: skip
    return observe(answer, fed.seconds, others=[lambda: Room(fed.start)], steps=steps)


class Work(IntEnum):
    """List the reactions of a thermostat to a goal, in the order in which they are judged."""

    DECISION = 0
    SWITCHED_ON = 1
    CANCEL = 2
    END = 3
    STATUS = 4
    DEGREES = 5
    HEATER = 6
    FEEDBACK = 7


def right_thermostat(goal: Goal) -> Track:
    """Return what a right thermostat does about a goal."""
    if not goal.is_good:
        return {Work.DECISION: ("rejected",), Work.HEATER: (... if goal.is_early else "off",)}
    return {
        Work.DECISION: ("accepted",),
        Work.SWITCHED_ON: ("yes",),
        Work.CANCEL: ("accepted",),
        Work.END: ("in time",),
        Work.STATUS: ("CANCELED" if goal.is_canceled else "SUCCEEDED",),
        Work.DEGREES: ("as read",),
        Work.HEATER: ("off",),
        Work.FEEDBACK: ("each second",),
    }


def _at(
    mistake: str, hint: str, point: Work, value: str, of: Callable[[Goal], bool] = lambda _: True
) -> Suspect:
    """Return a thermostat that is right about some goals until a point, and does anything after."""

    def model(goal: Goal) -> Track:
        right = right_thermostat(goal)
        if not of(goal) or point not in right:
            return right
        return {at: right[at] if at < point else (value if at == point else ...,) for at in right}

    return Suspect(mistake, hint, model)


_STOPPED, _RUNS_ON = (lambda goal: goal.is_canceled), (lambda goal: not goal.is_canceled)
_RANGE = "Goals from 10 to 26 make sense. Compare in the callback that decides."
_TWO_ENDS = "The work can end in two ways. Which call belongs to which?"
_ALL_READ = "A result holds every temperature that was read since the goal came, in order."
#: What can be wrong with the decision about a goal, with the work, and with a cancel.
DECISIONS = (
    _at("nonsense-accepted", _RANGE, Work.DECISION, "accepted", lambda goal: not goal.is_good),
    _at("good-value-refused",
        f"{_RANGE} Does it return one of the two GoalResponses on each way?",
        Work.DECISION, "rejected", lambda goal: 10 < goal.order < 26),
    _at("boundary",
        "Goals from 10 to 26 make sense, 10 and 26 themselves included.",
        Work.DECISION, "rejected", lambda goal: goal.order in (10, 26)),
)  # fmt: skip
HEATERS = (
    *DECISIONS,
    _at("never-switched-on",
        "The room only gets warmer after a Bool that is True on /heater.",
        Work.SWITCHED_ON, "no", lambda goal: goal.number == 1),
    _at("never-ends",
        "What makes the condition of the loop false? Print it in each round.",
        Work.END, "never", _RUNS_ON),
    _at("wrong-state",
        "If the room is already warm enough, there's nothing to wait for.",
        Work.END, "too late", lambda goal: goal.is_reached),
    _at("succeed-forgotten",
        "ROS regards a goal as aborted unless the work says how it ended. Which call says so?",
        Work.STATUS, "ABORTED", _RUNS_ON),
    _at("result-wrong", "The result has a field for the temperatures, as the feedback has.",
        Work.DEGREES, "none"),
    _at("ends-too-soon",
        "The work goes on as long as the room is colder than the target.",
        Work.DEGREES, "too few", _RUNS_ON),
    _at("boundary", "The target itself is warm enough.",
        Work.DEGREES, "one too many", _RUNS_ON),
    _at("result-wrong", _ALL_READ, Work.DEGREES, "others"),
    _at("feedback-missing",
        "Publish feedback in each round of the loop, with what was read so far.",
        Work.FEEDBACK, "missing", _RUNS_ON),
    _at("wrong-rate", "One feedback after each reading is enough. Which lines publish one?",
        Work.FEEDBACK, "too often", _RUNS_ON),
    _at("wrong-values", "Feedback holds all temperatures so far, as the result does in the end.",
        Work.FEEDBACK, "others", _RUNS_ON),
    _at("left-on", "Which line switches the heater off? Every way out of the work has to pass it.",
        Work.HEATER, "on", lambda goal: goal.is_good),
    _at("left-on", "There is nothing to heat for a goal that is rejected. Where does it switch on?",
        Work.HEATER, "on", lambda goal: not goal.is_good),
)  # fmt: skip
THERMOSTATS = (
    *HEATERS,
    _at("cancel-refused",
        "An action server refuses to cancel unless a callback of its own accepts.",
        Work.CANCEL, "refused", _STOPPED),
    _at("cancel-ignored",
        "Accepting a cancel is a promise: the work has to ask its goal handle in each round.",
        Work.END, "too late", _STOPPED),
    _at("cancel-not-reported", _TWO_ENDS, Work.STATUS, "ABORTED", _STOPPED),
    _at("cancel-not-reported", _TWO_ENDS, Work.STATUS, "SUCCEEDED", _STOPPED),
)  # fmt: skip


class _Heating:
    """Hold what a client got for one goal, what the room was like, and what the heater did.

    A canceled goal may end before or after the next reading, and a room that is warm enough need
    not be read at all: there, what is right is less exact.
    """

    def __init__(self, seen: Observation, goal: Goal) -> None:
        self._goal, self._canceled_at = goal, goal.at + (goal.cancel_after or inf)
        self._heater = [(one.time, bool(one.value)) for one in samples_on(seen, _HEATER)]
        replies = [one for one in seen.replies if one.number == goal.number]
        self._feedback = [
            (one.time, list(one.data["sequence"])) for one in replies if one.word == "feedback"
        ]
        got = {one.word: one for one in replies}
        self.decision = "neither accepted nor rejected"
        if "goal" in got:
            self.decision = "accepted" if got["goal"].data["accepted"] else "rejected"
        self._cancels = "cancel" in got and bool(got["cancel"].data["count"])
        self.end = got["result"].time if "result" in got else None
        result = got["result"].data if "result" in got else {"status": "", "sequence": ()}
        self._status, self._degrees = str(result["status"]), list(result["sequence"])
        room = [(one.time, int(one.value)) for one in samples_on(seen, _TEMPERATURE)]
        room = [one for one in room if one[0] <= (self.end or 0)]
        self._read = [one for one in room if one[0] > goal.at]
        self._wanted = [value for _, value in self._read]
        if not (goal.is_canceled or goal.is_reached):
            warmest = room[-1][1] if room else goal.order
            self._wanted = [value for value in self._wanted if value <= goal.order]
            self._wanted += range(warmest + 1, goal.order + 1)

    def points(self) -> dict[Work, tuple[Any, str]]:
        """Return what was done at each point, and a sentence about it; `...` if it may be any."""
        task = f"The goal {self._goal.order}, sent at {self._goal.at:g} s,"
        right = right_thermostat(self._goal)
        ended = "did not end" if self.end is None else f"ended at {self.end:g} s"
        decision = (
            self.decision,
            f"{task} was {self.decision}; it should be {right[Work.DECISION][0]}.",
        )
        if not self._goal.is_good:
            heats = "on" if self._is_on_at(self._goal.at + 1) else "off"
            said = f"{task} was rejected, and a second later the heater was on."
            return {Work.DECISION: decision, Work.HEATER: (heats, said)}
        canceled, end = self._goal.is_canceled, self._ended()
        due = f"It should end when {'it is canceled' if canceled else 'the target is reached'}"
        due += f", at {self._canceled_at:g} s" if canceled else ""
        # A cancel that comes after the end cannot be accepted.
        refused = canceled and end != "too soon" and not self._cancels
        return {
            Work.DECISION: decision,
            Work.SWITCHED_ON: (
                "yes" if any(state for _, state in self._heater) else "no",
                f"{task} was accepted, and the heater was never switched on.",
            ),
            Work.CANCEL: (
                "refused" if refused else "accepted",
                f"{task} was to be canceled at {self._canceled_at:g} s, and the node refused.",
            ),
            Work.END: (end, f"{task} {ended}. {due}."),
            Work.STATUS: (
                self._status,
                f"{task} {ended}. The client was told {self._status}, and not "
                f"{right[Work.STATUS][0]}.",
            ),
            Work.DEGREES: (
                self._compared(),
                f"The result of the goal {self._goal.order} holds {self._degrees[:8]}; it should "
                f"hold {self._wanted[:8]}.",
            ),
            Work.HEATER: (
                "on" if self.end is not None and self._is_on_at(self.end + 1) else "off",
                f"{task} {ended}, and a second later the heater was still on.",
            ),
            Work.FEEDBACK: self._reported(),
        }

    def _ended(self) -> str:
        if self._goal.is_canceled:
            after = (inf if self.end is None else self.end) - self._canceled_at
            return "too soon" if after < 0 else "too late" if after > 1 else "in time"
        if self.end is None:
            return "never"
        return "too late" if self._goal.is_reached and self.end > self._goal.at + 2 else "in time"

    def _compared(self) -> str:
        """Compare the result with the temperatures that were read."""
        found, read = self._degrees, [value for _, value in self._read]
        if not found and not self._goal.is_reached:
            return "none"
        if self._goal.is_canceled or self._goal.is_reached:
            return "as read" if found in (read, read[:-1]) else "others"
        if found[-1] < self._goal.order and found == read[: len(found)]:
            return "too few"
        if found == read and read[:-1] == self._wanted:
            return "one too many"
        return "as read" if found == self._wanted and len(read) <= len(found) else "others"

    def _reported(self) -> tuple[Any, str]:
        """Compare the feedback with the result, and with the readings on the way to the target."""
        if self._goal.is_canceled or self._goal.is_reached:
            return ..., ""
        found = [degrees for _, degrees in self._feedback]
        strange = next((one for one in found if one != self._degrees[: len(one)] or not one), None)
        if strange is not None:
            return "others", f"Feedback held {strange[:8]}; the result is {self._degrees[:8]}."
        for size, value in enumerate(self._wanted, 1):
            at = next((time for time, _ in self._read[size - 1 : size]), inf)
            times = [time for time, one in self._feedback if len(one) == size]
            times = [time for time in times if at <= time < at + 1]
            if len(times) > 1:
                return (
                    "too often",
                    f"After the reading of {value} there were {len(times)} feedbacks.",
                )
            if not times:
                return "missing", f"There was no feedback after the reading of {value}."
        return "each second", ""

    def _is_on_at(self, time: float) -> bool:
        """Return whether the last command for the heater up to a time was to switch it on."""
        return [state for at, state in self._heater if at <= time][-1:] == [True]


def _judge_decisions(seen: Observation, fed: Heating) -> Verdict:
    accepted = sum(one.is_good for one in fed.goals)
    return (
        _no_server(seen, "action server", _HEAT, _FIBONACCI)
        or _wrong_work(seen, fed, [Work.DECISION])
        or passed(f"Of {len(fed.goals)} goals, {accepted} were accepted and the others rejected.")
    )


def _judge_heating(seen: Observation, fed: Heating) -> Verdict:
    return _wrong_heating(seen, fed) or passed(
        f"Heated to {fed.goals[0].order}, with a report each second."
    )


def _judge_thermostat(seen: Observation, fed: Heating) -> Verdict:
    rejected = sum(not one.is_good for one in fed.goals)
    return _wrong_heating(seen, fed) or passed(
        f"Heated to {fed.goals[0].order}, with a report each second; stopped when it was "
        f"canceled; {rejected} goals that make no sense were rejected."
    )


def _wrong_heating(seen: Observation, fed: Heating) -> Diagnosis | None:
    return (
        _no_server(seen, "action server", _HEAT, _FIBONACCI)
        or _blocked(seen, fed)
        or _wrong_work(seen, fed, [Work.DECISION])
        or diagnose_unpublished(seen, _HEATER, hint=_SWITCH)
        or _wrong_work(seen, fed, list(Work)[: Work.FEEDBACK])
        or _wrong_work(seen, fed, list(Work))
    )


_SWITCH = "The work has to switch the heater on and off. Which lines of `heat` do that?"


def _wrong_work(seen: Observation, fed: Heating, judged: Sequence[Work]) -> Diagnosis | None:
    """Name the mistake of a thermostat at some points of its work; any other may be as it is."""
    for goal in fed.goals:
        points = _Heating(seen, goal).points()
        done = {at: (value if at in judged else ...,) for at, (value, _) in points.items()}
        describe = partial(_describe_work, points)
        found = diagnose(goal, done, right_thermostat(goal), THERMOSTATS, describe, same)
        if found:
            is_refused = goal.is_good and points[Work.DECISION][0] == "rejected"
            return (is_refused and _no_decision(seen, found)) or found
    return None


def _no_decision(seen: Observation, found: Diagnosis) -> Diagnosis | None:
    """Say why a goal was rejected if rclpy has warned of what the callback returned."""
    if not any("did not return a GoalResponse" in log.text for log in seen.logs):
        return None
    return Diagnosis(
        "not-a-goal-response",
        f"{found.evidence} The callback did not return a GoalResponse, and then rclpy rejects.",
        "Each way through the callback returns one of the two values of GoalResponse.",
    )


def _describe_work(points: Mapping[Work, tuple[Any, str]], mismatch: Mismatch) -> Diagnosis:
    hint = "Does the callback of this step come to its end? Print before and after it."
    return Diagnosis(UNKNOWN, points[mismatch.at][1], hint)


def _blocked(seen: Observation, fed: Heating) -> Diagnosis | None:
    """Name work that keeps the node from hearing: the executor shows it, not what was done."""
    first = fed.goals[0]
    work, begin = _Heating(seen, first), first.at
    end = work.end or begin + 4
    heard = [one.time for one in seen.callbacks if one.source == _TEMPERATURE.topic]
    if work.decision != "accepted" or not heard or end < begin + 2:
        return None
    if any(begin < at < end for at in heard):
        return None
    return Diagnosis(
        "callback-blocks",
        f"From {begin:g} to {end:g} s the node did not hear a single reading: while its work "
        "sleeps, nothing else of it runs, no cancel either.",
        "An `async` callback gives the others room while it awaits something.",
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("12a", observe_service, _judge_service, "a threshold behind a service", 2, (
        "A service is made like a subscription: a type, a name, a callback. The callback is "
        "handed a request and an empty response, fills the response, and gives it back.",
        "Look before you keep: only a value that makes sense may become self.high. If you "
        "refuse one, the response has a field for the reason, too.",
        "Ask whether the value is good, and not whether it is bad: NaN is neither above nor "
        "below anything.",
    ), draw=draw_service),
    Exercise("12b", observe_parameters, _judge_parameters, "two limits that belong together", 3, (
        "The callback is handed a list of parameters, each with a name and a value. Not every "
        "one has to be in the list: the others stay as they are.",
        "Start with the current limits, replace those that are in the list, and compare "
        "afterwards.",
        "The result has two fields: successful and reason.",
    ), draw=draw_parameters),
    Exercise("12c", observe_heating, _judge_decisions, "accept or reject a goal", 1, (
        "`decide` is handed the goal, and returns one of the two values of `GoalResponse`. "
        "Compare it with the airing.",
        "Python can compare a number with two limits at once. Are the limits themselves good?",
    ), draw=draw_decisions),
    Exercise("12d", observe_heating, _judge_heating, "heat to a target", 2, (
        "Compare `heat` with the airing: what it counts in seconds, the thermostat reads in "
        "degrees.",
        "`await self.reading` gives the next temperature. Read, report, and go on while it is "
        "too cold.",
        "Switch the heater on before the loop, and off after it. The loop goes on while there "
        "is no reading yet, or the newest one is below the target.",
    ), draw=draw_goals),
    Exercise("12e", observe_heating, _judge_thermostat, "stop when it is canceled", 1, (
        "`agree` accepts the cancel, but that stops nothing yet: the work has to ask its goal "
        "handle in each round.",
        "Whatever ends the work, the heater has to be off afterwards: one line after the loop "
        "covers both cases.",
        "End the goal with one of two calls. In both cases, return the result afterwards.",
    ), draw=draw_heating),
)  # fmt: skip

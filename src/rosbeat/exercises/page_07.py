"""Page 07, look inside the graph: findings about a system, limits as parameters, a log watcher."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import product
from typing import Any, NamedTuple

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import BLANK, Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.model import (
    STATUSES,
    Mismatch,
    Model,
    Suspect,
    Track,
    before_reading,
    diagnose,
    grouped,
    matching,
    numbered,
    status_of,
    suspects,
    tells_apart,
    track,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, Report, Value, feeder, observe, publishing, report
from rosbeat.records import INFRASTRUCTURE_TOPICS, Observation, QoS

# 07a: findings about a greenhouse that somebody else wrote. Nothing is drawn: learners examine the
# greenhouse of the page, and hand over what is true of that one.

#: A measured rate may differ by this share.
_TOLERANCE = 0.06
_NUMBERS = ("number", "rate")


@dataclass(frozen=True)
class Greenhouse:
    """Hold what a run of a greenhouse recorded.

    Attributes:
        run: What its nodes did.
        parameters: The value of each parameter of its nodes, by `/node name`.
    """

    run: Observation
    parameters: Mapping[str, Any]


@lru_cache(maxsize=1)
def _greenhouse() -> Greenhouse:
    """Run the greenhouse once, where none of a learner's code runs: it is the same each time."""
    # Imported here, so that judges can be imported where ROS is not installed.
    from rosbeat.ros import test_nodes

    return Greenhouse(*test_nodes.observe_greenhouse())


@dataclass(frozen=True)
class _Question:
    """Hold one thing to find out about a greenhouse.

    Attributes:
        key: Its name in the dict of findings.
        kind: `node`, `topic`, `type`, `number`, or `rate` for a number that was measured.
        truth: The right values.
        misread: Misunderstandings as models: the value that each one finds, its mistake and a
            sentence about it.
        otherwise: What is true of a value that no misunderstanding finds.
        instrument: Where to look, without the answer.
    """

    key: str
    kind: str
    truth: Collection[Any]
    misread: Mapping[Any, tuple[str, str]]
    otherwise: str
    instrument: str

    def same(self, one: Value, other: Value) -> bool:
        """Return whether two values are the same; only a measured one may be a little off."""
        if self.kind == "rate":
            return bool(abs(one - other) <= _TOLERANCE * other)
        if self.kind == "type":  # `Int32` and `std_msgs/Int32` are names of std_msgs/msg/Int32, too
            package, _, name = other.split("/")
            return one in (other, f"{package}/{name}", name)
        return bool(one == other)


def _questions(house: Greenhouse) -> tuple[_Question, ...]:
    graph, own = house.run.graph, house.run.graph.topics()
    topics = {*own, *INFRASTRUCTURE_TOPICS}
    senders, listeners = (
        {topic: sorted({end.node for end in graph.on(topic, kind)}) for topic in topics}
        for kind in ("publisher", "subscription")
    )
    unheard = {topic for topic in own if not listeners[topic]}
    unsent = {topic for topic in own if not senders[topic]}
    types = [end.type_name for end in graph.on("/moisture", "publisher")]
    rate = _rate(house.run, "/moisture")
    depths = {
        (end.kind, end.node): end.qos.depth for end in graph.endpoints if end.name == "/moisture"
    }
    sides = "ros2 topic info counts both sides. Ask about each topic, or look at all nodes."
    return (
        _Question(
            "publisher of /moisture", "node", senders["/moisture"],
            {node: ("sides-confused", f"{node} has a subscription there, and no publisher.")
             for node in listeners["/moisture"]},
            "That node has nothing to do with /moisture.",
            "ros2 topic info --verbose lists both sides of a topic, one below the other."),
        _Question(
            "type of /moisture", "type", types,
            {},
            "/moisture has another type.",
            "ros2 topic list -t shows a topic's type in brackets."),
        _Question(
            "messages a second on /moisture", "rate", [rate],
            {1 / rate: ("period-for-rate", "That is the time from one message to "
                                      "the next; a rate counts the messages in one second.")},
            "The messages come at another rate.",
            "ros2 topic hz measures it; wait for its second line."),
        _Question(
            "queue depth of /gardener for /moisture", "number",
            [depths["subscription", "/gardener"]],
            {depth: ("sides-confused", "That is the depth of the publisher's queue; the other "
                     "side of the topic has a queue of its own.")
             for (kind, _), depth in depths.items() if kind == "publisher"},
            "That queue has another depth.",
            "A terminal cannot see it. The graph of the session shows it: look for depth in "
            "ros.graph()."),
        _Question(
            "topic without a listener", "topic", unheard,
            dict.fromkeys(unsent, ("sides-confused", "It has a listener, and no publisher.")),
            "It has a listener.", sides),
        _Question(
            "topic without a publisher", "topic", unsent,
            dict.fromkeys(unheard, ("sides-confused", "It has a publisher, and no listener.")),
            "It has a publisher.", sides),
        _Question(
            "node that warns", "node",
            {_full(log.name) for log in house.run.logs if log.level == "WARN"},
            {},
            "It never warns.",
            "Log lines are published on /rosout; a warning has level 30."),
        _Question(
            "dry_below of /gardener", "number", [house.parameters["/gardener dry_below"]],
            {},
            "It has another value.",
            "ros2 param get takes the node and the parameter. If you have set it yourself: what "
            "was it when the greenhouse was started?"),
    )  # fmt: skip


def _rate(run: Observation, topic: str) -> float:
    times = [one.time for one in run.samples if one.topic == topic]
    spread = times[-1] - times[0] if times else 0.0
    return (len(times) - 1) / spread if spread else 0.0


def judge_findings(said: Report, greenhouse: Greenhouse | None = None) -> Verdict:
    """Compare what somebody found out with a greenhouse.

    Args:
        said: What the learner's function returned.
        greenhouse: The greenhouse; by default that of the page, which runs here.
    """
    early = before_reading(said, 'check("07a", findings)')
    if early:
        return early
    findings, house = said.value, greenhouse or _greenhouse()
    if not isinstance(findings, dict):
        evidence = f"The function returned a {said.type_name} instead of the dict."
        return Diagnosis("other-kind", evidence, "Leave the dict with its keys as it was.")
    questions = _questions(house)
    blank = [one for one in questions if _is_blank(findings.get(one.key))]
    wrong = [found for one in questions if (found := _compared(house, one, findings))]
    count, right = len(questions), len(questions) - len(blank) - len(wrong)
    if len(blank) == count:
        return not_attempted()
    if right == count:
        return passed(f"All {count} findings agree with what the greenhouse does.")
    counted = f"{right} of {count} findings {'is' if right == 1 else 'are'} right."
    if blank:
        counted += f" Still open: {', '.join(one.key for one in blank)}."
    if not wrong:
        return Diagnosis("finding-missing", counted, blank[0].instrument, right / count)
    more = f" And {len(wrong) - 1} more to look at again." if len(wrong) > 1 else ""
    first = wrong[0]
    return Diagnosis(first.mistake, f"{first.evidence}{more} {counted}", first.hint, right / count)


def _is_blank(given: object) -> bool:
    return isinstance(given, str) and given.strip() in (BLANK, "")


def _compared(house: Greenhouse, question: _Question, said: dict[str, Any]) -> Diagnosis | None:
    """Return what is wrong with one finding, or None; a blank is not wrong."""
    if question.key not in said:
        return Diagnosis(
            "finding-missing",
            f"The returned dict has no key '{question.key}'.",
            "Leave the keys of the dict as they were; only the values change.",
        )
    given = said[question.key]
    value = _of_kind(given, question.kind)
    right = value is not None and any(question.same(value, one) for one in question.truth)
    if _is_blank(given) or right:
        return None
    known = (found for one, found in question.misread.items() if question.same(value, one))
    mistake, evidence = _malformed(house, question, value) or next(
        known, ("finding-wrong", question.otherwise)
    )
    evidence = f"For '{question.key}' you wrote {given!r}. {evidence}"
    return Diagnosis(mistake, evidence, question.instrument)


def _of_kind(given: Value, kind: str) -> Value:
    """Return a value as it is compared; None if it is of another kind."""
    if isinstance(given, bool) or (kind not in _NUMBERS and not isinstance(given, str)):
        return None
    if kind not in _NUMBERS:
        return given.strip().replace(".", "/") if kind == "type" else _full(given)
    try:
        return float(given)
    except (TypeError, ValueError):
        return None


def _full(name: str) -> str:
    """Return a name with its slash: `lamp` and `/lamp` are the same, and so is a logger's."""
    return "/" + name.strip().lstrip("/").replace(".", "/")


def _malformed(house: Greenhouse, question: _Question, value: Value) -> tuple[str, str] | None:
    """Say what is wrong with the form of a value: not by models, because any text may come."""
    kind = question.kind
    if value is None:
        wanted = "a bare number" if kind in _NUMBERS else "a text in quotes"
        return "other-kind", f"The answer to this question is {wanted}."
    if kind == "type" and value.strip("[]") != value:
        return "stray-characters", "The name is the text inside the brackets, without them."
    if kind == "type" and any(value in one for one in question.truth):
        return "name-incomplete", "A type's full name has three parts: package, `msg`, name."
    if kind not in ("node", "topic"):
        return None
    graph = house.run.graph
    topics = {*graph.topics(), *INFRASTRUCTURE_TOPICS}
    if value in (graph.nodes if kind == "node" else topics):
        return None
    if value in topics or value in graph.nodes:
        other = "topic" if kind == "node" else "node"
        return "other-kind", f"That is a {other}, and the question is about a {kind}."
    said = f"The greenhouse has no {kind} of this name. Copy names letter by letter."
    return "not-in-graph", said


_FINDINGS = Exercise("07a", report, judge_findings, "a system of strangers", 3, (
    "Ask one question at a time, in the terminal `look`, and write down what you see.",
    "ros2 topic info --verbose names both sides of a topic; ros2 topic hz counts; ros2 "
    "param get reads; the field name of a log line names the node that logged it.",
    "Terminals do not know the depth of a queue, but this kernel made the greenhouse: "
    "for end in ros.graph().endpoints: print(end) shows it all.",
))  # fmt: skip


def _stripped(text: Value) -> str:
    return str(text).strip()


# 07b: limits that change while the node runs.

_TEMPERATURE = Wire("/temperature", "std_msgs/msg/Float32")
_STATUS = Wire("/status", "std_msgs/msg/String")
#: The values before anything is set.
_DEFAULTS = {"low": 20.0, "high": 26.0}
_EXCHANGED = {"low": 26.0, "high": 20.0}


class Tuning(NamedTuple):
    """Hold what a monitor is fed.

    Attributes:
        readings: One a second, the first at 1 s.
        changes: Number of a reading, name of a limit, and the value to which it is set half a
            second before that reading.
    """

    readings: tuple[float, ...]
    changes: tuple[tuple[int, str, float], ...]


#: A distance from a limit that two decimals do not show.
_JUST = 1 / 256


def draw_tuning(draw: Draw) -> Tuning:
    """Draw readings, at each limit and beside it, and limits, of which two have two decimals."""
    return draw.until(
        partial(_tuning, draw), lambda fed: tells_apart(fed, _right, _SUSPECT_MONITORS)
    )


def _tuning(draw: Draw) -> Tuning:
    high, low = draw.one_of(24.25, 24.75, 25.25), draw.one_of(21.25, 20.25, 20.75, 22.25)
    lowest, highest = draw.whole(10, 5, 14), draw.whole(30, 29, 40)
    far, near = partial(draw.number, step=0.25), draw.number(23.0, 22.75, 24.0)
    parts = (
        ((), (near, 26.0, 26.0 + _JUST, 20.0, 20.0 - _JUST, 25.5, far(25.0, 24.0, 25.75), 0.0)),
        ((("high", high),), (high + 0.5, high, high + _JUST, far(21.0, 20.0, 22.0))),
        ((("low", low),), (low - 0.5, low, near, low - _JUST)),
        (
            (("low", float(lowest)), ("high", float(highest))),
            (
                *(far(28.0, 26.5, 28.75), far(15.0, 14.25, 19.5), float(highest), highest + _JUST),
                *(float(lowest), lowest - _JUST, far(-22.0, -25.0, -20.0)),
            ),
        ),
        # A limit of 0 is a limit: in Python it counts as false.
        ((("low", 0.0), ("high", 8.0)), (far(4.0, 1.0, 7.0), -1.0, 0.0, 8.0 + _JUST)),
        ((("low", -8.0), ("high", 0.0)), (far(-4.0, -7.0, -1.0), 1.0, 0.0, -8.0 - _JUST)),
    )
    readings: list[float] = []
    changes: list[tuple[int, str, float]] = []
    for limits, values in parts:
        changes += [(len(readings) + 1, name, value) for name, value in limits]
        more = [draw.one_of(*values) for _ in range(draw.whole(0, 0, 3))]
        readings += draw.shuffled((*values, *more))
    return Tuning(tuple(readings), tuple(changes))


def _observe_tuning(answer: Answer, fed: Tuning) -> Observation:
    from rosbeat.ros.scenario import SetParameter

    steps = [
        SetParameter(number - 0.5, name=name, value=value) for number, name, value in fed.changes
    ]
    sensor = feeder("temperature_sensor", _TEMPERATURE, fed.readings)
    return observe(answer, len(fed.readings) + 0.5, others=[sensor], steps=steps)


#: Returns the status of a reading, from the reading and the limits `low` and `high`.
_Rule = Callable[[float, float, float], str]


def _limits(
    fed: Tuning,
    at: float,
    start: Mapping[str, float] = _DEFAULTS,
    frozen: Collection[str] = (),
) -> dict[str, float]:
    """Return the limits at a time, of which the frozen ones stay as they were at the start."""
    changed = {
        name: value
        for number, name, value in fed.changes
        if number - 0.5 <= at and name not in frozen
    }
    return {**start, **changed}


def _monitor(
    rule: _Rule = status_of,
    start: Mapping[str, float] = _DEFAULTS,
    frozen: Collection[str] = (),
    asked_at: Callable[[int], float] = float,
) -> Model:
    """Return the model of a monitor, by default a right one; `asked_at` is when it asks."""
    return lambda fed: numbered(
        rule(value, *_limits(fed, asked_at(number), start, frozen).values())
        for number, value in enumerate(fed.readings, 1)
    )


def _every(period: int, late: int) -> Callable[[int], float]:
    """Return when limits were asked for last; a timer asks before a reading comes, or after it."""
    return lambda number: (number - late) - (number - late) % period


_right = _monitor()
_EACH_READING = "Publish one status for each reading, when it comes, "
_NEVER = "never appears. Is its condition reached, and what comes after?"


def _kept(keeps: Callable[[Track, int], bool]) -> Model:
    """Return the model of a right monitor that publishes only some of its statuses."""

    def model(fed: Tuning) -> Track:
        right = _right(fed)
        return {at: now for at, now in right.items() if keeps(right, at)}

    return model


_SUSPECT_MONITORS = suspects(
    *(
        ("parameter-frozen", f"What is set for {' and '.join(names)} never counts. Where is the "
         "value asked for: once, or each time that a reading comes?", _monitor(frozen=names))
        for names in (("low", "high"), ("low",), ("high",))
    ),
    ("parameter-late", "A new value counts one reading too late. Ask for the value first, and then "
     "decide.", _monitor(asked_at=_every(1, late=1))),
    *(
        ("parameter-late", f"It looks as if the limits were asked for every {period} seconds. A "
         "new value counts from the next reading on.", _monitor(asked_at=_every(period, late)))
        for period, late in product((3, 5, 10), (0, 1))
    ),
    ("parameters-swapped", "High appears above the lower limit, and Low below the upper one. Which "
     "of the two values belongs to which name, and to which comparison?",
     _monitor(lambda v, low, high: status_of(v, high, low))),
    ("parameters-swapped", "Until something is set, the statuses are right; what is set for `low` "
     "counts as the upper limit, and what is set for `high` as the lower one. Which value begins "
     "under which name, and which name is asked for?",
     _monitor(lambda v, low, high: status_of(v, high, low), _EXCHANGED)),
    ("boundary", "A reading exactly at a limit is Normal: > and < leave the limit itself out.",
     _monitor(lambda v, low, high: "High" if v >= high else status_of(v, low, high)),
     _monitor(lambda v, low, high: "Low" if v <= low else status_of(v, low, high)),
     _monitor(lambda v, low, high: "High" if v >= high else "Low" if v <= low else "Normal")),
    ("decimals-lost", "The reading and both limits are decimal numbers: where does one of them "
     "lose its decimals?",
     _monitor(lambda v, low, high: status_of(int(v), low, high)),
     _monitor(lambda v, low, high: status_of(round(v), low, high)),
     _monitor(lambda v, low, high: status_of(v, int(low), int(high))),
     _monitor(lambda v, low, high: status_of(v, round(low), round(high))),
     _monitor(lambda v, low, high: status_of(v, int(low), high)),
     _monitor(lambda v, low, high: status_of(v, round(low), high)),
     _monitor(lambda v, low, high: status_of(v, low, int(high)))),
    ("wrong-state", f"High {_NEVER}", _monitor(lambda v, low, high: status_of(v, low, v))),
    ("wrong-state", f"Low {_NEVER}", _monitor(lambda v, low, high: status_of(v, v, high))),
    ("wrong-state", "Which limit belongs to which word, and on which side of it?",
     _monitor(lambda v, low, high: "High" if v < high else "Low" if v > low else "Normal"),
     _monitor(lambda v, low, high: "Low" if v > high else "High" if v < low else "Normal"),
     _monitor(lambda v, low, high: "High" if v > high else "Low"),
     _monitor(lambda v, low, high: status_of(v, high, high)),
     _monitor(lambda v, low, high: status_of(v, low, low))),
    ("wrong-state", "Each status is that of the reading before. Decide, and then publish.",
     lambda fed: numbered(["Normal", *(word for (word,) in _right(fed).values())][:-1])),
    ("wrong-rate", f"{_EACH_READING}whether it has changed or not.",
     _kept(lambda said, at: said[at] != said.get(at - 1))),
    ("wrong-rate", f"{_EACH_READING}also while it is Normal.",
     _kept(lambda said, at: said[at] != ("Normal",))),
    ("wrong-rate", f"{_EACH_READING}and only once.",
     lambda fed: {at: now * 2 for at, now in _right(fed).items()}),
)  # fmt: skip


def default_suspects(readings: Collection[float]) -> tuple[Suspect, ...]:
    """Return monitors whose limits begin elsewhere.

    Of all defaults between two readings one is enough: their statuses are the same.
    """
    limits = product((0.0, *sorted({*readings}), 99.0), repeat=2)
    starts = ({"low": low, "high": high} for low, high in limits)
    models = (_monitor(start=start) for start in starts if start != _DEFAULTS)
    return suspects(
        ("other-default", "The default of `low` is 20.0, and that of `high` is 26.0.", *models)
    )


def _judge_tuning(observation: Observation, fed: Tuning) -> Verdict:
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or diagnose_unpublished(observation, _STATUS)
        or _refused(observation)
        or _wrong_statuses(track(observation, _STATUS, _stripped), fed)
        or passed(
            f"{len(fed.readings)} readings, {len(fed.changes)} changes of a parameter, no slip."
        )
    )


#: Reasons of rclpy, and what they mean; they say more than a model could.
_REFUSALS = {
    "not declared": ("parameter-undeclared", "Which call in the constructor makes a parameter? "
                     "Its name has to be this one, letter by letter."),
    "Callback returned an invalid type": (
        "result-of-another-kind", "A parameter callback has to return a SetParametersResult, on "
        "every path. What does yours return?"),
    "Wrong parameter type": (
        "parameter-type", "A decimal number was set. The first value that declare_parameter gets "
        "decides about the type: 3 is a whole number, 3.0 is a decimal one."),
    "": ("parameter-refused", "Each of these numbers is a good limit. Which line of your node "
         "refuses it, and when?"),
}  # fmt: skip


def _refused(observation: Observation) -> Diagnosis | None:
    """Say why a parameter could not be set."""
    steps = [one.source for one in observation.callbacks if one.name == "SetParameter"]
    refused = next((one for one in steps if not one.endswith(": accepted")), "")
    if not refused:
        return None
    name, _, why = refused.partition(": ")
    said = why.partition(", ")[2].rstrip(".") or "without a reason"
    mistake, hint = next(found for reason, found in _REFUSALS.items() if reason in why)
    return Diagnosis(mistake, f"`ros2 param set` was refused for {name}: {said}.", hint)


def _wrong_statuses(done: Track, fed: Tuning) -> Diagnosis | None:
    readings = fed.readings
    said = [word for words in done.values() for word in words]

    def describe(mismatch: Mismatch) -> Diagnosis:
        at = mismatch.at
        gave, right = (" and ".join(one) or "no status" for one in (mismatch.done, mismatch.right))
        evidence = f"At {at:g} s your node published {gave}, and no reading came then."
        if mismatch.right:
            # What they are in the node is unknown: its first values may be others.
            low, high = _limits(fed, at).values()
            evidence = (
                f"At {at:g} s `low` should be {low:g} and `high` {high:g}: a reading of "
                f"{readings[int(at) - 1]:g} gave {gave} instead of {right}."
            )
        # Any text may come, at any time: no model can foretell those.
        if len(said) != len(readings) or len(done) != len(readings):
            count = f"{len(readings)} readings arrived, and {len(said)} statuses were published."
            return Diagnosis("wrong-rate", f"{count} {evidence}", f"{_EACH_READING}and only then.")
        if not set(STATUSES).issuperset(said):
            hint = "The words are High, Low and Normal, and nothing else."
            return Diagnosis("wrong-word", evidence, hint)
        return Diagnosis("wrong-state", evidence, "Which of your conditions is true there?")

    wrong_ones = (*_SUSPECT_MONITORS, *default_suspects(readings))
    return diagnose(fed, done, _right(fed), wrong_ones, describe)


_TUNING = Exercise("07b", _observe_tuning, _judge_tuning, "limits that you can set", 2, (
    "A parameter is declared in the constructor, with its name and its first value.",
    "get_parameter returns the parameter; its attribute `value` holds the number.",
    "The constructor runs once, so a value that it gets there never changes. The callback runs "
    "at each reading.",
), draw=draw_tuning)  # fmt: skip

# 07c: a node that listens to log lines.

_ROSOUT = Wire("/rosout", "rcl_interfaces/msg/Log")
_WARNINGS = Wire("/warnings", "std_msgs/msg/String")
_LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}
_DEBUG, _INFO, _WARN, _ERROR, _FATAL = _LEVELS


class Line(NamedTuple):
    """Hold one log line that is fed in, with the fields of a `Log`."""

    level: int
    name: str
    msg: str


#: One a second.
Lines = Sequence[Line]
# Texts hold `warning` and `error` where there is none; names and a text come twice; a name has a
# capital letter.
_LINES = (
    Line(_INFO, "gardener", "The window is shut"),
    Line(_WARN, "lamp", "I do not know how bright it is"),
    Line(_DEBUG, "weather", "warning: only a test"),
    Line(_WARN, "lamp", "I do not know how bright it is"),
    Line(_INFO, "window", "No error, no WARN, nothing"),
    Line(_ERROR, "Soil_probe", "The cable is loose"),
    Line(_FATAL, "pump", "No water"),
    Line(_DEBUG, "lamp", "12 readings"),
    Line(_WARN, "greenhouse.fan", "It is getting loud"),
    Line(_ERROR, "lamp", "The bulb is broken"),
    Line(_WARN, "lamp", "It is dark now"),
    Line(_INFO, "lamp", "A new bulb"),
)


def draw_lines(draw: Draw) -> Lines:
    """Draw the order of lines, who logs them, and some that come again."""
    right, names = _warnings, sorted({line.name for line in _LINES})
    numbers = {name: draw.whole(0, 1, 99) for name in names}
    lines = [
        line._replace(name=f"{line.name}_{numbers[line.name]}" if numbers[line.name] else line.name)
        for line in _LINES
    ]
    return draw.until(
        lambda: draw.shuffled((*lines, *(draw.one_of(*lines) for _ in range(draw.whole(0, 0, 4))))),
        lambda fed: tells_apart(fed, right, (*_SUSPECT_LINES, *_single_names(fed))),
    )


def _observe_log_watcher(answer: Answer, lines: Lines) -> Observation:
    fed = [(second, line._asdict()) for second, line in enumerate(lines, 1)]
    qos = QoS(durability="TRANSIENT_LOCAL", depth=1000)  # as every node's own publisher
    return observe(answer, len(lines) + 0.5, steps=publishing(_ROSOUT, fed, qos))


#: Within how many seconds a name may follow its line: a timer may tell what a callback heard.
_SOON = 0.5


def _by_line(said: Track) -> dict[float, tuple[str, ...]]:
    """Return the texts by the second of their line; those that follow none soon keep their own."""
    return grouped(
        (float(int(at)) if int(at) >= 1 and at - int(at) <= _SOON else at, text)
        for at, texts in sorted(said.items())
        for text in texts
    )


# Which lines count and what is published for them are two questions, each with its own suspects;
# so of an answer with a mistake in both the first one is named.


def _lines(counts: Callable[[Line], bool]) -> Model:
    """Return the model of a watcher for which some lines count."""
    return lambda lines: {float(n): (True,) for n, line in enumerate(lines, 1) if counts(line)}


def _is_warning(line: Line) -> bool:
    return line.level >= _WARN


def _among(values: Collection[Any], key: str = "level") -> Model:
    return _lines(lambda line: _is_warning(line) and getattr(line, key) in values)


def _once(key: Callable[[Line], Any], memory: int = 99) -> Model:
    """Return the model of a watcher that leaves out what it has in its memory."""

    def model(lines: Iterable[Line]) -> Track:
        known = deque[Any](maxlen=memory)
        found = {}
        for at, line in enumerate(lines, 1):
            if _is_warning(line) and key(line) not in known:
                found[float(at)] = (True,)
                known.append(key(line))
        return found

    return model


_warnings = _lines(_is_warning)
_BY_NUMBER = (
    "The number in the message is the level, whatever the text says. Compare it with the number "
    "of a warning."
)
_AT_ONCE = "Publish in the callback of /rosout."
_SUSPECT_LINES = suspects(
    ("level-too-low", _BY_NUMBER,
     _lines(lambda line: True),
     _lines(lambda line: line.level >= _INFO),
     _lines(lambda line: line.level <= _WARN),
     _lines(lambda line: line.level < _WARN),
     _lines(lambda line: "warn" in line.msg.lower() or "error" in line.msg.lower())),
    ("boundary", "A warning itself counts, and so does what is worse.", _among((_ERROR, _FATAL))),
    ("level-missed", "What is worse than a warning counts, too.",
     _among((_WARN,)), _among((_WARN, _ERROR)), _among((_WARN, _FATAL))),
    ("said-once", "Each line counts, also of a node named before.",
     _once(lambda line: line.name),
     _once(lambda line: line.name, memory=1),
     _once(lambda line: line.msg),
     _once(lambda line: line.msg, memory=1),
     _once(lambda line: line.level),
     _once(lambda line: (line.name, line.level))),
    ("alert-too-many", f"Each name comes a second late. {_AT_ONCE}",
     lambda lines: {at + 1: said for at, said in _warnings(lines).items()}),
)  # fmt: skip


def _single_names(lines: Lines) -> tuple[Suspect, ...]:
    """Return watchers for which one name counts."""
    names = sorted({line.name for line in lines if _is_warning(line)})
    models = (_among((name,), "name") for name in names)
    hint = "The level decides, whichever node logs the line."
    return suspects(("one-name-only", hint, *models))


def _texts_of(text: Callable[[Line, str], str]) -> Model:
    """Return the model of a watcher by the text that it makes of a line and its own full name."""
    return lambda fed: {at: (text(*one).strip(),) for at, one in fed.items()}


_names = _texts_of(lambda line, node: line.name)
_FIELD = "Which field of the message holds the name? ros2 interface show lists them all."
_SUSPECT_TEXTS = suspects(
    ("text-for-name", "That is the text of the line. Which field names the node?",
     _texts_of(lambda line, node: line.msg)),
    ("own-name", "That is the node that listens. The message holds the name of the node that "
     "logged the line.",
     _texts_of(lambda line, node: node), _texts_of(lambda line, node: node[1:].replace("/", "."))),
    ("wrong-values", f"That is the level. {_FIELD}",
     _texts_of(lambda line, node: str(line.level)),
     _texts_of(lambda line, node: _LEVELS[line.level])),
    ("wrong-values", "A name may have several parts: publish the field as it is.",
     _texts_of(lambda line, node: line.name.split(".")[0]),
     _texts_of(lambda line, node: line.name.split(".")[-1]),
     _texts_of(lambda line, node: line.name.replace(".", "/"))),
)  # fmt: skip


def _judge_log_watcher(observation: Observation, lines: Lines) -> Verdict:
    said = track(observation, _WARNINGS, _stripped)
    return (
        diagnose_unheard(observation, _ROSOUT)
        or diagnose_unpublished(observation, _WARNINGS)
        or _wrong_lines(said, lines)
        or _wrong_texts(_by_line(said), lines, observation.subject)
        or passed(
            f"{len(lines)} log lines, {len(_warnings(lines))} warnings or worse, each one named."
        )
    )


def _wrong_lines(said: Track, lines: Lines) -> Diagnosis | None:
    """Say which line was named and does not count, or the other way round."""
    told, right = _by_line(said), _warnings(lines)
    done: Track = dict.fromkeys(told, (True,))
    at = {float(second): line for second, line in enumerate(lines, 1)}
    watchers = (*_SUSPECT_LINES, *_single_names(lines))

    def describe(mismatch: Mismatch) -> Diagnosis:
        late = sorted(said.keys() - at.keys())  # no model: a timer may publish at any time
        if late and not matching(lines, done, watchers):
            soon = [one for one in late if one - int(one) <= _SOON and float(int(one)) in right]
            stray = next((one for one in late if one not in soon), late[0])
            since = f"the log line before it came at {int(stray)} s"
            if stray <= 1:
                since = "no line had come yet"
            evidence = f"A name was published at {stray:g} s, and {since}."
            return Diagnosis("alert-too-many", evidence, _AT_ONCE)
        line = at[mismatch.at]
        what = repr(told[mismatch.at][0]) if mismatch.done else "Nothing"
        evidence = f"{what} was published for a line of level {_LEVELS[line.level]}: {line.msg!r}."
        if mismatch.done:
            return Diagnosis("level-too-low", evidence, _BY_NUMBER)
        hint = "Go through your method step by step: what does it do with this line?"
        return Diagnosis(UNKNOWN, evidence, hint)

    return diagnose(lines, done, right, watchers, describe)


def _wrong_texts(said: Track, lines: Lines, node: str) -> Diagnosis | None:
    """Say what is wrong with the texts for the right lines."""
    fed = {at: (lines[int(at) - 1], node) for at in said}

    def describe(mismatch: Mismatch) -> Diagnosis:
        text, name = mismatch.done[0], mismatch.right[0]
        evidence = f"For a line of {name}, {text!r} was published."
        if name in text:
            hint = "Publish the name, and nothing around it."
            return Diagnosis("stray-characters", evidence, hint)
        return Diagnosis("wrong-values", evidence, _FIELD)  # no model: a text may be anything

    first = {at: texts[:1] for at, texts in said.items()}
    wrong = diagnose(fed, first, _names(fed), _SUSPECT_TEXTS, describe)
    count = sum(map(len, said.values()))
    if wrong or count == len(said):
        return wrong
    evidence = f"{count} names were published for {len(said)} lines."
    return Diagnosis("alert-too-many", evidence, "One name for each line is enough.")


_LOG_WATCHER = Exercise("07c", _observe_log_watcher, _judge_log_watcher, "a log watcher", 3, (
    "It's an alarm like the one on page 04, with another message type.",
    "create_subscription takes Log, the topic, your method and a depth. The message has "
    "the fields level, name and msg.",
    "Levels are numbers: the worse, the higher. Log.WARN is the number of a warning.",
), draw=draw_lines)  # fmt: skip

EXERCISES: tuple[Exercise[Any], ...] = (_FINDINGS, _TUNING, _LOG_WATCHER)

"""Page 13, build your own: the vent alone, then a whole greenhouse.

Each requirement of the greenhouse has a judge: a pure function from what was seen in all trials to
the mistake, or None if the requirement is met. The vent and the report are judged by models. The
pump, the alarms and the structure are judged step by step, because the requirements leave a right
greenhouse time to react, and its freedom: a model would have to do what was done to the second.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Any

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.exceptions import diagnose_fault, first_sentence, line_of
from rosbeat.diagnosis.findings import difference, listing, nearest
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import (
    FAILED,
    NEW_TO_ME,
    PASSED,
    Exercise,
    Verdict,
    before_judging,
    not_attempted,
    passed,
)
from rosbeat.exercises.greenhouse import (
    BROKEN,
    DROUGHT,
    LOSSY,
    OTHER,
    PATIENCE,
    PLAIN,
    SENSORS,
    TOTAL,
    USUAL,
    Day,
    Weather,
    draw_weather,
    matching_rubric,
    other_limits,
    read_rubric,
)
from rosbeat.exercises.model import (
    Suspect,
    Track,
    matching,
    name_mistake,
    samples_on,
    suspects,
    variants,
)
from rosbeat.exercises.random_inputs import PAGE
from rosbeat.exercises.scenarios import (
    Answer,
    Value,
    adding,
    listener,
    observe,
    observe_system,
    removing,
    station,
)
from rosbeat.records import Fault, GraphSnapshot, Observation, Outcome, Part, QoS

_BOOL, _FLOAT = "std_msgs/msg/Bool", "std_msgs/msg/Float32"
#: The agreed outputs and their types, and the inputs.
OUTPUTS = {
    "/vent": _BOOL,
    "/pump": _BOOL,
    "/alarm": "std_msgs/msg/String",
    "/report": _FLOAT,
}
INPUTS = ("/temperature", "/humidity")
#: The parameters of the vent's node.
_VENT = ("open_above", "close_below")
#: Topics of actuators, and the display of each that joins late.
_LATE_DISPLAYS = (("/vent", "late_vent_display"), ("/pump", "late_pump_display"))
_LATE = tuple(name for _, name in _LATE_DISPLAYS)
#: Faults after which another trial would say nothing new.
_HOPELESS = ("DeadlinePassed", "NoSystemError", "SessionError")
#: Slack for comparisons of times, in seconds.
_EPS = 1e-6
#: When an actuator was on, from and to.
_Spans = Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Trials:
    """Hold what a greenhouse did in every trial.

    Attributes:
        numbers: The numbers of the rubric, by name.
        runs: What was seen, by the name of the trial; some may be left out if the first one says
            that there is no greenhouse.
    """

    numbers: dict[str, float]
    runs: dict[str, Observation]

    @property
    def plain(self) -> Observation:
        """Return what was seen on the plain day, which every greenhouse goes through."""
        return self.runs[PLAIN]


def observe_vent(answer: Answer, seed: int = PAGE, numbers: Mapping[str, float] = USUAL) -> Trials:
    """Run a vent alone through the first part of the plain day, and then with other limits.

    Args:
        answer: What should be a node class.
        seed: Of the weather.
        numbers: Those of the rubric, by name.
    """
    from rosbeat.ros.scenario import SetParameters

    def observe_day(day: Day, step: Any) -> Observation:  # noqa: ANN401 - a step
        sensor = station(SENSORS[0], "temperature", day.temperature)
        return observe(answer, day.seconds, others=[sensor], steps=[step])

    days = Weather(numbers, seed)
    limits = {name: value for name, value in other_limits(numbers, seed).items() if name in _VENT}
    runs = {PLAIN: observe_day(days.airing, _late_display(days.airing, *_LATE_DISPLAYS[0]))}
    if not runs[PLAIN].faults:
        runs[OTHER] = observe_day(days.other, SetParameters(0.5, values=limits))
    return Trials(dict(numbers), runs)


def observe_greenhouse(
    answer: Answer, seed: int = PAGE, numbers: Mapping[str, float] = USUAL
) -> Trials:
    """Run a greenhouse through all trials.

    Args:
        answer: What should be a function that returns a list of nodes; see `observe_system`.
        seed: Of the weather.
        numbers: Those of the rubric, by name.
    """
    days = Weather(numbers, seed)
    late = [_late_display(days.plain, *one) for one in _LATE_DISPLAYS]
    runs = {PLAIN: _observe_day(answer, days.plain, late)}
    if not _is_hopeless(runs[PLAIN]):
        endings = [
            removing(days.lossy.marks[f"without {name}"] + 0.5, node)
            for name in ("report", "alarm", "pump")
            for node in _publishers(runs[PLAIN].graph, f"/{name}")
        ]
        runs[BROKEN] = _observe_day(answer, days.broken)
        runs[LOSSY] = _observe_day(answer, days.lossy, endings)
        runs[DROUGHT] = _observe_day(answer, days.drought)
        runs[OTHER] = _observe_day(answer, days.other, parameters=other_limits(numbers, seed))
    return Trials(dict(numbers), runs)


def _late_display(day: Day, topic: str, name: str) -> Any:  # noqa: ANN401 - a step
    """Return a step that adds a display for the last second of a day."""
    qos = QoS(durability="TRANSIENT_LOCAL", depth=1)
    return adding(day.seconds - 1, listener(name, Wire(topic, _BOOL), qos))


def _observe_day(
    answer: Answer, day: Day, steps: Iterable[Any] = (), **options: Value
) -> Observation:
    readings = (("temperature", day.temperature), ("humidity", day.humidity))
    sensors = [
        station(name, topic, values)
        for name, (topic, values) in zip(SENSORS, readings, strict=True)
    ]
    return observe_system(answer, day.seconds, others=sensors, steps=steps, **options)


def _is_hopeless(seen: Observation) -> bool:
    """Return whether there is no system, or one that stands still."""
    blank = any("'____'" in fault.text for fault in seen.faults)
    none = seen.faults and set(seen.graph.nodes) <= {f"/{name}" for name in (*SENSORS, *_LATE)}
    return bool(blank or none or any(one.kind in _HOPELESS for one in seen.faults))


# What a greenhouse published.


@dataclass(frozen=True)
class Switch:
    """Hold the commands of an actuator: it is off until its first command.

    Attributes:
        commands: When it got which command, in order.
    """

    commands: tuple[tuple[float, bool], ...]

    def at(self, time: float) -> bool:
        """Return whether it is on at a time, commands of that time included."""
        place = bisect_right([when for when, _ in self.commands], time + _EPS)
        return self.commands[place - 1][1] if place else False

    def spans(self, end: float) -> list[tuple[float, float]]:
        """Return from when to when it was on; a span that is open lasts until `end`."""
        found: list[tuple[float, float]] = []
        since: float | None = None
        for when, is_on in (*self.commands, (end, False)):
            if is_on and since is None:
                since = when
            elif not is_on and since is not None:
                found.append((since, when))
                since = None
        return [(begin, until) for begin, until in found if until > begin]


def _said(seen: Observation, topic: str) -> list[tuple[float, Any]]:
    """Return when what was published on an output."""
    return [(one.time, one.value) for one in samples_on(seen, Wire(topic, OUTPUTS[topic]))]


def _switch(seen: Observation, topic: str) -> Switch:
    return Switch(tuple((time, bool(value)) for time, value in _said(seen, topic)))


def _spans(seen: Observation, topic: str) -> list[tuple[float, float]]:
    return _switch(seen, topic).spans(seen.time)


def _begins_in_time(spans: _Spans, due: float, react: float) -> bool:
    """Return whether the first span begins when it is due, or soon after."""
    return bool(spans) and due - _EPS <= spans[0][0] <= due + react + _EPS


def _publishers(graph: GraphSnapshot, topic: str) -> list[str]:
    """Return the nodes that have a publisher on a topic."""
    return sorted({end.node for end in graph.on(topic, "publisher")})


def _stamp(time: float) -> str:
    return f"{round(time, 2):g} s"


def _silent(seen: Observation, *topics: str) -> Diagnosis | None:
    """Say why nothing that can be read was published on one of some outputs."""
    for topic in topics:
        ends = seen.graph.on(topic, "publisher")
        wrong = next((end for end in ends if end.type_name != OUTPUTS[topic]), None)
        if wrong:
            evidence = f"{wrong.node} publishes {wrong.type_name} on {topic}"
            hint = "One topic carries one type, and all sides have to name the same one."
            return Diagnosis("type-mismatch", f"{evidence}; agreed is {OUTPUTS[topic]}.", hint)
        if _said(seen, topic):
            continue
        if not ends:
            return _no_publisher(seen, topic)
        evidence = f"{ends[0].node} has a publisher on {topic}, and nothing was published there."
        hint = "Does the callback that publishes run at all? To what does its node listen?"
        return Diagnosis("never-published", evidence, hint)
    return None


def _no_publisher(seen: Observation, topic: str) -> Diagnosis:
    names = {end.name for end in seen.graph.endpoints if end.kind == "publisher"} - set(OUTPUTS)
    near = nearest(topic, names)
    if near:
        evidence = f"A node publishes on {near}, and {topic} is agreed: {difference(near, topic)}."
        hint = "Topic names match letter by letter, a namespace before the slash included."
        return Diagnosis("topic-misspelled", evidence, hint)
    evidence = f"No node has a publisher on {topic}."
    return Diagnosis("no-publisher", evidence, "Which node of your drawing has this task?")


# R1 and 13a: the vent follows the temperature.


@dataclass(frozen=True)
class HeldTemperature:
    """Hold a temperature that is held for some seconds.

    Attributes:
        value: The temperature.
        was_open: Whether the vent had to be open before.
        opening: The limit above which it opens.
        closing: The limit below which it closes.
    """

    value: float
    was_open: bool
    opening: float
    closing: float

    @property
    def right(self) -> bool:
        """Return whether the vent has to be open."""
        return self.value > self.opening or (self.was_open and self.value >= self.closing)

    @property
    def is_between(self) -> bool:
        """Return whether the vent has to stay as it is."""
        return self.closing < self.value < self.opening


def _vent(is_open: Callable[[HeldTemperature], bool]) -> Callable[[HeldTemperature], Track]:
    return lambda held: {0: (is_open(held),)}


#: Vents that are wrong about the first temperature at which they are not right.
VENTS = suspects(
    ("boundary",
        "A limit itself changes nothing: above means above, and below means below.",
        _vent(lambda one: one.value >= one.opening or (one.was_open and one.value > one.closing))),
    ("no-hysteresis",
        "Between the two limits the vent stays as it was. So the node has to remember that.",
        _vent(lambda one: one.right != one.is_between)),
    ("wrong-state",
        "Above the upper limit it opens, below the lower one it closes. Which line decides that?",
        _vent(lambda one: one.right == (
            one.is_between or one.value in (one.opening, one.closing)))),
)  # fmt: skip


@dataclass(frozen=True)
class Temperatures:
    """Hold the temperatures of a whole day, one each second, and the limits.

    Attributes:
        values: The temperatures; None is a second without one.
        opening: The limit above which the vent opens.
        closing: The limit below which it closes.
    """

    values: tuple[float | None, ...]
    opening: float
    closing: float


def _forgetful(fed: Temperatures, is_open: bool) -> Track:
    """Return what a vent does that judges each temperature as if it still stood as at first."""
    return {
        at: (not is_open,)
        for at, value in enumerate(fed.values, 1)
        if value is not None and (value < fed.closing if is_open else value > fed.opening)
    }


_REMEMBER = (
    "For each reading, the node decides as if it had not given a command yet. Where does it "
    "remember the last command, and which line changes that?"
)
#: Vents that never remember what they have done.
FORGETFUL = variants(
    _forgetful, [("status-repeated", _REMEMBER, {"is_open": False}, {"is_open": True})]
)


def held_temperatures(
    day: Day, numbers: Mapping[str, float]
) -> list[tuple[int, int, HeldTemperature]]:
    """Return when each temperature that tries the vent alone begins and ends, and what it is."""
    found, is_open = [], False
    for begins, ends, value in day.held:
        held = HeldTemperature(value, is_open, numbers["open_above"], numbers["close_below"])
        found.append((begins, ends, held))
        is_open = held.right
    return found


def _wrong_vent(seen: Observation, day: Day, numbers: Mapping[str, float]) -> Diagnosis | None:
    """Name the mistake at the first temperature after which the vent is not as it should be."""
    vent, states = _switch(seen, "/vent"), ("closed", "open")
    limits = numbers["open_above"], numbers["close_below"]
    commands = {time: (bool(value),) for time, value in _said(seen, "/vent")}
    for begins, ends, held in held_temperatures(day, numbers):
        for time in (begins + numbers["react_seconds"], ends - 0.01):  # as soon as due, and at last
            done = vent.at(time)
            if done == held.right:
                continue
            evidence = (
                f"It was {states[held.was_open]}, the temperature became {held.value:g}, and at "
                f"{_stamp(time)} the vent was {states[done]}; it should have been "
                f"{states[held.right]}."
            )
            # Those that never remember have given the commands of the whole day.
            whole_day = Temperatures(tuple(day.temperature), *limits)
            found = matching(whole_day, commands, FORGETFUL)
            if found:
                evidence += " Every command that was published is the same."
            hint = "Go through your conditions in their order with this temperature."
            found = found or matching(held, {0: (done,)}, VENTS)
            return name_mistake(found, Diagnosis(UNKNOWN, evidence, hint))
        pairs = pairwise([(0.0, False), *_said(seen, "/vent")])
        moves = [at for (_, before), (at, now) in pairs if before != now and begins <= at < ends]
        if len(moves) > 1:
            return Diagnosis(
                "wrong-state",
                f"From {_stamp(begins)} on the temperature was {held.value:g}, and the vent moved "
                f"at {' and '.join(map(_stamp, moves))}.",
                "The second of two equal temperatures changes nothing. Does the line that moves "
                "the vent ask whether it is open already?",
            )
    return None


def _judge_vent(trials: Trials, days: Weather) -> Diagnosis | None:
    seen = trials.plain
    return _silent(seen, "/vent") or _wrong_vent(seen, days.plain, days.numbers)


def _judge_vent_alone(trials: Trials, seed: int) -> Verdict:
    seen, days = trials.plain, Weather(matching_rubric(trials.numbers).numbers, seed)
    for run in trials.runs.values():
        early = before_judging(run)
        if early:
            return early
    count = len(_said(seen, "/vent"))
    return (
        diagnose_unheard(seen, Wire("/temperature", _FLOAT))
        or diagnose_unpublished(seen, Wire("/vent", _BOOL))
        or _wrong_vent(seen, days.airing, days.numbers)
        or _repeated(seen, "/vent")
        or _limits_not_set(trials.runs[OTHER], days)
        or _not_stored(seen, *_LATE_DISPLAYS[0])
        or passed(f"{len(days.airing.held)} temperatures, and {count} commands.")
    )


def _limits_not_set(seen: Observation, days: Weather) -> Diagnosis | None:
    """Say that limits that were set while a vent ran have changed nothing."""
    replies = [one.data for one in seen.replies if one.word == "parameters"]
    if not all(one["successful"] for one in replies):
        evidence = f"open_above and close_below were set, and refused: {replies[0]['reason']}."
        return Diagnosis("limit-fixed", evidence, "Keep the lines that declare both, as floats.")
    return _wrong_limits_of_vent(
        seen, days, "The limits were set to other values half a second after the start."
    )


# R2 and R3: the pump runs when it should, and only then.


def _judge_pump(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R2: the pump runs for so long, rests for so long, and only when it is dry."""
    n, day, both = days.numbers, days.plain, days.plain.marks["both"]
    runs, drought = _spans(trials.plain, "/pump"), _spans(trials.runs[DROUGHT], "/pump")
    spans = [one for one in runs if one[0] < both]
    return (
        _silent(trials.plain, "/pump")
        or _wrong_start(spans, day.marks, n)
        or _wrong_duration(runs, n, both)
        or _wrong_duration(
            drought, n, days.drought.marks["dry again"], "On a dry day with silent sensors, the"
        )
        or (None if len(spans) > 1 else _stopped_for_good(trials, days))
        or _started_in_the_wet(spans, day.marks["wet"] + n["react_seconds"])
    )


def _wrong_start(
    spans: _Spans, marks: Mapping[str, float], n: Mapping[str, float]
) -> Diagnosis | None:
    limit, due, react = n["dry_below"], marks["dry"], n["react_seconds"]
    if _begins_in_time(spans, due, react):
        return None
    first = spans[0][0] if spans else inf
    if first > due:
        evidence = f"From {_stamp(due)} on it was dry, and by {_stamp(due + react)} no pump was"
        hint = "What has to hold before it starts? Print each of these."
        return Diagnosis("never-switched-on", f"{evidence} running.", hint)
    evidence = f"The pump was started at {_stamp(first)}, and no humidity was below {limit:g} yet."
    if first >= marks["at the limit"]:
        return Diagnosis("boundary", evidence, f"Exactly {limit:g} is not below {limit:g}.")
    return Diagnosis("wrong-state", evidence, "Which reading starts it, and what is its value?")


def _wrong_duration(
    spans: _Spans, n: Mapping[str, float], cut: float, lead: str = "The"
) -> Diagnosis | None:
    """Name a run that is too short or too long, or a rest; runs may be cut short from a time on."""
    wanted, rest = n["pump_seconds"], n["rest_seconds"]
    for begin, until in spans:
        if begin < cut and abs(until - begin - wanted) > 1 + _EPS:
            evidence = f"{lead} pump ran from {_stamp(begin)} to {_stamp(until)}, which is "
            hint = f"It should run for {wanted:g} s. What switches it off, and when?"
            return Diagnosis("wrong-duration", f"{evidence}{_stamp(until - begin)}.", hint)
    for (_, off), (begin, _) in pairwise(spans):
        if begin - off < rest - _EPS:
            evidence = f"{lead} pump stopped at {_stamp(off)} and ran again at {_stamp(begin)}."
            hint = f"It has to rest for {rest:g} s, counted from when it stops."
            return Diagnosis("rest-too-short", evidence, hint)
    return None


def _stopped_for_good(trials: Trials, days: Weather) -> Diagnosis | None:
    """Name a pump that ran once on a day that stays dry: a rest may be long, and has an end."""
    n, spans = days.numbers, _spans(trials.runs[DROUGHT], "/pump")
    rest, react = n["rest_seconds"], n["react_seconds"]
    if not spans:
        evidence = f"It was dry from {_stamp(days.drought.marks['dry'])} on, and no pump ran."
        hint = "What has to hold before it starts? Print each of these."
        return Diagnosis("never-switched-on", evidence, hint)
    off = spans[0][1]
    latest = off + PATIENCE * rest + react + 1
    if len(spans) > 1 and spans[1][0] <= latest + _EPS:
        return None
    evidence = f"On a day that stays dry, the pump stopped at {_stamp(off)}, and by "
    evidence += f"{_stamp(latest)} it had not run again."
    hint = f"After a rest of {rest:g} s it may run again. What tells it that the rest is over?"
    return Diagnosis("never-switched-on", evidence, hint)


def _started_in_the_wet(spans: _Spans, wet: float) -> Diagnosis | None:
    late = next((begin for begin, _ in spans if begin > wet + _EPS), None)
    if late is None:
        return None
    evidence = f"The pump was started at {_stamp(late)}, and it was no longer dry."
    return Diagnosis("wrong-state", evidence, "Does it start again only because the rest is over?")


def _judge_interlock(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R3: vent and pump exclude each other, and the pump comes back afterwards."""
    marks, react = days.plain.marks, days.numbers["react_seconds"]
    vent, pump = _vent_and_pump(trials.plain, marks["both"])
    both = _both_on(vent, pump, react)
    if both:
        return both
    if not vent:
        evidence = f"It was hot from {_stamp(marks['both'])} on, and no vent was open."
        hint = "Let the vent work first; then this can be tried."
        return Diagnosis("never-switched-on", evidence, hint)
    due = marks["cool and dry"]
    # A vent without hysteresis is closed earlier: that is another matter.
    if any(min(due, vent[0][1]) <= begin <= due + 2 * react + 1 + _EPS for begin, _ in pump):
        # A pump with a long rest has not yet run again when it becomes hot on a plain day.
        hot = days.drought.marks["hot again"]
        late = _vent_and_pump(trials.runs[DROUGHT], hot)
        return _both_on(*late, react, "After a drought, from")
    evidence = f"It was cool and dry from {_stamp(due)} on, and the pump did not start."
    hint = "When the vent is closed again, the pump may run. Does its node hear of that?"
    return Diagnosis("never-switched-on", evidence, hint)


def _vent_and_pump(seen: Observation, after: float) -> tuple[_Spans, _Spans]:
    """Return when the vent was open and when the pump ran, after a time."""
    vent, pump = (
        [one for one in _spans(seen, topic) if one[1] > after] for topic in ("/vent", "/pump")
    )
    return vent, pump


def _both_on(vent: _Spans, pump: _Spans, react: float, lead: str = "From") -> Diagnosis | None:
    """Name a pump that runs while the vent is open, for longer than a reaction takes."""
    for one in vent:
        for other in pump:
            begin, until = max(one[0], other[0]), min(one[1], other[1])
            if until - begin > react + _EPS:
                evidence = (
                    f"{lead} {_stamp(begin)} to {_stamp(until)} the vent was open and the pump"
                )
                hint = "The pump's node has to know how the vent stands. Which topic carries that?"
                if other[0] < one[0]:
                    hint = "The pump was already running when the vent opened. What stops it then?"
                return Diagnosis("no-interlock", f"{evidence} was running.", hint)
    return None


# R4: alarms come once, in time, with the agreed words, and only then.


def _judge_alarms(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R4: an alarm when a sensor falls silent, and one when it is back."""
    seen, n = trials.runs[BROKEN], days.numbers
    wrong = _silent(seen, "/alarm")
    alarms = [(time, str(text).lower()) for time, text in _said(seen, "/alarm")]
    marks, wait = days.broken.marks, n["silent_seconds"]
    for sensor, silences in (("temperature", ("temperature", "both")), ("humidity", ("both",))):
        for word, delay in (("silent", wait - 1), ("back", 0)):
            dues = [marks[f"{silence} {word}"] + delay for silence in silences]
            wrong = wrong or _wrong_alarm(alarms, (sensor, word), dues, n)
    false = _said(trials.plain, "/alarm")
    if wrong or not false:
        return wrong
    time, text = false[0]
    evidence = f"All sensors spoke every second, and at {_stamp(time)} came an alarm: {text!r}."
    return Diagnosis("alert-too-many", evidence, "On a day like this no alarm is due.")


def _wrong_alarm(
    alarms: Sequence[tuple[float, str]],
    words: tuple[str, str],
    dues: Sequence[float],
    n: Mapping[str, float],
) -> Diagnosis | None:
    """Name what is wrong with the alarms of some words, which are due at some times only."""
    wanted, react, last = " ".join(words), n["react_seconds"], -1.0
    times = [time for time, text in alarms if all(word in text for word in words)]
    for due, following in zip(dues, [*dues[1:], inf], strict=True):
        here = [time for time in times if last < time < following - _EPS]
        if not here or here[0] > due + react + _EPS:
            return _no_alarm(alarms, words, due, due + react)
        if here[0] < due - _EPS:
            return _early_alarm(words, here[0], due, due - n["silent_seconds"])
        # One that comes before the next is due, and still too early, is a repetition of this one.
        if len(here) > 1:
            first, second = here[:2]
            evidence = f"'{wanted}' came at {_stamp(first)}, and again at {_stamp(second)}."
            hint = "One alarm is enough: the node has to remember that it has sent it."
            return Diagnosis("alert-too-many", evidence, hint)
        last = due + react + _EPS
    return None


def _early_alarm(words: tuple[str, str], time: float, due: float, heard: float) -> Diagnosis:
    evidence = f"'{' '.join(words)}' came at {_stamp(time)}; it was due at {_stamp(due)}"
    if words[1] == "back":
        hint = "Only a silent sensor can be back: the node has to remember that it was silent."
        return Diagnosis("alert-too-many", f"{evidence}, after a silence.", hint)
    if time >= heard - _EPS:
        evidence += f", because the last message had come at {_stamp(heard)}"
    hint = "How long has it been since the last message? Every message begins that time anew."
    return Diagnosis("alarm-too-early", f"{evidence}.", hint)


def _no_alarm(
    alarms: Sequence[tuple[float, str]], words: tuple[str, str], due: float, late: float
) -> Diagnosis:
    wanted = " ".join(words)
    (other,) = {"temperature", "humidity"} - {words[0]}
    here = [
        text for time, text in alarms if due - _EPS <= time <= late + _EPS and other not in text
    ]
    if here:
        evidence = f"From {_stamp(due)} to {_stamp(late)} the alarm said {here[0]!r}."
        hint = f"The agreed words are '{wanted}'; more words do not matter."
        return Diagnosis("wrong-word", evidence, hint)
    evidence = f"'{wanted}' was due from {_stamp(due)} to {_stamp(late)}, and did not come."
    hint = "No message comes to say that there is no message. What else can wake the node?"
    both = any(due - _EPS <= time <= late + _EPS and other in text for time, text in alarms)
    if words[1] == "back":
        hint = "The first message after a silence says that the sensor is back."
    elif both:
        hint = "Both sensors are silent. Does the node watch each of them, with a memory for each?"
    return Diagnosis("alert-missing", evidence, hint)


# R5: an impossible reading changes nothing.

_CHECKED = "Which node checks that a reading is possible, before any other uses it?"


def _judge_belief(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R5: nonsense moves no actuator and no mean."""
    seen, n = trials.runs[BROKEN], days.numbers
    marks, react = days.broken.marks, n["react_seconds"]
    return (
        _silent(seen, "/vent", "/pump", "/report")
        or _vent_believes(_spans(seen, "/vent"), marks["hot"], marks["cool"], react)
        or _pump_believes(_spans(seen, "/pump"), marks["dry"], react)
        # A report that is wrong on a plain day, too, is another matter.
        or (None if _judge_reports(trials, days) else _report_believes(seen, days))
    )


def _vent_believes(spans: _Spans, hot: float, cool: float, react: float) -> Diagnosis | None:
    if not _begins_in_time(spans, hot, react):
        evidence = f"It was hot from {_stamp(hot)} on, and the vent did not open then."
        return Diagnosis("never-switched-on", evidence, "Let the vent work first.")
    closed, hint = spans[0][1], _CHECKED
    if closed < cool - _EPS:
        evidence = f"The vent was closed at {_stamp(closed)}, by an impossible reading."
    elif closed > cool + react + _EPS:
        evidence = f"It was cool from {_stamp(cool)} on, and the vent stayed open."
        hint = "What remains of a NaN or of infinity in what the node calculates?"
    elif len(spans) > 1:
        evidence = f"The vent was opened at {_stamp(spans[1][0])}, by an impossible reading."
    else:
        return None
    return Diagnosis("nonsense-believed", evidence, hint)


def _pump_believes(spans: _Spans, dry: float, react: float) -> Diagnosis | None:
    if _begins_in_time(spans, dry, react):
        return None
    if spans and spans[0][0] < dry:
        evidence = f"The pump was started at {_stamp(spans[0][0])}, by an impossible reading."
        return Diagnosis("nonsense-believed", evidence, _CHECKED)
    evidence = f"After some impossible humidities it was dry at {_stamp(dry)}, and no pump ran."
    return Diagnosis("never-switched-on", evidence, "The next possible reading counts again.")


def _report_believes(seen: Observation, days: Weather) -> Diagnosis | None:
    every, day = days.numbers["report_seconds"], days.broken.temperature
    least, most = days.air.cold - 2, days.air.hot + 1
    possible = [one if one is not None and least <= one <= most else None for one in day]
    for time, value in _said(seen, "/report"):
        # A mean of no readings is left open, and so it is if only some right windows are empty.
        windows = (_between(day, time - a, time - b) for a, b in _windows(every))
        if not all(windows) or least <= value <= most:
            continue
        said = f"The report at {_stamp(time)} said {value:g}"
        # A sum of the right readings, divided by something else, has believed nothing.
        sums = [sum(_between(possible, time - a, time - b)) for a, b in _windows(every)]
        if any(is_near(value * every, one) for one in sums):
            evidence = f"{said}: fewer readings than usual were possible in the last {every:g} s."
            hint = "By what does the mean divide: by the readings in it, or by a fixed number?"
            return Diagnosis("wrong-window", evidence, hint)
        evidence = f"{said}; an impossible reading is in it."
        return Diagnosis("nonsense-believed", evidence, _CHECKED)
    return None


# R6: the report is the mean of the right readings, at the right times.


@dataclass(frozen=True)
class Reports:
    """Hold what reports are made of.

    Attributes:
        day: The readings.
        times: When the reports came.
    """

    day: Day
    times: tuple[float, ...]


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else 0.0


def _between(values: Iterable[float | None], after: float, until: float) -> list[float]:
    """Return the readings after one time and up to another; one came each second."""
    return [one for at, one in enumerate(values, 1) if one is not None and after < at <= until]


def _windows(every: float) -> tuple[tuple[float, float], ...]:
    """Return how long ago a right window may begin and end: it has a second to spare."""
    return ((every, 0), (every + 1, 0), (every + 1, 1), (every, 1))


def _report(fed: Reports, value: Callable[[Day, float], float], shift: float) -> Track:
    """Return the reports of a node, made with the reading of the same second or before it."""
    return {at: (value(fed.day, at - shift),) for at in fed.times}


def _reporters(*rows: tuple[str, Callable[[Day, float], float]]) -> tuple[Suspect, ...]:
    """Return nodes that report another value, from rows of a hint and that value."""
    return variants(
        _report,
        [
            ("wrong-window", hint, *({"value": value, "shift": shift} for shift in (0, 0.5)))
            for hint, value in rows
        ],
    )


REPORTERS = _reporters(
    ("That is the mean of all readings since the start. What forgets the older ones?",
        lambda day, time: _mean(_between(day.temperature, 0, time))),
    ("That is the last reading alone. What collects the ones before it?",
        lambda day, time: _between(day.temperature, 0, time)[-1]),
    ("That is the mean of the humidities. On which topic does the node collect?",
        lambda day, time: _mean(_between(day.humidity, time - 10, time))),
    ("That is the sum. By what does a mean divide it?",
        lambda day, time: sum(_between(day.temperature, time - 10, time))),
)  # fmt: skip


def _judge_reports(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R6: a mean, so often, of so many seconds."""
    return (
        _silent(trials.plain, "/report")
        or _wrong_reports(trials, days)
        or _reports_of_old_readings(trials, days)
    )


def _wrong_reports(trials: Trials, days: Weather) -> Diagnosis | None:
    seen, every = trials.plain, days.numbers["report_seconds"]
    reports = [(time, float(value)) for time, value in _said(seen, "/report")]
    day, times = days.plain, [time for time, _ in reports]
    for before, time in pairwise([0.0, *times, max(seen.time, times[-1])]):
        gap, last = time - before, time >= seen.time
        if gap > every + 1 + _EPS or (gap < every - 1 - _EPS and not last):
            evidence = f"After {_stamp(before)} no report came until {_stamp(time)}."
            hint = f"One report every {every:g} s, and the first after {every:g} s."
            return Diagnosis("wrong-rate", evidence, hint)
    for time, value in reports:
        means = [_mean(_between(day.temperature, time - a, time - b)) for a, b in _windows(every)]
        if min(means) - _NEAR <= value <= max(means) + _NEAR:
            continue
        evidence = (
            f"The report at {_stamp(time)} said {value:.2f}; the mean of the last {every:g} s "
            f"was {means[0]:.2f}."
        )
        hint = "Which readings are in it? Those of the last report are not."
        fed, done = Reports(day, tuple(times)), {time: (value,) for time, value in reports}
        otherwise = Diagnosis("wrong-window", evidence, hint)
        return name_mistake(matching(fed, done, REPORTERS, is_near), otherwise)
    return None


def _reports_of_old_readings(trials: Trials, days: Weather) -> Diagnosis | None:
    """Name the first report after a silence that has readings from before the silence in it."""
    seen, every = trials.runs.get(BROKEN), days.numbers["report_seconds"]
    for time, value in _said(seen, "/report") if seen else ():
        begins = max((at for at in _returns(days.broken) if at <= time), default=-inf)
        heard = [_between(days.broken.temperature, time - a, time - b) for a, b in _windows(every)]
        # Only while fewer readings came than in as many seconds of a sensor that works.
        if time - begins >= every - 2 or not all(heard):
            continue
        means = list(map(_mean, heard))
        if not min(means) - _NEAR <= value <= max(means) + _NEAR:
            return Diagnosis(
                "wrong-window",
                f"The temperature was silent until {_stamp(begins)}. The report at {_stamp(time)} "
                f"said {float(value):.2f}; the mean of the last {every:g} s was {means[0]:.2f}.",
                f"How many readings come in {every:g} s depends on the sensor. What tells the node "
                "how old a reading is?",
            )
    return None


def _returns(day: Day) -> list[int]:
    """Return when the temperature came back after a silence, in seconds."""
    pairs = enumerate(pairwise(day.temperature), 2)
    return [at for at, (before, now) in pairs if before is None and now is not None]


#: How far a mean may be away, because a float32 is rounded.
_NEAR = 0.02


def is_near(one: float, other: float) -> bool:
    """Return whether two reports are the same."""
    return abs(one - other) <= _NEAR


# R7 and R10: commands are given when they change, and late-joining subscriptions get the last one.


def _judge_commands(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R7: no command twice in a row."""
    for topic in ("/vent", "/pump"):
        wrong = _silent(trials.plain, topic) or _repeated(trials.plain, topic)
        if wrong:
            return wrong
    return None


def _repeated(seen: Observation, topic: str) -> Diagnosis | None:
    commands = _switch(seen, topic).commands
    for (first, was), (second, now) in pairwise(commands):
        if was == now:
            evidence = f"{topic} got {now} at {_stamp(first)}, and again at {_stamp(second)}."
            hint = "Remember the last command, and publish only a different one."
            return Diagnosis("status-repeated", evidence, hint)
    if any(is_on for _, is_on in commands):
        return None
    evidence = f"{topic} never got True, so nothing can be said of changes."
    return Diagnosis("never-switched-on", evidence, "Let the actuator work first.")


def _judge_late_joining(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R10: a late-joining subscription gets the last command at once."""
    seen = trials.plain
    found = (
        _silent(seen, topic) or _not_stored(seen, topic, name) for topic, name in _LATE_DISPLAYS
    )
    return next(filter(None, found), None)


def _not_stored(seen: Observation, topic: str, display: str) -> Diagnosis | None:
    """Say that a display that joined late did not get the last command on a topic."""
    wanted = str(_switch(seen, topic).at(seen.time))
    if [line.text for line in seen.logs if line.name == display][-1:] == [wanted]:
        return None
    (end, *_) = seen.graph.on(topic, "publisher")
    evidence = (
        f"A display that joined at the end did not hear that {topic} is {wanted}. "
        f"{end.node} offers {end.qos.durability}, with a depth of {end.qos.depth}."
    )
    hint = "Which durability keeps the last message for late-joining subscriptions?"
    return Diagnosis("first-messages-lost", evidence, hint)


# R8, R9 and R11: the work is shared out.


def _judge_tasks(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R8: one node for each output, and topics between them."""
    graph = trials.runs[BROKEN].graph
    outputs = {topic: _publishers(graph, topic) for topic in OUTPUTS}
    unpublished = next((topic for topic, nodes in outputs.items() if not nodes), "")
    if unpublished:
        return _no_publisher(trials.runs[BROKEN], unpublished)
    name, count = max(Counter(graph.nodes).items(), key=lambda pair: pair[1])
    if count > 1:
        hint = "Each node needs a name of its own; a class can be started under another name."
        return Diagnosis("run-twice", f"{count} nodes are called {name}.", hint)
    for topic in OUTPUTS:
        ends = sorted(end.node for end in graph.on(topic, "publisher"))
        if len(ends) > 1:
            hint = "Which one is right if the two disagree? One node decides; the others ask it."
            if topic in ("/alarm", "/report"):
                hint = "One node speaks there; the others tell it, on a topic of their own."
            return Diagnosis("two-controllers", f"{' and '.join(ends)} publish on {topic}.", hint)
    for node in graph.nodes:
        topics = [topic for topic, nodes in outputs.items() if node in nodes]
        if len(topics) > 1:
            evidence = f"{node} publishes on {' and on '.join(topics)}."
            hint = "Two tasks, two nodes: then one of them can end, or be replaced, alone."
            return Diagnosis("two-tasks", evidence, hint)
    return _shared_variable(trials, days, graph)


def _shared_variable(trials: Trials, days: Weather, graph: GraphSnapshot) -> Diagnosis | None:
    """Name an output that rightly depends on an input, while no topic leads there."""
    needs = (
        ("/vent", INPUTS[:1], _judge_vent),
        ("/pump", INPUTS, _judge_interlock),
        ("/alarm", INPUTS, _judge_alarms),
        ("/report", INPUTS[:1], _judge_reports),
    )
    for topic, sources, judge in needs:
        for source in sources:
            if topic not in reached(graph, source) and judge(trials, days) is None:
                evidence = f"{topic} depends on {source}, and no topic or service leads there."
                hint = "Do two nodes share a Python variable? In two processes, each has its own."
                return Diagnosis("shared-variable", evidence, hint)
    return None


def reached(graph: GraphSnapshot, source: str) -> set[str]:
    """Return the topics and services that a topic may lead to, through any nodes.

    Args:
        graph: The graph.
        source: Full name of the topic.
    """
    hears = {(end.node, end.name) for end in graph.endpoints if end.kind != "publisher"}
    says = {(end.node, end.name) for end in graph.endpoints if end.kind != "subscription"}
    known, new = {source}, {source}
    while new:
        nodes = {node for node, name in hears if name in new}
        new = {name for node, name in says if node in nodes} - known
        known |= new
    return known


def _judge_endings(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R9: the vent goes on whichever other node ends."""
    marks, react = days.lossy.marks, days.numbers["react_seconds"]
    vent = _switch(trials.runs[LOSSY], "/vent")
    for name, after in (("report", "without alarm"), ("alarm", "without pump"), ("pump", "end")):
        nodes = _publishers(trials.plain.graph, f"/{name}")
        if not nodes:
            return _silent(trials.plain, f"/{name}")
        hot, cool = marks[f"hot without {name}"], marks[after]
        for when, weather, wanted in ((hot, "hot", True), (cool, "cool", False)):
            if vent.at(when + react) != wanted:
                evidence = (
                    f"After {' and '.join(nodes)} had ended, it was {weather} from {_stamp(when)} "
                    f"on, and the vent did not {'open' if wanted else 'close'}."
                )
                hint = "What does the node of the vent need from the one that ended?"
                return Diagnosis("falls-together", evidence, hint)
    return None


def _judge_parameters(trials: Trials, days: Weather) -> Diagnosis | None:
    """Judge R11: the limits can be set when the nodes are started."""
    return _silent(trials.plain, "/vent", "/pump") or _kept_limits(trials, days)


def _kept_limits(trials: Trials, days: Weather) -> Diagnosis | None:
    seen, react = trials.runs[OTHER], days.numbers["react_seconds"]
    marks = days.other.marks
    refused = next((one for one in seen.faults if "arameter" in one.kind), None)
    if refused:
        evidence = f"With other limits, a node was not made: {refused.kind}: {refused.text}"
        return Diagnosis(
            "limit-fixed", evidence, "All three are floats: 28.0 is a float, but 28 isn't."
        )
    vent = _wrong_limits_of_vent(
        seen, days, "The vent was started with other values of open_above and close_below."
    )
    if vent or _begins_in_time(_spans(seen, "/pump"), marks["damp"], react):
        return vent
    evidence = "The pump was started with another value of dry_below, and went on with the old one."
    return Diagnosis("limit-fixed", evidence, _ASK_FOR_IT)


_ASK_FOR_IT = (
    "A node declares a parameter with a default, and asks for its value where it needs it."
)


def _wrong_limits_of_vent(seen: Observation, days: Weather, lead: str) -> Diagnosis | None:
    """Name a vent that does not use its other limits; `lead` says how it was told of them."""
    vent, marks, react = _spans(seen, "/vent"), days.other.marks, days.numbers["react_seconds"]
    if len(vent) != 1 or not _begins_in_time(vent, marks["warm"], react):
        return Diagnosis("limit-fixed", f"{lead} The vent went on with the old ones.", _ASK_FOR_IT)
    if not marks["cool"] <= vent[0][1] <= marks["cool"] + react + _EPS:
        evidence = "With another value of close_below the vent did not close as it should."
        return Diagnosis("limit-fixed", evidence, _ASK_FOR_IT)
    return None


# From the requirements to an outcome.

#: The judge of each requirement.
JUDGES: dict[str, Callable[[Trials, Weather], Diagnosis | None]] = {
    "R1": _judge_vent,
    "R2": _judge_pump,
    "R3": _judge_interlock,
    "R4": _judge_alarms,
    "R5": _judge_belief,
    "R6": _judge_reports,
    "R7": _judge_commands,
    "R8": _judge_tasks,
    "R9": _judge_endings,
    "R10": _judge_late_joining,
    "R11": _judge_parameters,
}


def _judge_greenhouse(trials: Trials, seed: int) -> Verdict:
    """Judge a greenhouse; the outcome has a part for each requirement if there is a greenhouse."""
    rubric = matching_rubric(trials.numbers)
    requirements, days = rubric.requirements, Weather(rubric.numbers, seed)
    early = _before_judging(trials.plain)
    if early:
        return early
    found = {one.id: JUDGES[one.id](trials, days) for one in requirements}
    parts = tuple(
        Part(
            one.id, one.text, wrong is None, wrong.evidence if wrong else "", one.points,
            not one.required,
        )
        for one, wrong in zip(requirements, found.values(), strict=True)
    )  # fmt: skip
    evidence = f"{sum(part.met for part in parts)} of {len(parts)} requirements are met."
    missed = [part.id for part in parts if not (part.met or part.optional)]
    # An exception of a node comes first, except with other limits: R11 tells of those.
    faults = [one for name, seen in trials.runs.items() if name != OTHER for one in seen.faults]
    first = _raised(faults[0]) if faults else found[missed[0]] if missed else None
    if first is None:
        left = [part.id for part in parts if not part.met]
        verb = "is" if len(left) == 1 else "are"
        evidence += f" {listing(left)} {verb} optional, and missing." if left else ""
        return Outcome("13b", PASSED, evidence, parts=parts)
    evidence += f" {first.evidence}" if faults else f" Look at {missed[0]} first."
    return Outcome("13b", FAILED, evidence, first.hint, first.mistake, parts=parts)


def _before_judging(seen: Observation) -> Verdict | None:
    """Return the outcome if there is a blank, no list, or a list that is never made."""
    if any("'____'" in fault.text for fault in seen.faults):
        return not_attempted()
    if not _is_hopeless(seen):
        return None
    fault = next((one for one in seen.faults if one.kind == "DeadlinePassed"), seen.faults[0])
    if fault.kind not in ("NoSystemError", "SessionError"):
        return _raised(fault)
    hint = (
        'The check wants the function: check("13b", greenhouse). It returns a list of classes, or '
        "of pairs of a class and a dict that says how to start it."
    )
    return Diagnosis("no-system", fault.text, hint)


def _raised(fault: Fault) -> Diagnosis:
    node = f"{fault.node}: " if fault.node else ""
    known = diagnose_fault(fault)
    if known:
        return Diagnosis(known.mistake, node + known.evidence, known.hint)
    if fault.callback in ("add", "run"):
        return Diagnosis("no-node", fault.text, "Use classes, or functions that create a node.")
    text = f"{node}{fault.callback} raised {fault.kind}: {first_sentence(fault.text)}."
    return Diagnosis(UNKNOWN, f"{text}{line_of(fault)}", NEW_TO_ME)


def _given() -> dict[str, Any]:
    """Return what both scenarios are handed besides an answer."""
    return {"numbers": read_rubric().numbers}


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("13a", observe_vent, _judge_vent_alone, "the vent alone", 3, (
        "You wrote a node like this on page 04: the calm monitor. What does it remember?",
        "The new state depends on the temperature and on the old state. Test for above and "
        "below; in between, nothing happens.",
        "Store the last published command in a variable of the node, and publish only a "
        "different one.",
    ), draw=draw_weather, given=_given),
    Exercise("13b", observe_greenhouse, _judge_greenhouse, "the whole greenhouse", TOTAL, (
        "Do one requirement at a time, and run the check in between: it gives points for each "
        "one that is met.",
        "For the pump, draw its states: ready, running, resting. Which event leads from one to "
        "the next, and when must it not?",
        "A silence doesn't trigger a callback. Let a timer check regularly how long ago the "
        "last message was: self.get_clock().now() is the time.",
        "Where you check a reading is up to you: in each node, or in one node that passes "
        "plausible readings on, on topics of its own. The second way is shorter.",
    ), draw=draw_weather, given=_given),
)  # fmt: skip

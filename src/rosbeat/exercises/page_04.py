"""Page 04, write a subscriber: watch a fridge, raise the alarm, a calm monitor with hysteresis."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain, combinations, pairwise
from math import inf
from typing import Any

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard
from rosbeat.exercises.exercise import Exercise, failed_by, passed
from rosbeat.exercises.model import (
    Suspect,
    Track,
    agree,
    fitting,
    missing,
    named,
    on,
    parting,
    spelling,
)
from rosbeat.exercises.scenarios import feeder, observe
from rosbeat.records import Observation, Outcome

_TEMPERATURE = Wire("/temperature", "std_msgs/msg/Float32")
#: The readings that an answer is fed, one a second, the first at 1 s.
Readings = Sequence[float]
Model = Callable[[Readings], Track]


def _fed(readings: Readings) -> Callable[[Any], Observation]:
    def run(answer: Any) -> Observation:  # noqa: ANN401 - whatever a learner hands over
        sensor = feeder("sensor", _TEMPERATURE.topic, _TEMPERATURE.type_name, readings)
        return observe(answer, len(readings) + 1, others=[sensor])

    return run


def _unheard(observation: Observation, readings: Readings) -> Diagnosis | None:
    """Say why the node received no reading, or None if it received some."""
    if any(call.source == _TEMPERATURE.topic for call in observation.callbacks):
        return None
    return why_not_heard(observation, _TEMPERATURE) or Diagnosis(
        "new-to-me",
        f"{len(readings)} readings were published on /temperature and the node got none.",
        'Does it call create_subscription, with the topic "temperature"?',
    )


def _track(observation: Observation, wire: Wire) -> Track:
    """Return what was published on a topic, by the second."""
    found: dict[float, tuple[Any, ...]] = {}
    for sample in on(observation, wire):
        found[sample.time] = (*found.get(sample.time, ()), sample.value)
    return found


def _each(rule: Callable[[float], Any]) -> Model:
    """Return the model of a node that does `rule(reading)` with each reading."""
    return lambda readings: {second: (rule(one),) for second, one in enumerate(readings, 1)}


# 04a: watch a fridge. A float32 holds each of the numbers below exactly.

#: Readings beyond each limit, at it, and as near to it as is told apart.
FRIDGE = (
    *(5.0, 9.5, 12.5, 100.0, 7.75, 8.0, 8.015625, 7.984375, 2.25, 2.0, 1.984375, 2.015625),
    -18.0,
)
#: A state in a log line, of whatever capitals; with its brackets if it is an item of a list.
_STATE = re.compile(r"(?i)[\[({]['\"](?:warm|frost|fine)['\"],?[\])}]|\b(?:warm|frost|fine)\b")


def _state(value: float, high: float = 8.0, low: float = 2.0) -> str:
    return "Warm" if value > high else "Frost" if value < low else "Fine"


_OTHER_STATES = {"Warm": "Frost", "Frost": "Warm", "Fine": "Fine"}
FRIDGE_SUSPECTS = (
    *(Suspect("boundary", "Exactly 8 and exactly 2 are Fine: above 8 is Warm, below 2 is Frost.",
              _each(partial(_state, **limits)))
      for limits in ({"high": 7.99}, {"low": 2.01}, {"high": 7.99, "low": 2.01})),
    Suspect("wrong-state", "These are the monitor's limits. A fridge has limits of its own.",
            _each(partial(_state, high=26.0, low=20.0))),
    Suspect("wrong-state", "Warm and Frost have changed places.",
            _each(lambda value: _OTHER_STATES[_state(value)])),
    Suspect("wrong-state", "Whole degrees are too coarse: compare the reading as it comes.",
            _each(lambda value: _state(int(value)))),
    Suspect("wrong-state", "It is the state of the reading before. Which comes first, to keep a "
            "reading or to judge it?", lambda fed: _each(_state)([fed[0], *fed[:-1]])),
)  # fmt: skip


#: The state in the form that the page asks for, and a remark behind it.
_FORM = re.compile(rf"(?i)\bstatus\s*:\s*({_STATE.pattern.removeprefix('(?i)')})")
_REMARK = re.compile(r"\([^()]*\)")


def _states(lines: Sequence[str]) -> list[str]:
    """Return the states that log lines name; lines without the form count if none has it."""
    with_form = [line for line in lines if _FORM.search(line)]
    return [state for line in with_form or lines for state in _STATE.findall(_bare(line))]


def _bare(line: str) -> str:
    """Return a line without a remark in parentheses, unless the remark names all states."""
    found = _FORM.search(line)
    if not found:
        return line
    remark = _REMARK.search(line, found.end())
    if not remark or len(set(_STATE.findall(remark[0]))) == len(_OTHER_STATES):
        return line
    return line[: remark.start()] + line[remark.end() :]


def _logged(observation: Observation) -> Track:
    """Return the states in the log lines of each second, or the whole text if it has none."""
    found = {}
    for second in range(1, len(FRIDGE) + 1):
        lines = [log.text for log in observation.logs if log.time == second]
        text = "\n".join(lines)
        if text:
            found[second] = tuple(dict.fromkeys(_states(lines))) or (text,)
    return found


def _judge_states(observation: Observation) -> Outcome:
    unheard = _unheard(observation, FRIDGE)
    if unheard:
        return failed_by("04a", unheard)
    done, right = _logged(observation), _each(_state)(FRIDGE)
    part = parting(done, right)
    if part is None:
        return passed("04a", f"All {len(FRIDGE)} readings got the right state, 8.0 and 2.0 too.")
    value, (wanted,) = FRIDGE[part.at - 1], part.right
    if not part.done:
        evidence = f"A reading of {value:g} arrived and nothing was logged."
        hint = "End the callback with self.get_logger().info(...)."
        return failed_by("04a", Diagnosis("nothing-logged", evidence, hint))
    evidence = f"For a reading of {value:g} the node said {' and '.join(part.done)}."
    strange = next((one for one in part.done if one not in _OTHER_STATES), None)
    if strange is not None:
        return failed_by("04a", Diagnosis("wrong-word", evidence, _about_word(strange)))
    hint = f"It should be {wanted}. Which of your conditions is true for {value:g}?"
    other = Diagnosis("wrong-state", evidence, hint)
    return failed_by("04a", named(evidence, fitting(FRIDGE, done, FRIDGE_SUSPECTS), other))


def _about_word(strange: str) -> str:
    """Return a hint that fits what stands in the place of a state."""
    if re.search(r"\bNone\b", strange):
        return "None came instead of a word. A function that ends without return gives None."
    hint = "The three words are Warm, Frost and Fine, letter by letter: capitals count."
    return f"{hint} A list with a word in it is not the word." if strange[0] in "[({" else hint


# 04b: raise the alarm.

#: Readings just inside of a limit, at it, and just outside.
ROOM = (22.0, 27.5, 25.5, 26.0, 26.015625, 100.0, 28.25, 20.5, 20.0, 19.984375, 19.75, -5.0)
_ALERT = Wire("/alert", "std_msgs/msg/String")


def _alerts(high: float = 26.0, low: float = 20.0, first: bool = False, times: int = 1) -> Model:
    """Return the model of a node that publishes an alert for each reading beyond a limit.

    Args:
        high: An alert is due above it.
        low: An alert is due below it.
        first: Whether only the first of several in a row counts.
        times: How many alerts a reading gets.
    """

    def model(readings: Readings) -> Track:
        bad = [value > high or value < low for value in readings]
        due = [now and not (first and before) for before, now in pairwise([False, *bad])]
        return {second: ("alert",) * times for second, one in enumerate(due, 1) if one}

    return model


_LIMITS_ARE_FINE = "Publish only if the reading is above 26 or below 20; the limits are still fine."
_BOTH_COUNT = "Both above 26 and below 20 count."
ROOM_SUSPECTS = (
    *(Suspect("boundary", _LIMITS_ARE_FINE, _alerts(*limits))
      for limits in ((25.99, 20.0), (26.0, 20.01), (25.99, 20.01), (25.99, -inf), (inf, 20.01))),
    Suspect("alert-missing", f"Low readings got no alert. {_BOTH_COUNT}", _alerts(low=-inf)),
    Suspect("alert-missing", f"High readings got no alert. {_BOTH_COUNT}", _alerts(high=inf)),
    Suspect("alert-missing", "Only the first bad reading got an alert. Each one should, whatever "
            "came before it.", lambda fed: dict([*_alerts()(fed).items()][:1])),
    Suspect("alert-missing", "Only the first of several bad readings in a row got an alert. Each "
            "one should, whatever came before it.", _alerts(first=True)),
    Suspect("alert-too-many", "Every reading got an alert. Is your condition true for 22, too? "
            "Compare its limits; and each side of `or` needs a comparison of its own.",
            _alerts(-inf)),
    Suspect("alert-too-many", "One alert for each reading is enough.", _alerts(times=2)),
)  # fmt: skip


def _judge_alarm(observation: Observation) -> Outcome:
    wrong = _unheard(observation, ROOM) or _silent(observation) or _wrong_alerts(observation)
    if wrong:
        return failed_by("04b", wrong)
    alerts = len(on(observation, _ALERT))
    return passed("04b", f"{len(ROOM)} readings, {alerts} alerts: none too many.")


def _silent(observation: Observation) -> Diagnosis | None:
    bad = "Readings were too high and too low, and"
    made = any(end.name == _ALERT.topic for end in observation.graph.endpoints)
    if made and not on(observation, _ALERT):
        return Diagnosis(
            "never-published",
            f"{bad} no alert was published.",
            "Is your condition ever true? No reading is above 26 and below 20 at once. And is "
            "there a publish behind it?",
        )
    hint = "Make a publisher in __init__ and call its publish in the callback."
    nothing = Diagnosis("no-publisher", f"{bad} nothing was published on /alert.", hint)
    return missing(observation, _ALERT, otherwise=nothing)


def _wrong_alerts(observation: Observation) -> Diagnosis | None:
    """Say what is wrong with the alerts; what they say is free."""
    texts = _track(observation, _ALERT)
    done: Track = {at: ("alert",) * len(found) for at, found in texts.items()}
    part = parting(done, _alerts()(ROOM))
    if part is None:
        return None
    if part.at not in range(1, len(ROOM) + 1):
        return Diagnosis(
            "alert-too-many",
            f"An alert was published at {part.at:g} s, and no reading came then.",
            "Publish in the callback of the subscription: it runs when a reading comes.",
        )
    value = ROOM[round(part.at) - 1]
    fit = fitting(ROOM, done, ROOM_SUSPECTS)
    if fit and fit[0].mistake == "alert-too-many" and _says_fine(texts):
        fit = []
    if len(part.done) > 1 and part.right:
        total, due = sum(map(len, done.values())), len(_alerts()(ROOM))
        evidence, other = f"{total} alerts for {due} readings.", "One alert for each is enough."
    elif part.done:
        evidence, other = f"An alert was published for a reading of {value:g}.", _LIMITS_ARE_FINE
        if _says_fine(texts):
            evidence = f"{texts[part.at][0]!r} was published on /alert for a reading of {value:g}."
            other = "Whatever comes on /alert is an alert. For a reading that is fine, publish "
            other += "nothing."
    else:
        evidence, other = f"No alert for a reading of {value:g}.", _BOTH_COUNT
    mistake = "alert-too-many" if part.done else "alert-missing"
    return named(evidence, fit, Diagnosis(mistake, evidence, other))


def _says_fine(texts: Track) -> bool:
    """Return whether readings that are fine got a text of their own, whatever numbers are in it."""
    due = _alerts()(ROOM)
    good, bad = (
        {
            re.sub(r"[-\d.]+", "", one)
            for at, found in texts.items()
            if (at in due) is is_due
            for one in found
        }
        for is_due in (False, True)
    )
    return bool(good and bad) and not good & bad


# 04c: a calm monitor: the mean of the last five readings, and a status with hysteresis.

#: Every border of a status with hysteresis, from both sides, and jumps across.
CALM = (
    *(22.0, 25.5, 20.5, 26.0, 26.015625, 25.5, 26.25, 25.0, 24.984375, 25.5, 20.0, 19.984375),
    *(20.5, 21.0, 21.015625, 20.5, 41.0, -3.5, 30.0, 23.0, 19.0, 25.5, 27.0, 20.5),
)
_STATUSES = ("High", "Low", "Normal")
_MEAN, _STATUS = Wire("/mean", "std_msgs/msg/Float32"), Wire("/status", "std_msgs/msg/String")


#: How many readings count.
_WIDTH = 5


def _means(width: int = _WIDTH, begin: Readings = (), divisor: int = 0, late: int = 0) -> Model:
    """Return the model of a node that publishes a running mean.

    Args:
        width: How many readings count, at most.
        begin: What is in the window at first.
        divisor: What the sum is always divided by; 0 for the number of readings.
        late: How many of the newest readings are left out.
    """

    def model(readings: Readings) -> Track:
        found = {}
        for second in range(1, len(readings) + 1):
            last = [*begin, *readings[: second - late]][-width:]
            found[second] = (sum(last) / (divisor or len(last) or 1),)
        return found

    return model


MEAN_SUSPECTS = (
    Suspect("wrong-window", "It is the last reading alone. The last five count.", _means(1)),
    Suspect("wrong-window", "It is the mean of all readings so far. The last five count.",
            _means(len(CALM))),
    Suspect("wrong-window", "While there are fewer than five, divide by how many there are.",
            _means(divisor=5)),
    Suspect("wrong-window", "It is the sum. A mean is divided by how many there are.",
            _means(divisor=1)),
    Suspect("wrong-window", "The newest reading is not in it. Which comes first, to keep it or to "
            "calculate?", _means(late=1)),
    *(Suspect("wrong-window", f"It is the mean of the last {width} readings. The last five count.",
              _means(width)) for width in (2, 3, 4, 6, 7, 8, 10)),
    *(Suspect("wrong-window", f"The list begins with five times {value:g}, and these are no "
              "readings. Begin with an empty one.", _means(begin=(value,) * 5))
      for value in (0.0, 22.0)),
)  # fmt: skip


def _next_status(
    before: str,
    value: float,
    high: float = 26.0,
    low: float = 20.0,
    back_high: float = 25.0,
    back_low: float = 21.0,
) -> str:
    if value > high:
        return "High"
    if value < low:
        return "Low"
    stays = (before == "High" and value >= back_high) or (before == "Low" and value <= back_low)
    return before if stays else "Normal"


def _statuses(
    limits: Mapping[str, float] | None = None, keeps: bool = True, compares: bool = True
) -> Model:
    """Return the model of a node that publishes its status when it changes.

    Args:
        limits: Limits other than the page's, as `_next_status` has them.
        keeps: Whether a new status is kept for the next reading.
        compares: Whether only a change is published.
    """

    def model(readings: Readings) -> Track:
        status, found = "Normal", {}
        for second, value in enumerate(readings, 1):
            new = _next_status(status, value, **(limits or {}))
            if new != status or not compares:
                found[second] = (new,)
            status = new if keeps else "Normal"
        return found

    return model


_OF_THE_MEAN = "Find the status from the reading itself, and not from the mean."
_NOTHING_KEEPS = (
    "The limits may be right, but nothing keeps the status from one reading to the next. A local "
    "variable is gone when the callback returns: keep the new status in self."
)
_ONLY_CHANGES = "Compare the new status with the old one, and publish only a change."
#: A reading at a limit, and the limit of a node that counts it to the wrong side.
_AT_A_LIMIT = (
    *((26, {"high": 25.99}), (20, {"low": 20.01})),
    *((25, {"back_high": 25.01}), (21, {"back_low": 20.99})),
)


def _on_the_wrong_side() -> Iterator[Suspect]:
    """Generate a suspect for each limit, and for each set of them, single ones first."""
    for slips in chain.from_iterable(combinations(_AT_A_LIMIT, count) for count in (1, 2, 3, 4)):
        at = " and exactly ".join(str(reading) for reading, _ in slips)
        change = "changes" if len(slips) == 1 else "change"
        limits = {name: limit for _, one in slips for name, limit in one.items()}
        hint = f"Exactly {at} {change} nothing: above and below leave the limit out."
        yield Suspect("boundary", hint, _statuses(limits))


STATUS_SUSPECTS = (
    Suspect("status-repeated", _NOTHING_KEEPS, _statuses(keeps=False)),
    Suspect("no-hysteresis", _NOTHING_KEEPS, _statuses(keeps=False, compares=False)),
    *_on_the_wrong_side(),
    Suspect("hysteresis-lost", "From High, nothing leads back to Normal.",
            _statuses({"back_high": -inf})),
    Suspect("hysteresis-lost", "From Low, nothing leads back to Normal.",
            _statuses({"back_low": inf})),
    Suspect("hysteresis-lost", "The two limits of the way back have changed places: 25 belongs to "
            "High, and 21 to Low.", _statuses({"back_high": 21.0, "back_low": 25.0})),
    Suspect("wrong-state", _OF_THE_MEAN,
            lambda readings: _statuses()([mean for (mean,) in _means()(readings).values()])),
)  # fmt: skip


def _judge_calm(observation: Observation) -> Outcome:
    wrong = _unheard(observation, CALM) or _unpublished(observation, _MEAN)
    wrong = wrong or _wrong_means(_track(observation, _MEAN)) or _unpublished(observation, _STATUS)
    wrong = wrong or _wrong_statuses(_track(observation, _STATUS))
    if wrong:
        return failed_by("04c", wrong)
    changes = len(on(observation, _STATUS))
    return passed("04c", f"{len(CALM)} readings, as many means, {changes} changes.")


def _unpublished(observation: Observation, wire: Wire) -> Diagnosis | None:
    evidence = "Readings arrived, and nothing was published on {topic}."
    hint = "Does the callback come to the line that publishes?"
    hint += f" {_OF_THE_MEAN}" * (wire == _STATUS)
    silent = Diagnosis("never-published", evidence, hint)
    return missing(observation, wire, (_MEAN.topic, _STATUS.topic), silent)


def _wrong_means(done: Track) -> Diagnosis | None:
    part = parting(done, _means()(CALM))
    if part is None:
        return None
    if agree(done, {at: mean for at, mean in _means()(CALM).items() if at >= _WIDTH}):
        return Diagnosis(
            "wrong-window",
            f"The first mean was published after reading {_WIDTH}; those before it got none.",
            "While there are fewer than five readings, it is the mean of those that are there.",
        )
    if len(part.done) != len(part.right):
        count = sum(map(len, done.values()))
        return Diagnosis(
            "wrong-rate",
            f"{len(CALM)} readings arrived, and {count} means were published: at {part.at:g} s "
            f"there were {len(part.done)}, and {len(part.right)} was due.",
            "Publish one mean for each reading, also while there are fewer than five.",
        )
    last = [f"{value:g}" for value in CALM[: round(part.at)][-6:]]
    evidence = (
        f"After reading {part.at:g} the mean was {part.done[0]:.3f}; of the last five it is "
        f"{part.right[0]:.3f}. The last readings were {', '.join(last)}."
    )
    hint = "The sum of the last five, divided by how many they are. Print both to compare."
    other = Diagnosis("wrong-window", evidence, hint)
    return named(evidence, fitting(CALM, done, MEAN_SUSPECTS), other)


def _wrong_statuses(done: Track) -> Diagnosis | None:
    words = [word for found in done.values() for word in found]
    strange = next((word for word in words if word not in _STATUSES), None)
    if strange is not None:
        hint = spelling(strange, _STATUSES) or "The status is one word, High, Low or Normal."
        return Diagnosis("wrong-word", f"On /status appeared {strange!r}.", hint)
    right = _statuses()(CALM)
    part = parting(done, right)
    if part is None:
        return None
    before = [("Normal",), *(right[at] for at in sorted(right) if at < part.at)][-1][0]
    value = CALM[max(0, min(len(CALM), int(part.at)) - 1)]
    after = f"after a reading of {value:g}" if part.at >= 1 else "before the first reading"
    evidence = (
        f"The status was {before}. At {part.at:g} s, {after}, "
        f"{_quoted(part.done)} was published, and {_quoted(part.right)} was due."
    )
    other = _unmodelled(before, part.done, part.right, evidence)
    return named(evidence, fitting(CALM, done, STATUS_SUSPECTS), other)


def _quoted(words: Sequence[str]) -> str:
    return " and ".join(words) or "nothing"


def _unmodelled(before: str, done: Sequence[str], right: Sequence[str], evidence: str) -> Diagnosis:
    """Name a mistake by its first moment alone: limits may be any numbers, so no table has all."""
    if done[:1] == (before,) or len(set(done)) < len(done):
        return Diagnosis("status-repeated", evidence, f"{_ONLY_CHANGES} It begins as Normal.")
    if len(done) > 1:
        hint = "One reading, one status: find it first, and publish it then, if it is new."
        return Diagnosis("wrong-state", evidence, hint)
    if right == ("Normal",):
        hint = "It has come far enough back. From High that is below 25, from Low above 21."
        return Diagnosis("hysteresis-lost", evidence, hint)
    if done == ("Normal",) and not right:
        hint = "It has not come far enough back: from High that is below 25, from Low above 21."
        return Diagnosis("no-hysteresis", evidence, hint)
    hint = "Follow your conditions from top to bottom with this reading."
    return Diagnosis("wrong-state", evidence, hint)


EXERCISES = (
    Exercise(
        "04a",
        _fed(FRIDGE),
        _judge_states,
        "watch a fridge",
        1,
        (
            "The monitor of this page decides between three words, too. Compare the limits.",
            "if, elif and else are tried from top to bottom. > and < leave the limit itself out.",
        ),
    ),
    Exercise(
        "04b",
        _fed(ROOM),
        _judge_alarm,
        "raise the alarm",
        2,
        (
            "The publisher is made once, in __init__, like the sensor's; the message type and the "
            "topic are others.",
            "One reading is enough for an alert if it is too high or if it is too low: join the "
            "two conditions with `or`.",
            "A String is made like a Float32, with text in its field data.",
        ),
    ),
    Exercise(
        "04c",
        _fed(CALM),
        _judge_calm,
        "a calm monitor, alone",
        4,
        (
            "Do one thing after the other and check in between: first the mean, then the status.",
            "Keep the readings in a list. readings[-5:] are the last five of it, or all if there "
            "are fewer.",
            "The status needs a memory: self.status. Find the new one from the reading and from "
            "the old one, and publish it only if they differ.",
            "Ask for High and for Low first: they do not depend on what was before. Then ask "
            "whether a High or a Low has come back far enough.",
        ),
    ),
)

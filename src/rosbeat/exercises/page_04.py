"""Page 04, write a subscriber: watch a fridge, raise the alarm, a calm monitor in three steps."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain, combinations, pairwise
from math import inf

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    STATUSES,
    Mismatch,
    Model,
    Track,
    diagnose,
    diagnose_words,
    numbered,
    samples_on,
    status_of,
    suspects,
    tells_apart,
    track,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, feeder, observe
from rosbeat.records import Observation

_TEMPERATURE = Wire("/temperature", "std_msgs/msg/Float32")
#: The readings that an answer is fed, one a second, the first at 1 s.
Readings = Sequence[float]


def _feed(answer: Answer, readings: Sequence[float | None], period: float = 1.0) -> Observation:
    sensor = feeder("sensor", _TEMPERATURE, readings, period=period)
    return observe(answer, period * len(readings) + 1, others=[sensor])


def _each(rule: Callable[[float], str]) -> Model:
    """Return the model of a node that says `rule(reading)` of each reading."""
    return lambda readings: numbered(map(rule, readings))


# 04a: watch a fridge. A float32 holds each of the numbers below exactly.

#: A state in a log line, of whatever capitals; with its brackets if it is an item of a list.
_STATE = re.compile(r"(?i)[\[({]['\"](?:warm|frost|fine)['\"],?[\])}]|\b(?:warm|frost|fine)\b")
_STATE_OF = {"High": "Warm", "Low": "Frost", "Normal": "Fine"}


def _state(value: float, high: float = 8.0, low: float = 2.0) -> str:
    return _STATE_OF[status_of(value, low, high)]


FRIDGE_SUSPECTS = suspects(
    ("boundary", "Exactly 8 and exactly 2 are Fine: above 8 is Warm, below 2 is Frost.",
     _each(partial(_state, high=7.999)), _each(partial(_state, low=2.001)),
     _each(partial(_state, high=7.999, low=2.001))),
    ("wrong-state", "These are the monitor's limits. A fridge has limits of its own.",
     _each(partial(_state, high=26.0, low=20.0))),
    ("wrong-state", "Your second `if` starts a new decision: its `else` overwrites Warm. Did you "
     "mean `elif`?", _each(lambda value: "Frost" if value < 2.0 else "Fine")),
    ("wrong-state", "Warm and Frost are swapped.",
     _each(lambda value: {"Warm": "Frost", "Frost": "Warm"}.get(_state(value), "Fine"))),
    ("wrong-state", "Whole degrees aren't precise enough: compare the reading itself.",
     _each(lambda value: _state(int(value))), _each(lambda value: _state(round(value)))),
    ("wrong-state", "Your node compares the rounded number. Compare the reading itself, and round "
     "only what you display.", _each(lambda value: _state(round(value, 1))),
     _each(lambda value: _state(round(value, 2)))),
    ("wrong-state", "It's the state of the previous reading. Does your node store a reading before "
     "it judges it?", lambda fed: _each(_state)([fed[0], *fed[:-1]])),
)  # fmt: skip


def draw_fridge(draw: Draw) -> Readings:
    """Draw readings beyond each limit, at it and very near to it; one is 0, one comes twice."""
    borders = (7.75, 8.25, 1.75, 8.0, 8.00390625, 7.99609375, 2.25, 2.0, 1.99609375, 2.00390625)
    return draw.until(
        lambda: draw.shuffled(
            (
                *(draw.number(5.0, 2.5, 7.5), draw.number(9.5, 8.5, 11.0), 12.5, 12.5, 0.0),
                *(draw.number(100.0, 27.0, 120.0), *borders, draw.number(-18.0, -25.0, -1.0)),
            )
        ),
        lambda fed: tells_apart(fed, _each(_state), FRIDGE_SUSPECTS),
    )


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
    if not remark or len(set(_STATE.findall(remark[0]))) == len(_STATE_OF):
        return line
    return line[: remark.start()] + line[remark.end() :]


def _logged(observation: Observation, readings: Readings) -> Track:
    """Return the states in the log lines of each second, or the whole text if it has none."""
    found = {}
    for second in range(1, len(readings) + 1):
        lines = [log.text for log in observation.logs if log.time == second]
        text = "\n".join(lines)
        if text:
            found[second] = tuple(dict.fromkeys(_states(lines))) or (text,)
    return found


def _judge_states(observation: Observation, readings: Readings) -> Verdict:
    done, right = _logged(observation, readings), _each(_state)(readings)
    describe = partial(_describe_state, readings, observation.printed > 0)
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or diagnose(readings, done, right, FRIDGE_SUSPECTS, describe)
        or passed(f"All {len(readings)} readings got the right state, 8.0 and 2.0 too.")
    )


def _describe_state(readings: Readings, prints: bool, mismatch: Mismatch) -> Diagnosis:
    value, (wanted,) = readings[mismatch.at - 1], mismatch.right
    if not mismatch.done:
        evidence = f"A reading of {value:g} arrived and nothing was logged."
        hint = (
            "End the callback with self.get_logger().info(...). A `return` above that line would "
            "leave the callback before."
        )
        if prints:
            hint = (
                "`print` is for you; other nodes and tools see only the log. End the callback with "
                "self.get_logger().info(...)."
            )
        return Diagnosis("nothing-logged", evidence, hint)
    evidence = f"For a reading of {value:g} the node said {' and '.join(mismatch.done)}."
    strange = next((one for one in mismatch.done if one not in _STATE_OF.values()), None)
    if strange is not None:
        return Diagnosis("wrong-word", evidence, _about_word(strange))
    hint = f"It should be {wanted}. Which of your conditions is true for {value:g}?"
    return Diagnosis("wrong-state", evidence, hint)


def _about_word(strange: str) -> str:
    """Return a hint that fits what stands in the place of a state."""
    if re.search(r"\bNone\b", strange):
        return "None came instead of a word. A function that ends without return gives None."
    hint = "The three words are Warm, Frost and Fine, spelled exactly like this, with capitals."
    return f"{hint} A list with a word in it is not the word." if strange[0] in "[({" else hint


# 04b: raise the alarm.

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
_EACH_ONE = "Each one should, whatever came before it."
ROOM_SUSPECTS = suspects(
    ("boundary", _LIMITS_ARE_FINE, _alerts(25.999), _alerts(low=20.001), _alerts(25.999, 20.001),
     _alerts(25.999, -inf), _alerts(inf, 20.001)),
    ("alert-missing", "Your node compares the rounded number. Compare the reading as it comes.",
     *(lambda fed, digits=digits: _alerts()([round(one, digits) for one in fed])
       for digits in (0, 1, 2)), lambda fed: _alerts()([int(one) for one in fed])),
    ("alert-too-many", "The normal readings get the alerts. Is your condition the wrong way round?",
     lambda fed: {at: ("alert",) for at in range(1, len(fed) + 1) if at not in _alerts()(fed)}),
    ("alert-missing", f"Low readings got no alert. {_BOTH_COUNT}", _alerts(low=-inf)),
    ("alert-missing", f"High readings got no alert. {_BOTH_COUNT}", _alerts(high=inf)),
    ("alert-missing", f"Only the first bad reading got an alert. {_EACH_ONE}",
     lambda fed: dict([*_alerts()(fed).items()][:1])),
    ("alert-missing", f"Only the first of several bad readings in a row got an alert. {_EACH_ONE}",
     _alerts(first=True)),
    ("alert-too-many", "Every reading got an alert. Is your condition true for 22, too? Compare "
     "its limits; and each side of `or` needs a comparison of its own.", _alerts(-inf)),
    ("alert-too-many", "One alert for each reading is enough.", _alerts(times=2)),
)  # fmt: skip


def draw_room(draw: Draw) -> Readings:
    """Draw readings just inside of a limit, at it, and just outside.

    The first one is bad, one is 0, one comes twice, and one would be fine without its sign.
    """
    far = draw.number
    return draw.until(
        lambda: (
            far(27.5, 26.5, 29.0),
            *draw.shuffled(
                (
                    *(far(22.0, 21.0, 25.0), 25.5, 26.0, 0.0, far(-22.0, -25.0, -21.0)),
                    *(26.00390625, far(100.0, 40.0, 120.0), 28.25, 28.25, 20.5, 20.0),
                    *(19.99609375, far(19.75, 15.0, 19.75), far(-5.0, -20.0, 10.0)),
                )
            ),
        ),
        lambda fed: tells_apart(fed, _alerts(), ROOM_SUSPECTS),
    )


_NEVER_TRUE = (
    "Is your condition ever true? No reading is above 26 and below 20 at "
    "once. And does a publish follow it?"
)


def _judge_alarm(observation: Observation, readings: Readings) -> Verdict:
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or diagnose_unpublished(observation, _ALERT, hint=_NEVER_TRUE)
        or _wrong_alerts(track(observation, _ALERT), readings)
        or passed(
            f"{len(readings)} readings, {len(samples_on(observation, _ALERT))} alerts: none too "
            "many."
        )
    )


def _wrong_alerts(texts: Track, readings: Readings) -> Diagnosis | None:
    """Say what is wrong with the alerts; what they say is free."""
    due = _alerts()(readings)
    # A text of its own for readings that are fine is another mistake than an alert for each.
    other = "fine" if _says_fine(texts, due) else "alert"
    done = {at: ("alert" if at in due else other,) * len(found) for at, found in texts.items()}

    def describe(mismatch: Mismatch) -> Diagnosis:
        if mismatch.at not in range(1, len(readings) + 1):
            return Diagnosis(
                "alert-too-many",
                f"An alert was published at {mismatch.at:g} s, and no reading came then.",
                "Publish in the callback of the subscription: it runs when a reading comes.",
            )
        value = readings[round(mismatch.at) - 1]
        if not mismatch.done:
            return Diagnosis("alert-missing", f"No alert for a reading of {value:g}.", _BOTH_COUNT)
        if mismatch.right and len(mismatch.done) > 1:
            evidence = f"{sum(map(len, done.values()))} alerts for {len(due)} readings."
            return Diagnosis("alert-too-many", evidence, "One alert for each is enough.")
        said, hint = "An alert was published", _LIMITS_ARE_FINE
        if other == "fine":
            said = f"{texts[mismatch.at][0]!r} was published on /alert"
            hint = "Whatever comes on /alert is an alert. For a reading that is fine, publish "
            hint += "nothing."
        return Diagnosis("alert-too-many", f"{said} for a reading of {value:g}.", hint)

    return diagnose(readings, done, due, ROOM_SUSPECTS, describe)


def _says_fine(texts: Track, due: Track) -> bool:
    """Return whether readings that are fine got a text of their own, whatever numbers are in it."""
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


# 04c, 04d, 04e: the mean of the last five readings, a status with hysteresis, and changes only.

_MEAN, _STATUS = Wire("/mean", "std_msgs/msg/Float32"), Wire("/status", "std_msgs/msg/String")
_BOTH = (_MEAN.topic, _STATUS.topic)
_OF_THE_MEAN = "Find the status from the reading itself, and not from the mean."
_ALSO = "This step also publishes the status: the mean of the step before stays."
_NO_STATUS = f"Does the callback come to the line that publishes? {_OF_THE_MEAN}"
_NO_CHANGE = (
    "Does the callback come to the line that publishes? Compare the new status with the old one "
    "before you store it."
)


def _judge_means(observation: Observation, seconds: Seconds) -> Verdict:
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or diagnose_unpublished(observation, _MEAN)
        or _wrong_means(track(observation, _MEAN), seconds)
        or passed(f"{len(_heard(seconds))} readings, and as many means.")
    )


def _judge_hysteresis(observation: Observation, seconds: Seconds) -> Verdict:
    """Judge the statuses first, which are new in this step, and then the means."""
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or diagnose_unpublished(observation, _STATUS, _BOTH, _NO_STATUS)
        or diagnose_words(observation, _STATUS, STATUSES)
        or _wrong_statuses(track(observation, _STATUS), seconds, each=True)
        or diagnose_unpublished(observation, _MEAN, _BOTH, _ALSO)
        or _wrong_means(track(observation, _MEAN), seconds)
        or passed(f"{len(_heard(seconds))} readings, and the right mean and status for each.")
    )


def _judge_changes(observation: Observation, seconds: Seconds) -> Verdict:
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or diagnose_unpublished(observation, _MEAN, _BOTH)
        or _wrong_means(track(observation, _MEAN), seconds)
        or diagnose_unpublished(observation, _STATUS, _BOTH, _NO_CHANGE)
        or diagnose_words(observation, _STATUS, STATUSES)
        or _wrong_statuses(track(observation, _STATUS), seconds)
        or passed(
            f"{len(_heard(seconds))} readings, as many means, "
            f"{len(samples_on(observation, _STATUS))} changes."
        )
    )


#: How many readings count.
_WIDTH = 5
#: Seconds from one reading to the next. No answer may rely on one reading a second.
_SPACING = 0.5
#: The readings, one after the other; None where none comes.
Seconds = Sequence[float | None]


def _heard(seconds: Seconds) -> dict[float, float]:
    """Return the readings, by the time in seconds at which each comes."""
    found = enumerate(seconds, 1)
    return {place * _SPACING: value for place, value in found if value is not None}


def _means(width: int = _WIDTH, begin: Readings = (), divisor: int = 0, late: int = 0) -> Model:
    """Return the model of a node that publishes a running mean.

    Args:
        width: How many readings count, at most.
        begin: What is in the window at first.
        divisor: What the sum is always divided by; 0 for the number of readings.
        late: How many of the newest readings are left out.
    """

    def model(seconds: Seconds) -> Track:
        found, window = {}, [*begin]
        for second, value in _heard(seconds).items():
            window.append(value)
            last = window[: len(window) - late][-width:]
            found[second] = (sum(last) / (divisor or len(last) or 1),)
        return found

    return model


def _means_of_five_seconds(seconds: Seconds) -> Track:
    heard = _heard(seconds)
    windows = {now: [value for at, value in heard.items() if now - 5 < at <= now] for now in heard}
    return {now: (sum(last) / len(last),) for now, last in windows.items()}


def _means_that_change(seconds: Seconds) -> Track:
    found, last = {}, None
    for second, mean in _means()(seconds).items():
        if mean != last:
            found[second] = last = mean
    return found


MEAN_SUSPECTS = suspects(
    ("wrong-rate", "A mean is published only when it differs from the one before. Here, each "
     "reading gets a mean.", _means_that_change),
    ("wrong-window", "It is the last reading alone. The last five count.", _means(1)),
    ("wrong-window", "It is the mean of all readings so far. The last five count.",
     _means(10_000)),
    ("wrong-window", "While there are fewer than five, divide by how many there are.",
     _means(divisor=5)),
    ("wrong-window", "While there are fewer than five readings, it is the mean of those that are "
     "there.", lambda fed: dict([*_means()(fed).items()][_WIDTH - 1 :])),
    ("wrong-window", "It is the sum. A mean is divided by how many there are.", _means(divisor=1)),
    ("wrong-window", "The newest reading is not in it. Which comes first, to keep it or to "
     "calculate?", _means(late=1)),
    ("wrong-window", "It is the mean of the last five seconds. Count readings, not seconds: a "
     "reading may be missing.", _means_of_five_seconds),
    *(("wrong-window", f"It is the mean of the last {width} readings. The last five count.",
       _means(width)) for width in (2, 3, 4, 6, 7, 8, 10)),
    *(("wrong-window", f"The list begins with five times {value:g}, and these are no readings. "
       "Begin with an empty one.", _means(begin=(value,) * 5)) for value in (0.0, 22.0)),
)  # fmt: skip


def _wrong_means(done: Track, seconds: Seconds) -> Diagnosis | None:
    heard = _heard(seconds)

    def describe(mismatch: Mismatch) -> Diagnosis:
        if len(mismatch.done) != len(mismatch.right):
            return Diagnosis(
                "wrong-rate",
                f"{len(heard)} readings arrived, and {sum(map(len, done.values()))} means "
                f"were published: at {mismatch.at:g} s there were {len(mismatch.done)}, and "
                f"{len(mismatch.right)} should have been.",
                "Publish one mean for each reading, also while there are fewer than five.",
            )
        last = [f"{value:g}" for at, value in heard.items() if at <= mismatch.at][-6:]
        return Diagnosis(
            "wrong-window",
            f"At {mismatch.at:g} s the mean was {mismatch.done[0]:.3f}; of the last five "
            f"it is {mismatch.right[0]:.3f}. The last readings were {', '.join(last)}.",
            "The sum of the last five, divided by how many they are. Print both to compare.",
        )

    return diagnose(seconds, done, _means()(seconds), MEAN_SUSPECTS, describe)


def _next_status(
    before: str,
    value: float,
    high: float = 26.0,
    low: float = 20.0,
    back_high: float = 25.0,
    back_low: float = 21.0,
    one_band: bool = False,
) -> str:
    status = status_of(value, low, high)
    if status != "Normal":
        return status
    if one_band:  # the same way back from both sides
        return "Normal" if back_low < value < back_high else before
    stays = (before == "High" and value >= back_high) or (before == "Low" and value <= back_low)
    return before if stays else "Normal"


def _statuses(
    limits: Mapping[str, float] | None = None,
    keeps: bool = True,
    compares: bool = True,
    one_band: bool = False,
) -> Model:
    """Return the model of a node that publishes its status when it changes.

    Args:
        limits: Limits other than the page's, as `_next_status` has them.
        keeps: Whether a new status is kept for the next reading.
        compares: Whether only a change is published.
        one_band: Whether the way back needs both limits, wherever it begins.
    """

    def model(seconds: Seconds) -> Track:
        status, found = "Normal", {}
        for second, value in _heard(seconds).items():
            new = _next_status(status, value, one_band=one_band, **(limits or {}))
            if new != status or not compares:
                found[second] = (new,)
            status = new if keeps else "Normal"
        return found

    return model


_NOTHING_KEEPS = (
    "Between its two limits, a status stays as it was. Do you keep it in self? A local variable is "
    "gone when the callback returns. And does High end below 25, and Low above 21?"
)
_ONLY_CHANGES = "Compare the new status with the old one, and publish only a change."
#: A reading at a limit, and the limit of a node that counts it to the wrong side.
_AT_A_LIMIT = (
    *((26, {"high": 25.999}), (20, {"low": 20.001})),
    *((25, {"back_high": 25.001}), (21, {"back_low": 20.999})),
)


def _on_the_wrong_side(each: bool) -> Iterator[tuple[str, str, Model]]:
    """Generate a suspect for each limit, and for each set of them, single ones first."""
    for slips in chain.from_iterable(combinations(_AT_A_LIMIT, count) for count in (1, 2, 3, 4)):
        at = " and exactly ".join(str(reading) for reading, _ in slips)
        change = "changes" if len(slips) == 1 else "change"
        limits = {name: limit for _, one in slips for name, limit in one.items()}
        hint = f"Exactly {at} {change} nothing: above and below leave the limit out."
        yield "boundary", hint, _statuses(limits, compares=not each)


def _mean_each_second(seconds: Seconds) -> Seconds:
    means = _means()(seconds)
    return [means.get(place * _SPACING, (None,))[0] for place in range(1, len(seconds) + 1)]


def _hysteresis_suspects(each: bool) -> Iterator[tuple[str, str, Model]]:
    """Generate what can be wrong with the two limits, of a node that publishes each or changes."""
    says = partial(_statuses, compares=not each)
    yield from _on_the_wrong_side(each)
    lost = "hysteresis-lost"
    yield lost, "From High, nothing leads back to Normal.", says({"back_high": -inf})
    yield lost, "From Low, nothing leads back to Normal.", says({"back_low": inf})
    one_limit = (
        "Each way back has one limit: from High only below 25 counts, and from Low only above 21."
    )
    yield lost, one_limit, says(one_band=True)
    swapped = (
        "The two limits of the way back have changed places: 25 belongs to High, and 21 to Low."
    )
    yield lost, swapped, says({"back_high": 21.0, "back_low": 25.0})
    yield "wrong-state", _OF_THE_MEAN, lambda seconds: says()(_mean_each_second(seconds))


def _first_of_each(said: Track) -> Track:
    """Return only the first time that each status is said; it begins as Normal."""
    known: list[Sequence[str]] = [("Normal",)]
    found = {}
    for at, one in sorted(said.items()):
        if one not in known:
            found[at] = one
            known.append(one)
    return found


def _one_late(said: Track) -> Track:
    """Return the status before each change in its place."""
    times = sorted(said)
    return dict(zip(times, [("Normal",), *(said[at] for at in times[:-1])], strict=True))


#: Of a node that publishes a status for each reading.
EACH_SUSPECTS = suspects(
    ("no-hysteresis", _NOTHING_KEEPS, _statuses(keeps=False, compares=False)),
    *_hysteresis_suspects(each=True),
    ("wrong-rate", "Only the changes are published. Here, each reading gets a status.",
     _statuses()),
)  # fmt: skip
#: Of a node that publishes a status when it changes.
STATUS_SUSPECTS = suspects(
    ("status-repeated", _NOTHING_KEEPS, _statuses(keeps=False)),
    ("no-hysteresis", _NOTHING_KEEPS, _statuses(keeps=False, compares=False)),
    *_hysteresis_suspects(each=False),
    ("change-missing", "The return to Normal is a change, too, and has to be published.",
     lambda seconds: {at: one for at, one in _statuses()(seconds).items() if one != ("Normal",)}),
    ("change-missing", "Compare with the status just before, and not with all earlier ones.",
     lambda seconds: _first_of_each(_statuses()(seconds))),
    ("wrong-state", "At a change, the status before it is published. Which of the two is new?",
     lambda seconds: _one_late(_statuses()(seconds))),
)  # fmt: skip


def draw_hysteresis(draw: Draw) -> Seconds:
    """Draw readings at every border of a status, jumps across, and moments without a reading.

    The first one shows with which status a node begins, and in one place the mean is below 0.
    """
    far = draw.number
    return draw.until(
        lambda: (
            25.5,
            far(22.0, 21.5, 24.5),
            *chain.from_iterable(
                draw.shuffled(
                    (
                        (25.5, 20.5, 26.0, None, 26.00390625, 25.5, 26.25, 25.0, 24.99609375, 25.5),
                        (20.0, 19.99609375, 20.5, None, None, 21.0, 21.00390625, 20.5),
                        (far(41.0, 27.0, 50.0), far(-3.5, -9.0, 19.0)),
                        (far(30.0, 27.0, 50.0), far(23.0, 22.0, 24.5), 0.0, 0.0, 23.5),
                        (far(19.0, -9.0, 19.5), far(25.5, 22.0, 25.5)),
                        (*(far(-20.0, -40.0, -15.0), -18.5, -19.25, -17.75), 24.0),
                        (far(27.0, 26.5, 50.0), far(20.5, 20.5, 24.5)),
                        # So often that the mean stays the same.
                        (22.5,) * 6,
                    )
                )
            ),
        ),
        lambda fed: (
            tells_apart(fed, _means(), MEAN_SUSPECTS)
            and tells_apart(fed, _statuses(compares=False), EACH_SUSPECTS)
            and tells_apart(fed, _statuses(), STATUS_SUSPECTS)
        ),
    )


def _wrong_statuses(done: Track, seconds: Seconds, each: bool = False) -> Diagnosis | None:
    heard, right = _heard(seconds), _statuses(compares=not each)(seconds)

    def describe(mismatch: Mismatch) -> Diagnosis:
        at = mismatch.at
        before = [("Normal",), *(right[second] for second in sorted(right) if second < at)][-1][0]
        values = [value for second, value in heard.items() if second <= at]
        after = f"after a reading of {values[-1]:g}" if values else "before the first reading"
        said, due = (" and ".join(one) or "nothing" for one in (mismatch.done, mismatch.right))
        evidence = (
            f"The status was {before}. At {at:g} s, {after}, {said} was published, and {due} "
            "should have been."
        )
        if not each:
            return _unmodelled(before, mismatch.done, mismatch.right, evidence)
        if len(mismatch.done) != len(mismatch.right):
            return Diagnosis("wrong-rate", evidence, "Publish one status for each reading.")
        stayed = () if mismatch.right == (before,) else mismatch.right
        return _unmodelled("", mismatch.done, stayed, evidence)

    suspected = EACH_SUSPECTS if each else STATUS_SUSPECTS
    return diagnose(seconds, done, right, suspected, describe)


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
    Exercise("04a", _feed, _judge_states, "watch a fridge", 1, (
        "The monitor of this page decides between three words, too. Compare the limits.",
        "if, elif and else are tried from top to bottom. > and < leave the limit itself out.",
    ), draw=draw_fridge),
    Exercise("04b", _feed, _judge_alarm, "raise the alarm", 2, (
        "The publisher is made once, in __init__, like the sensor's; the message type and the "
        "topic are others.",
        "A reading gets an alert if it's too high or too low: join the two conditions with "
        "`or`.",
        "Create a String like a Float32, with a text in its field data.",
    ), draw=draw_room),
    Exercise("04c", partial(_feed, period=_SPACING), _judge_means, "the mean of five readings", 1, (
        "The node needs a memory: a list in self, which begins empty. Each reading goes into "
        "it.",
        "Keep the readings in a list. readings[-5:] is its last five items, or all of them if "
        "there are fewer.",
    ), draw=draw_hysteresis),
    Exercise("04d", partial(_feed, period=_SPACING), _judge_hysteresis, "a status with two limits",
        2, (
        "The status needs a memory: self.status. Find the new one from the reading and from "
        "the old one.",
        "Test for High and Low first: they don't depend on the old status. Then test whether a "
        "High or a Low has come back far enough.",
    ), draw=draw_hysteresis),
    Exercise("04e", partial(_feed, period=_SPACING), _judge_changes, "a calm monitor", 1, (
        "Your node already finds the new status. What does it still know of the old one at "
        "that moment?",
        "Find the new status and keep it in a variable of its own first. Publish it only if "
        "it differs from self.status, and then store it there.",
    ), draw=draw_hysteresis),
)  # fmt: skip

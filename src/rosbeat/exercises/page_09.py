"""Page 09, test the five claims: a silence noticed, work beside a beat, a monitor for any place."""

from __future__ import annotations

import re
from bisect import bisect_right, insort
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import accumulate, cycle, pairwise
from typing import Any, NamedTuple

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    STATUSES,
    Mismatch,
    Model,
    Track,
    diagnose,
    diagnose_wait,
    diagnose_words,
    first_mismatch,
    grouped,
    matching,
    name_mistake,
    numbered,
    samples_on,
    status_of,
    suspects,
    tells_apart,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, feeder, observe, publishing, started
from rosbeat.records import INFRASTRUCTURE_TOPICS, Observation, Sample

_FLOAT, _INT, _STRING = (f"std_msgs/msg/{name}" for name in ("Float32", "Int32", "String"))
_STATUS = Wire("/status", _STRING)
_CALLED = "Which callback comes to the line that publishes, and what calls it?"

# 09a: notice the silence.

_TEMPERATURE = Wire("/temperature", _FLOAT)
#: When readings come, in seconds.
Readings = tuple[float, ...]
#: Seconds from the last reading to the end of the run.
_REST = 2.0
#: Seconds without a reading after which a sensor is lost, and how late that may be said.
SILENCE, LATE = 3.0, 1.0
_ROOM = 0.05
#: Words and when they were published.
Words = Iterable[tuple[float, str]]


def draw_readings(draw: Draw) -> Readings:
    """Draw readings: the first one late, a silence after it, short pauses, and two more silences.

    A silence begins at a full second or half of one: so a node that counts seconds, or halves, is
    in time with each seed or with none. And one that looks every two or three seconds is late.
    """
    return draw.until(
        partial(_readings, draw),
        lambda fed: (
            tells_apart(fed, _watch(), SILENCE_SUSPECTS)
            and all(
                any(-(last + SILENCE) % period > LATE for last in _before_silences(fed))
                for period in (2.0, 3.0)
            )
        ),
    )


def _before_silences(readings: Readings) -> list[float]:
    return [last for last, first in pairwise(readings) if first - last > SILENCE]


def _readings(draw: Draw) -> Readings:
    def seconds(usual: int) -> tuple[float, ...]:
        return (1.0,) * draw.whole(usual, 1, 5)

    gaps = (
        *(draw.one_of(7.0, 5.0, 8.0, 10.0), *seconds(2), 2.75, 1.25),
        draw.number(8.0, 6.0, 14.0, 1.0),
        *(*seconds(1), 2.5, draw.number(7.5, 5.5, 13.5, 1.0), *seconds(1), 2.5),
    )
    return tuple(accumulate(gaps, initial=draw.number(6.5, 5.5, 14.5, 1.0)))


def _run_with_silences(answer: Answer, readings: Readings) -> Observation:
    # The value does not matter: a reading of 0 is a reading, although Python treats 0 as false.
    steps = publishing(_TEMPERATURE, zip(readings, cycle((0.0, 22.0, 22.0)), strict=False))
    return observe(answer, readings[-1] + _REST, steps=steps)


def _by_reading(words: Words, readings: Readings) -> Track:
    """Return the words by the number of readings that had come, each early, due or late."""

    def placed(at: float, word: str) -> tuple[int, str]:
        count = bisect_right(readings, at + _ROOM)
        waited = at - readings[count - 1] if count else 0.0
        due = SILENCE if word == "lost" else 0.0
        when = "early" if waited < due - _ROOM else "late" if waited > due + LATE + _ROOM else "due"
        return count, f"{word} {when}"

    return grouped(placed(at, word) for at, word in words)


def _watch(after: float = SILENCE, at_once: bool = False, most: int | None = None) -> Model:
    """Return the model of a node that says `lost` and `back`.

    Args:
        after: Seconds of silence until it says `lost`.
        at_once: Whether it says `lost` only when the silence is over.
        most: How many words it ever says.
    """

    def model(readings: Readings) -> Track:
        words = []
        for last, first in pairwise(readings):
            if first - last > after:
                words += [(first if at_once else last + after, "lost"), (first, "back")]
        return _by_reading(words[:most], readings)

    return model


_UNSEEN = (
    "No message can tell you that none are coming. What else can call the"
    " node regularly, and by which clock does it measure the silence?"
)
_IN_TIME = f"At most {LATE:g} s late: how often does the node look?"
_COUNT = f"Count from the last reading, and wait for {SILENCE:g} s of silence."
SILENCE_SUSPECTS = suspects(
    ("silence-unnoticed", _UNSEEN, _watch(after=100.0)),
    ("silence-unnoticed", "The first silence was noticed, and the second was not. What does the "
     "node remember after `back`?", _watch(most=2)),
    ("noticed-afterwards", "The callback of a subscription runs when a message arrives. What runs "
     "when none arrives?", _watch(at_once=True)),
    ("noticed-early", _COUNT, *(_watch(after=after) for after in (0.0, 1.5, 2.6))),
    ("noticed-late", _IN_TIME, _watch(after=5.0)),
)  # fmt: skip


def _judge_silence(observation: Observation, readings: Readings) -> Verdict:
    silent = diagnose_unpublished(observation, _STATUS)
    if silent and silent.mistake == "never-published":
        silent = None  # no word was ever said: that is told better by what should have been said
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or silent
        or diagnose_words(observation, _STATUS, ("lost", "back"))
        or _wrong_words(observation, readings)
        or passed(
            f"{len(readings)} readings, {len(_watch()(readings)) // 2} silences: each was noticed "
            "once, and its end too."
        )
    )


def _wrong_words(observation: Observation, readings: Readings) -> Diagnosis | None:
    words = [(one.time, str(one.value)) for one in samples_on(observation, _STATUS)]

    def describe(mismatch: Mismatch) -> Diagnosis:
        number, times = mismatch.at, (0.0, *readings, readings[-1] + _REST)
        here = [one for one in words if [*_by_reading([one], readings)] == [number]]
        said = " and ".join(f"{word} at {at:g} s" for at, word in here) or "nothing"
        due = f"{mismatch.right[0].split()[0] if mismatch.right else 'nothing'} was due"
        came = "the next reading came"
        if number == len(readings):
            came = "no reading came, and the run ended"
        begin = f"After {times[number]:g} s, {came} at {times[number + 1]:g} s. {due.capitalize()}"
        if number == 0:
            begin = f"Before the first reading, at {times[1]:g} s, {due}"
        evidence = f"{begin}, and the node said {said}."
        return diagnose_wait(observation, evidence, 0.5) or _first_word(mismatch, evidence)

    done, right = _by_reading(words, readings), _watch()(readings)
    return diagnose(readings, done, right, SILENCE_SUSPECTS, describe)


def _first_word(mismatch: Mismatch, evidence: str) -> Diagnosis:
    """Name a mistake by its first word alone: a node may look at any moments, and forget a lot."""
    done, right = mismatch.done, mismatch.right
    same = next(n for n in range(9) if done[n : n + 1] != right[n : n + 1])
    if same == len(done):
        if right[same] == "lost due":
            return Diagnosis("silence-unnoticed", evidence, _UNSEEN)
        return Diagnosis("back-missing", evidence, "A reading that ends a silence is news.")
    word, when = done[same].split()
    if word == "back" and right[same:] != ("back due",):
        return Diagnosis("back-too-often", evidence, "Back is the end of lost, and only of that.")
    if word == "lost" and mismatch.at == 0:
        hint = "Before the first reading there is nothing to lose. How does the node know of one?"
        return Diagnosis("lost-before-found", evidence, hint)
    if word == "lost" and any(one.startswith("lost") for one in done[:same]):
        return Diagnosis(
            "status-repeated", evidence, "Once is enough: what does the node have to remember?"
        )
    if when == "early":
        return Diagnosis("noticed-early", evidence, _COUNT)
    return Diagnosis("noticed-late", evidence, _IN_TIME)


# 09b: work, and keep beating.

_ORDER, _DONE, _BEAT = Wire("/order", _INT), Wire("/done", _INT), Wire("/beat", _STRING)
#: Seconds that an order takes.
WORK = 3.0
#: The longest period in seconds of a timer that looks whether an order is done: a report may be
#: late by a period.
_LOOK = 1.0
Reports = Sequence[tuple[float, int]]


class Work(NamedTuple):
    """Hold what a worker is fed.

    Attributes:
        orders: When orders come, in seconds, and their numbers.
        end: When the run ends.
        each: Seconds that a worker takes for an order.
    """

    orders: tuple[tuple[float, int], ...]
    end: float
    each: float = WORK


def draw_work(draw: Draw) -> Work:
    """Draw orders: one after another, two while two others wait, and one more while some wait.

    A test for "no order" must not take the number 0 for none. A number says nothing of which order
    it is: one comes again while it waits, and one when it is done. Work begins at half a second
    past a full one: so a node that counts halves is in time.
    """

    def tells_all(fed: Work) -> bool:
        slow = fed._replace(each=WORK + 0.5)
        return all(tells_apart(one, _worker(), WORK_SUSPECTS) for one in (fed, slow))

    return draw.until(partial(_orders, draw), tells_all)


def _orders(draw: Draw) -> Work:
    done, waits, other = (7, 12, 5) if draw.is_page else draw.shuffled(range(1, 100))[:3]
    first = draw.number(2.5, 2.5, 7.5, 1.0)
    second = first + draw.whole(7, 4, 12)
    third = second + draw.one_of(2.25, 0.25, 0.75, 1.25, 1.75)
    times = (first, second, second, third, third, second + 7.25)
    numbers = (done, 0, waits, waits, other, done)
    return Work(tuple(zip(times, numbers, strict=True)), second + 19.5)


def _run_with_orders(answer: Answer, fed: Work) -> Observation:
    return observe(answer, fed.end, steps=publishing(_ORDER, fed.orders))


def _judge_work(observation: Observation, fed: Work) -> Verdict:
    both = (_BEAT.topic, _DONE.topic)
    beats = [beat.time for beat in samples_on(observation, _BEAT)]
    return (
        diagnose_unheard(observation, _ORDER)
        or diagnose_unpublished(observation, _BEAT, both, _CALLED)
        or _wrong_beats(beats, fed)
        or diagnose_unpublished(observation, _DONE, both, _CALLED)
        or _wrong_reports(observation, fed)
        or passed(
            f"{len(fed.orders)} orders, each done after {WORK:g} s, one after the other; meanwhile "
            f"{len(beats)} beats, none of them late."
        )
    )


def _wrong_beats(beats: Sequence[float], fed: Work) -> Diagnosis | None:
    """Say what is wrong with the beat; without a model, since a timer may begin at any moment."""
    hint = "One beat a second, whether it works or not."
    # Before the first beat, and behind the last one, a gap may be shorter.
    for begin, end in pairwise((0.0, *beats, fed.end)):
        if end - begin < 0.9 and begin > 0.0 and end < fed.end:
            evidence = f"A beat came at {begin:g} s, and the next at {end:g} s already."
            return Diagnosis("wrong-rate", evidence, hint)
        if end - begin > 1.1 and end <= fed.orders[0][0]:
            evidence = f"Between {begin:g} s and {end:g} s there was no beat, and no work to do."
            return Diagnosis("wrong-rate", evidence, "One beat a second needs a timer of 1.0 s.")
        if end - begin > 1.1:
            return Diagnosis(
                "beat-starved",
                f"Between {begin:g} s and {end:g} s there was no beat, "
                f"{_work_between(begin, end, fed)}.",
                "A node runs one callback at a time. While yours waits for the work to be done, no "
                "other can run: what could call you back when it is done?",
            )
    mean = (beats[-1] - beats[0]) / max(1, len(beats) - 1)
    if len(beats) > 1 and abs(mean - 1.0) > 0.02:
        evidence = f"{len(beats)} beats came, every {mean:.2f} s."
        return Diagnosis("wrong-rate", evidence, hint)
    return None


def _work_between(begin: float, end: float, fed: Work) -> str:
    """Return what there was to do between two moments, for somebody who does it as asked."""
    free = 0.0
    for at, number in fed.orders:
        started = max(at, free)
        free = started + WORK
        if begin < free and started < end:
            return f"while order {number} was being worked on"
    return f"after order {[number for at, number in fed.orders if at < end][-1]} had come"


def _by_report(reports: Reports, fed: Work) -> Track:
    """Return each report's number, and the seconds from when the order could begin."""
    came, free, found = grouped((number, at) for at, number in fed.orders), 0.0, {}
    for place, (at, number) in enumerate(reports):
        times = came.get(number, (0.0,))
        came[number] = times[1:] or times  # of equal numbers, the first that is not yet done
        found[place] = (number, at - max(free, times[0]))
        free = at
    return found


def _worker(
    put: Callable[[list[int], int], Any] = list.append,
    take: Callable[[list[int]], list[int]] = lambda waiting: [waiting.pop(0)],
    restart: bool = False,
) -> Model:
    """Return the model of a worker, from orders and the seconds that each takes to its reports.

    Args:
        put: Adds an order to those that wait; the first of them is being worked on.
        take: Takes out what is done when the time is over.
        restart: Whether each order that comes begins the time anew.
    """

    def model(fed: Work) -> Track:
        reports: list[tuple[float, int]] = []
        waiting: list[int] = []
        due, work = fed.end, fed.each
        for at, order in (*fed.orders, (fed.end, 0)):
            while waiting and due <= at:
                reports += [(due, number) for number in take(waiting)]
                due += work
            if restart or not waiting:
                due = at + work
            put(waiting, order)
        return _by_report(reports, fed)

    return model


def _independent(fed: Work) -> Track:
    """Return the reports of a timer for each order, which all run at once."""
    return _by_report([(at + fed.each, number) for at, number in fed.orders], fed)


def _started_by_orders(fed: Work) -> Track:
    """Return the reports of a worker that goes on only when another order comes."""
    reports: list[tuple[float, int]] = []
    waiting: list[int] = []
    due = 0.0
    for at, order in (*fed.orders, (fed.end, 0)):
        if due and due <= at:
            reports.append((due, waiting.pop(0)))
            due = 0.0
        waiting.append(order)
        due = due or at + fed.each
    return _by_report(reports, fed)


def _each_number_once(fed: Work) -> Track:
    """Return the reports of a worker to whom a number that came before is the same order."""
    numbers = [number for _, number in fed.orders]
    new = tuple(one for at, one in enumerate(fed.orders) if one[1] not in numbers[:at])
    return _worker()(fed._replace(orders=new))


def _free_running(fed: Work) -> Track:
    """Return the reports of a timer that runs from the beginning."""
    reports, waiting = [], list(fed.orders)
    for tick in range(3, int(fed.end), 3):
        if waiting and waiting[0][0] <= tick:
            reports.append((float(tick), waiting.pop(0)[1]))
    return _by_report(reports, fed)


def _keep(most: int) -> Callable[[list[int], int], None]:
    return lambda waiting, order: waiting.append(order) if len(waiting) < most else None


def _take_and_empty(waiting: list[int]) -> list[int]:
    done = waiting[:1]
    waiting.clear()
    return done


_WAITS = "An order that comes while another one is worked on has to wait somewhere."
_ONE_AT_A_TIME = f"Orders are done one after the other: the next {WORK:g} s begin when one is done."
_FIRST_COME = "The order that came first is done first."
WORK_SUSPECTS = suspects(
    ("work-too-short", "The timer keeps running: restart its period when the work on an order "
     "begins.", _free_running),
    ("work-too-long", "Each new order restarts the time. It should keep running for the order in "
     "progress.", _worker(restart=True)),
    ("work-at-once", _ONE_AT_A_TIME, _independent,
     _worker(take=lambda waiting: [waiting.pop(0) for _ in waiting[:]])),
    ("order-lost", f"Only the newest order is kept. {_WAITS}",
     _worker(put=lambda waiting, order: waiting.__setitem__(slice(None), [order]))),
    ("order-lost", "A waiting order begins only when another one comes. When an order is done, "
     "check whether another is waiting.", _started_by_orders),
    ("order-lost", "Two orders may have the same number, and each of them is to be done.",
     _each_number_once,
     _worker(put=lambda waiting, order: waiting.extend({order} - {*waiting}))),
    ("order-lost", f"No order could wait. {_WAITS}", _worker(_keep(1))),
    ("order-lost", f"Only one order could wait. {_WAITS}", _worker(_keep(2))),
    ("order-lost", f"Only two orders could wait. {_WAITS}", _worker(_keep(3))),
    ("order-lost", f"When one order was done, all others were gone. {_WAITS}",
     _worker(take=_take_and_empty)),
    ("order-swapped", f"The newest came first. {_FIRST_COME}",
     _worker(take=lambda waiting: [waiting.pop()])),
    ("order-swapped", f"The smallest number came first. {_FIRST_COME}", _worker(put=insort)),
)  # fmt: skip
TOO_SHORT, TOO_LONG = suspects(
    ("work-too-short", f"The work itself takes {WORK:g} s.", _worker()),
    ("work-too-long", f"It takes {WORK:g} s. What does it wait for besides?", _worker()),
)


def _lateness(observation: Observation) -> float:
    """Return the period of a timer that ran at each report: a report may be late by that."""
    reports = {report.time_ns for report in samples_on(observation, _DONE)}
    runs: dict[tuple[str, str], set[int]] = {}
    for one in observation.callbacks:
        if (one.node, one.kind) == (observation.subject, "timer"):
            runs.setdefault((one.name, one.source), set()).add(one.time_ns)
    periods = [float(source.split()[0]) for (_, source), times in runs.items() if reports <= times]
    return max((period for period in periods if period <= _LOOK), default=0.0)


def _wrong_reports(observation: Observation, fed: Work) -> Diagnosis | None:
    reports = [(report.time, int(report.value)) for report in samples_on(observation, _DONE)]
    done = _by_report(reports, fed)
    late = _lateness(observation)
    room = min(late, 0.1) + 0.01  # a counter of small steps may be off by one

    def in_time(found: float, wanted: float) -> bool:
        return found == wanted or (
            isinstance(found, float) and -room <= found - wanted <= late + room
        )

    mismatch = first_mismatch(done, _worker()(fed), in_time)
    if mismatch is None:
        return None
    place = mismatch.at
    evidence = f"No order was due after {len(fed.orders)} reports"
    if mismatch.right:
        at, order = fed.orders[place]
        begin = max(at, reports[place - 1][0]) if 0 < place <= len(reports) else at
        evidence = f"Order {order} could begin at {begin:g} s and was due {WORK:g} s later"
    said = f"it was not done by {observation.time:g} s"
    if mismatch.done:
        said = f"order {reports[place][1]} was done at {reports[place][0]:g} s"
    work = done[0][1]
    other_length = TOO_SHORT if work < WORK else TOO_LONG
    # That one fits for every length of the work; others only for some lengths.
    as_measured = fed._replace(each=work)
    matches = matching(as_measured, done, [other_length], in_time)
    return name_mistake(
        matches or matching(as_measured, done, WORK_SUSPECTS, in_time),
        _first_report(mismatch, done, f"{evidence}; {said}.", fed),
    )


def _first_report(mismatch: Mismatch, reports: Track, evidence: str, fed: Work) -> Diagnosis:
    """Name a mistake by its first report alone: several at once have too many models."""
    done, right = mismatch.done, mismatch.right
    numbers = [number for number, _ in reports.values()]
    ordered = [number for _, number in fed.orders]
    is_early, again = done and done[1] < 0, done and done[0] in numbers[: mismatch.at]
    if done and (done[0] not in ordered or (is_early and not again)):
        return Diagnosis("wrong-values", evidence, "Publish the number that was ordered.")
    before = reports.get(mismatch.at - 1)
    if done and before and done[1] == 0 and done[0] != before[0]:
        return Diagnosis("work-at-once", evidence, _ONE_AT_A_TIME)
    if done and (is_early or numbers.count(done[0]) > ordered.count(done[0])):
        hint = "A timer calls again and again until it is stopped."
        return Diagnosis("done-twice", evidence, hint)
    if numbers.count(right[0]) < ordered.count(right[0]):
        return Diagnosis("order-lost", evidence, _WAITS)
    if done[0] != right[0]:
        return Diagnosis("order-swapped", evidence, _FIRST_COME)
    suspect = TOO_SHORT if done[1] < WORK else TOO_LONG
    return Diagnosis(suspect.mistake, evidence, suspect.hint)


# 09c: a monitor for any place.

LOW, HIGH, UNIT = 20.0, 26.0, "C"


@dataclass(frozen=True)
class Place:
    """Hold a place in which the monitor is started.

    Attributes:
        node: Full name of the node; empty for the one that is started without arguments.
        listens: Full name of the topic on which its readings come.
        speaks: Full name of the topic on which it has to publish.
        readings: What it hears, one a second, the first at 1 s.
        low: Its lower limit.
        high: Its upper limit.
        unit: Its unit.
        remappings: Other names of topics that the node is started with.
        parameters: Parameters that it is started with.
    """

    node: str
    listens: str
    speaks: str
    readings: tuple[float, ...]
    low: float = LOW
    high: float = HIGH
    unit: str = UNIT
    remappings: tuple[tuple[str, str], ...] = ()
    parameters: tuple[tuple[str, Any], ...] = ()


#: The one without arguments, then one with all limits of its own, and one with an upper limit.
Places = tuple[Place, Place, Place]


#: A distance from a limit that two decimals do not show; a float32 holds each limit and this.
_JUST = 1 / 256


def draw_places(draw: Draw) -> Places:
    """Draw places; all limits of the first one are the defaults, and one of the last."""
    return draw.until(
        partial(_places, draw), lambda places: tells_apart(places[1], _words(), PLACE_SUSPECTS)
    )


def _places(draw: Draw) -> Places:
    # Readings at the limits of a place, just outside, and between the limits of the others. A
    # float32 holds each of the numbers at a limit exactly.
    number = partial(draw.number, step=0.5)
    readings = (
        *(number(22.0, 20.5, 25.0), number(27.5, 26.5, 29.0), 26.0, 26.0 + _JUST, 25.5, 20.0),
        *(20.0 - _JUST, number(12.5, 1.0, 19.0), 20.5, number(55.0, 30.0, 90.0)),
        *(0.0, number(-7.5, -9.0, -1.0)),
    )
    home = Place("", "/reading", "/status", draw.shuffled(readings))

    # A limit of 0 is a limit, although Python treats 0 as false; and a unit is only a text.
    low, high = draw.one_of(0.0, -6.5, 5.5), number(34.0, 30.0, 38.0)
    space = draw.one_of("freezer", "cellar", "attic", "barn")
    name, topic = draw.one_of(("frost", "frost"), ("cold", "air"))
    freezer = Place(
        f"/{space}/{name}_monitor",
        f"/{space}/{topic}",
        f"/{space}/status",
        draw.shuffled(
            (
                *(number(12.0, 9.0, 19.0), high + 2.5, high, high, high + _JUST, low),
                *(low - _JUST, number(22.0, 20.5, 25.5), number(27.5, 26.5, 29.5)),
                *(number(15.5, 9.0, 19.0), -44.5, number(7.5, 6.0, 8.5)),
            )
        ),
        low,
        high,
        "F",
        (("reading", topic),),
        (("low", low), ("high", high), ("unit", "F")),
    )

    high = number(70.0, 67.0, 80.0)
    space = draw.one_of("greenhouse", "garage", "street", "garden", "bathroom")
    topic, unit = draw.one_of(("humidity", "%"), ("noise", "dB"), ("dust", "ug"))
    greenhouse = Place(
        f"/{space}/{topic}_monitor",
        f"/{space}/reading",
        f"/{space}/{topic}",
        draw.shuffled(
            (
                *(number(55.0, 51.0, 66.0), high + 10.5, high, 19.5, 20.0, 20.0),
                *(number(27.5, 26.5, 37.0), number(65.5, 51.0, 66.0), number(12.0, 1.0, 19.0)),
                *(high + 2.5, number(42.0, 40.0, 50.0), 0.0),
            )
        ),
        LOW,
        high,
        unit,
        (("status", topic),),
        (("high", high), ("unit", unit)),
    )
    return home, freezer, greenhouse


_PARAMETERS = {"low": LOW, "high": HIGH, "unit": UNIT}


def _run_everywhere(answer: Answer, places: Places) -> Observation:
    """Start an answer in three places at once; the one without arguments is looked at."""
    from rosbeat.ros.scenario import SetParameters

    seconds = len(places[0].readings) + 1
    feeds = [
        feeder(f"sensor_{number}", Wire(one.listens, _FLOAT), one.readings)
        for number, one in enumerate(places, 1)
    ]
    elsewhere = [
        started(
            answer,
            name=one.node.split("/")[2],
            namespace=one.node.split("/")[1],
            remappings=dict(one.remappings),
            parameters=dict(one.parameters),
        )
        for one in places[1:]
    ]
    # The reply says whether there is such a parameter.
    steps = [SetParameters(seconds - 0.5, values={name: _PARAMETERS[name]}) for name in _PARAMETERS]
    return observe(answer, seconds, others=[*feeds, *elsewhere], steps=steps)


def _judge_places(observation: Observation, places: Places) -> Verdict:
    each = (
        *(_wrong_names(observation, place) for place in places[1:]),
        *(_wrong_count(observation, place) for place in places),
    )
    return (
        diagnose_unheard(observation, Wire(places[0].listens, _FLOAT))
        or diagnose_unpublished(observation, _STATUS, hint=_CALLED)
        or next(filter(None, each), None)
        or next(filter(None, (_wrong_texts(observation, place, places) for place in places)), None)
        or passed(
            f"One class in {len(places)} places at once, with other topics, limits and units "
            f"({', '.join(place.unit for place in places)}): "
            f"{sum(len(place.readings) for place in places)} readings, no wrong word."
        )
    )


def _wrong_texts(observation: Observation, place: Place, places: Places) -> Diagnosis | None:
    """Say what is wrong with the texts in a place, which has one text for each reading."""
    texts = [str(one.value) for one in _published(observation, place)]
    said = list(zip(place.readings, texts, strict=True))
    return (
        _unfilled(said, place)
        or _wrong_states(observation, place, places, texts)
        or _wrong_form(observation, place, said)
    )


def _wrong_names(observation: Observation, place: Place) -> Diagnosis | None:
    space = place.node.rpartition("/")[0]
    for kind, does, topic in (
        ("subscription", "listen to", place.listens),
        ("publisher", "publish on", place.speaks),
    ):
        ends = [
            end for end in observation.graph.endpoints if (end.node, end.kind) == (place.node, kind)
        ]
        names = [end.name for end in ends if end.name not in INFRASTRUCTURE_TOPICS]
        if topic in names:
            continue
        evidence = (
            f"Started in the namespace {space}, the node should {does} {topic}, and the name in "
            f"use is {' and '.join(names) or 'none'}."
        )
        if all(name.startswith(f"{space}/") for name in names):
            hint = (
                "Which name is in the code? It has to be exactly the name that the exercise gives."
            )
            return Diagnosis("wrong-topic", evidence, hint)
        hint = "A namespace moves a name only if it does not begin with a slash."
        return Diagnosis("absolute-name", evidence, hint)
    return None


def _published(observation: Observation, place: Place) -> list[Sample]:
    node = place.node or observation.subject
    return [one for one in samples_on(observation, Wire(place.speaks, _STRING)) if one.node == node]


def _wrong_count(observation: Observation, place: Place) -> Diagnosis | None:
    times = [one.time for one in _published(observation, place)]
    if times == [float(second) for second in range(1, len(place.readings) + 1)]:
        return None
    return Diagnosis(
        "wrong-rate",
        f"{len(place.readings)} readings came on {place.listens}, one a second, and {len(times)} "
        f"texts were published on {place.speaks}.",
        "One text for each reading, when it comes: also if nothing has changed.",
    )


def _words(
    low: float | None = None,
    high: float | None = None,
    above: float = 0.0,
    below: float = 0.0,
    **other: str,
) -> Model:
    """Return the model of a monitor, from a place to the word for each reading.

    Args:
        low: Its lower limit; by default the place's.
        high: Its upper limit; by default the place's.
        above: How much too far up its lower limit is.
        below: How much too far down its upper limit is.
        other: Other words, by the right ones.
    """

    def model(place: Place) -> Track:
        limits = (place.low if low is None else low, place.high if high is None else high)
        said = (status_of(one, limits[0] + above, limits[1] - below) for one in place.readings)
        return numbered(other.get(one, one) for one in said)

    return model


_FROM_OUTSIDE = (
    "A value from outside reaches a node only through a parameter that it declares, by exactly "
    "that name, and reads."
)
_AT_THE_LIMIT = "Above and below leave the limit itself out: exactly there all is Normal."
PLACE_SUSPECTS = suspects(
    ("limits-fixed", f"The parameters low and high changed nothing. {_FROM_OUTSIDE}",
     _words(LOW, HIGH)),
    ("limits-fixed", f"The parameter low changed nothing. {_FROM_OUTSIDE}", _words(low=LOW)),
    ("limits-fixed", f"The parameter high changed nothing. {_FROM_OUTSIDE}", _words(high=HIGH)),
    ("boundary", _AT_THE_LIMIT,
     _words(above=1e-3), _words(below=1e-3), _words(above=1e-3, below=1e-3)),
    ("wrong-state", "High and Low have changed places.", _words(High="Low", Low="High")),
    ("wrong-state", "The parameters low and high have changed places.",
     lambda place: _words(place.high, place.low)(place)),
)  # fmt: skip
_ANY_WORD = re.compile(r"(?i)(?<![a-z])(?:high|low|normal)(?![a-z])")


def _states(texts: Iterable[str]) -> Track:
    """Return the words of a status that each text holds; an empty one if it holds none."""
    found = [tuple(dict.fromkeys(_ANY_WORD.findall(text))) for text in texts]
    return {second: words or ("",) for second, words in enumerate(found, 1)}


def _wrong_states(
    observation: Observation, place: Place, places: Places, texts: Sequence[str]
) -> Diagnosis | None:
    def describe(mismatch: Mismatch) -> Diagnosis:
        number = mismatch.at - 1
        evidence = (
            f"With the limits {place.low:g} and {place.high:g}, it said {texts[number]!r} of a "
            f"reading of {place.readings[number]:g}.{_undeclared(observation)}"
        )
        if mismatch.done[0] not in STATUSES or len(mismatch.done) > 1:
            hint = (
                "Each text contains one of three words: High, Low or Normal, spelled "
                "exactly like this."
            )
            return Diagnosis("wrong-word", evidence, f"{hint} Capitals count.")
        home, told, _ = places
        elsewhere = _states(str(one.value) for one in _published(observation, told))
        if place == home and elsewhere == _words()(told):
            hint = f"Where it is told no limits, they are {LOW:g} and {HIGH:g}: the default values."
            return Diagnosis("other-default", f"{evidence} Where it was told, it kept them.", hint)
        return Diagnosis("wrong-state", evidence, "Which of your conditions is true for it?")

    return diagnose(place, _states(texts), _words()(place), PLACE_SUSPECTS, describe)


#: What an f-string or `format` fills in; the text of a set or a dict looks otherwise.
_UNFILLED = re.compile(
    r"\{(?!(?:High|Low|Normal)\b)"
    r"(?:[A-Za-z_][^{}]*|[^{}]* if [^{}]*|\d?(?:![rsa])?(?::[^{}]*)?)\}"
)


#: A reading, and the text that was published for it.
_Said = Sequence[tuple[float, str]]


def _unfilled(said: _Said, place: Place) -> Diagnosis | None:
    """Say which text still has the braces of an f-string that is none."""
    for reading, text in said:
        if {*_UNFILLED.findall(text)} - {f"{{{place.unit}}}"}:
            return Diagnosis(
                "f-missing",
                f"Of {reading:g} it said {text!r}.",
                "The braces are still there: an f before the first quote fills in those with a "
                "name inside, and format() the empty ones. Each piece of a text needs its own.",
            )
    return None


def _undeclared(observation: Observation) -> str:
    """Return a sentence about parameters that the node does not declare, or an empty text."""
    names = [
        [*_PARAMETERS][reply.number - 1]
        for reply in observation.replies
        if reply.data.get("reason") == "not declared"
    ]
    return f" The node declares no parameter {' and no '.join(names)}." if names else ""


def _form(text: str, reading: float, unit: str) -> str:
    """Return a text with the names of its parts in their place."""
    edge = ("(?<![A-Za-z])", "(?![A-Za-z])") if unit.isalpha() else ("", "")
    text = re.sub(re.escape(unit).join(edge), "<unit>", text)
    numbers = (number for number in re.findall(r"[-+]?\d+\.\d+", text))
    for number in numbers:
        if abs(float(number) - reading) < 0.06:  # one decimal, and 32 bits
            text = text.replace(number, "<reading>")
    return _ANY_WORD.sub("<word>", text)


def _whole_numbers(said: _Said) -> Diagnosis | None:
    """Say that each number shown is the whole one below or above its reading, if it is so."""
    for reading, text in said:
        numbers = map(float, re.findall(r"[-+]?\d+(?:\.\d+)?", text))
        if not any(one.is_integer() and abs(one - reading) < 1.0 for one in numbers):
            return None
    reading, text = next(one for one in said if round(one[0], 1) % 1)
    evidence = f"Of {reading:g} it said {text!r}."
    hint = "The reading is a decimal number: where does it lose its decimals?"
    return Diagnosis("decimals-lost", evidence, hint)


def _wrong_form(observation: Observation, place: Place, said: _Said) -> Diagnosis | None:
    for reading, text in said:
        form = _form(text, reading, place.unit)
        if form == "<word> <reading> <unit>":
            continue
        evidence = f"Of {reading:g} it said {text!r}."
        if "<unit>" not in form and "<unit>" in _form(text, reading, UNIT):
            evidence += f" It was started with the unit {place.unit!r}.{_undeclared(observation)}"
            return Diagnosis("unit-fixed", evidence, f"The unit is a parameter. {_FROM_OUTSIDE}")
        if "<unit>" not in form:
            hint = f"Each text ends with the unit, here {place.unit}."
            return Diagnosis("wrong-unit", evidence, hint)
        if "<reading>" not in form:
            hint = "The reading itself belongs in the text, with a decimal or more."
            return _whole_numbers(said) or Diagnosis("wrong-values", evidence, hint)
        hint = "Three parts, each once, with a space between them: word, reading, unit."
        return Diagnosis("wrong-form", evidence, hint)
    return None


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("09a", _run_with_silences, _judge_silence, "notice the silence", 3, (
        "You need two callbacks: one for readings, and one that notices their absence.",
        "They share two facts: when the last reading came, and whether the sensor is lost.",
        "self.get_clock().now() is a time, and subtracting two times gives a duration, with "
        "nanoseconds. Or reset a timer at each reading.",
        "Before the first reading, no sensor can be lost. Publish only when the status you "
        "remember changes.",
    ), draw=draw_readings),
    Exercise("09b", _run_with_orders, _judge_work, "work, and keep beating", 3, (
        "No callback may take long: each one does a little, returns, and is called again.",
        "To wait, use timers. One of them can signal that the work on an order is done.",
        "A list holds the waiting orders: append new ones at its end; the first one is in "
        "progress.",
        "cancel() stops a timer, and reset() starts its period again; is_canceled() says "
        "whether it's stopped.",
    ), draw=draw_work),
    Exercise("09c", _run_everywhere, _judge_places, "a monitor for any place", 3, (
        "Whatever differs from place to place comes from outside; the code only provides the "
        "default.",
        "Look at the sensor on this page: declare a parameter once, with its default, and get "
        "its value by the same name.",
        "A name without a slash in front is completed by the node's namespace, and can be "
        "remapped there.",
        "Decide first: above one limit, below the other, or neither. Then make one text of the "
        "word, the reading and the unit.",
    ), draw=draw_places),
)  # fmt: skip

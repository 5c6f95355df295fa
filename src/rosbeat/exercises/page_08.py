"""Page 08, tune quality of service: the current mode, listen to everybody, count missed deadlines.

The scenarios know only what they feed. What a right node makes of it, and what a node makes of it
whose author misunderstood something, is simulated by the judges.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from itertools import accumulate, pairwise
from typing import Any, NamedTuple

from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.qos import POLICY_ALONE, incompatible, rule
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    Mismatch,
    Suspect,
    Track,
    agree,
    diagnose,
    grouped,
    samples_on,
    spelling,
    tells_apart,
    track,
    variants,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, Value, adding, feeder, listener, observe, publishing
from rosbeat.records import NANOSECONDS, Endpoint, Observation, QoS

_FLOAT, _STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
#: A time in seconds, and the word that was said then.
_Word = tuple[float, str]

# What the judges of this page share.


def _ends(observation: Observation, wire: Wire, kind: str) -> list[Endpoint]:
    ends = observation.graph.on(wire.topic, kind)
    return [end for end in ends if end.node == observation.subject]


def _seconds(span_ns: int) -> str:
    return f"{span_ns / NANOSECONDS:g} s"


def _described(qos: QoS) -> str:
    """Return a quality of service in words."""
    depth = "every message" if qos.history == "KEEP_ALL" else f"a depth of {qos.depth}"
    limits = {"deadline": qos.deadline_ns, "lifespan": qos.lifespan_ns}
    said = [f"a {name} of {_seconds(limit)}" for name, limit in limits.items() if limit]
    return ", ".join([qos.reliability, qos.durability, depth, *said])


def _suspects_by_policy(
    policies: Iterable[tuple[str, str, str]],
    model: Callable[..., Track],
    fed: Value,
    right: QoS,
    mine: QoS,
) -> list[Suspect]:
    """Return a suspect for each policy of an endpoint, given as field of `QoS`, mistake and hint.

    Each policy is tried alone, with all others as they should be. Then those that do harm alone
    are tried together: two wrong policies may hide each other.
    """
    alone = []
    for policy, mistake, hint in policies:
        qos = replace(right, **{policy: getattr(mine, policy)})
        said = f"{hint} {POLICY_ALONE}" if mine.policy_alone else hint
        alone.append(Suspect(mistake, said, partial(model, qos=qos)))
    harmful = [one for one in alone if not agree(one.model(fed), model(fed, right))]
    return alone + [replace(one, model=partial(model, qos=mine)) for one in harmful]


# 08a, the current mode: displays come at different times and log what they hear.

_MODE, _COMMAND = Wire("/mode", _STRING), Wire("/command", _STRING)
#: Modes of which three are commanded, besides the first one. The text counts as it is, with
#: its small and its capital letters.
_MODES = (
    *("driveOn", "stopNow", "dockA", "chargeB", "exploreAll"),
    *("followMe", "liftUp", "parkC", "turnLeft", "waitHere"),
)
_ONE_STORED = QoS(depth=1, durability="TRANSIENT_LOCAL")
_TEN_STORED = QoS(depth=10, durability="TRANSIENT_LOCAL")
#: Names of displays, and what each asks for.
_DISPLAYS = {
    "display_from_the_start": _ONE_STORED,
    "display_after_the_first_mode": _TEN_STORED,
    "display_of_what_is_new": QoS(depth=10),
    "display_in_between": _TEN_STORED,
    "display_of_one_word": _ONE_STORED,
    "display_that_is_in_no_hurry": QoS("BEST_EFFORT", depth=5),
    "display_at_the_end": _TEN_STORED,
}
_START = "idle"


class Commands(NamedTuple):
    """Hold what a mode keeper is fed.

    Attributes:
        said: Commands, with their times.
        joins: The second at which each display joins, in the order of the displays.
    """

    said: tuple[_Word, ...]
    joins: tuple[float, ...]


def draw_commands(draw: Draw) -> Commands:
    """Draw three modes, and when commands and displays come.

    Commands for the mode that there is are among them, the very first one too, and modes come
    back. No display joins when a command comes; the last one joins 21 s or more after it.
    """
    drive, stop, dock, *_ = draw.shuffled(_MODES)
    words = (_START, drive, drive, stop, _START, dock, drive)
    times = (
        *(draw.number(0.75, 0.5, 0.875), draw.number(1.0, 1.0, 1.5), draw.number(2.0, 1.75, 2.25)),
        *(draw.number(3.0, 2.75, 3.5), draw.number(5.0, 4.5, 5.25), draw.number(6.0, 5.5, 6.25)),
        draw.number(7.0, 6.5, 7.0),
    )
    first, second = draw.number(0.5, 0.125, 0.375), draw.number(2.5, 2.375, 2.625)
    third = draw.number(4.0, 3.75, 4.25)
    joins = (0.0, first, second, second, third, third, 28.0)
    return Commands(tuple(zip(times, words, strict=True)), joins)


def _run_mode_keeper(answer: Answer, commands: Commands) -> Observation:
    makes = [listener(name, _MODE, qos) for name, qos in _DISPLAYS.items()]
    displays = list(zip(commands.joins, makes, strict=True))
    late = [adding(joins, make) for joins, make in displays if joins]
    others = [make for joins, make in displays if not joins]
    steps = [*publishing(_COMMAND, commands.said), *late]
    return observe(answer, 30.0, others=others, steps=steps)


#: Whether a command is worth a message, from the mode, the command before and the command.
_IsNews = Callable[[str, str, str], bool]


def _keep_mode(
    commands: Commands,
    is_news: _IsNews = lambda mode, _, command: command != mode,
    begins: bool = True,
) -> Track:
    """Return what a mode keeper publishes, by time in seconds; with `begins` its first mode."""
    said: dict[float, tuple[str, ...]] = {0.0: (_START,)} if begins else {}
    mode, before = _START, ""
    for at, command in commands.said:
        if is_news(mode, before, command):
            mode = command
            said[at] = (mode,)
        before = command
    return said


_REPEATED = "A command for the current mode changes nothing, so it needs no message."
_UNASKED = "No command came then. What repeats the mode? The publisher stores it for late displays."
_CHANGE = "A command for another mode is a change. Does your node keep it, and publish it?"
_BEGIN = f"Publish {_START!r} in the constructor, as soon as there is something to publish with."
_FIRST_MODE = f"Before the first command there is a mode, too: {_START!r}."
_COMPARED = (
    "With which mode does your node compare a command: the one it started with, or the current one?"
)
_EACH_CHANGE = "Each change counts, not only the first. What does your node remember of the last?"
KEEPERS = variants(_keep_mode, (
    ("status-repeated", _REPEATED, {"is_news": lambda *_: True}),
    ("status-repeated", _FIRST_MODE, {"is_news": lambda _, before, command: command != before}),
    ("status-repeated", _COMPARED, {"is_news": lambda _, __, command: command != _START}),
    ("change-missing", _EACH_CHANGE, {"is_news": lambda mode, _, __: mode == _START}),
    ("change-missing", _CHANGE, {"is_news": lambda *_: False}),
    ("wrong-start", _BEGIN, {"begins": False}),
))  # fmt: skip


class Modes(NamedTuple):
    """Hold what displays may hear: words with their times, and when each display joins."""

    words: Sequence[_Word]
    joins: Sequence[float]


def _heard_by_displays(modes: Modes, qos: QoS) -> Track:
    """Return what each display hears of some words, by its place in `_DISPLAYS`."""
    words, heard = modes.words, dict[int, tuple[str, ...]]()
    for number, (joins, asks) in enumerate(zip(modes.joins, _DISPLAYS.values(), strict=True)):
        if incompatible(qos, asks):
            continue
        stores = "TRANSIENT_LOCAL" == qos.durability == asks.durability
        before = [
            word
            for at, word in words
            if joins and at <= joins and stores
            if not qos.lifespan_ns or (joins - at) * NANOSECONDS < qos.lifespan_ns
        ]
        depth = asks.depth if qos.history == "KEEP_ALL" else min(qos.depth, asks.depth)
        live = [word for at, word in words if at > joins or not joins]
        heard[number] = (*before[-depth:], *live)
    return heard


_STORE = (
    "The publisher has to store its messages for late-joining "
    "subscriptions. Which policy does that?"
)
_DEPTH = (
    "For late-joining subscriptions, the publisher stores as many "
    "messages as its depth. How many of them are still true?"
)
_EXPIRES = (
    "A lifespan drops older messages. A mode stays valid until the next "
    "one, however long that takes."
)
_MODE_POLICIES = (
    ("durability", "not-kept", _STORE),
    ("reliability", "qos-mismatch", f"The rule of reliability: {rule('reliability')}."),
    ("depth", "old-words-too", _DEPTH),
    ("history", "old-words-too", _DEPTH),
    ("lifespan_ns", "lifespan-too-short", _EXPIRES),
)


def offer_suspects(modes: Modes, offers: QoS) -> list[Suspect]:
    """Return what each policy that a publisher of these words offers may have done."""
    return _suspects_by_policy(_MODE_POLICIES, _heard_by_displays, modes, _ONE_STORED, offers)


def _judge_mode_keeper(observation: Observation, commands: Commands) -> Verdict:
    return (
        diagnose_unpublished(observation, _MODE)
        or diagnose_unheard(observation, _COMMAND)
        or _diagnose_modes(track(observation, _MODE, str), commands)
        or _diagnose_displays(observation, commands.joins)
        or passed(
            f"{len(_DISPLAYS)} displays came at different times. Each one that asked for it got "
            "the mode of that moment, and only that one."
        )
    )


def _diagnose_modes(done: Track, commands: Commands) -> Diagnosis | None:
    right = _keep_mode(commands)

    def describe(mismatch: Mismatch) -> Diagnosis:
        said, due = _listed(mismatch.done), _listed(mismatch.right)
        evidence = (
            f"At {mismatch.at:g} s the node published {said} on /mode; {due} should have been."
        )
        modes = [word for at in sorted(right) if at <= mismatch.at for word in right[at]]
        if not mismatch.right:
            modes = [*modes[:-1], modes[-1], modes[-1]]
        if mismatch.at == 0 and mismatch.done[:1] != mismatch.right:
            return Diagnosis("wrong-start", evidence, _BEGIN)
        if not mismatch.done:
            return Diagnosis("change-missing", evidence, _CHANGE)
        if set(mismatch.right) <= set(mismatch.done) <= set(modes[-2:]):
            is_asked = mismatch.at in dict(commands.said)
            return Diagnosis("status-repeated", evidence, _REPEATED if is_asked else _UNASKED)
        hint = spelling(mismatch.done[0], modes) or "The mode is the command's text, unchanged."
        return Diagnosis("wrong-values", evidence, hint)

    return diagnose(commands, done, right, KEEPERS, describe)


def _diagnose_displays(observation: Observation, joining: Sequence[float]) -> Diagnosis | None:
    words = [(one.time, str(one.value)) for one in samples_on(observation, _MODE)]
    modes = Modes(words, joining)
    numbers = {name: number for number, name in enumerate(_DISPLAYS)}
    # A display logs what it hears; rclpy warns in its name if it cannot hear the publisher.
    lines = [log for log in observation.logs if log.name in numbers and log.level == "INFO"]
    done = grouped((numbers[log.name], log.text) for log in lines)
    # A publisher that was destroyed is no longer in the graph.
    offers = next((end.qos for end in _ends(observation, _MODE, "publisher")), _ONE_STORED)

    def describe(mismatch: Mismatch) -> Diagnosis:
        joins, asks = joining[mismatch.at], [*_DISPLAYS.values()][mismatch.at]
        evidence = (
            f"A display joined at {joins:g} s and asked for {asks.reliability}, "
            f"{asks.durability}. It heard {_listed(mismatch.done)}, and should have heard "
            f"{_listed(mismatch.right)}. Your publisher offers {_described(offers)}."
        )
        hint = "Compare what the publisher offers with what such a display asks for."
        return Diagnosis(UNKNOWN, evidence, hint)

    right = _heard_by_displays(modes, _ONE_STORED)
    return diagnose(modes, done, right, offer_suspects(modes, offers), describe)


def _listed(words: Iterable[str]) -> str:
    return ", ".join(map(repr, words)) or "nothing"


# 08b, listen to everybody: two sensors, and a node that is away for a while.

_READING, _ARCHIVE = Wire("/reading", _FLOAT), Wire("/archive", _FLOAT)
_OFFERED = {"/new_sensor": QoS("BEST_EFFORT", depth=5), "/old_sensor": QoS(depth=5)}
#: Seconds for which the archive is away; that is told on the page.
_ABSENCE = 8.0


class Sensors(NamedTuple):
    """Hold what an archive is fed, and when it is away.

    Attributes:
        new: What the new sensor publishes, one reading a second.
        old: What the old sensor publishes.
        leaves: The second at which the archive begins to be away.
    """

    new: tuple[float, ...]
    old: tuple[float, ...]
    leaves: float

    @property
    def returns(self) -> float:
        """Return the second at which the archive is back."""
        return self.leaves + _ABSENCE

    def by_sensor(self) -> dict[str, tuple[float, ...]]:
        """Return the readings by the node that publishes them."""
        return {"/new_sensor": self.new, "/old_sensor": self.old}

    def readings(self) -> dict[tuple[float, str], float]:
        """Return the value of each reading, by the second at which it comes, and the node."""
        return {
            (float(at), node): value
            for node, values in self.by_sensor().items()
            for at, value in enumerate(values, 1)
        }


_COUNT = 20
_ROOMY = QoS("BEST_EFFORT", depth=2 * _COUNT)


def draw_sensors(draw: Draw) -> Sensors:
    """Draw readings, some of them below 0, of which none follows from another.

    No number comes twice, except that once both sensors read the same at the same moment.
    A float32 holds each of them exactly.
    """
    numbers = range(_COUNT)
    new = tuple(20.0 + number * number % 61 / 8 for number in numbers)
    old = tuple((number - 10) / 8 for number in numbers)
    if not draw.is_page:
        drawn = [number / 8 for number in draw.shuffled(range(-200, 200))]
        new, old = tuple(drawn[:_COUNT]), tuple(drawn[_COUNT : 2 * _COUNT])
    return Sensors(new, (*old[:1], new[1], *old[2:]), draw.number(5.5, 2.5, 10.5, 1.0))


def _run_archive(answer: Answer, fed: Sensors) -> Observation:
    from rosbeat.ros.scenario import Pause, Resume

    sensors = [
        feeder(name.strip("/"), _READING, values, qos=_OFFERED[name])
        for name, values in fed.by_sensor().items()
    ]
    steps = [Pause(fed.leaves), Resume(fed.returns)]
    return observe(answer, _COUNT + 1.0, others=sensors, steps=steps)


def _copies(kept: Sequence[float], fed: Sensors) -> Track:
    """Return the copies of each reading; those of equal readings are shared out in turns."""
    counts, found = Counter(kept), {}
    for one, value in fed.readings().items():
        turns = [key for key, other in fed.readings().items() if other == value]
        times = len(range(turns.index(one), counts[value], len(turns)))
        if times:
            found[one] = (value,) * times
    return found


def _without_repetitions(fed: Sensors) -> Track:
    """Return what an archive keeps that takes equal readings for one."""
    return _copies(list(dict.fromkeys(fed.readings().values())), fed)


def _archive(fed: Sensors, qos: QoS | Sequence[QoS], most: int = 99) -> Track:
    """Return each reading as often as an archive with these subscriptions has it, or `most`."""
    counts: Counter[tuple[float, str]] = Counter()
    readings = fed.readings()
    for asks in [qos] if isinstance(qos, QoS) else qos:
        heard = sorted(one for one in readings if not incompatible(_OFFERED[one[1]], asks))
        waiting = [one for one in heard if fed.leaves < one[0] <= fed.returns]
        counts.update(one for one in heard if one not in waiting)
        depth = len(waiting) if asks.history == "KEEP_ALL" else asks.depth
        counts.update(
            one
            for one in waiting[-depth:]
            if not asks.lifespan_ns or (fed.returns - one[0]) * NANOSECONDS < asks.lifespan_ns
        )
    return _copies([readings[one] for one in counts for _ in range(min(counts[one], most))], fed)


_QUEUE = (
    "How many readings come while it is away, from all sensors together? They all wait in one "
    "queue."
)
_EQUAL = "Two sensors may report the same value, and equal readings are still two readings."
_TWICE = "One subscription is enough if it asks for no more than the least that any sensor offers."
_WAITS = "A lifespan drops readings that have waited longer. How long may a reading have to wait?"
_READING_POLICIES = (
    ("reliability", "qos-mismatch", f"The rule of reliability: {rule('reliability')}."),
    ("durability", "qos-mismatch", f"The rule of durability: {rule('durability')}."),
    ("deadline_ns", "qos-mismatch", f"The rule of deadline: {rule('deadline')}."),
    ("depth", "queue-too-short", _QUEUE),
    ("lifespan_ns", "lifespan-too-short", _WAITS),
)


def archive_suspects(fed: Sensors, asks: Sequence[QoS]) -> list[Suspect]:
    """Return what the policies of an archive's subscriptions may have done."""
    if len(asks) == 1:
        return [
            *_suspects_by_policy(_READING_POLICIES, _archive, fed, _ROOMY, asks[0]),
            Suspect("change-missing", _EQUAL, _without_repetitions),
        ]
    return [
        Suspect("heard-twice", _TWICE, partial(_archive, qos=asks)),
        Suspect("queue-too-short", _QUEUE, partial(_archive, qos=asks, most=1)),
        Suspect("change-missing", _EQUAL, _without_repetitions),
    ]


def _judge_archive(observation: Observation, fed: Sensors) -> Verdict:
    sensors, count = len(fed.by_sensor()), len(fed.readings())
    return (
        diagnose_unheard(observation, _READING)
        or diagnose_unpublished(observation, _ARCHIVE)
        or _diagnose_archive(observation, fed)
        or passed(
            f"{sensors} sensors, {count} readings, {count} in the archive: it heard everybody, and "
            "nothing was lost while it was away."
        )
    )


def _diagnose_archive(observation: Observation, fed: Sensors) -> Diagnosis | None:
    readings = fed.readings()
    kept = [float(one.value) for one in samples_on(observation, _ARCHIVE)]
    # Of a number that no sensor has published nobody can say which reading it was.
    strange = next((value for value in kept if value not in readings.values()), None)
    if strange is not None:
        return Diagnosis(
            "wrong-values",
            f"{strange:g} is in the archive, and no sensor has published it.",
            "Each reading goes into the archive as it is.",
        )
    done = _copies(kept, fed)
    asks = [end.qos for end in _ends(observation, _READING, "subscription")]

    def describe(mismatch: Mismatch) -> Diagnosis:
        (at, node), times = mismatch.at, len(mismatch.done)
        found = f"in the archive {times} times" if times else "not in the archive"
        missed = len(readings) - len(done)
        evidence = (
            f"The reading {readings[at, node]:g}, which {node} published at {at:g} s, is {found}, "
            f"and should be there once. {missed} of {len(readings)} readings are missing there; "
            f"the node was away from {fed.leaves:g} s to {fed.returns:g} s. Your subscription asks "
            f"for {' and '.join(map(_described, asks)) or 'nothing'}."
        )
        return Diagnosis("wrong-values", evidence, "Publish each reading once, when it comes.")

    wrong = diagnose(fed, done, _archive(fed, _ROOMY), archive_suspects(fed, asks), describe)
    return wrong or _diagnose_order(kept, fed)


def _diagnose_order(kept: Sequence[float], fed: Sensors) -> Diagnosis | None:
    """Compare the order; what turns it round is the node's own doing, whatever its policies."""
    for name, values in fed.by_sensor().items():
        left = iter(kept)
        if not all(value in left for value in values):
            return Diagnosis(
                "wrong-values",
                f"The readings of {name} are in the archive in another order than it published "
                "them.",
                "What came first waits at the front. Does something turn the order round?",
            )
    return None


# 08c, count missed deadlines: readings that stop for a while.

_TEMPERATURE, _MISSED = Wire("/temperature", _FLOAT), Wire("/missed", "std_msgs/msg/Int32")
#: The deadline that the sensor offers, in seconds.
LIMIT = 2.0
#: How late a node may be that looks at a clock now and then, and any other, in seconds.
_LATE, _EXACT = 0.45, 1e-6


class Silences(NamedTuple):
    """Hold when readings come, and when the run ends, in seconds."""

    times: tuple[float, ...]
    end: float


def draw_silences(draw: Draw) -> Silences:
    """Draw readings a second apart, or nearly two; a long silence, a short one, one to the end.

    The first reading is late: what was not heard yet cannot fall silent.

    A silence begins at a full second or half of one: so a node that looks at the clock twice a
    second is in time.
    """
    return draw.until(
        partial(_silences, draw), lambda fed: tells_apart(fed, _watch, _WITH_A_LATE_DEADLINE)
    )


def _silences(draw: Draw) -> Silences:
    def seconds(usual: int) -> tuple[float, ...]:
        return (1.0,) * draw.whole(usual, 1, 5)

    nearly = draw.shuffled((1.75, 1.25))
    gaps = (
        *(*seconds(2), *nearly, 6.5 + draw.whole(3, 2, 9), *seconds(2)),
        *(draw.one_of(2.5, 3.5), draw.one_of(7.0, 6.5, 7.5, 8.5, 9.5, 10.5)),
    )
    *times, end = accumulate(gaps, initial=draw.number(5.0, 4.5, 12.0, 0.5))
    return Silences(tuple(times), end)


def _run_watchdog(answer: Answer, fed: Silences) -> Observation:
    qos = QoS(deadline_ns=round(LIMIT * NANOSECONDS))
    # The value does not matter: a reading of 0 is a reading, although Python treats 0 as false.
    readings = [(at, 0.0 if number > 2 else 21.5) for number, at in enumerate(fed.times)]
    return observe(answer, fed.end, steps=publishing(_TEMPERATURE, readings, qos))


#: What is published at a missed deadline, from how many were missed in a row, and in all.
_Number = Callable[[int, int], "int | None"]


def _watch(
    fed: Silences,
    number: _Number = lambda in_a_row, _: in_a_row,
    limit: float = LIMIT,
    restarts: bool = True,
    at_readings: bool = False,
) -> Track:
    """Return the messages of a watchdog, by their order.

    Its time limit begins anew with each reading, or never `restarts`. `at_readings` it publishes 0.
    """
    spans = pairwise([*fed.times, fed.end]) if restarts else [(0.0, fed.end)]
    misses = [
        (begin + limit * (count + 1), True)
        for begin, end in spans
        for count in range(int((end - begin - _EXACT) / limit))
    ]
    in_a_row, said = 0, []
    signals = sorted([*misses, *((at, False) for at in fed.times)], key=lambda one: one[0])
    for at, is_miss in signals:
        in_a_row = in_a_row + 1 if is_miss else 0
        in_all = sum(missed for earlier, missed in signals if earlier <= at)
        found = number(in_a_row, in_all) if is_miss else 0 if at_readings else None
        said += [] if found is None else [(at, found)]
    return {order: (one,) for order, one in enumerate(said)}


_DUE = f"A deadline is missed when nothing has come for {LIMIT:g} s."
_RESTART = f"{_DUE} Whatever measures the silence must start again at each reading."
_EVENTS = "The event repeats after each further period of silence, and each one counts."
_TOTAL = "A reading starts the count again. The event's total_count is never reset."
_IN_A_ROW = "How many have been missed in a row? Each further one is one more."
_FROM_ONE = "The first missed deadline is number 1: count first, and then publish."
_NO_NEWS = "Publish nothing at a reading: only a missed deadline is worth a message."

WATCHDOGS = variants(_watch, (
    ("wrong-values", _TOTAL, {"number": lambda _, in_all: in_all}),
    ("wrong-values", _IN_A_ROW, {"number": lambda *_: 1}),
    ("wrong-values", _FROM_ONE, {"number": lambda in_a_row, _: in_a_row - 1}),
    ("change-missing", _EVENTS, {"number": lambda in_a_row, _: 1 if in_a_row == 1 else None}),
    ("alert-too-many", _NO_NEWS, {"at_readings": True}),
    ("wrong-deadline", _RESTART, {"restarts": False}),
))  # fmt: skip


def deadline_suspects(asks: Sequence[QoS]) -> list[Suspect]:
    """Return the watchdogs that measure with these deadlines; a shorter one is not connected."""
    limits = [qos.deadline_ns / NANOSECONDS for qos in asks]
    limits = [limit for limit in limits if limit >= LIMIT]
    return [Suspect("wrong-deadline", _DUE, partial(_watch, limit=limit)) for limit in limits]


_WITH_A_LATE_DEADLINE = (*WATCHDOGS, *deadline_suspects([QoS(deadline_ns=3 * NANOSECONDS)]))


def _judge_watchdog(observation: Observation, fed: Silences) -> Verdict:
    numbers = [one[0][1] for one in _watch(fed).values()]
    return (
        diagnose_unheard(observation, _TEMPERATURE)
        or _unmeasured(observation)
        or diagnose_unpublished(observation, _MISSED)
        or _diagnose_watch(observation, fed)
        or passed(
            f"{len(fed.times)} readings, {len(numbers)} missed deadlines, {max(numbers)} of them "
            "in a row."
        )
    )


def _diagnose_watch(observation: Observation, fed: Silences) -> Diagnosis | None:
    said = [(one.time, one.value) for one in samples_on(observation, _MISSED)]
    asks = [end.qos for end in _ends(observation, _TEMPERATURE, "subscription")]
    mine = [one for one in observation.callbacks if one.node == observation.subject]
    late = _LATE if any(one.kind == "timer" for one in mine) else _EXACT

    def in_time(found: tuple[float, Any], due: tuple[float, Any]) -> bool:
        return found[1] == due[1] and due[0] - _EXACT <= found[0] <= due[0] + late

    def describe(mismatch: Mismatch) -> Diagnosis:
        found = _describe_number(mismatch, late)
        deadline = next((_seconds(qos.deadline_ns) for qos in asks if qos.deadline_ns), "")
        own = f" Your subscription has a deadline of {deadline}." if deadline else ""
        return replace(found, evidence=found.evidence + own)

    done: Track = {order: (one,) for order, one in enumerate(said)}
    watchdogs = [*WATCHDOGS, *deadline_suspects(asks)]
    return diagnose(fed, done, _watch(fed), watchdogs, describe, in_time)


def _describe_number(mismatch: Mismatch, late: float) -> Diagnosis:
    """Describe the first message that is not as it should be."""
    if not mismatch.done:
        ((due, wanted),) = mismatch.right
        nth = {1: "first", 2: "second", 3: "third"}.get(wanted, f"{wanted}th")
        evidence = f"A deadline was missed at {due:g} s, the {nth} in a row, and nothing "
        return Diagnosis("change-missing", f"{evidence}was published.", _EVENTS)
    ((at, number),) = mismatch.done
    evidence = f"Message {mismatch.at + 1} on /missed was {number}, at {at:g} s; "
    if not mismatch.right:
        return Diagnosis(
            "alert-too-many", f"{evidence}nothing more should have been published.", _NO_NEWS
        )
    ((due, wanted),) = mismatch.right
    evidence += f"{wanted} should have been published, at {due:g} s."
    if due - _EXACT <= at <= due + late:
        return Diagnosis("wrong-values", evidence, _IN_A_ROW)
    if at > due and number != wanted:
        return Diagnosis("change-missing", evidence, _EVENTS)
    return Diagnosis("wrong-deadline", evidence, _RESTART if at < due else _DUE)


def _unmeasured(observation: Observation) -> Diagnosis | None:
    """Say why the node did not notice that readings stopped.

    It said nothing, and all silent models are alike. So this reads what the node has made.
    """
    if samples_on(observation, _MISSED):
        return None
    mine = [end for end in observation.graph.endpoints if end.node == observation.subject]
    calls = [one for one in observation.callbacks if one.node == observation.subject]
    if any(one.kind in ("event", "timer") for one in calls):
        return None
    bounded = {end.kind: end for end in mine if end.qos.deadline_ns}
    if "subscription" in bounded:
        deadline_ns = bounded["subscription"].qos.deadline_ns
        evidence = f"The subscription has a deadline of {_seconds(deadline_ns)}"
        if deadline_ns > LIMIT * NANOSECONDS:
            return Diagnosis("wrong-deadline", f"{evidence}.", _DUE)
        return Diagnosis(
            "deadline-unheard",
            f"{evidence}. It was missed, and no callback of your node was told.",
            "create_subscription takes event_callbacks: what is called if the deadline is missed?",
        )
    if "publisher" in bounded:
        return Diagnosis(
            "deadline-wrong-side",
            f"The publisher on {bounded['publisher'].name} has a deadline, and the subscription "
            "to /temperature has none.",
            "The node waits for readings. Which of its endpoints receives them?",
        )
    return Diagnosis(
        "no-deadline",
        "Readings stopped coming, and nothing in the node measures how long: its subscription has "
        "no deadline.",
        "A deadline is a part of the QoS that the subscription asks for.",
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("08a", _run_mode_keeper, _judge_mode_keeper, "the current mode", 2, (
        "There are two questions: does a late-joining subscription get old messages at all, "
        "and if so, how many? A policy answers the first, and the depth answers the second.",
        "QoSProfile(depth=..., durability=...) creates a profile. The policies that you leave "
        "out keep their defaults, such as reliable.",
        "In the callback, compare the command with self.mode, and do nothing if they are "
        "the same.",
    ), draw=draw_commands),
    Exercise("08b", _run_archive, _judge_archive, "listen to everybody", 2, (
        "There are two decisions: what can you ask for, so that no sensor is left out? And how "
        "many readings have to wait?",
        "Ask for no more than the least that any sensor offers. The other sensor offers more, "
        "and that's compatible.",
        "Both sensors fill the same queue. Count the readings of both in eight seconds.",
    ), draw=draw_sensors),
    Exercise("08c", _run_watchdog, _judge_watchdog, "count missed deadlines", 3, (
        "You need three things: a deadline in the QoS of the subscription, a callback for its "
        "event, and a variable that counts.",
        "QoSProfile takes deadline=Duration(...). Pass the method, without parentheses, as "
        "SubscriptionEventCallbacks(deadline=...).",
        "The event's total_count goes on from one silence to the next. Your own count begins "
        "anew with each reading.",
    ), draw=draw_silences),
)  # fmt: skip

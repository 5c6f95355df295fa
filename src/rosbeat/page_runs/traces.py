"""Draw an answer's behaviour over time beside that of the published solution.

A trace is a small part of an answer's evidence: some messages of each topic, the first log lines,
or the content of a terminal. It is kept after the answer has been judged, so that a page can show
it. The picture is SVG embedded in the page: it uses the page's colours, in both themes and in
print, and has a text description.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice
from math import isfinite
from typing import Any

from markupsafe import Markup

from rosbeat.errors import RecordError
from rosbeat.exercises.scenarios import Report, TypedIn
from rosbeat.records import Observation, ProgramRun, Sample
from rosbeat.records_json import from_json, to_json
from rosbeat.viz.text_format import count, rounded, sentence_case

#: What a lane shows: what the node was sent, what it published, what it logged.
HEARD, PUBLISHED, LOGGED = "heard", "published", "logged"
#: Lanes of a trace, moments of a lane, letters of a name, of a word, and of a text.
_LANES, _MOMENTS, _NAME, _WORD, _TEXT = 6, 90, 80, 40, 2_000


@dataclass(frozen=True)
class Lane:
    """Hold what happened in one place.

    Attributes:
        role: `heard`, `published` or `logged`.
        name: The topic's name; of log lines the name of the logger.
        count: How many messages there were.
        times: When those that are kept came, in seconds.
        values: Their values, if all of them are finite numbers.
        words: Otherwise their values in words.
    """

    role: str
    name: str
    count: int
    times: tuple[float, ...]
    values: tuple[float, ...] = ()
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class Trace:
    """Hold what an answer did.

    Attributes:
        seconds: How long it was observed.
        lanes: What happened in each place, the answer's own doing first.
        text: What a terminal shows, or what a function returned.
    """

    seconds: float = 0.0
    lanes: tuple[Lane, ...] = ()
    text: str = ""


# From evidence to a trace.


def trace_of(seen: Any) -> str:  # noqa: ANN401 - any kind of evidence
    """Return the trace of an answer as JSON; empty if there is nothing to show.

    Evidence that somebody has forged may hold numbers that are none of ROS; it has no trace.
    """
    try:
        trace = _trace(seen)
    except (ValueError, TypeError, OverflowError, RecursionError):
        return ""
    return to_json(trace) if trace.lanes or trace.text else ""


@lru_cache(maxsize=64)  # of published solutions, which each page shows
def read_trace(text: str) -> Trace | None:
    """Return what `trace_of` wrote; None if the text is empty or is none."""
    try:
        return from_json(Trace, text, "trace")
    except RecordError:
        return None


def _trace(seen: Any) -> Trace:  # noqa: ANN401 - any kind of evidence
    if isinstance(seen, Observation):
        return Trace(seen.time, tuple(islice(_lanes(seen), _LANES)))
    if isinstance(seen, TypedIn):
        return Trace(text=seen.text[-_TEXT:])
    if isinstance(seen, ProgramRun):
        return Trace(text=seen.output[-_TEXT:])
    if isinstance(seen, Report):
        return Trace(text=(seen.result or seen.problem)[:_TEXT])
    runs = getattr(seen, "runs", None)  # several trials, of which the first says most
    if isinstance(runs, dict) and runs:
        return _trace(next(iter(runs.values())))
    return Trace()


def _lanes(seen: Observation) -> Iterator[Lane]:
    own = [one for one in seen.samples if seen.subject in (one.node, "")]
    yield from _by_topic(PUBLISHED, own)
    logger = seen.subject.lstrip("/").replace("/", ".")
    lines = [one for one in seen.logs if seen.subject == "" or one.name == logger]
    if lines:
        kept = _some(lines)
        words = tuple(one.text[:_WORD] for one in kept)
        yield Lane(LOGGED, logger[:_NAME], len(lines), tuple(one.time for one in kept), words=words)
    ends = (end for end in seen.graph.endpoints if end.kind == "subscription")
    heard = {end.name for end in ends if end.node == seen.subject}
    yield from _by_topic(
        HEARD, [one for one in seen.samples if one.topic in heard and one.node != seen.subject]
    )


def _by_topic(role: str, samples: Sequence[Sample]) -> Iterator[Lane]:
    found: dict[str, list[Sample]] = {}
    for one in samples:
        found.setdefault(one.topic, []).append(one)
    for topic, some in islice(found.items(), _LANES):
        kept = _some(some)
        times = tuple(one.time for one in kept)
        values = [one.value for one in kept]
        if all(type(one) in (int, float) and isfinite(one) for one in values):
            yield Lane(
                role, topic[:_NAME], len(some), times, tuple(round(float(one), 4) for one in values)
            )
        else:
            yield Lane(role, topic[:_NAME], len(some), times, words=tuple(map(_in_a_word, values)))


def _some(items: Sequence[Any]) -> list[Any]:
    """Return some of many items, the first and the last among them, at equal distances."""
    if len(items) <= _MOMENTS:
        return list(items)
    step = (len(items) - 1) / (_MOMENTS - 1)
    return [items[round(n * step)] for n in range(_MOMENTS)]


def _in_a_word(value: Any) -> str:  # noqa: ANN401 - what a message may hold
    text = value if isinstance(value, str) else json.dumps(value, default=str)
    return text[:_WORD]


# From traces to a picture.

_WIDTH, _LEFT, _RIGHT = 640.0, 8.0, 632.0
#: Heights of a heading, of a band of numbers, of a band of words, and of the time axis.
_HEADING, _NUMBERS, _WORDS, _AXIS = 20.0, 54.0, 26.0, 22.0
#: Width of a letter, from which is known which words have room.
_LETTER = 6.6
_HEADINGS = {
    PUBLISHED: "published on {}",
    LOGGED: "log lines of {}",
    HEARD: "input: what others published on {}",
}
_LABELS = {"own": "this answer", "expected": "published solution", "input": ""}


@dataclass(frozen=True)
class Band:
    """Place what one answer did in one place, as a strip of a picture.

    Attributes:
        kind: `own`, `expected` or `input`; the name of its colour and of its mark.
        top: Where it begins, in units of the picture.
        height: Its height.
        marks: Its marks as a path of SVG: a line without length is a dot.
        words: Words beside the marks, with where they begin.
    """

    kind: str
    label: str
    top: float
    height: float
    marks: str = ""
    words: tuple[tuple[float, str], ...] = ()


@dataclass(frozen=True)
class Picture:
    """Hold a picture, ready for `templates/trace.html`.

    Attributes:
        height: Its height; its width is 640.
        headings: What each lane shows, with the height at which it is written.
        ticks: The time axis: places and labels.
        said: What it shows, in words.
        own: What a terminal shows after this answer.
        expected: What it shows after the published solution.
    """

    height: float
    headings: tuple[tuple[float, str], ...]
    bands: tuple[Band, ...]
    ticks: tuple[tuple[float, str], ...]
    said: str
    own: str = ""
    expected: str = ""


def picture(own: str, expected: str = "") -> Picture | None:
    """Return the picture of an answer beside that of the published solution.

    Returns:
        The picture; None if there is nothing to show.
    """
    mine, right = read_trace(own), read_trace(expected)
    if mine is None:
        return None
    seconds = max(mine.seconds, right.seconds if right else 0.0, 1e-9)
    headings, bands, said, top = [], [], [], 0.0
    for role, name, lanes in _places(mine, right):
        headings.append((top + _HEADING - 6, _HEADINGS[role].format(name)))
        top += _HEADING
        low, high = _range(lane for lane in lanes.values() if lane)
        for kind, lane in lanes.items():
            band = _band(kind, lane, top, seconds, (low, high))
            bands.append(band)
            top += band.height
        said.append(_said(role, name, lanes))
    ticks = _ticks(seconds) if bands else ()
    return Picture(top + _AXIS if bands else 0.0, tuple(headings), tuple(bands), ticks,
                   " ".join(said), mine.text, right.text if right else "")  # fmt: skip


def _places(mine: Trace, right: Trace | None) -> Iterator[tuple[str, str, dict[str, Lane | None]]]:
    """Yield what a picture shows: role, name, and by kind what was done there."""
    own = {(one.role, one.name): one for one in mine.lanes}
    wanted = {(one.role, one.name): one for one in right.lanes} if right else {}
    logger = next((name for role, name in wanted if role == LOGGED), "")
    for role, name in dict.fromkeys((*own, *wanted)):
        if role == HEARD:
            yield role, name, {"input": own.get((role, name)) or wanted.get((role, name))}
        elif role == LOGGED:  # a node may have any name
            if (role, name) in own or not any(one == LOGGED for one, _ in own):
                lane = wanted.get((LOGGED, logger))
                yield role, name, _pair(right, lane, own.get((role, name)))
        else:
            yield role, name, _pair(right, wanted.get((role, name)), own.get((role, name)))


def _pair(right: Trace | None, wanted: Lane | None, own: Lane | None) -> dict[str, Lane | None]:
    return {"expected": wanted, "own": own} if right else {"own": own}


def _range(lanes: Iterable[Lane]) -> tuple[float, float]:
    values = [value for lane in lanes for value in lane.values]
    return (min(values), max(values)) if values else (0.0, 0.0)


def _band(
    kind: str, lane: Lane | None, top: float, seconds: float, span: tuple[float, float]
) -> Band:
    """Place the marks of a lane; numbers by their value, words in a line."""
    if lane is None or not lane.times:
        return Band(kind, f"{_LABELS[kind]}: nothing", top, _WORDS)
    across = [_LEFT + (_RIGHT - _LEFT) * min(at / seconds, 1.0) for at in lane.times]
    if lane.words:
        words = _fitting(across, lane.words)
        return Band(
            kind, _LABELS[kind], top, _WORDS + 14, _dots(across, [top + 22] * len(across)), words
        )
    low, high = span
    ups = [(value - low) / (high - low) if high > low else 0.5 for value in lane.values]
    inner, base = _NUMBERS - 24, top + 18
    some = f"{rounded(min(lane.values))} to {rounded(max(lane.values))}"
    label = f"{_LABELS[kind]}: {some}".removeprefix(": ")
    return Band(kind, label, top, _NUMBERS, _dots(across, [base + inner * (1 - up) for up in ups]))


def _dots(across: Iterable[float], down: Iterable[float]) -> str:
    places = zip(across, down, strict=True)
    return Markup("".join(f"M{x:.1f} {y:.1f}h0" for x, y in places))  # whole in any length


def _fitting(across: Sequence[float], words: Sequence[str]) -> tuple[tuple[float, str], ...]:
    """Return the words that differ from the one before, with their places, if there is room."""
    found: list[tuple[float, str]] = []
    free = _LEFT
    for place, word, before in zip(across, words, ("", *words), strict=False):
        left = max(_LEFT, min(place, _RIGHT - _LETTER * len(word)))
        if word != before and left >= free:
            found.append((left, word))
            free = left + _LETTER * len(word) + 8
    return tuple(found)


def _ticks(seconds: float) -> tuple[tuple[float, str], ...]:
    step = next(
        (one for one in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60, 120, 300, 600, 1800, 3600)
         if seconds / one <= 10), seconds)  # fmt: skip
    many = int(seconds / step + 1e-9)
    return tuple(
        (_LEFT + (_RIGHT - _LEFT) * n * step / seconds, f"{n * step:g} s") for n in range(many + 1)
    )


def _said(role: str, name: str, lanes: dict[str, Lane | None]) -> str:
    """Say a lane of a picture in words."""
    parts = [f"{_LABELS[kind]}: {_doing(lane)}".removeprefix(": ") for kind, lane in lanes.items()]
    return f"{sentence_case(_HEADINGS[role].format(name))}. {'; '.join(parts)}."


def _doing(lane: Lane | None) -> str:
    if lane is None or not lane.times:
        return "nothing"
    what = count(lane.count, "line" if lane.role == LOGGED else "message")
    when = f"from {lane.times[0]:g} s to {lane.times[-1]:g} s"
    if lane.values:
        return f"{what} {when}, values from {rounded(min(lane.values))} to " + rounded(
            max(lane.values)
        )
    first = list(dict.fromkeys(lane.words))[:5]
    return f"{what} {when}, the first ones: {', '.join(first)}"

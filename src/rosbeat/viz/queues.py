"""Draw a subscription's queue: what waits in it, what is taken, what is dropped."""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

from matplotlib.patches import Rectangle

from rosbeat.errors import PictureError, called_as
from rosbeat.records import Endpoint, Observation, QueueStep, queue_steps
from rosbeat.viz import theme
from rosbeat.viz.arguments import Observed, known_name, observed, topic_names
from rosbeat.viz.canvas import ROOM, Canvas, Entry, blank, text_width
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import count, listing, not_shown, ranges, seconds

#: More moments than this have no room side by side.
MOST_MOMENTS = 220

#: The lines of an almost empty queue are as long as if so many moments were drawn.
_FEWEST = 8
_CELL, _WIDEST, _ROOMY = 22.0, 34.0, 17.0
_HEAD, _FOOT = 12.0, 56.0
_WAITS = theme.Style(theme.BLUE, "s", "")
_TAKEN = theme.Style(theme.TAKEN, "v", "")
_DROPPED = theme.Style(theme.DROPPED, "X", "")
_LIMIT = theme.Style(theme.INK, "", "--")


@dataclass(frozen=True)
class Moment:
    """Hold one column of the picture: a message arrives (and may push one out), or one is taken.

    Attributes:
        time_ns: When, in nanoseconds of virtual time.
        waiting: Numbers of the messages in the queue afterwards, the oldest first.
        arrived: Number of the message that arrived, or 0.
        taken: Number of the message that was taken, or 0.
        dropped: Number of the message that was dropped, or 0.
    """

    time_ns: int
    waiting: tuple[int, ...]
    arrived: int = 0
    taken: int = 0
    dropped: int = 0


def moments(steps: Sequence[QueueStep]) -> list[Moment]:
    """Replay the steps; a drop and the arrival that caused it are one moment."""
    found: list[Moment] = []
    waiting: tuple[int, ...] = ()
    dropped = 0
    for step in steps:
        if step.kind == "arrived":
            waiting = (*waiting, step.number)
            found.append(Moment(step.time_ns, waiting, arrived=step.number, dropped=dropped))
            dropped = 0
            continue
        waiting = tuple(number for number in waiting if number != step.number)
        if step.kind == "taken":
            found.append(Moment(step.time_ns, waiting, taken=step.number))
        else:
            dropped = step.number
    return found


# The picture.


@called_as('viz.queue(ros, "temperature")')
def queue(
    source: Observed | Sequence[QueueStep],
    topic: str | int | None = None,
    depth: int | None = None,
    *,
    node: str | None = None,
) -> Picture:
    """Draw a subscription's queue filling, emptying and dropping.

    One column for every moment at which something happened, from left to right; in it the messages
    that wait then, the oldest at the bottom. Moments at the same virtual time stand side by side,
    since a burst has no width on a time axis. Every message on the topic counts as one that
    arrived: the subscription has to be there before the first one.

    Args:
        source: A session, or what it observed.
        topic: The topic's name; `temperature` and `/temperature` are the same. None for the only
            one that has a subscription.
        depth: Queue length in messages, of release 0.1.0's `queue(steps, depth)` only.
        node: The node that subscribes, if several do.

    Raises:
        PictureError: If `source` is no session, the topic has no subscription or several, no
            message arrived there, or some expired in the queue.
    """
    if isinstance(source, Sequence):
        words = "`viz.queue(steps, depth)` is deprecated: `viz.queue(ros, topic)` takes a session."
        warnings.warn(words, DeprecationWarning, stacklevel=3)
        return of_steps(source, cast("int", topic if depth is None else depth))
    seen = observed(source, "a session")
    end = _subscription(seen, cast("str | None", topic), node)
    return of_steps(_steps(seen, end), end.qos.depth)


def _subscription(seen: Observation, topic: str | None, node: str | None) -> Endpoint:
    """Return the one subscription whose queue is drawn."""
    graph = seen.graph
    known = [name for name in graph.topics() if graph.on(name, "subscription")]
    (name, *others) = topic_names(topic, known) or ("",)
    ends = graph.on(name, "subscription")
    if node is not None:
        wanted = known_name(node, [end.node for end in ends], "subscription of the node")
        ends = tuple(end for end in ends if end.node == wanted)
    if len(ends) == 1 and not others:
        return ends[0]
    many = [end.node for end in ends] if len(ends) > 1 else known
    raise PictureError(
        f"A picture shows the queue of one subscription, and here are {len(many) or 'none'}.",
        f"Recorded: {listing(many)}." if many else "Nobody subscribes to a topic here.",
        f'Choose one: `viz.queue(ros, "{name}", node="{ends[0].node}")`.'
        if len(ends) > 1
        else "Give the name of a topic: `viz.queue(ros, topic)`.",
    )


def _steps(seen: Observation, end: Endpoint) -> Sequence[QueueStep]:
    """Replay the queue of a subscription from what was published and which callbacks ran."""
    calls = [one for one in seen.callbacks if (one.node, one.source) == (end.node, end.name)]
    if any(one.kind == "expired" for one in calls):
        raise PictureError(
            f"The queue of {end.node} for {end.name} cannot be drawn.",
            "Some messages expired in it: they were older than a lifespan allows.",
            "Draw the queue of a subscription without a lifespan.",
        )
    arrived = [one.time_ns for one in seen.samples if one.topic == end.name and end.matched]
    taken = [one.time_ns for one in calls if one.kind == "subscription"]
    return queue_steps(arrived, taken, end.qos.depth)


def of_steps(steps: Sequence[QueueStep], depth: int) -> Picture:
    """Draw the steps of a queue, from `rosbeat.records.queue_steps` with the same depth.

    Raises:
        PictureError: If there are none.
    """
    if not steps:
        raise PictureError(
            "There is nothing to draw of this queue.",
            "No message arrived, so nothing waited, was taken or was dropped.",
            "Let the session run until messages arrive.",
        )
    every = moments(steps)
    shown = every[:MOST_MOMENTS]
    note = not_shown(len(every) - len(shown), "later moment")
    cell = max(3.0, min(_CELL, 264 / depth))
    height = _HEAD + depth * cell + _FOOT
    with blank(height, entries=_key(shown, depth), note=note) as canvas:
        grid = _Grid(canvas.bottom + _FOOT, min(_WIDEST, ROOM / len(shown)), cell)
        _draw(canvas, shown, depth, grid)
    return Picture(
        canvas.figure, f"{describe(every, depth)} {note}".strip(), "A queue filling and dropping"
    )


@dataclass(frozen=True)
class _Grid:
    """Hold where columns and cells are, in CSS pixels."""

    bottom: float
    step: float
    cell: float

    def x(self, rank: float) -> float:
        """Return the middle of a column."""
        return theme.MARGIN + (rank + 0.5) * self.step

    def y(self, place: float) -> float:
        """Return the middle of a place in the queue, counted from 0 at the bottom."""
        return self.bottom + (place + 0.5) * self.cell


def _key(shown: Sequence[Moment], depth: int) -> list[Entry]:
    entries = [Entry("waits", _WAITS, theme.NODE_FILL), Entry(f"depth {depth}", _LIMIT)]
    if any(one.taken for one in shown):
        entries.append(Entry("taken by the callback", _TAKEN))
    if any(one.dropped for one in shown):
        entries.append(Entry("dropped", _DROPPED))
    return entries


def _draw(canvas: Canvas, shown: Sequence[Moment], depth: int, grid: _Grid) -> None:
    for rank, one in enumerate(shown):
        _draw_column(canvas, one, grid.x(rank), grid)
        if one.taken or one.dropped:
            _draw_exit(canvas, one, grid.x(rank), grid)
    right = theme.MARGIN + grid.step * max(len(shown), _FEWEST)
    for level, look in ((0, "-"), (depth, "--")):
        y = grid.bottom + level * grid.cell
        canvas.axes.plot([theme.MARGIN, right], [y, y], color=theme.INK, lw=1.3, ls=look, zorder=4)
    _draw_times(canvas, shown, grid)


def _draw_column(canvas: Canvas, one: Moment, x: float, grid: _Grid) -> None:
    if grid.step < _ROOMY or grid.cell < 12:
        # Too narrow for cells: one bar as high as the queue is long.
        height = len(one.waiting) * grid.cell
        bar = Rectangle((x - grid.step / 2, grid.bottom), grid.step, height)
        bar.set(fc=theme.NODE_FILL_STRONG, lw=0, aa=False)
        canvas.axes.add_patch(bar)
        return
    for place, number in enumerate(one.waiting):
        fill = theme.NODE_FILL_STRONG if number == one.arrived else theme.NODE_FILL
        corner = (x - grid.step / 2 + 1, grid.y(place) - grid.cell / 2 + 1)
        cell = Rectangle(corner, grid.step - 2, grid.cell - 2, fc=fill, ec=theme.BLUE, lw=0.8)
        canvas.axes.add_patch(cell)
        canvas.text(x, grid.y(place), str(number), align="center")


def _draw_exit(canvas: Canvas, one: Moment, x: float, grid: _Grid) -> None:
    look, colour = (_TAKEN, theme.TAKEN_TEXT) if one.taken else (_DROPPED, theme.DROPPED_TEXT)
    canvas.mark(x, grid.bottom - 12, look, min(8.0, grid.step * 0.6), width=0, layer=2)
    if grid.step >= _ROOMY:
        number = str(one.taken or one.dropped)
        canvas.text(x, grid.bottom - 28, number, colour, "center", "bold")


def _draw_times(canvas: Canvas, shown: Sequence[Moment], grid: _Grid) -> None:
    """Draw one bracket under the moments of each instant, and its time where there is room."""
    free, y = 0.0, grid.bottom - 42
    ranked = itertools.groupby(enumerate(shown), key=lambda one: one[1].time_ns)
    for time_ns, group in ranked:
        columns = [rank for rank, _ in group]
        ends = [grid.x(columns[0]) - grid.step * 0.4, grid.x(columns[-1]) + grid.step * 0.4]
        canvas.axes.plot(ends, [y, y], color=theme.MUTED, lw=1)
        words = seconds(time_ns)
        half = text_width(words) / 2
        rim = theme.MARGIN + half
        middle = min(max(sum(ends) / 2, rim), canvas.width - rim)
        if middle - half >= free:
            canvas.text(middle, y - 13, words, theme.MUTED, "center")
            free = middle + half + 8


# The same in words.


def describe(every: Sequence[Moment], depth: int) -> str:
    """Tell which messages arrived, were taken, were dropped and wait at the end."""
    first, last = seconds(every[0].time_ns), seconds(every[-1].time_ns)
    span = f"at {first}" if first == last else f"from {first} to {last}"
    arrived = sum(one.arrived > 0 for one in every)
    fullest = max(len(one.waiting) for one in every)
    return " ".join(
        (
            f"A queue of depth {depth}, {span}: {count(arrived, 'message')} arrived.",
            _share("was taken", "were taken", [one.taken for one in every if one.taken]),
            _share("was dropped", "were dropped", [one.dropped for one in every if one.dropped]),
            _share("waits at the end", "wait at the end", every[-1].waiting),
            f"At its fullest the queue held {count(fullest, 'message')}.",
        )
    )


def _share(one: str, many: str, numbers: Sequence[int]) -> str:
    if not numbers:
        return f"None {one}."
    which = f"number {ranges(numbers)}" if len(numbers) == 1 else f"numbers {ranges(numbers)}"
    return f"{len(numbers)} {one if len(numbers) == 1 else many}: {which}."

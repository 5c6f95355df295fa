"""A subscription's queue: what waits in it, what is taken, what is dropped."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.patches import Rectangle

from rosbeat.errors import PictureError
from rosbeat.records import QueueStep
from rosbeat.viz import key, theme
from rosbeat.viz.canvas import Canvas, blank, line_height, text_width
from rosbeat.viz.picture import Picture
from rosbeat.viz.queue_story import Moment, describe, moments
from rosbeat.viz.words import count, seconds

#: More moments than this have no room side by side.
MOST_MOMENTS = 220

#: The lines of an almost empty queue are as long as if so many moments were drawn.
_FEWEST = 8
_CELL, _WIDEST, _ROOMY = 22.0, 34.0, 17.0
_FOOT = 56.0
_WAITS = theme.Style(theme.BLUE, "s", "")
_TAKEN = theme.Style(theme.TAKEN, "v", "")
_DROPPED = theme.Style(theme.ALERT, "X", "")
_LIMIT = theme.Style(theme.INK, "", "--")


@dataclass(frozen=True)
class _Grid:
    """Where columns and cells are, in CSS pixels."""

    left: float
    bottom: float
    step: float
    cell: float

    def x(self, rank: float) -> float:
        """The middle of a column."""
        return self.left + (rank + 0.5) * self.step

    def y(self, place: float) -> float:
        """The middle of a place in the queue, counted from 0 at the bottom."""
        return self.bottom + (place + 0.5) * self.cell

    @property
    def numbers(self) -> bool:
        """Whether a cell is wide enough for a number."""
        return self.step >= _ROOMY and self.cell >= 12


def queue(steps: Sequence[QueueStep], depth: int) -> Picture:
    """Draw a queue filling, emptying and dropping.

    One column for every moment at which something happened, from left to right; in it the messages
    that wait then, the oldest at the bottom. Moments at the same virtual time stand side by side,
    since a burst has no width on a time axis.

    Args:
        steps: From `rosbeat.records.queue_steps`.
        depth: Queue length in messages, at least 1.

    Returns:
        The picture.

    Raises:
        PictureError: If these are no steps, or there are none, or the depth is below 1 or below
            what waited.
    """
    _check(steps, depth)
    every = moments(steps)
    shown = every[:MOST_MOMENTS]
    room = theme.WIDTH - 2 * theme.MARGIN
    entries = _key(shown, depth)
    head = key.height(entries, room) + 12
    note = _note(len(every) - len(shown))
    foot = _FOOT + (line_height(theme.SMALL) + 6 if note else 0)
    cell = max(3.0, min(_CELL, 264 / depth))
    with blank(2 * theme.MARGIN + head + depth * cell + foot) as canvas:
        step = min(_WIDEST, room / len(shown))
        grid = _Grid(theme.MARGIN, theme.MARGIN + foot, step, cell)
        key.draw(canvas, entries, theme.MARGIN, canvas.height - theme.MARGIN, room)
        _draw(canvas, shown, depth, grid)
        canvas.text(theme.MARGIN, theme.MARGIN, note, theme.SMALL, theme.MUTED)
    words = f"{describe(every, depth)} {note}".strip()
    return Picture(canvas.figure, words, "A queue filling and dropping")


def _check(steps: Sequence[QueueStep], depth: int) -> None:
    if not isinstance(steps, Sequence) or not all(isinstance(one, QueueStep) for one in steps):
        raise PictureError(
            "A picture of a queue is drawn from its steps, and these are none.",
            "A step is a `QueueStep`: what came, was taken or was dropped at one moment.",
            "Make them with `queue_steps(arrivals, takes, depth)`.",
        )
    if not steps:
        raise PictureError(
            "There are no steps of a queue to draw.",
            "No message arrived, so nothing waited, was taken or was dropped.",
            "Make them with `queue_steps(arrivals, takes, depth)`.",
        )
    longest = max(step.length for step in steps)
    if not isinstance(depth, int) or depth < max(1, longest):
        raise PictureError(
            f"A queue of depth {depth!r} does not fit these steps.",
            f"In them up to {count(longest, 'message')} wait at once; a depth is at least 1.",
            "Give the same depth as to `queue_steps`.",
        )


def _note(skipped: int) -> str:
    if not skipped:
        return ""
    verb = "is" if skipped == 1 else "are"
    return f"{count(skipped, 'later moment')} {verb} not shown."


def _key(shown: Sequence[Moment], depth: int) -> list[key.Entry]:
    entries = [key.Entry("waits", _WAITS, theme.NODE_FILL), key.Entry(f"depth {depth}", _LIMIT)]
    if any(one.taken for one in shown):
        entries.append(key.Entry("taken by the callback", _TAKEN))
    if any(one.dropped for one in shown):
        entries.append(key.Entry("dropped", _DROPPED))
    return entries


def _draw(canvas: Canvas, shown: Sequence[Moment], depth: int, grid: _Grid) -> None:
    for rank, one in enumerate(shown):
        _draw_column(canvas, one, rank, grid)
        if one.taken or one.dropped:
            _draw_exit(canvas, one, grid.x(rank), grid)
    right = grid.left + grid.step * max(len(shown), _FEWEST)
    for level, look in ((0, "-"), (depth, "--")):
        y = grid.bottom + level * grid.cell
        canvas.axes.plot([grid.left, right], [y, y], color=theme.INK, lw=1.3, ls=look, zorder=4)
    _draw_times(canvas, shown, grid)


def _draw_column(canvas: Canvas, one: Moment, rank: int, grid: _Grid) -> None:
    x = grid.x(rank)
    if not grid.numbers:
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
        canvas.text(x, grid.y(place), str(number), theme.TINY, align="center")


def _draw_exit(canvas: Canvas, one: Moment, x: float, grid: _Grid) -> None:
    look = _TAKEN if one.taken else _DROPPED
    size = min(8.0, grid.step * 0.6)
    canvas.axes.plot([x], [grid.bottom - 12], look.marker, ms=size, color=look.colour, mew=0)
    if grid.step >= _ROOMY:
        colour = theme.TAKEN_TEXT if one.taken else theme.ALERT_TEXT
        number = str(one.taken or one.dropped)
        canvas.text(x, grid.bottom - 28, number, theme.TINY, colour, "center", "bold")


def _draw_times(canvas: Canvas, shown: Sequence[Moment], grid: _Grid) -> None:
    """One bracket under the moments of each instant, and its time where there is room."""
    free = 0.0
    for first, last in _instants(shown):
        y = grid.bottom - 42
        ends = [grid.x(first) - grid.step * 0.4, grid.x(last) + grid.step * 0.4]
        canvas.axes.plot(ends, [y, y], color=theme.MUTED, lw=1)
        words = seconds(shown[first].time_ns)
        half = text_width(words, theme.SMALL) / 2
        middle = min(max(sum(ends) / 2, grid.left + half), canvas.width - theme.MARGIN - half)
        if middle - half >= free:
            canvas.text(middle, y - 13, words, theme.SMALL, theme.MUTED, "center")
            free = middle + half + 8


def _instants(shown: Sequence[Moment]) -> list[tuple[int, int]]:
    """First and last column of each run of moments at one time."""
    runs: list[tuple[int, int]] = []
    for rank, one in enumerate(shown):
        if rank and shown[rank - 1].time_ns == one.time_ns:
            runs[-1] = (runs[-1][0], rank)
        else:
            runs.append((rank, rank))
    return runs

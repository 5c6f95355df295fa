"""The row above a picture that says what each mark means, in words beside the mark itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.viz import bars, theme
from rosbeat.viz.canvas import Canvas, line_height, text_width

_MARK = 26.0
_BETWEEN = 22.0
_SIZE = theme.SMALL

#: Height of one row of a key, in CSS pixels.
ROW = line_height(_SIZE) + 4


@dataclass(frozen=True)
class Entry:
    """One mark and its meaning.

    Attributes:
        words: The meaning.
        style: Colour, marker and dash; an empty marker or dash leaves that part out.
        fill: Colour inside the marker if it is not the line's.
        bar: A stretch of time in place of marker and line.
    """

    words: str
    style: theme.Style
    fill: str = ""
    bar: theme.Bar | None = None


def rows(entries: Sequence[Entry], width: float) -> list[list[Entry]]:
    """Entries broken into rows that fit into `width` CSS pixels."""
    broken: list[list[Entry]] = [[]]
    used = 0.0
    for entry in entries:
        need = _width(entry)
        if broken[-1] and used + need > width:
            broken.append([])
            used = 0.0
        broken[-1].append(entry)
        used += need
    return broken


def height(entries: Sequence[Entry], width: float) -> float:
    """Height in CSS pixels that `draw` will need; 0 without entries."""
    return len(rows(entries, width)) * ROW if entries else 0.0


def draw(canvas: Canvas, entries: Sequence[Entry], left: float, top: float, width: float) -> None:
    """Draw the entries from (`left`, `top`) rightwards and down, all in CSS pixels."""
    for number, row in enumerate(rows(entries, width)):
        x, y = left, top - (number + 0.5) * ROW
        for entry in row:
            _draw_mark(canvas, entry, x, y)
            canvas.text(x + _MARK, y, entry.words, size=_SIZE)
            x += _width(entry)


def _draw_mark(canvas: Canvas, entry: Entry, x: float, y: float) -> None:
    look = entry.style
    middle = x + (_MARK - 6) / 2
    if entry.bar:
        bars.draw(canvas, [bars.Part(x, x + _MARK - 6, entry.bar)], y, 10.0)
    if look.dash:
        ends = [x, x + _MARK - 6]
        canvas.axes.plot(ends, [y, y], color=look.colour, ls=look.dash, lw=1.6)
    if look.marker:
        canvas.axes.plot(
            [middle], [y], marker=look.marker, ms=6, mfc=entry.fill or look.colour, mec=look.colour
        )


def _width(entry: Entry) -> float:
    return _MARK + text_width(entry.words, _SIZE) + _BETWEEN

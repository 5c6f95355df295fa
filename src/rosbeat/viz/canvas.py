"""Draw what all pictures are made of: text, keys, time axes, lanes, frames, bars, arrows.

Everything is measured in CSS pixels. The figure is made without pyplot, so no global list holds it
and nothing shows it a second time. All drawing goes through one transparent pair of axes that
covers the figure and counts pixels from the lower left corner.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from math import hypot
from typing import Any

from matplotlib import style as mpl_style
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch, Polygon, Rectangle
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.textpath import TextPath
from matplotlib.ticker import MaxNLocator

from rosbeat.viz import theme
from rosbeat.viz.text_format import number

Point = tuple[float, float]

#: Width between the margins.
ROOM = theme.WIDTH - 2 * theme.MARGIN
#: CSS pixels per point at 100 dots per inch.
_PIXELS_PER_POINT = theme.DPI / 72
#: Height of a line of text in units of its font size.
_LINE = 1.35
#: A text up to the next `/`, `_` or blank; a leading slash stays with what follows it.
_PART = re.compile(r"(?:(?<![^ ])/)?[^/_ ]+[/_ ]?|[/_ ]")
#: Widest line of a lane's name.
_LANE_NAMES = 170.0


# Text.


@lru_cache(maxsize=4096)
def text_width(words: str, weight: str = "normal") -> float:
    """Return the width of one line of text in CSS pixels."""
    if not words.strip():
        return 0.0
    font = FontProperties(family="DejaVu Sans", weight=weight)
    path = TextPath((0, 0), words.replace("$", r"\$"), size=theme.TEXT, prop=font)
    # Control points may lie a hair outside the outline; they cost a tenth of exact extents.
    return float(path.vertices[:, 0].max()) * _PIXELS_PER_POINT


def line_height() -> float:
    """Return the height of one line of text in CSS pixels."""
    return theme.TEXT * _PIXELS_PER_POINT * _LINE


def wrap(name: str, limit: float) -> tuple[str, ...]:
    """Break a ROS name or words into lines no wider than `limit` CSS pixels, after `/`, `_` or ` `.

    A part that is wider than the limit on its own is broken anywhere.
    """
    rows = [""]
    for part in _PART.findall(name):
        pieces = [part] if text_width(part) <= limit else list(part)
        for piece in pieces:
            if rows[-1] and text_width(rows[-1] + piece) > limit:
                rows.append("")
            rows[-1] += piece
    return tuple(row.strip() for row in rows)


# Times as places on an axis.


@dataclass(frozen=True)
class TimeScale:
    """Convert seconds to CSS pixels.

    Attributes:
        last: Time at the right end, in seconds; the first one if all is one instant.
        left: The left end in CSS pixels.
        right: The right end in CSS pixels.
        first: Time at the left end, in seconds.
    """

    last: float
    left: float
    right: float
    first: float = 0.0

    def __call__(self, time: float) -> float:
        """Return where a time is, in CSS pixels; one single instant stands in the middle."""
        span = self.last - self.first
        part = (time - self.first) / span if span > 0 else 0.5
        return self.left + part * (self.right - self.left)

    def ticks(self) -> list[float]:
        """Return round times in the range, few enough that their labels stand apart."""
        if self.last <= self.first:
            return [self.first]
        room = max(text_width(number(end)) for end in (self.first, self.last)) + 34
        most = max(2, min(10, int((self.right - self.left) / room)))
        values = MaxNLocator(nbins=most, steps=(1, 2, 5, 10)).tick_values(self.first, self.last)
        rounding = self.last * 1e-9
        return [float(at) for at in values if self.first - rounding <= at <= self.last + rounding]


def lane_scale(
    names: Sequence[str], last: float, least: float = 0.0, first: float = 0.0
) -> TimeScale:
    """Return the scale from `first` to `last` for lanes, with room for their names at the left."""
    wide = max(text_width(row) for name in names for row in wrap(name, _LANE_NAMES))
    left = theme.MARGIN + max(wide, least) + 24
    return TimeScale(last, left, theme.WIDTH - theme.MARGIN - 34, first)


# Arrows.

_HEAD, _HALF_HEAD = 9.0, 4.0
_RADIUS = 9.0


@dataclass(frozen=True)
class Stroke:
    """Describe how an arrow looks: its colour, matplotlib line style, and width in points."""

    colour: str = theme.INK
    dash: str | tuple[float, tuple[float, ...]] = "-"
    width: float = 1.4


#: Nothing passes here: another colour and another dash.
BROKEN = Stroke(theme.ALERT, "--", 1.6)
PLAIN = Stroke()


def smooth(points: Sequence[Point], downward: bool = False) -> Path:
    """Return a smooth line through the points, along the flow (to the right or down) at each."""
    vertices, codes = [points[0]], [Path.MOVETO]
    for (x0, y0), (x1, y1) in itertools.pairwise(points):
        if downward:
            middle = (y0 + y1) / 2
            vertices += [(x0, middle), (x1, middle), (x1, y1)]
        else:
            middle = (x0 + x1) / 2
            vertices += [(middle, y0), (middle, y1), (x1, y1)]
        codes += [Path.CURVE4] * 3
    return Path(vertices, codes)


def cornered(points: Sequence[Point]) -> Path:
    """Return a line through the points with rounded corners."""
    vertices, codes = [points[0]], [Path.MOVETO]
    for before, corner, after in zip(points, points[1:], points[2:], strict=False):
        vertices += [_toward(corner, before), corner, _toward(corner, after)]
        codes += [Path.LINETO, Path.CURVE3, Path.CURVE3]
    return Path([*vertices, points[-1]], [*codes, Path.LINETO])


def _toward(start: Point, end: Point) -> Point:
    """Return the point where a rounded corner at `start` ends, at most half way to `end`."""
    length = hypot(end[0] - start[0], end[1] - start[1]) or 1.0
    part = min(_RADIUS / length, 0.5)
    return start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part


# The canvas, and the key above what is drawn.

#: Left and right end of a stretch of time in CSS pixels, and how it looks.
Part = tuple[float, float, theme.Bar]

#: Bars are above lanes and rules, and below arrows and marks.
_BAR_ZORDER = 1.4
#: A bar that takes hardly any time can still be seen.
_LEAST_BAR = 3.0

_FRAME_LABEL = "one process"
#: From the side of a frame to its label.
FRAME_INDENT = 14.0

_NO_STYLE = theme.Style("", "", "")


@dataclass(frozen=True)
class Entry:
    """Describe one mark of a picture's key.

    Attributes:
        words: The meaning of the mark.
        style: Colour, marker and dash; an empty marker or dash leaves that part out.
        fill: Colour inside the marker if it is not the line's.
        bar: A stretch of time in place of marker and line.
    """

    words: str
    style: theme.Style = _NO_STYLE
    fill: str = ""
    bar: theme.Bar | None = None


@dataclass(frozen=True)
class Canvas:
    """Hold a figure with axes that count CSS pixels.

    Attributes:
        axes: Axes over the whole figure, x from 0 to `width`, y from 0 (bottom) to `height`.
        bottom: Lower end of what is drawn, above the note if there is one.
        top: Upper end of what is drawn, below the heading and the key if there are any.
    """

    figure: Figure
    axes: Axes
    width: float
    height: float
    bottom: float
    top: float

    def text(
        self,
        x: float,
        y: float,
        words: str,
        colour: str = theme.INK,
        align: str = "left",
        weight: str = "normal",
    ) -> Text:
        """Write one line with its middle at height `y`; `align` says which end `x` is."""
        return self.axes.text(
            x, y, words, color=colour, ha=align, va="center_baseline", weight=weight
        )

    def shape(
        self,
        middle: Point,
        size: Point,
        radius: float | None,
        fill: str,
        edge: str,
        width: float,
        dash: str = "-",
        layer: float = 3,
    ) -> None:
        """Draw a rectangle with corners of this radius, or an ellipse if there is none."""
        look: dict[str, Any] = {"fc": fill, "ec": edge, "lw": width, "ls": dash, "zorder": layer}
        if radius is None:
            self.axes.add_patch(Ellipse(middle, *size, **look))
            return
        corner = (middle[0] - size[0] / 2, middle[1] - size[1] / 2)
        box = f"round,pad=0,rounding_size={radius}"
        self.axes.add_patch(FancyBboxPatch(corner, *size, box, **look))

    def mark(
        self,
        x: float,
        y: float,
        look: theme.Style,
        size: float,
        rim: str = "",
        width: float = 1.0,
        layer: float = 4,
        fill: str = "",
    ) -> None:
        """Draw one mark of `size` points, in its own colour where rim or fill have none."""
        fill, rim = fill or look.colour, rim or look.colour
        more: dict[str, Any] = {"mfc": fill, "mec": rim, "mew": width, "zorder": layer}
        self.axes.plot([x], [y], look.marker, ms=size, **more)

    def time_axis(self, scale: TimeScale, bottom: float, top: float) -> None:
        """Draw rules from `bottom` to `top`, and the times below them."""
        for at in scale.ticks():
            x = scale(at)
            self.axes.plot([x, x], [bottom, top], color=theme.RULE, lw=0.8, zorder=0.5)
            self.text(x, bottom - 12, f"{number(at)} s", theme.MUTED, "center")

    def lane(self, scale: TimeScale, y: float, name: str, has_text_below: bool = False) -> None:
        """Draw a lane at height `y` and its name at the left, in the middle or above it."""
        ends = [scale.left - 8, scale.right + 8]
        self.axes.plot(ends, [y, y], color=theme.RULE, lw=2, zorder=1, solid_capstyle="round")
        rows = wrap(name, _LANE_NAMES)
        first = (len(rows) - 1) * (1.0 if has_text_below else 0.5)
        for rank, row in enumerate(rows):
            self.text(scale.left - 18, y + (first - rank) * line_height(), row, align="right")

    def frame(
        self,
        left: float,
        bottom: float,
        right: float,
        top: float,
        words: str = _FRAME_LABEL,
        strong: bool = False,
        is_centred: bool = False,
    ) -> None:
        """Draw a rounded frame with its label on the upper edge, below everything else."""
        edge, width = (theme.INK, 2.2) if strong else (theme.FRAME, 1.1)
        middle, size = ((left + right) / 2, (bottom + top) / 2), (right - left, top - bottom)
        self.shape(middle, size, 10, theme.FRAME_FILL, edge, width, layer=0.3)
        x, align = ((left + right) / 2, "center") if is_centred else (left + FRAME_INDENT, "left")
        colour, weight = (theme.INK, "bold") if strong else (theme.MUTED, "normal")
        label = self.text(x, top, words, colour, align, weight)
        # The label interrupts the edge, and an arrow passes behind it.
        label.set_bbox({"fc": theme.CARD, "ec": "none", "pad": 1.5})

    def bar(self, parts: Sequence[Part], y: float, high: float, name: str = "") -> None:
        """Draw a bar of one or several parts, with one outline around all.

        Args:
            parts: The parts, from left to right.
            y: The bar's middle in CSS pixels.
            high: Its height in CSS pixels.
            name: What is written in it, if there is room.
        """
        bottom, top = y - high / 2, y + high / 2
        for begin, end, look in parts:
            width = max(end - begin, _LEAST_BAR)
            box = Rectangle((begin, bottom), width, high, fc=look.fill, zorder=_BAR_ZORDER)
            # The edge gives the hatch its colour, and has no width of its own.
            box.set(ec=theme.HATCH, hatch=look.hatch, lw=0)
            self.axes.add_patch(box)
        left, right = parts[0][0], max(parts[-1][1], parts[0][0] + _LEAST_BAR)
        self._name_bar(name, (left, right), y, parts[0][2])
        line: dict[str, Any] = {"color": theme.BAR_EDGE, "lw": 1.0, "zorder": _BAR_ZORDER + 0.2}
        outline = [bottom, bottom, top, top, bottom]
        xs = [left, right, right, left, left]
        self.axes.plot(xs, outline, solid_joinstyle="miter", **line)
        for begin, *_ in parts[1:]:
            self.axes.plot([begin, begin], [bottom, top], **line)

    def _name_bar(self, name: str, ends: Point, y: float, look: theme.Bar) -> None:
        left = ends[0] + 10.0  # room for the mark with which a callback begins
        if name and text_width(name) <= ends[1] - left - 3:
            words = self.text(left, y, name)
            words.set_zorder(_BAR_ZORDER + 0.1)
            # Between the lines of a hatch nobody can read.
            words.set_bbox({"fc": look.fill, "ec": "none", "pad": 0.5})

    def arrow(self, path: Path, stroke: Stroke = PLAIN, head: bool = True) -> None:
        """Draw a path, usually with a solid head at its end."""
        (x0, y0), (x1, y1) = (tuple(map(float, vertex)) for vertex in path.vertices[-2:])
        length = hypot(x1 - x0, y1 - y0) or 1.0
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        # The line ends inside the head; otherwise its blunt end would show beside the tip.
        inside = 5 if head else 0
        shown = Path([*path.vertices[:-1], (x1 - ux * inside, y1 - uy * inside)], path.codes)
        look = {"color": stroke.colour, "ls": stroke.dash, "lw": stroke.width}
        self.axes.add_patch(PathPatch(shown, fill=False, zorder=2, **look))
        if head:
            back = (x1 - ux * _HEAD, y1 - uy * _HEAD)
            wings = [
                (back[0] - uy * side, back[1] + ux * side) for side in (_HALF_HEAD, -_HALF_HEAD)
            ]
            self.axes.add_patch(
                Polygon([(x1, y1), *wings], fc=stroke.colour, ec="none", zorder=2.5)
            )


@contextmanager
def blank(
    height: float,
    width: float = theme.WIDTH,
    entries: Sequence[Entry] = (),
    heading: str = "",
    note: str = "",
) -> Iterator[Canvas]:
    """Make a canvas with a margin around; the theme holds inside the `with` block.

    Args:
        height: Of what will be drawn.
        width: Of the whole picture.
        entries: What the marks mean, written above.
        heading: Written in bold above everything else.
        note: Written below everything else, on as many lines as it needs.
    """
    rows = _key_rows(entries)
    head = (line_height() + 4 if heading else 0.0) + len(rows) * _KEY_ROW
    below = wrap(note, width - 2 * theme.MARGIN) if note else ()
    foot = line_height() * len(below) + 6 if below else 0.0
    total = 2 * theme.MARGIN + head + height + foot
    with mpl_style.context(["default", theme.RC]):
        figure = Figure(figsize=(width / theme.DPI, total / theme.DPI), dpi=theme.DPI)
        FigureCanvasAgg(figure)
        axes = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(0, total), zorder=1)
        axes.axis("off")
        top = total - theme.MARGIN
        canvas = Canvas(figure, axes, width, total, theme.MARGIN + foot, top - head)
        if heading:
            canvas.text(theme.MARGIN, top - line_height() / 2, heading, weight="bold")
        for rank, row in enumerate(reversed(rows)):
            _draw_key_row(canvas, row, canvas.top + (rank + 0.5) * _KEY_ROW)
        for rank, words in enumerate(reversed(below)):
            canvas.text(theme.MARGIN, theme.MARGIN + rank * line_height(), words, theme.MUTED)
        yield canvas


_KEY_MARK, _KEY_GAP = 26.0, 22.0
_KEY_ROW = line_height() + 4


def _key_rows(entries: Sequence[Entry]) -> list[list[Entry]]:
    """Break entries into rows that fit between the margins."""
    rows: list[list[Entry]] = []
    used = 0.0
    for entry in entries:
        if not rows or used + _entry_width(entry) > ROOM:
            rows.append([])
            used = 0.0
        rows[-1].append(entry)
        used += _entry_width(entry)
    return rows


def _entry_width(entry: Entry) -> float:
    return _KEY_MARK + text_width(entry.words) + _KEY_GAP


def _draw_key_row(canvas: Canvas, row: Sequence[Entry], y: float) -> None:
    x = float(theme.MARGIN)
    for entry in row:
        look, ends = entry.style, [x, x + _KEY_MARK - 6]
        if entry.bar:
            canvas.bar([(ends[0], ends[1], entry.bar)], y, 10.0)
        if look.dash:
            canvas.axes.plot(ends, [y, y], color=look.colour, ls=look.dash, lw=1.6)
        if look.marker:
            canvas.mark(x + (_KEY_MARK - 6) / 2, y, look, 6, layer=2, fill=entry.fill)
        canvas.text(x + _KEY_MARK, y, entry.words)
        x += _entry_width(entry)

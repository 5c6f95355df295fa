"""A blank figure in the theme, measured in CSS pixels, and text that knows how wide it is.

The figure is made without pyplot, so no global list holds it and nothing shows it a second time.
All drawing goes through one transparent pair of axes that covers the figure and counts pixels from
the lower left corner.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache

from matplotlib import style as mpl_style
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text
from matplotlib.textpath import TextPath

from rosbeat.viz import theme

#: CSS pixels per point at 100 dots per inch.
PIXELS_PER_POINT = theme.DPI / 72
#: Height of a line of text in units of its font size.
LINE = 1.35


@dataclass(frozen=True)
class Canvas:
    """A figure with axes that count CSS pixels.

    Attributes:
        figure: The figure.
        axes: Axes over the whole figure, x from 0 to `width`, y from 0 (bottom) to `height`.
        width: In CSS pixels.
        height: In CSS pixels.
    """

    figure: Figure
    axes: Axes
    width: float
    height: float

    def text(
        self,
        x: float,
        y: float,
        words: str,
        size: float = theme.TEXT,
        colour: str = theme.INK,
        align: str = "left",
        weight: str = "normal",
    ) -> Text:
        """Write one line with its middle at height `y`; `align` says which end `x` is."""
        return self.axes.text(
            x, y, words, size=size, color=colour, ha=align, va="center_baseline", weight=weight
        )


@contextmanager
def blank(height: float, width: float = theme.WIDTH) -> Iterator[Canvas]:
    """A canvas of the given size in CSS pixels; the theme holds inside the `with` block."""
    with mpl_style.context(["default", theme.RC]):
        figure = Figure(figsize=(width / theme.DPI, height / theme.DPI), dpi=theme.DPI)
        FigureCanvasAgg(figure)
        axes = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(0, height), zorder=1)
        axes.axis("off")
        yield Canvas(figure, axes, width, height)


@lru_cache(maxsize=4096)
def text_width(words: str, size: float = theme.TEXT, weight: str = "normal") -> float:
    """Width of one line of text in CSS pixels, at a font size in points."""
    if not words.strip():
        return 0.0
    font = FontProperties(family="DejaVu Sans", weight=weight)
    path = TextPath((0, 0), words.replace("$", r"\$"), size=size, prop=font)
    # Control points may lie a hair outside the outline; they cost a tenth of exact extents.
    return float(path.vertices[:, 0].max()) * PIXELS_PER_POINT


def line_height(size: float = theme.TEXT) -> float:
    """Height of one line of text in CSS pixels, at a font size in points."""
    return size * PIXELS_PER_POINT * LINE


def wrap(name: str, limit: float, size: float = theme.TEXT) -> tuple[str, ...]:
    """Break a ROS name into lines no wider than `limit` CSS pixels, after `/` or `_`.

    A part that is wider than the limit on its own is broken anywhere.
    """
    rows = [""]
    for part in _parts(name):
        pieces = [part] if text_width(part, size) <= limit else list(part)
        for piece in pieces:
            if rows[-1] and text_width(rows[-1] + piece, size) > limit:
                rows.append("")
            rows[-1] += piece
    return tuple(rows)


def _parts(name: str) -> list[str]:
    """The name cut after every `/` and `_`; a leading slash stays with what follows it."""
    parts = [""]
    for letter in name:
        parts[-1] += letter
        if letter in "/_" and parts != ["/"]:
            parts.append("")
    return [part for part in parts if part]

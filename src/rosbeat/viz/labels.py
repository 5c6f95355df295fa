"""Boxes of a graph picture: what is written in them and how large that makes them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from matplotlib.patches import Ellipse, FancyBboxPatch, Patch

from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas, line_height, text_width, wrap

# An ellipse around a text is wider and higher than the text: (1/a)² + (1/b)² = 1.
_WIDER, _HIGHER = 1.2, 1.8
_PADDING_X, _PADDING_Y = 13.0, 7.0


@dataclass(frozen=True)
class Line:
    """One line of text in a box."""

    words: str
    size: float
    colour: str = theme.INK


@dataclass(frozen=True)
class Label:
    """What is written in one box.

    Attributes:
        lines: From top to bottom.
        is_node: Whether the box is a node (ellipse) or a topic (rectangle).
        strong: Whether it is highlighted.
        broken: Whether nothing passes here.
        dashed: Whether it does not run, or is not there.
    """

    lines: tuple[Line, ...]
    is_node: bool
    strong: bool = False
    broken: bool = False
    dashed: bool = False

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the box in CSS pixels."""
        width = max(text_width(line.words, line.size, self._weight(line)) for line in self.lines)
        height = sum(line_height(line.size) for line in self.lines)
        if self.is_node:
            return width * _WIDER + 14, height * _HIGHER + 6
        return width + 2 * _PADDING_X, height + 2 * _PADDING_Y

    def draw(self, canvas: Canvas, x: float, y: float) -> None:
        """Draw box and text with the middle at (`x`, `y`), in CSS pixels."""
        canvas.axes.add_patch(self._shape(x, y))
        if self.dashed and self.is_node:
            self._cross(canvas, x, y)
        top = y + sum(line_height(line.size) for line in self.lines) / 2
        for line in self.lines:
            high = line_height(line.size)
            look = (line.size, line.colour, "center", self._weight(line))
            canvas.text(x, top - high / 2, line.words, *look)
            top -= high

    def _weight(self, line: Line) -> str:
        """Only the name of a highlighted box is bold, not its type."""
        return "bold" if self.strong and line.colour == theme.INK else "normal"

    def _shape(self, x: float, y: float) -> Patch:
        width, height = self.size
        look: dict[str, Any] = {
            "lw": 2.6 if self.strong else 1.3,
            "zorder": 3,
            "ls": "--" if self.dashed else "-",
        }
        if self.is_node:
            fill = theme.NODE_FILL_STRONG if self.strong else theme.NODE_FILL
            edge = theme.ALERT if self.dashed else theme.BLUE
            return Ellipse((x, y), width, height, fc=fill, ec=edge, **look)
        fill = theme.TOPIC_FILL_STRONG if self.strong else theme.TOPIC_FILL
        edge = theme.ALERT if self.broken else theme.TOPIC_EDGE
        corner = (x - width / 2 + 3, y - height / 2 + 3)
        box = "round,pad=3,rounding_size=4"
        return FancyBboxPatch(corner, width - 6, height - 6, box, fc=fill, ec=edge, **look)

    def _cross(self, canvas: Canvas, x: float, y: float) -> None:
        """A cross on the rim, at the upper right."""
        width, height = self.size
        at = (x + width / 2 * 0.62, y + height / 2 * 0.78)
        look: dict[str, Any] = {"mfc": theme.ALERT, "mec": theme.CARD, "mew": 1.2, "zorder": 5}
        canvas.axes.plot(*at, marker="X", ms=12, **look)


def node_label(
    name: str,
    limit: float,
    size: float,
    strong: bool,
    faults: tuple[str, ...] = (),
    stopped: bool = False,
) -> Label:
    """The label of a node: its name, broken at `limit` CSS pixels, and what is wrong."""
    small = min(size, theme.SMALL)
    lines = [Line(row, size) for row in wrap(name, limit, size)]
    lines += [Line(row, small, theme.ALERT_TEXT) for row in faults]
    return Label(tuple(lines), is_node=True, strong=strong, dashed=stopped)


def topic_label(
    name: str,
    types: tuple[str, ...],
    faults: tuple[str, ...],
    limit: float,
    size: float,
    strong: bool,
    unused: bool = False,
) -> Label:
    """The label of a topic: name, types without their package, what is wrong."""
    small = min(size, theme.SMALL)
    lines = [Line(row, size) for row in wrap(name, limit, size)]
    lines += [Line(kind.rsplit("/", 1)[-1], small, theme.MUTED) for kind in types]
    lines += [Line(fault, small, theme.ALERT_TEXT) for fault in faults]
    return Label(tuple(lines), is_node=False, strong=strong, broken=bool(faults), dashed=unused)

"""Bars along a time axis: stretches in their colours and hatches, with one outline around all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.patches import Rectangle

from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas, text_width

#: Above lanes and rules, below arrows and marks.
_ZORDER = 1.4
#: From its left end to its name: room for the mark with which a callback begins.
_INDENT = 10.0
#: A bar that takes hardly any time can still be seen.
_LEAST = 3.0


@dataclass(frozen=True)
class Part:
    """One stretch of a bar, from its left to its right end in CSS pixels."""

    left: float
    right: float
    look: theme.Bar


def draw(canvas: Canvas, parts: Sequence[Part], y: float, height: float, name: str = "") -> None:
    """Draw a bar of one or several parts.

    Args:
        canvas: Where to draw.
        parts: The parts, from left to right.
        y: Its middle in CSS pixels.
        height: Its height in CSS pixels.
        name: What is written in it, if there is room.
    """
    bottom = y - height / 2
    for part in parts:
        width = max(part.right - part.left, _LEAST)
        box = Rectangle((part.left, bottom), width, height, fc=part.look.fill, zorder=_ZORDER)
        # The edge gives the hatch its colour, and has no width of its own.
        box.set(ec=theme.HATCH, hatch=part.look.hatch, lw=0)
        canvas.axes.add_patch(box)
    _write(canvas, parts, y, name)
    left, right = parts[0].left, max(parts[-1].right, parts[0].left + _LEAST)
    xs, ys = [left, right, right, left, left], [bottom, bottom, bottom + height, bottom + height]
    line: dict[str, Any] = {"color": theme.BAR_EDGE, "lw": 1.0, "zorder": _ZORDER + 0.2}
    canvas.axes.plot(xs, [*ys, bottom], solid_joinstyle="miter", **line)
    for part in parts[1:]:
        canvas.axes.plot([part.left] * 2, [bottom, bottom + height], **line)


def _write(canvas: Canvas, parts: Sequence[Part], y: float, name: str) -> None:
    left = parts[0].left + _INDENT
    if name and text_width(name, theme.TINY) <= parts[-1].right - left - 3:
        words = canvas.text(left, y, name, theme.TINY)
        words.set_zorder(_ZORDER + 0.1)
        # Between the lines of a hatch nobody can read.
        words.set_bbox({"fc": parts[0].look.fill, "ec": "none", "pad": 0.5})

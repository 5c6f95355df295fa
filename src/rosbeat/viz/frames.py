"""Frames around what shares one process: a rounded outline with its label on the upper edge."""

from __future__ import annotations

from typing import Any

from matplotlib.patches import FancyBboxPatch

from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas, text_width

LABEL = "one process"
#: From the left end of a frame to its label, in CSS pixels.
_INDENT = 14.0
_CORNER = 10.0


def least_width() -> float:
    """The least width of a frame in CSS pixels, so that its label fits on the edge."""
    return text_width(LABEL, theme.SMALL) + 2 * _INDENT


def draw(canvas: Canvas, left: float, bottom: float, right: float, top: float) -> None:
    """Draw a frame with its label, below everything else in the picture."""
    look: dict[str, Any] = {"fc": theme.FRAME_FILL, "ec": theme.FRAME, "lw": 1.1, "zorder": 0.3}
    box = f"round,pad=0,rounding_size={_CORNER}"
    size = (right - left, top - bottom)
    canvas.axes.add_patch(FancyBboxPatch((left, bottom), *size, boxstyle=box, **look))
    label = canvas.text(left + _INDENT, top, LABEL, theme.SMALL, theme.MUTED)
    # The label interrupts the edge, and an arrow passes behind it.
    label.set_bbox({"fc": theme.CARD, "ec": "none", "pad": 1.5})

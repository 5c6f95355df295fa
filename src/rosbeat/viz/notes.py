"""Notes on arrows: a few words where nothing passes."""

from __future__ import annotations

from dataclasses import dataclass

from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas, line_height, text_width

_PADDING = 5.0


@dataclass(frozen=True)
class Note:
    """Words between the two halves of an arrow.

    Attributes:
        lines: From top to bottom.
        points: Font size in points.
    """

    lines: tuple[str, ...]
    points: float = theme.SMALL

    @property
    def size(self) -> tuple[float, float]:
        """Width and height in CSS pixels."""
        width = max(text_width(line, self.points) for line in self.lines)
        return width + 2 * _PADDING, len(self.lines) * line_height(self.points) + 2 * _PADDING

    def draw(self, canvas: Canvas, x: float, y: float) -> None:
        """Write the words with their middle at (`x`, `y`), in CSS pixels."""
        high = line_height(self.points)
        top = y + high * (len(self.lines) - 1) / 2
        for number, line in enumerate(self.lines):
            canvas.text(x, top - number * high, line, self.points, theme.ALERT_TEXT, "center")

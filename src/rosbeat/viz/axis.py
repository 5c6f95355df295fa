"""A time axis on a canvas: a scale, round ticks, faint rules."""

from __future__ import annotations

from dataclasses import dataclass

from matplotlib.ticker import MaxNLocator

from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas, text_width
from rosbeat.viz.words import number

_STEPS = (1, 2, 5, 10)


@dataclass(frozen=True)
class Scale:
    """From seconds to CSS pixels.

    Attributes:
        first: Time at the left end, in seconds.
        last: Time at the right end, in seconds; equal to `first` if all is one instant.
        left: The left end in CSS pixels.
        right: The right end in CSS pixels.
    """

    first: float
    last: float
    left: float
    right: float

    def __call__(self, time: float) -> float:
        """Where a time is, in CSS pixels; one single instant stands in the middle."""
        if self.last <= self.first:
            return (self.left + self.right) / 2
        part = (time - self.first) / (self.last - self.first)
        return self.left + part * (self.right - self.left)

    def ticks(self) -> list[float]:
        """Round times in the range, few enough that their labels stand apart."""
        if self.last <= self.first:
            return [self.first]
        room = max(text_width(number(end), theme.SMALL) for end in (self.first, self.last)) + 34
        most = max(2, min(10, int((self.right - self.left) / room)))
        values = MaxNLocator(nbins=most, steps=_STEPS).tick_values(self.first, self.last)
        slack = (self.last - self.first) * 1e-9
        return [float(at) for at in values if self.first - slack <= at <= self.last + slack]


def draw(canvas: Canvas, scale: Scale, bottom: float, top: float) -> None:
    """Draw rules from `bottom` to `top` and the times below, the last with its unit."""
    ticks = scale.ticks()
    for at in ticks:
        x = scale(at)
        canvas.axes.plot([x, x], [bottom, top], color=theme.RULE, lw=0.8, zorder=0.5)
        words = f"{number(at)} s"
        canvas.text(x, bottom - 12, words, theme.SMALL, theme.MUTED, "center")

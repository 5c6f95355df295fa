"""Two runs side by side: the values of both over time, and what one of them lacks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isfinite, nan

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from rosbeat.comparisons import Comparison
from rosbeat.errors import PictureError
from rosbeat.records import Sample
from rosbeat.viz import key, theme
from rosbeat.viz.canvas import blank, line_height, text_width
from rosbeat.viz.fields import read
from rosbeat.viz.picture import Picture
from rosbeat.viz.words import count, number, sentence_case

_PLOT = 250.0
_FOOT = 36.0
#: Up to so many messages each has its own mark; above, marks stand at a distance.
_MARKS = 60
_AIR = 0.08
_ONE = theme.Style(theme.BLUE, "o", "-")
_OTHER = theme.Style(theme.VERMILLION, "s", "--")
_MISSING = theme.Style(theme.BLUE, "o", "")
_EXTRA = theme.Style(theme.PURPLE, "D", "")
_ODD = theme.Style(theme.INK, "x", "")


@dataclass(frozen=True)
class _Points:
    """Times in seconds and values, as they are drawn."""

    times: tuple[float, ...]
    values: tuple[float, ...]

    @property
    def finite(self) -> list[float]:
        return [value for value in self.values if isfinite(value)]

    def where(self, finite: bool) -> _Points:
        """Those with finite values, or those without."""
        both = zip(self.times, self.values, strict=True)
        kept = [(at, value) for at, value in both if isfinite(value) == finite]
        return _Points(tuple(at for at, _ in kept), tuple(value for _, value in kept))


@dataclass(frozen=True)
class _Plan:
    """What is drawn."""

    one: _Points
    other: _Points
    missing: _Points
    extra: _Points

    @property
    def odd(self) -> _Points:
        """What the second run has that is no finite number."""
        return self.other.where(finite=False)


def differences(
    comparison: Comparison, field: str | None = None, label: str | None = None, unit: str = ""
) -> Picture:
    """Draw two runs over each other, and mark what only one of them has.

    Args:
        comparison: What `rosbeat.bags.compare` found.
        field: Field to draw if messages have several, nested ones with dots.
        label: What the values are; the topic's name by default.
        unit: Unit of the values, such as `°C`.

    Returns:
        The picture.

    Raises:
        PictureError: If it is no comparison, there is no value to draw, or the field is missing or
            not a number.
    """
    plan = _plan(comparison, field)
    name = label or comparison.topic
    entries = _key(plan, comparison.names)
    room = theme.WIDTH - 2 * theme.MARGIN
    head = line_height() + 8 + key.height(entries, room)
    with blank(2 * theme.MARGIN + head + _PLOT + _FOOT) as canvas:
        top = canvas.height - theme.MARGIN
        heading = f"{name} in {unit}" if unit else name
        canvas.text(theme.MARGIN, top - line_height() / 2, heading, weight="bold")
        key.draw(canvas, entries, theme.MARGIN, top - line_height() - 4, room)
        low, high = _extent(plan)
        left = theme.MARGIN + max(text_width(number(at), theme.SMALL) for at in _ticks(low, high))
        place = ((left + 10) / canvas.width, (theme.MARGIN + _FOOT) / canvas.height)
        size = ((canvas.width - left - 16 - theme.MARGIN) / canvas.width, _PLOT / canvas.height)
        axes = canvas.figure.add_axes((*place, *size), zorder=2, ylim=(low, high))
        _dress(axes, low, high)
        _draw(axes, plan)
    words = f"{sentence_case(name)} of two runs" + (f", in {unit}." if unit else ".")
    return Picture(canvas.figure, f"{words} {comparison!r}{_oddities(plan)}", f"{name} compared")


def _plan(comparison: object, field: str | None) -> _Plan:
    if not isinstance(comparison, Comparison):
        raise PictureError(
            f"Differences cannot be drawn from {type(comparison).__name__!r}.",
            "They are drawn from a comparison of two runs.",
            'Write `viz.differences(compare(one, other, "temperature"))`.',
        )
    ones = [one for one, _ in comparison.pairs]
    others = [other for _, other in comparison.pairs]
    plan = _Plan(
        _points([*ones, *comparison.missing], field),
        _points([*others, *comparison.extra], field),
        _points(comparison.missing, field).where(finite=True),
        _points(comparison.extra, field).where(finite=True),
    )
    if not plan.one.finite and not plan.other.finite:
        raise PictureError(
            f"There is no value to draw on {comparison.topic}.",
            "Neither run has a message with a finite number there.",
            "Run the sessions for some seconds first, or choose another topic.",
        )
    return plan


def _points(samples: Iterable[Sample], field: str | None) -> _Points:
    ordered = sorted(samples, key=lambda one: one.time_ns)
    return _Points(tuple(one.time for one in ordered), tuple(read(one, field) for one in ordered))


def _oddities(plan: _Plan) -> str:
    total = len(plan.odd.times)
    if not total:
        return ""
    verb = "is" if total == 1 else "are"
    return f" {count(total, 'value')} of the second {verb} infinite or not a number."


def _key(plan: _Plan, names: tuple[str, str]) -> list[key.Entry]:
    """The marks in use, each with its meaning."""
    hollow = theme.CARD
    one, other = names
    entries = (
        (key.Entry(one, _ONE), plan.one),
        (key.Entry(other, _OTHER), plan.other),
        (key.Entry(f"missing in {other}", _MISSING, hollow), plan.missing),
        (key.Entry(f"only in {other}", _EXTRA, hollow), plan.extra),
        (key.Entry("not a number", _ODD), plan.odd),
    )
    return [entry for entry, points in entries if points.times]


def _extent(plan: _Plan) -> tuple[float, float]:
    """The value range of both runs, with air around."""
    every = plan.one.finite + plan.other.finite
    low, high = min(every), max(every)
    air = (high - low) * _AIR or abs(high) * 0.1 or 1.0
    return low - air, high + air


def _ticks(low: float, high: float) -> list[float]:
    ticks = MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [tick for tick in ticks if low <= tick <= high]


def _dress(axes: Axes, low: float, high: float) -> None:
    shown = _ticks(low, high)
    axes.set_yticks(shown, [number(tick) for tick in shown])
    axes.xaxis.set_major_locator(MaxNLocator(nbins=9, steps=[1, 2, 5, 10]))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda at, _: number(at)))
    axes.set_xlabel("virtual time in s", size=theme.SMALL, color=theme.MUTED)
    axes.tick_params(length=0, labelsize=theme.SMALL)
    axes.grid(color=theme.RULE, lw=0.7)
    axes.set_axisbelow(True)
    axes.spines[:].set_visible(False)


def _draw(axes: Axes, plan: _Plan) -> None:
    times = plan.one.times + plan.other.times
    first, last = min(0.0, *times), max(times)
    air = (last - first) * 0.015 or 0.5
    axes.set_xlim(first - air, last + air)
    # The first line is the wider one, so that it is seen where both are the same.
    _draw_line(axes, plan.one, _ONE, 3.2)
    _draw_line(axes, plan.other, _OTHER, 1.6)
    for points, look in ((plan.missing, _MISSING), (plan.extra, _EXTRA)):
        _draw_marks(axes, points.times, points.values, look)
    low, high = axes.get_ylim()
    foot = low + _AIR / 2 * (high - low)
    _draw_marks(axes, plan.odd.times, [foot] * len(plan.odd.times), _ODD)


def _draw_line(axes: Axes, points: _Points, look: theme.Style, width: float) -> None:
    axes.plot(
        points.times,
        [value if isfinite(value) else nan for value in points.values],
        color=look.colour,
        ls=look.dash,
        lw=width,
        drawstyle="steps-post",
        marker=look.marker,
        ms=4,
        mec=theme.CARD,
        mew=0.6,
        markevery=max(1, len(points.values) // _MARKS),
        clip_on=False,
        zorder=3,
    )


def _draw_marks(
    axes: Axes, times: Sequence[float], values: Sequence[float], look: theme.Style
) -> None:
    fill = look.colour if look.marker == "x" else theme.CARD
    axes.plot(
        times,
        values,
        ls="",
        marker=look.marker,
        ms=5 if look.marker == "x" else 7,
        mfc=fill,
        mec=look.colour,
        mew=1.6,
        clip_on=False,
        zorder=4,
    )

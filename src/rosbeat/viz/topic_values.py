"""A topic's numbers over virtual time, with threshold bands."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from rosbeat.errors import PictureError
from rosbeat.records import Sample
from rosbeat.viz import key, sources, theme
from rosbeat.viz.bands import Band, Limits, read_bands
from rosbeat.viz.canvas import Canvas, blank, line_height, text_width
from rosbeat.viz.fields import Series, series
from rosbeat.viz.picture import Picture
from rosbeat.viz.placement import spread
from rosbeat.viz.value_words import describe
from rosbeat.viz.words import number

_PLOT = 250.0
_FOOT = 36.0
#: Up to so many messages each has its own mark; above, marks stand at a distance.
_MARKS = 60
#: Free part of the value range above and below, so that every band has room for its name.
_AIR = 0.14


def values(
    source: sources.Samples,
    topic: str | Iterable[str] | None = None,
    bands: Limits | None = None,
    label: str | None = None,
    unit: str = "",
    field: str | None = None,
) -> Picture:
    """Draw the values of one topic or several over virtual time.

    A value holds until the next message, so the line has steps. Each publisher has its own line.

    Args:
        source: A session, what it observed, or a sequence of messages.
        topic: Topic to draw, or several. May be left out if the source has only one.
        bands: Named ranges, from the name to (lower, upper) limit, None for an open end. A band
            with two limits includes both, an open one does not include its limit.
        label: What the values are; the topic's name by default.
        unit: Unit of the values, such as `°C`.
        field: Field to draw if messages have several, nested ones with dots.

    Returns:
        The picture.

    Raises:
        PictureError: If the topic is unknown, nothing was published on it, the field is missing or
            not a number, or a band is not a pair of ascending limits.
    """
    samples = _chosen(sources.samples(source), topic)
    lines, ranges = series(samples, field), read_bands(bands)
    if not any(line.finite for line in lines):
        raise PictureError(
            f"There is no value to draw on {lines[0].topic}.",
            "Every value is infinite or not a number, so none has a place on an axis.",
            "Look at the node that publishes it.",
        )
    name = label or _names(dict.fromkeys(line.topic for line in lines))
    entries = _key(lines)
    room = theme.WIDTH - 2 * theme.MARGIN
    head = line_height() + 8 + key.height(entries, room)
    with blank(2 * theme.MARGIN + head + _PLOT + _FOOT) as canvas:
        top = canvas.height - theme.MARGIN
        heading = f"{name} in {unit}" if unit else name
        canvas.text(theme.MARGIN, top - line_height() / 2, heading, weight="bold")
        key.draw(canvas, entries, theme.MARGIN, top - line_height() - 4, room)
        _draw_plot(canvas, lines, ranges, unit)
    return Picture(canvas.figure, describe(lines, ranges, name, unit), f"{name} over time")


def _names(topics: Iterable[str]) -> str:
    return ", ".join(topics)


def _chosen(samples: Sequence[Sample], topic: str | Iterable[str] | None) -> list[Sample]:
    known = tuple(dict.fromkeys(one.topic for one in samples))
    if not known:
        raise PictureError(
            "There are no messages to draw.",
            "Nothing was published while the session ran, or it did not run.",
            "Run the session for some seconds first.",
        )
    if topic is None and len(known) > 1:
        raise PictureError(
            f"There are messages on {len(known)} topics.",
            "Different topics often have different units and do not share an axis.",
            f"Choose one: {', '.join(known)}.",
        )
    wanted = sources.topic_names(topic, known) or known
    return [one for one in samples if one.topic in wanted]


def _key(lines: Sequence[Series]) -> list[key.Entry]:
    """A key only where it is needed: for more than one line."""
    if len(lines) < 2:
        return []
    topics = {line.topic for line in lines}
    return [
        key.Entry(
            line.node if len(topics) == 1 else f"{line.topic} from {line.node}", theme.style(k)
        )
        for k, line in enumerate(lines)
    ]


def _draw_plot(canvas: Canvas, lines: Sequence[Series], ranges: Sequence[Band], unit: str) -> None:
    low, high = _extent(lines, ranges)
    axes = _axes(canvas, low, high, _right(ranges, unit))
    for rank, band in enumerate(ranges):
        _draw_band(axes, band, theme.BANDS[rank % len(theme.BANDS)])
    _name_bands(canvas, axes, ranges, unit)
    for rank, line in enumerate(lines):
        _draw_line(axes, line, theme.style(rank))
    last = max(line.times[-1] for line in lines)
    first = min(0.0, *(line.times[0] for line in lines))
    air = (last - first) * 0.015 or 0.5
    axes.set_xlim(first - air, last + air)


def _axes(canvas: Canvas, low: float, high: float, right: float) -> Axes:
    ticks = MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10])
    shown = [tick for tick in ticks.tick_values(low, high) if low <= tick <= high]
    left = theme.MARGIN + max(text_width(number(tick), theme.SMALL) for tick in shown) + 10
    width = canvas.width - left - right
    place = (left / canvas.width, (theme.MARGIN + _FOOT) / canvas.height)
    axes = canvas.figure.add_axes(
        (*place, width / canvas.width, _PLOT / canvas.height), zorder=2, ylim=(low, high)
    )
    axes.set_yticks(shown, [number(tick) for tick in shown])
    axes.xaxis.set_major_locator(MaxNLocator(nbins=9, steps=[1, 2, 5, 10]))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda at, _: number(at)))
    axes.set_xlabel("virtual time in s", size=theme.SMALL, color=theme.MUTED)
    axes.tick_params(length=0, labelsize=theme.SMALL)
    axes.grid(color=theme.RULE, lw=0.7)
    axes.set_axisbelow(True)
    axes.spines[:].set_visible(False)
    return axes


def _right(ranges: Sequence[Band], unit: str) -> float:
    """Space at the right for the names of the bands, in CSS pixels."""
    words = [band.name for band in ranges]
    wide = max((text_width(word, theme.TEXT, "bold") for word in words), default=0.0)
    limits = (text_width(band.words(unit), theme.SMALL) for band in ranges)
    return theme.MARGIN + max(wide, *limits, 0.0) + 10 if words else theme.MARGIN + 6.0


def _extent(lines: Sequence[Series], ranges: Sequence[Band]) -> tuple[float, float]:
    """The value range: all values and all limits, with air around."""
    limits = [limit for band in ranges for limit in (band.low, band.high) if limit is not None]
    every = [value for line in lines for value in line.finite] + limits
    low, high = min(every), max(every)
    air = (high - low) * _AIR or abs(high) * 0.1 or 1.0
    return low - air, high + air


def _draw_band(axes: Axes, band: Band, tint: str) -> None:
    low, high = _visible(axes, band)
    axes.axhspan(low, high, color=tint, lw=0, zorder=0)
    for limit in (band.low, band.high):
        if limit is not None:
            axes.axhline(limit, color=theme.MUTED, lw=1, ls=(0, (4, 3)), zorder=1)


def _visible(axes: Axes, band: Band) -> tuple[float, float]:
    """The part of a band that is inside the axes."""
    bottom, top = axes.get_ylim()
    return (
        bottom if band.low is None else max(bottom, band.low),
        top if band.high is None else min(top, band.high),
    )


def _name_bands(canvas: Canvas, axes: Axes, ranges: Sequence[Band], unit: str) -> None:
    """Write each band's name beside its middle, moved as little as keeps the names apart."""
    bottom, top = axes.get_ylim()
    foot, x = theme.MARGIN + _FOOT, canvas.width - _right(ranges, unit) + 10
    middles = [sum(_visible(axes, band)) / 2 for band in ranges]
    wishes = [foot + (middle - bottom) / (top - bottom) * _PLOT for middle in middles]
    high = line_height() + line_height(theme.SMALL)
    for band, y in zip(ranges, spread(wishes, [high] * (len(ranges) - 1)), strict=True):
        canvas.text(x, y + line_height(theme.SMALL) / 2, band.name, weight="bold")
        limits = band.words(unit)
        canvas.text(x, y - line_height() / 2, limits, theme.SMALL, theme.MUTED)


def _draw_line(axes: Axes, line: Series, look: theme.Style) -> None:
    every = max(1, len(line.values) // _MARKS)
    numbers = [value if isfinite(value) else float("nan") for value in line.values]
    axes.plot(
        line.times,
        numbers,
        color=look.colour,
        ls=look.dash,
        lw=1.6,
        drawstyle="steps-post",
        marker=look.marker,
        ms=5,
        mec=theme.CARD,
        mew=0.6,
        markevery=every,
        clip_on=False,
        zorder=3,
    )

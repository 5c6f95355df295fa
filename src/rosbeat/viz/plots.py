"""Plot numbers over virtual time: the values of topics with threshold bands, and two runs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf, isfinite, nan

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from rosbeat.comparisons import Comparison
from rosbeat.errors import PictureError, called_as
from rosbeat.records import Sample
from rosbeat.viz import arguments, theme
from rosbeat.viz.canvas import Canvas, Entry, blank, line_height, text_width
from rosbeat.viz.layout import apart
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import count, listing, number, rounded, sentence_case

_PLOT, _HEAD, _FOOT = 250.0, 4.0, 36.0
#: Up to so many messages of a line each has its own mark. A line of more has none, unless there are
#: several lines: then each has so few that they do not run together, and tells itself apart.
_MARKS, _FEW_MARKS = 60, 10
#: Free part of the value range above and below: so that every band has room for its name, or not.
_BAND_AIR, _AIR = 0.14, 0.08

_ONE = theme.Style(theme.BLUE, "o", "-")
_OTHER = theme.Style(theme.VERMILLION, "s", "--")
_MISSING = theme.Style(theme.BLUE, "o", "")
_EXTRA = theme.Style(theme.PURPLE, "D", "")
_ODD = theme.Style(theme.INK, "x", "")
_BANDS = 'For example `bands={"Low": (None, 20.0), "Normal": (20.0, 26.0)}`.'

#: What a caller gives: from a name to lower and upper limit, None for an open end.
Limits = Mapping[str, tuple[float | None, float | None]]


@dataclass(frozen=True)
class Series:
    """Hold numbers at times, such as one publisher's on one topic.

    Attributes:
        times: In seconds of virtual time, ascending.
        values: The numbers, maybe some that are not finite.
        topic: Full name of the topic.
        node: Full name of the node that published.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    topic: str = ""
    node: str = ""

    @property
    def finite(self) -> list[float]:
        """Return the values that can be drawn."""
        return [value for value in self.values if isfinite(value)]

    def where(self, finite: bool) -> Series:
        """Return those with finite values, or those without."""
        both = zip(self.times, self.values, strict=True)
        kept = [(at, value) for at, value in both if isfinite(value) == finite]
        return Series(tuple(at for at, _ in kept), tuple(value for _, value in kept))


def _series(samples: Iterable[Sample], field: str | None, *names: str) -> Series:
    ordered = sorted(samples, key=lambda one: one.time_ns)
    numbers = tuple(arguments.number_in(one, field) for one in ordered)
    return Series(tuple(one.time for one in ordered), numbers, *names)


# Values of topics, with threshold bands.


@dataclass(frozen=True)
class Band:
    """Hold one named range of a value, such as Low, Normal or High.

    Attributes:
        name: What it is called.
        low: Lower limit, or minus infinity.
        high: Upper limit, or infinity.
    """

    name: str
    low: float
    high: float

    @property
    def limits(self) -> list[float]:
        """Return the limits that it has."""
        return [limit for limit in (self.low, self.high) if isfinite(limit)]

    def holds(self, value: float) -> bool:
        """Return whether a finite value is in the band: one with two limits includes both."""
        if len(self.limits) == 2:
            return self.low <= value <= self.high
        return self.low < value < self.high

    def words(self, unit: str = "") -> str:
        """Return the range in words: `below 20 °C`, `20 to 26 °C`, `above 26 °C`."""
        if not self.limits:
            return "any value"
        limits = " to ".join(map(number, self.limits)) + (f" {unit}" if unit else "")
        if len(self.limits) == 2:
            return limits
        return f"above {limits}" if isfinite(self.low) else f"below {limits}"


def read_bands(limits: Limits | None) -> tuple[Band, ...]:
    """Return bands in ascending order.

    Raises:
        PictureError: If they are no dictionary, a band is not a pair, or its lower limit is not
            below its upper one.
    """
    if not isinstance(limits, Mapping | None):
        raise PictureError(
            f"`bands` was given {limits!r}.",
            "Bands are a dictionary that gives each name its limits.",
            _BANDS,
        )
    found = [_band(name, pair) for name, pair in (limits or {}).items()]
    return tuple(sorted(found, key=lambda band: band.low))


def _band(name: str, pair: object) -> Band:
    match pair:
        case (None | int() | float() as low, None | int() | float() as high):
            band = Band(name, -inf if low is None else low, inf if high is None else high)
            if band.low < band.high:
                return band
    raise PictureError(
        f"The band {name!r} has the limits {pair!r}.",
        "A band is a pair: a lower limit and a higher one, None where it is open.",
        _BANDS,
    )


@called_as('viz.values(ros, "temperature")')
def values(
    source: arguments.Samples,
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

    Raises:
        PictureError: If the topic is unknown, nothing was published on it, the field is missing or
            not a number, or a band is not a pair of ascending limits.
    """
    lines, ranges = _lines(_chosen(arguments.samples(source), topic), field), read_bands(bands)
    if not any(line.finite for line in lines):
        raise PictureError(
            f"There is no value to draw on {lines[0].topic}.",
            "Every value is infinite or not a number, so none has a place on an axis.",
            "Look at the node that publishes it.",
        )
    name = label or ", ".join(dict.fromkeys(line.topic for line in lines))
    limits = [limit for band in ranges for limit in band.limits]
    extent = _extent([*limits, *(value for line in lines for value in line.finite)], _BAND_AIR)
    with _plot(name, unit, _line_key(lines), extent, _room_for_names(ranges, unit)) as (
        canvas,
        axes,
    ):
        for rank, band in enumerate(ranges):
            _draw_band(axes, band, theme.BANDS[rank % len(theme.BANDS)])
        _name_bands(canvas, axes, ranges, unit)
        for rank, line in enumerate(lines):
            _draw_line(axes, line, theme.style(rank), is_alone=len(lines) == 1)
        _fit(axes, [at for line in lines for at in line.times])
    return Picture(canvas.figure, _say_values(lines, ranges, name, unit), f"{name} over time")


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
    wanted = arguments.topic_names(topic, known) or known
    return [one for one in samples if one.topic in wanted]


def _lines(samples: Sequence[Sample], field: str | None) -> list[Series]:
    """Return one series for each topic and publisher, in order of first message."""
    groups: dict[tuple[str, str], list[Sample]] = {}
    for one in samples:
        groups.setdefault((one.topic, one.node), []).append(one)
    return [_series(group, field, *names) for names, group in groups.items()]


def _line_key(lines: Sequence[Series]) -> list[Entry]:
    """Return a key only where it is needed: for more than one line."""
    if len(lines) < 2:
        return []
    is_one_topic = len({line.topic for line in lines}) == 1
    return [
        Entry(line.node if is_one_topic else f"{line.topic} from {line.node}", theme.style(k))
        for k, line in enumerate(lines)
    ]


def _draw_band(axes: Axes, band: Band, tint: str) -> None:
    axes.axhspan(*_visible(axes, band), color=tint, lw=0, zorder=0)
    for limit in band.limits:
        axes.axhline(limit, color=theme.MUTED, lw=1, ls=(0, (4, 3)), zorder=1)


def _visible(axes: Axes, band: Band) -> tuple[float, float]:
    """Return the part of a band that is inside the axes."""
    bottom, top = axes.get_ylim()
    return max(bottom, band.low), min(top, band.high)


def _room_for_names(ranges: Sequence[Band], unit: str) -> float:
    """Return the width of the names of the bands, in CSS pixels."""
    names = (text_width(band.name, weight="bold") for band in ranges)
    return max([0.0, *names, *(text_width(band.words(unit)) for band in ranges)])


def _name_bands(canvas: Canvas, axes: Axes, ranges: Sequence[Band], unit: str) -> None:
    """Write each band's name beside its middle, moved as little as keeps the names apart."""
    bottom, top = axes.get_ylim()
    x = canvas.width - theme.MARGIN - _room_for_names(ranges, unit)
    wishes = []
    for band in ranges:
        part = (sum(_visible(axes, band)) / 2 - bottom) / (top - bottom)
        wishes.append(canvas.bottom + _FOOT + part * _PLOT)
    places = apart(wishes, [2 * line_height()] * (len(ranges) - 1))
    for band, y in zip(ranges, places, strict=True):
        canvas.text(x, y + line_height() / 2, band.name, weight="bold")
        limits = band.words(unit)
        canvas.text(x, y - line_height() / 2, limits, theme.MUTED)


def _say_values(lines: Sequence[Series], bands: Sequence[Band], name: str, unit: str) -> str:
    head = f"{sentence_case(name)} over virtual time" + (f", in {unit}." if unit else ".")
    return " ".join([head, *(_say_line(line, bands, unit) for line in lines)])


def _say_line(line: Series, bands: Sequence[Band], unit: str) -> str:
    """Tell how many values there are, from where to where, and in which band."""
    total, finite = len(line.values), line.finite
    first, last = number(line.times[0]), number(line.times[-1])
    span = f"at {first} s" if first == last else f"from {first} s to {last} s"
    said = [f"{count(total, 'value')} on {line.topic} from {line.node}, {span}."]
    if finite:
        said.append(_say_range(finite, f" {unit}" if unit else ""))
    if lost := total - len(finite):
        said.append(f"{count(lost, 'value')} {_no_numbers(lost)} and left out.")
    if bands:
        # A value in two bands counts for the first.
        homes = [next((band for band in bands if band.holds(value)), None) for value in finite]
        shares = [
            f"{homes.count(band) or 'none'} {band.name} ({band.words(unit)})" for band in bands
        ]
        shares += [f"{homes.count(None)} in no band"] if None in homes else []
        said.append(f"Of these, {listing(shares)}.")
    return " ".join(said)


def _say_range(finite: Sequence[float], tail: str) -> str:
    low, high = rounded(min(finite)), rounded(max(finite))
    if low == high:
        return f"All of them are {low}{tail}." if len(finite) > 1 else f"It is {low}{tail}."
    ends = f"first {rounded(finite[0])}, last {rounded(finite[-1])}{tail}"
    return f"They lie between {low} and {high}{tail}: {ends}."


# Two runs over each other.


@called_as("viz.comparison(compared)")
def comparison(
    compared: Comparison, field: str | None = None, label: str | None = None, unit: str = ""
) -> Picture:
    """Draw two runs over each other, and mark what only one of them has.

    Args:
        compared: What `rosbeat.bags.compare` found.
        field: Field to draw if messages have several, nested ones with dots.
        label: What the values are; the topic's name by default.
        unit: Unit of the values, such as `°C`.

    Raises:
        PictureError: If it is no comparison, there is no value to draw, or the field is missing or
            not a number.
    """
    if not isinstance(compared, Comparison):
        raise PictureError(
            f"A comparison cannot be drawn from {type(compared).__name__!r}.",
            "It is drawn from two runs that were compared.",
            'Write `viz.comparison(bags.compare(one, other, "temperature"))`.',
        )
    missing = _series(compared.missing, field).where(finite=True)
    extra = _series(compared.extra, field).where(finite=True)
    one = _series([*(first for first, _ in compared.pairs), *compared.missing], field)
    other = _series([*(second for _, second in compared.pairs), *compared.extra], field)
    odd = other.where(finite=False)
    if not one.finite and not other.finite:
        raise PictureError(
            f"There is no value to draw on {compared.topic}.",
            "Neither run has a message with a finite number there.",
            "Run the sessions for some seconds first, or choose another topic.",
        )
    name, hollow = label or compared.topic, theme.CARD
    first, second = compared.names
    entries = (
        (Entry(first, _ONE), one),
        (Entry(second, _OTHER), other),
        (Entry(f"missing in {second}", _MISSING, hollow), missing),
        (Entry(f"only in {second}", _EXTRA, hollow), extra),
        (Entry("not a number", _ODD), odd),
    )
    key = [entry for entry, points in entries if points.times]
    low, high = _extent(one.finite + other.finite, _AIR)
    with _plot(name, unit, key, (low, high)) as (canvas, axes):
        _fit(axes, one.times + other.times)
        # The first line is the wider one, so that it is seen where both are the same.
        _draw_line(axes, one, _ONE, width=3.2)
        _draw_line(axes, other, _OTHER)
        for points, look in ((missing, _MISSING), (extra, _EXTRA)):
            _draw_marks(axes, points.times, points.values, look)
        foot = low + _AIR / 2 * (high - low)
        _draw_marks(axes, odd.times, [foot] * len(odd.times), _ODD)
    words = f"{sentence_case(name)} of two runs" + (f", in {unit}." if unit else ".")
    return Picture(canvas.figure, f"{words} {compared!r}{_say_odd(odd)}", f"{name} compared")


def _draw_marks(
    axes: Axes, times: Sequence[float], values: Sequence[float], look: theme.Style
) -> None:
    is_cross = look.marker == "x"
    fill, size = (look.colour, 5) if is_cross else (theme.CARD, 7)
    line = axes.plot(times, values, look.marker, mfc=fill, ms=size, mec=look.colour, mew=1.6)
    line[0].set(clip_on=False, zorder=4)


def _say_odd(odd: Series) -> str:
    total = len(odd.times)
    return f" {count(total, 'value')} of the second {_no_numbers(total)}." if total else ""


def _no_numbers(total: int) -> str:
    return f"{'is' if total == 1 else 'are'} infinite or not a number"


# Axes over virtual time.


@contextmanager
def _plot(
    name: str, unit: str, key: Sequence[Entry], extent: tuple[float, float], names: float = 0.0
) -> Iterator[tuple[Canvas, Axes]]:
    """Make a canvas with a heading and a key, and axes on it with room for names at the right."""
    heading = f"{name} in {unit}" if unit else name
    locator = MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10])
    ticks = [tick for tick in locator.tick_values(*extent) if extent[0] <= tick <= extent[1]]
    left = theme.MARGIN + max(text_width(number(tick)) for tick in ticks) + 10
    right = theme.MARGIN + (names + 10 if names else 6)
    with blank(_HEAD + _PLOT + _FOOT, entries=key, heading=heading) as canvas:
        place = (left / canvas.width, (canvas.bottom + _FOOT) / canvas.height)
        size = ((canvas.width - left - right) / canvas.width, _PLOT / canvas.height)
        axes = canvas.figure.add_axes((*place, *size), zorder=2, ylim=extent)
        axes.set_yticks(ticks, [number(tick) for tick in ticks])
        axes.xaxis.set_major_locator(MaxNLocator(nbins=9, steps=[1, 2, 5, 10]))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda at, _: number(at)))
        axes.set_xlabel("virtual time in s", color=theme.MUTED)
        axes.tick_params(length=0)
        axes.grid(color=theme.RULE, lw=0.7)
        axes.set_axisbelow(True)
        axes.spines[:].set_visible(False)
        yield canvas, axes


def _extent(values: Sequence[float], air: float) -> tuple[float, float]:
    """Return the range of the values, with a share of it as air above and below."""
    low, high = min(values), max(values)
    free = (high - low) * air or abs(high) * 0.1 or 1.0
    return low - free, high + free


def _fit(axes: Axes, times: Sequence[float]) -> None:
    """Let the axes reach from 0 s, or what was before it, to the last time."""
    first, last = min(0.0, *times), max(times)
    air = (last - first) * 0.015 or 0.5
    axes.set_xlim(first - air, last + air)


def _draw_line(
    axes: Axes,
    line: Series,
    look: theme.Style,
    is_alone: bool = False,
    width: float = 1.6,
) -> None:
    numbers = [value if isfinite(value) else nan for value in line.values]
    (drawn,) = axes.plot(line.times, numbers, color=look.colour, ls=look.dash, lw=width)
    drawn.set(drawstyle="steps-post", clip_on=False, zorder=3)
    if len(numbers) <= _MARKS or not is_alone:
        every = max(1, len(numbers) // _FEW_MARKS) if len(numbers) > _MARKS else 1
        drawn.set(marker=look.marker, ms=width + 3.4, mec=theme.CARD, mew=0.6, markevery=every)

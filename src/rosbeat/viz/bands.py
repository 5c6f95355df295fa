"""Threshold bands: named ranges of a value, such as Low, Normal and High."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isnan

from rosbeat.errors import PictureError
from rosbeat.viz.words import number

#: What a caller gives: from a name to lower and upper limit, None for an open end.
Limits = Mapping[str, tuple[float | None, float | None]]


@dataclass(frozen=True)
class Band:
    """One named range.

    Attributes:
        name: What it is called.
        low: Lower limit, or None.
        high: Upper limit, or None.
    """

    name: str
    low: float | None
    high: float | None

    def holds(self, value: float) -> bool:
        """Whether a value is in the band: a band with two limits includes both of them."""
        closed = self.low is not None and self.high is not None
        above = self.low is None or value > self.low or (closed and value == self.low)
        below = self.high is None or value < self.high or (closed and value == self.high)
        return above and below and not isnan(value)

    def words(self, unit: str = "") -> str:
        """The range in words: `below 20 °C`, `20 to 26 °C`, `above 26 °C`."""
        tail = f" {unit}" if unit else ""
        if self.low is None and self.high is None:
            return "any value"
        if self.low is None:
            return f"below {number(self.high or 0.0)}{tail}"
        if self.high is None:
            return f"above {number(self.low)}{tail}"
        return f"{number(self.low)} to {number(self.high)}{tail}"


def read_bands(limits: Limits | None) -> tuple[Band, ...]:
    """Bands in ascending order.

    Raises:
        PictureError: If a band is not a pair, or its lower limit is not below its upper one.
    """
    found = [_band(name, pair) for name, pair in (limits or {}).items()]
    return tuple(sorted(found, key=lambda band: float("-inf") if band.low is None else band.low))


def tally(bands: Sequence[Band], values: Sequence[float]) -> dict[str, int]:
    """How many values each band holds; a value in two bands counts for the first."""
    totals = {band.name: 0 for band in bands}
    for value in values:
        home = next((band.name for band in bands if band.holds(value)), None)
        if home is not None:
            totals[home] += 1
    return totals


def _band(name: str, pair: object) -> Band:
    match pair:
        case (None | int() | float() as low, None | int() | float() as high):
            if low is None or high is None or low < high:
                return Band(name, low, high)
    raise PictureError(
        f"The band {name!r} has the limits {pair!r}.",
        "A band is a pair: a lower limit and a higher one, None where it is open.",
        'For example `bands={"Low": (None, 20.0), "Normal": (20.0, 26.0)}`.',
    )

"""The weather of each trial.

Everything follows from the numbers of a rubric. Each temperature is held for one second longer
than a system may take to react, so that what it does can be told from what it did.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, nan

#: The numbers that stand in the course's own rubric: limits in degrees Celsius and per cent, and
#: times in seconds.
USUAL: Mapping[str, float] = {
    "open_above": 28.0,
    "close_below": 26.0,
    "dry_below": 40.0,
    "temperature_min": -20.0,
    "temperature_max": 60.0,
    "pump_seconds": 5.0,
    "rest_seconds": 20.0,
    "silent_seconds": 5.0,
    "report_seconds": 10.0,
    "react_seconds": 2.0,
}
WET = 95.0
#: How far beyond a limit a reading is that is clearly beyond it.
_BEYOND, _JUST = 4.0, 0.25


@dataclass
class Day:
    """What two sensors say, second by second from 1 s on, and what matters in it.

    Attributes:
        temperature: Readings; None is a second without a message.
        humidity: The same.
        marks: When something begins, by name.
        held: For each temperature that tries the vent alone: when it begins, when it ends, and
            the temperature.
    """

    temperature: list[float | None] = field(default_factory=list)
    humidity: list[float | None] = field(default_factory=list)
    marks: dict[str, int] = field(default_factory=dict)
    held: list[tuple[int, int, float]] = field(default_factory=list)

    @property
    def seconds(self) -> int:
        """How long it takes."""
        return len(self.temperature) + 1

    def hold(
        self, seconds: float, temperature: float | None, humidity: float | None, mark: str = ""
    ) -> int:
        """Let the sensors say the same for some seconds; return when that begins."""
        begins = self.seconds
        self.temperature += [temperature] * int(seconds)
        self.humidity += [humidity] * int(seconds)
        if mark:
            self.marks[mark] = begins
        return begins


@dataclass(frozen=True)
class Air:
    """Readings with a name.

    Attributes:
        hot: Clearly above the limit at which the vent opens.
        middle: Between the two limits.
        cold: Clearly below the limit at which it closes.
        dry: Clearly below the limit for the pump.
    """

    hot: float
    middle: float
    cold: float
    dry: float


def air(numbers: Mapping[str, float]) -> Air:
    """The readings that the trials are made of."""
    opening, closing = numbers["open_above"], numbers["close_below"]
    middle = (opening + closing) / 2
    return Air(opening + _BEYOND, middle, closing - _BEYOND, numbers["dry_below"] - 10)


def as_sent(value: float) -> float:
    """A number as a `Float32` carries it."""
    return float(struct.unpack("f", struct.pack("f", value))[0])


def vent_readings(numbers: Mapping[str, float]) -> list[float]:
    """Temperatures on all sides of both limits at which the vent moves."""
    opening, closing, some = numbers["open_above"], numbers["close_below"], air(numbers)
    # A limit that a Float32 cannot carry is met by no reading.
    top = opening if as_sent(opening) == opening else opening - _JUST
    bottom = closing if as_sent(closing) == closing else closing + _JUST
    return [
        *(some.cold, some.middle, top, opening + _JUST),
        *(some.middle, bottom, closing - _JUST, some.middle),
        *(some.hot, some.middle, some.cold, some.cold + 1),
    ]


def plain_day(n: Mapping[str, float]) -> Day:
    """Sensors that work: the vent alone, the pump alone, then both at once."""
    day, some, react = Day(), air(n), n["react_seconds"]
    _airing(day, n, react)
    limit = n["dry_below"]
    at_limit = limit if as_sent(limit) == limit else limit + _JUST
    cold, pause = some.cold, n["pump_seconds"] + n["rest_seconds"]
    day.hold(2, cold, WET, "pumping")
    day.hold(react + 1, cold + 1, at_limit, "at the limit")
    day.hold(react + 1, cold + 2, limit - _JUST, "dry")
    day.hold(pause + 9 - react - 1, cold, some.dry)
    day.hold(pause + 3, cold + 1, WET, "wet")
    day.hold(react + 1, some.hot, WET, "both")
    day.hold(max(n["pump_seconds"], react) + 10, some.hot + 1, some.dry, "hot and dry")
    day.hold(2 * react + 2, cold, some.dry, "cool and dry")
    day.hold(pause + react + 3, cold + 1, WET)
    day.hold(react, cold, some.dry, "dry again")
    day.hold(n["pump_seconds"] + 6, some.hot, some.dry, "hot again")
    return day


def _airing(day: Day, n: Mapping[str, float], react: float) -> None:
    for value in vent_readings(n):
        begins = day.hold(react + 1, value, WET)
        day.held.append((begins, day.seconds, value))


def airing(n: Mapping[str, float]) -> Day:
    """The first part of the plain day, for the vent alone."""
    day = Day()
    _airing(day, n, n["react_seconds"])
    return day


def broken_day(n: Mapping[str, float]) -> Day:
    """Sensors that say what cannot be, and sensors that say nothing."""
    day, some, react = Day(), air(n), n["react_seconds"]
    still, cold = react + 1, some.cold
    day.hold(still + 3, cold, WET)
    day.hold(still + 2, some.hot, WET, "hot")
    for value in (nan, n["temperature_min"] - 50, -inf):
        day.hold(1, value, WET)
        day.hold(2, some.hot, WET)
    day.hold(still, some.hot, WET, "still open")
    day.hold(still + 2, cold, WET, "cool")
    for value in (nan, n["temperature_max"] + 500, inf):
        day.hold(1, value, WET)
        day.hold(2, cold, WET)
    for value in (-5.0, -inf, nan):
        day.hold(1, cold, value)
        day.hold(2, cold, WET)
    day.hold(still, cold, WET, "still closed")
    day.hold(still + 1, cold, some.dry, "dry")
    day.hold(n["pump_seconds"] + 3, cold, WET, "wet")
    _silence(day, n, cold)
    return day


def _silence(day: Day, n: Mapping[str, float], cold: float) -> None:
    # Time for a second alarm that nobody wants, and for a report without a single reading.
    long = max(2 * n["silent_seconds"] + n["react_seconds"] + 2, 2 * n["report_seconds"] + 1)
    for name, humidity in (("temperature", WET), ("both", None)):
        day.hold(long, None, humidity, f"{name} silent")
        day.hold(n["react_seconds"] + 4, cold, WET, f"{name} back")


def lossy_day(n: Mapping[str, float]) -> Day:
    """Three times hot and cool again; before each, a node ends."""
    day, some = Day(), air(n)
    span = n["react_seconds"] + 2
    for name in ("report", "alarm", "pump"):
        day.hold(span, some.cold, WET, f"without {name}")
        day.hold(span, some.hot, WET, f"hot without {name}")
    day.hold(span, some.cold, WET, "end")
    return day


#: By how much the limits differ from the usual ones in the trial of parameters.
COOLER, WETTER = 4.0, 20.0


def other_limits(n: Mapping[str, float]) -> dict[str, float]:
    """The parameters of the trial with other limits."""
    return {
        "open_above": n["open_above"] - COOLER,
        "close_below": n["close_below"] - COOLER,
        "dry_below": n["dry_below"] + WETTER,
    }


def other_day(n: Mapping[str, float]) -> Day:
    """Readings that mean something only with the other limits."""
    day, span = Day(), n["react_seconds"] + 2
    cold = n["close_below"] - COOLER - 2
    day.hold(span, cold, 99.0)
    day.hold(span, n["open_above"] - COOLER / 2, 99.0, "warm")
    day.hold(span, n["close_below"] - COOLER / 2, 99.0, "less warm")
    day.hold(span + 1, cold, 99.0, "cool")
    day.hold(span, cold, n["dry_below"] + WETTER / 2, "damp")
    return day

"""The greenhouse of page 13: what is required of it, and the weather to try it in.

The requirements are read from JSON; `ROSBEAT_RUBRIC` names another file than the course's own. The
weather of every trial follows from the numbers in that file, and from a seed.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.resources import files
from math import inf, isfinite, nan
from pathlib import Path
from textwrap import wrap
from typing import Any

from rosbeat.errors import ExerciseError, RecordError
from rosbeat.exercises.model import as_float32
from rosbeat.exercises.outcome_display import words
from rosbeat.exercises.random_inputs import PAGE, Draw
from rosbeat.exercises.scenarios import station
from rosbeat.records_json import from_json

# What is required.

SETTING = "ROSBEAT_RUBRIC"
#: The requirements that can be judged.
KNOWN = tuple(f"R{number}" for number in range(1, 12))
#: What the points of all requirements add up to: the points of the exercise.
TOTAL = 20
_OWN = "rubrics/greenhouse.json"
_OWN_TEXT = files("rosbeat.exercises").joinpath(_OWN).read_text(encoding="utf-8")
#: The numbers that stand in the course's own rubric: limits in degrees Celsius and per cent, and
#: times in whole seconds.
USUAL: Mapping[str, float] = json.loads(_OWN_TEXT)["numbers"]


@dataclass(frozen=True)
class Requirement:
    """Hold one thing that a greenhouse has to do.

    Attributes:
        id: Its name, such as `R1`.
        text: One sentence, numbers filled in.
        points: What it is worth.
        required: Whether the exercise is passed only with it.
    """

    id: str
    text: str
    points: int
    required: bool


@dataclass(frozen=True)
class Rubric:
    """Hold all that a greenhouse has to do.

    Attributes:
        numbers: The limits and times that stand in the requirements, by name.
        requirements: The requirements, in order.
    """

    numbers: dict[str, Any]  # JSON has one kind of number, and Python two
    requirements: tuple[Requirement, ...]


def read_rubric() -> Rubric:
    """Read the rubric: the file that `ROSBEAT_RUBRIC` names, or the course's own.

    Raises:
        ExerciseError: If the file cannot be read, or is no rubric.
    """
    chosen = os.environ.get(SETTING, "")
    if not chosen:
        return parse_rubric(_OWN_TEXT, _OWN)
    try:
        text = Path(chosen).expanduser().read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        raise ExerciseError(
            f"The rubric {chosen} cannot be read: {error}.",
            f"The variable {SETTING} names a file that is not there, or holds no text.",
            f"Correct the path, or unset {SETTING}: then the course's own rubric counts.",
        ) from None
    return parse_rubric(text, chosen)


def matching_rubric(numbers: Mapping[str, float]) -> Rubric:
    """Return the rubric, if it has the numbers that a trial was made with.

    Args:
        numbers: Those of the trial; what it says of itself is not believed.

    Raises:
        ExerciseError: If they are others, or the rubric cannot be used.
    """
    rubric = read_rubric()
    if dict(numbers) != rubric.numbers:
        raise ExerciseError(
            "This greenhouse was run in the weather of another rubric.",
            "Its numbers differ from those that count now, so what it did says nothing of them.",
            "Run the check again, or grade the answer anew.",
        )
    return rubric


def parse_rubric(text: str, name: str) -> Rubric:
    """Make a rubric of the text of a file.

    Args:
        text: JSON, an object with `numbers` and `requirements`.
        name: The file's name, for errors.

    Raises:
        ExerciseError: If it is no rubric that a check could use.
    """
    try:
        found = from_json(Rubric, text, "rubric")
    except RecordError as error:
        said = error.what.partition(". ")[2]  # behind what it says of every record
        raise _refused(name, said.rstrip(".")) from None
    wrong = [*_numbers(found.numbers), *_rows(found.requirements)]
    wrong = wrong or [*_spans(found.numbers), *_texts(found)]
    if wrong:
        raise _refused(name, "; ".join(wrong))
    numbers = {key: float(value) for key, value in found.numbers.items()}
    return Rubric(
        numbers,
        tuple(replace(row, text=_filled(row.text, numbers)) for row in found.requirements),
    )


# What may be wrong with it; each yields a few words for each thing.


def _numbers(found: Mapping[str, Any]) -> Iterator[str]:
    for name in sorted(set(USUAL) ^ set(found)):
        yield f"`{name}` is missing" if name in USUAL else f"there is no number `{name}`"
    for name, value in found.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
            yield f"`{name}` is {value!r} and should be a number"
        elif name.endswith("_seconds") and (value != int(value) or not 1 <= value <= 120):
            yield f"`{name}` is {value!r} and should be a whole number from 1 to 120"


def _rows(rows: Sequence[Requirement]) -> Iterator[str]:
    ids = [row.id for row in rows]
    if set(ids) - set(KNOWN) or len(set(ids)) != len(ids):
        yield f"each of {', '.join(KNOWN)} may stand there once, and nothing else"
    points = [row.points for row in rows]
    if sum(points) != TOTAL or min(points, default=0) < 0:
        yield f"the points add up to {sum(points)}; they should make {TOTAL}, none below 0"
    if not any(row.required for row in rows):
        yield "nothing is required"


#: How far one number has to be below another, so that the weather of the trials tells a right
#: answer from a wrong one.
_APART = (
    ("close_below", 1, "open_above"),
    ("temperature_min", 10, "close_below"),
    ("open_above", 10, "temperature_max"),
    ("react_seconds", 3, "pump_seconds"),
    ("react_seconds", 3, "silent_seconds"),
    ("react_seconds", 5, "rest_seconds"),
)
#: The least and the most that a number may be, for the same reason.
_RANGES = {"dry_below": (20, 70), "report_seconds": (5, 30), "react_seconds": (1, 5)}


def _spans(n: Mapping[str, float]) -> Iterator[str]:
    for lower, least, upper in _APART:
        if n[lower] + least > n[upper]:
            yield f"`{lower}` has to be at least {least} below `{upper}`"
    for name, (least, most) in _RANGES.items():
        if not least <= n[name] <= most:
            yield f"`{name}` has to be from {least} to {most}"


def _texts(rubric: Rubric) -> Iterator[str]:
    for row in rubric.requirements:
        try:
            _filled(row.text, rubric.numbers)
        except (ValueError, LookupError, AttributeError):
            yield f"the text of {row.id} has a brace that stands for no number"


def _filled(text: str, numbers: Mapping[str, float]) -> str:
    return text.format(**{name: f"{value:g}" for name, value in numbers.items()})


def _refused(name: str, why: str) -> ExerciseError:
    return ExerciseError(
        f"{name} is no rubric of the greenhouse: {why}.",
        "A check needs to know what is required, what it is worth, and which numbers count.",
        f"Start from a copy of the course's own, {_OWN} beside the exercises, and change little.",
    )


# The weather. Each temperature is held for one second longer than a system may take to react, so
# that what it does can be told from what it did. When a class is graded, its seed draws how far
# readings are beyond the limits, and how long most of them are held; on a page nothing is added.

#: Names of the trials, and of the sensors.
PLAIN, BROKEN, LOSSY, OTHER = "plain day", "broken sensors", "ending nodes", "other limits"
DROUGHT = "drought"
SENSORS = ("thermometer", "hygrometer")
WET = 95.0
#: How far beyond a limit a reading is that is clearly beyond it.
_BEYOND, _JUST = 4.0, 1 / 256


@dataclass
class Day:
    """Hold the readings of two sensors, second by second from 1 s on, and what matters in them.

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
        """Return how long it takes, in seconds."""
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
    """Hold the readings that the trials are made of.

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


def air(numbers: Mapping[str, float], seed: int = PAGE) -> Air:
    """Return the readings that the trials are made of."""
    opening, closing, draw = numbers["open_above"], numbers["close_below"], Draw(seed)
    return Air(
        opening + draw.number(_BEYOND, 3.0, 6.0, 0.25),
        (opening + closing) / 2,
        closing - draw.number(_BEYOND, 3.5, 4.5, 0.25),
        numbers["dry_below"] - draw.number(10.0, 6.0, 14.0, 0.25),
    )


def _vent_readings(numbers: Mapping[str, float], seed: int) -> Iterator[float]:
    """Return temperatures on all sides of both limits at which the vent moves."""
    opening, closing, some = numbers["open_above"], numbers["close_below"], air(numbers, seed)
    # A limit that a Float32 cannot carry is met by no reading.
    top = opening if as_float32(opening) == opening else opening - _JUST
    bottom = closing if as_float32(closing) == closing else closing + _JUST
    # Whether a vent says at first that it is closed is up to the answer: R10 may ask for it. After
    # the second hot reading no command is due, because the vent is open already.
    yield from (some.hot, some.middle, some.hot, some.cold)
    yield from (some.middle, top, opening + _JUST, bottom)
    yield from (some.middle, bottom, closing - _JUST, some.middle)


def _longer(seed: int) -> Iterator[int]:
    """Yield by how many seconds readings are held for longer than has to be."""
    draw = Draw(seed)
    while True:
        yield draw.whole(0, 0, 3)


def _is_right_by_chance(start: float, seconds: float) -> bool:
    """Return whether a pump that starts then, and runs until a timer ticks, runs long enough.

    A timer that nobody resets ticks whenever its period is over, so how long the pump runs depends
    on when it starts. On the page it runs for too short a time.
    """
    periods = (seconds, 2 * seconds - 1)
    return any(abs(period - start % period - seconds) <= 1 for period in periods)


def plain_day(n: Mapping[str, float], seed: int = PAGE) -> Day:
    """Return a day with sensors that work: the vent alone, the pump alone, then both at once."""
    day, some, react, more = airing(n, seed), air(n, seed), n["react_seconds"], _longer(seed)
    limit = n["dry_below"]
    at_limit = limit if as_float32(limit) == limit else limit + _JUST
    cold, pause = some.cold, n["pump_seconds"] + n["rest_seconds"]
    day.hold(2 + next(more), cold, WET, "pumping")
    still = react + 1 + next(more)
    while _is_right_by_chance(day.seconds + still, n["pump_seconds"]):
        still += 1
    day.hold(still, cold + 1, at_limit, "at the limit")
    day.hold(react + 1, cold + 2, limit - _JUST, "dry")
    day.hold(pause + 9 - react - 1, cold, some.dry)
    day.hold(pause + 3 + next(more), cold + 1, WET, "wet")
    day.hold(react + 1 + next(more), some.hot, WET, "both")
    # Between the limits the vent is still open: a pump that looks at the temperature starts here.
    day.hold(7, some.hot + 1, some.dry, "hot and dry")
    day.hold(n["pump_seconds"] + 3, some.middle, some.dry)
    day.hold(2 * react + 2, cold, some.dry, "cool and dry")
    day.hold(pause + react + 3 + next(more), cold + 1, WET)
    day.hold(react, cold, some.dry, "dry again")
    day.hold(n["pump_seconds"] + 6, some.hot, some.dry, "hot again")
    return day


def airing(n: Mapping[str, float], seed: int = PAGE) -> Day:
    """Return the first part of the plain day, for the vent alone."""
    day = Day()
    for value, more in zip(_vent_readings(n, seed), _longer(seed), strict=False):
        begins = day.hold(n["react_seconds"] + 1 + more, value, WET)
        day.held.append((begins, day.seconds, value))
    return day


def broken_day(n: Mapping[str, float], seed: int = PAGE) -> Day:
    """Return a day with sensors that report impossible values, and sensors that fall silent."""
    day, some, react, more = Day(), air(n, seed), n["react_seconds"], _longer(seed)
    still, cold, draw = react + 1, some.cold, Draw(seed)
    day.hold(still + 3 + next(more), cold, WET)
    day.hold(still + 2 + next(more), some.hot, WET, "hot")
    for value in draw.shuffled((nan, n["temperature_min"] - draw.number(50.0, 50.0, 90.0), -inf)):
        day.hold(1, value, WET)
        day.hold(2, some.hot, WET)
    day.hold(still + next(more), some.hot, WET, "still open")
    day.hold(still + 2 + next(more), cold, WET, "cool")
    for value in draw.shuffled((nan, n["temperature_max"] + draw.number(500.0, 100.0, 900.0), inf)):
        day.hold(1, value, WET)
        day.hold(2, cold, WET)
    for value in draw.shuffled((-5.0, -inf, nan)):
        day.hold(1, cold, value)
        day.hold(2, cold, WET)
    day.hold(still + next(more), cold, WET, "still closed")
    # The end of the range is possible: the air cannot be drier than that.
    day.hold(still + 1, cold, 0.0, "dry")
    day.hold(n["pump_seconds"] + 3 + next(more), cold, WET, "wet")
    # Time for a second alarm that nobody wants, and for a report without a single reading.
    long = max(2 * n["silent_seconds"] + react + 2, 2 * n["report_seconds"] + 1)
    # After each silence a report comes while there are fewer readings than seconds in its window.
    # Each time it is colder than before, so the mean shows whether older readings are in it.
    every = n["report_seconds"]
    back = max(react + 4, every + 2)
    for name, humidity in (("temperature", WET), ("both", None)):
        silent = long + next(more)
        while not 0.3 <= -(day.seconds + silent) % every / every <= 0.7 and silent < long + every:
            silent += 1
        day.hold(silent, None, humidity, f"{name} silent")
        cold -= 0.75
        day.hold(back + next(more), cold, WET, f"{name} back")
    return day


#: A pump that rests for longer than so many times the shortest rest is taken for one that stopped.
PATIENCE = 3


def drought(n: Mapping[str, float], seed: int = PAGE) -> Day:
    """Return a day that leaves time for a long rest: dry all along, then wet, then hot and dry.

    Both sensors are silent while the pump runs for the first time, and the thermometer while the
    vent is open. The hot air cuts a run short, and it is cool again before that rest is over.
    """
    day, some, react = Day(), air(n, seed), n["react_seconds"]
    pause = n["pump_seconds"] + PATIENCE * n["rest_seconds"] + 2 * react + 3
    day.hold(2 + next(_longer(seed)), some.cold, WET)
    silent = n["pump_seconds"] + react + 1
    day.hold(react + 1, some.cold, some.dry, "dry")
    day.hold(silent, None, None)
    day.hold(pause - react - 1 - silent, some.cold, some.dry)
    day.hold(pause, some.cold, WET, "wet")
    day.hold(react, some.cold, some.dry, "dry again")
    day.hold(react + 1, some.hot, some.dry, "hot again")
    day.hold(n["pump_seconds"] + 5 - react, None, some.dry)
    day.hold(2 * react + 2, some.cold, some.dry)
    return day


def lossy_day(n: Mapping[str, float], seed: int = PAGE) -> Day:
    """Return a day that is three times hot and cool again; before each, a node ends."""
    day, some, more = Day(), air(n, seed), _longer(seed)
    span = n["react_seconds"] + 2
    for name in ("report", "alarm", "pump"):
        day.hold(span + next(more), some.cold, WET, f"without {name}")
        day.hold(span + next(more), some.hot, WET, f"hot without {name}")
    day.hold(span, some.cold, WET, "end")
    return day


#: By how much the limits differ from the usual ones in the trial of parameters.
COOLER, WETTER = 4.0, 20.0


def _shift(seed: int) -> tuple[float, float]:
    draw = Draw(seed)
    return draw.number(COOLER, 3.0, 5.0, 0.25), draw.number(WETTER, 15.0, 25.0, 0.25)


def other_limits(n: Mapping[str, float], seed: int = PAGE) -> dict[str, float]:
    """Return the parameters of the trial with other limits."""
    cooler, wetter = _shift(seed)
    return {
        "open_above": n["open_above"] - cooler,
        "close_below": n["close_below"] - cooler,
        "dry_below": n["dry_below"] + wetter,
    }


def other_day(n: Mapping[str, float], seed: int = PAGE) -> Day:
    """Return a day whose readings mean something only with the other limits."""
    day, span, more = Day(), n["react_seconds"] + 2, _longer(seed)
    cooler, wetter = _shift(seed)
    cold = n["close_below"] - cooler - 2
    day.hold(span + next(more), cold, 99.0)
    day.hold(span + next(more), n["open_above"] - cooler / 2, 99.0, "warm")
    day.hold(span + next(more), n["close_below"] - cooler / 2, 99.0, "less warm")
    day.hold(span + 1 + next(more), cold, 99.0, "cool")
    day.hold(span, cold, n["dry_below"] + wetter / 2, "damp")
    return day


class Weather:
    """Hold the weather of every trial.

    Args:
        numbers: The numbers of the rubric, by name.
        seed: From what the days are drawn.
    """

    def __init__(self, numbers: Mapping[str, float], seed: int = PAGE) -> None:
        self.numbers = numbers
        self.air = air(numbers, seed)
        self.airing, self.plain, self.broken, self.lossy, self.drought, self.other = (
            make(numbers, seed)
            for make in (airing, plain_day, broken_day, lossy_day, drought, other_day)
        )


def draw_weather(draw: Draw) -> int:
    """Draw a seed for the weather: the days follow from it where the rubric is known."""
    return draw.whole(PAGE, 1, 2**31 - 1)


# What a page shows.

_DAYS = {PLAIN: plain_day, BROKEN: broken_day}
_WIDTH = 84


@dataclass(frozen=True)
class Requirements:
    """Show requirements in Jupyter and in a terminal.

    Attributes:
        rows: The requirements.
    """

    rows: tuple[Requirement, ...]

    def __str__(self) -> str:
        return "\n".join(line for row in self.rows for line in _lines(row))

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """Return the requirements as a table in HTML."""
        left = 'style="text-align:left"'  # Jupyter's own is right
        head = "".join(f"<th {left}>{one}</th>" for one in ("", "requirement", "points"))
        body = "".join(_row(row) for row in self.rows)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


def requirements(*ids: str) -> Requirements:
    """Show what the greenhouse has to do, as the check will judge it.

    Args:
        ids: Only these, such as `"R1"`; by default all.

    Raises:
        ExerciseError: If there is no such requirement.
    """
    rows = read_rubric().requirements
    strange = sorted(set(ids) - {row.id for row in rows})
    if strange:
        raise ExerciseError(
            f"There is no requirement {strange[0]!r}.",
            f"The requirements are: {', '.join(row.id for row in rows)}.",
            f'Write for example requirements("{rows[0].id}").',
        )
    return Requirements(tuple(row for row in rows if not ids or row.id in ids))


def weather(
    day: str = PLAIN,
    *,
    temperature: Iterable[float | None] | None = None,
    humidity: Iterable[float | None] | None = None,
) -> tuple[Callable[[], Any], Callable[[], Any]]:
    """Return the two sensors of the greenhouse, which publish one reading a second.

    Args:
        day: What they say: `"plain day"` or `"broken sensors"`.
        temperature: Readings of your own for the first one; None is a second of silence.
        humidity: The same for the second one.

    Returns:
        Two node classes, for `ros.add`.

    Raises:
        ExerciseError: If there is no such day.
    """
    if day not in _DAYS:
        raise ExerciseError(
            f"There is no weather {day!r}.",
            f"The course knows: {', '.join(_DAYS)}.",
            'Write weather("plain day"), or give readings: weather(temperature=[20.0, 30.0]).',
        )
    numbers = read_rubric().numbers
    own = temperature is not None or humidity is not None
    known = Day() if own else _DAYS[day](numbers)
    return (
        station(SENSORS[0], "temperature", known.temperature if not own else temperature or ()),
        station(SENSORS[1], "humidity", known.humidity if not own else humidity or ()),
    )


def _worth(row: Requirement) -> str:
    return f"{row.points}" + ("" if row.required else ", optional")


def _lines(row: Requirement) -> list[str]:
    text = wrap(f"{row.text} ({_worth(row)})", _WIDTH - 5)
    return [f"{row.id if not at else '':<5}{line}" for at, line in enumerate(text)]


def _row(row: Requirement) -> str:
    left = 'style="text-align:left"'
    worth = _worth(row).replace(" ", "&nbsp;")  # no line break, and no sanitizer drops it
    return f"<tr><td>{words(row.id)}</td><td {left}>{words(row.text)}</td><td>{worth}</td></tr>"

"""What a page shows of the greenhouse: the requirements, and the weather to try it in."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

from rosbeat.errors import ExerciseError
from rosbeat.exercises.cards import words
from rosbeat.exercises.greenhouse import days
from rosbeat.exercises.greenhouse.rubric import Requirement, the_rubric
from rosbeat.exercises.greenhouse.trials import BROKEN, PLAIN, SENSORS
from rosbeat.exercises.scenarios import station

_DAYS = {PLAIN: days.plain_day, BROKEN: days.broken_day}
_WIDTH = 84


@dataclass(frozen=True)
class Requirements:
    """Requirements as Jupyter and a terminal show them.

    Attributes:
        rows: The requirements.
    """

    rows: tuple[Requirement, ...]

    def __str__(self) -> str:
        return "\n".join(line for row in self.rows for line in _lines(row))

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """The requirements as a table in HTML."""
        left = 'style="text-align:left"'  # Jupyter's own is right
        head = "".join(f"<th {left}>{one}</th>" for one in ("", "requirement", "points"))
        body = "".join(_row(row) for row in self.rows)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


def requirements(*ids: str) -> Requirements:
    """What the greenhouse has to do, as the check will judge it.

    Args:
        ids: Only these, such as `"R1"`; by default all.

    Raises:
        ExerciseError: If there is no such requirement.
    """
    rows = the_rubric().requirements
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
    """The two sensors of the greenhouse, which publish one reading a second.

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
    numbers = the_rubric().numbers
    own = temperature is not None or humidity is not None
    known = days.Day() if own else _DAYS[day](numbers)
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

"""`rosbeat progress`: how far somebody is with the course, as a table in a terminal."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from rosbeat.checks.display import LOOKS
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.progress import heading
from rosbeat.exercises.progress_file import Standings, progress_file
from rosbeat.exercises.registry import PAGES
from rosbeat.exercises.standing import Standing

VERSION = 1
_HEAD = ("", "exercise", "", "outcome", "points", "attempts", "hints")
_Row = tuple[str, ...]


def as_text() -> str:
    """Return the table of all pages, their exercises and the total."""
    standings = progress_file().standings()
    blocks = [(heading(page), [_row(one, standings) for one in page.exercises]) for page in PAGES]
    widths = [max(map(len, column)) for column in zip(_HEAD, *_every(blocks), strict=True)]
    lines = [_line(_HEAD, widths)]
    for title, rows in blocks:
        lines += ["", title, *(_line(row, widths) for row in rows)]
    return "\n".join([*lines, "", _total(as_data(standings))])


def as_json() -> str:
    """Return the same as JSON."""
    return json.dumps(as_data(progress_file().standings()), indent=1)


def as_data(standings: Standings) -> dict[str, Any]:
    """Return the same as plain data, with the version of its form.

    Args:
        standings: How far somebody is, by exercise.
    """
    rows = [
        {
            **{"exercise": one.id, "page": page.number, "title": one.title, "out_of": one.points},
            **{"status": _at(one, standings).status, **_at(one, standings).as_dict()},
        }
        for page in PAGES
        for one in page.exercises
    ]
    return {
        "version": VERSION,
        "passed": sum(bool(row["passed"]) for row in rows),
        "points": sum(row["points"] for row in rows),
        "out_of": sum(row["out_of"] for row in rows),
        "exercises": rows,
    }


def _at(exercise: Exercise[Any], standings: Standings) -> Standing:
    return standings.get(exercise.id, Standing())


def _every(blocks: list[tuple[str, list[_Row]]]) -> Iterator[_Row]:
    for _, rows in blocks:
        yield from rows


def _row(exercise: Exercise[Any], standings: Standings) -> _Row:
    at = _at(exercise, standings)
    sign, word = LOOKS[at.status]
    hints = f"{at.hints} and the answer" if at.answer else str(at.hints)
    points = f"{at.points} of {exercise.points}"
    return f"  {sign}", exercise.id, exercise.title, word, points, str(at.attempts), hints


def _line(row: _Row, widths: list[int]) -> str:
    return "  ".join(part.ljust(width) for part, width in zip(row, widths, strict=True)).rstrip()


def _total(data: dict[str, Any]) -> str:
    there_are = len(data["exercises"])
    return (
        f"{data['passed']} of {there_are} exercises passed, "
        f"{data['points']} of {data['out_of']} points"
    )

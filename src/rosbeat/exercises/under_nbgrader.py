"""Outcomes as nbgrader counts them.

Of a check cell nbgrader knows three things (`nbgrader/utils.py`, `determine_grade`): an error gives
no points; a result that is a number gives so many; anything else gives all of them. What is shown
besides is for readers.
"""

from __future__ import annotations

from textwrap import wrap
from typing import Any

from IPython.display import display

from rosbeat.checks.display import Shown
from rosbeat.errors import ExerciseError
from rosbeat.records import Outcome

#: `nbgrader validate` cuts lines at 87 characters, its own indentation of 4 included.
_WIDTH = 80


class NotPassedError(ExerciseError):
    """An answer does not get all points; this is how nbgrader is told."""

    def _render_traceback_(self) -> list[str]:
        """The text alone (IPython calls this): where in rosbeat it was raised helps nobody."""
        return self.what.splitlines()


class AllPoints(Shown):
    """An outcome with all points: it is shown, and there is no result to be taken for a number."""

    def _ipython_display_(self) -> None:
        display(Shown(self.outcome))


class SomePoints(Shown):
    """An outcome with some of the points: the result is their number, the words are for readers."""

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return {**super()._repr_mimebundle_(), "text/plain": f"{self.outcome.points:g}"}


def for_nbgrader(outcome: Outcome, execution: str) -> Shown:
    """Say an outcome so that nbgrader gives the points for it that the course gives.

    Args:
        outcome: The outcome.
        execution: Why nbgrader runs the page: `autograde`, where points are noted, or `validate`,
            where a learner reads why there are not all of them.

    Returns:
        What Jupyter shows.

    Raises:
        NotPassedError: If there are no points; under `validate`, if there are not all of them.
    """
    if outcome.points >= outcome.out_of:
        return AllPoints(outcome)
    if execution == "validate":
        rows = str(Shown(outcome)).splitlines()
        raise NotPassedError("\n".join(line for row in rows for line in _lines(row)))
    if outcome.points > 0:
        return SomePoints(outcome)
    display(Shown(outcome))
    raise NotPassedError(f"Exercise {outcome.exercise}: 0 of {outcome.out_of} points.")


def _lines(row: str) -> list[str]:
    """A row in lines that nbgrader does not cut, set in as the row is."""
    inside = " " * (len(row) - len(row.lstrip()) + 2)
    return wrap(row, _WIDTH, subsequent_indent=inside) or [""]

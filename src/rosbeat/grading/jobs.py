"""Define the input and output of a sandbox, each as a line of JSON.

The input contains nothing of a judge: no expected value, no solution, no other submission.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from rosbeat.errors import GradingError, RecordError
from rosbeat.records_json import from_json, to_json

#: How a run may end besides what `sandbox.Ending` says: the process that watched it is gone; what
#: came out of it is nothing that the course has written.
LOST, FORGED = "lost", "forged"
_Line = TypeVar("_Line")


@dataclass(frozen=True)
class Job:
    """Describe one answer to observe.

    Attributes:
        subject: The expression that the check cell hands over, such as `HumiditySensor`.
        answer: The text of the learner's cell; the last one, if the exercise has several.
        parts: The texts of those before.
        imports: The cell of imports of the course's page.
        earlier: Statements of other cells that the answer needs, in the order to run them.
        replay: The cells of the page up to the check, in order, to be run as a kernel runs them;
            empty if the answer stands alone.
        page: The number of the page, whose workspace a replay starts from.
        given: What the scenario is handed besides the answer, as an object of JSON; it is plain
            data that the exercise makes from an instructor's files, such as numbers of a rubric.
        seed: From what the inputs of the scenario are drawn; 0 on a page.
        files: The workspace that a replay starts from, content in Latin-1 by path. It follows
            from `page`, and is put in when the job is sent.
    """

    exercise: str
    subject: str
    answer: str
    parts: tuple[str, ...] = ()
    imports: str = ""
    earlier: tuple[str, ...] = ()
    replay: tuple[str, ...] = ()
    page: str = ""
    given: str = "{}"
    seed: int = 0
    files: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Evidence:
    """Hold what came out of a sandbox for one job; it is hostile until a judge has read it.

    Attributes:
        how: How the run ended: see `sandbox.Ending`, and `LOST` and `FORGED`.
        number: The exit code, or the number of the signal.
        seen: What `exercises.evidence.to_json` wrote there, or empty.
        raised: If the answer's own cell could not be run: the exception's class name.
        line: The line of the cell, or 0.
        output: What was printed, cut off.
        seconds: How long it took, by the clock on the wall.
    """

    how: str
    number: int = 0
    seen: str = ""
    raised: str = ""
    text: str = ""
    line: int = 0
    code: str = ""
    output: str = ""
    seconds: float = 0.0


def to_line(value: Job | Evidence) -> str:
    """Return a job, or evidence, as one line of JSON; equal values give equal lines."""
    return to_json(value)


def read_line(kind: type[_Line], line: str) -> _Line:
    """Read a job, or evidence.

    Raises:
        GradingError: If the line is none.
    """
    try:
        return from_json(kind, line, "line")
    except RecordError as error:
        raise GradingError(
            "A line between two processes of the grader cannot be read.",
            "One of them was stopped while it wrote, or is of another version.",
            "Run the command again; what is graded already stays graded.",
        ) from error

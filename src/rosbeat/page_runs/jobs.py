"""Define what goes into a sandbox, a page of one learner, and what comes out of it.

Both are lines of JSON. A job contains nothing of a judge: no expected value, no solution, no other
submission, and not the secret of the class, only numbers that were drawn from it for this page.
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
class PageCell:
    """Describe one code cell of a page that is to be run.

    Attributes:
        source: Its text, commands of IPython included.
        place: Its place on the learner's page, from 0.
        exercise: The exercise whose cell it is; empty for a cell of the learner's own.
        checks: The exercises that it checks, in order.
    """

    source: str
    place: int = 0
    exercise: str = ""
    checks: tuple[str, ...] = ()


@dataclass(frozen=True)
class PageJob:
    """Describe one page of one learner, to be run from top to bottom.

    Attributes:
        page: The number of the page, such as `03`.
        cells: The code cells to run, in order.
        subjects: The expression that the course's own check of each exercise hands over, such as
            `HumiditySensor`. An exercise that no cell checks is checked at the end with it.
        seeds: From what the inputs of each exercise's scenario are drawn; 0 on a page. Of a class
            it is drawn from the secret and this page, so that it fits no other page.
        given: What each scenario is handed besides the answer, as an object of JSON: plain data
            that the exercise makes from an instructor's files, such as the numbers of a rubric.
        needs_files: Whether the page works in the workspace, so that it starts from `files`.
        files: The workspace that the pages before leave, content in Latin-1 by path. It follows
            from `page`, and is put in when the job is sent.
    """

    page: str
    cells: tuple[PageCell, ...]
    subjects: Mapping[str, str]
    seeds: Mapping[str, int] = field(default_factory=dict)
    given: Mapping[str, str] = field(default_factory=dict)
    needs_files: bool = False
    files: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Evidence:
    """Hold what came out of a sandbox for one exercise; it is hostile until a judge has read it.

    Attributes:
        how: How the run of the answer ended: see `sandbox.Ending`, and `LOST` and `FORGED`.
        number: The exit code, or the number of the signal.
        seen: What `exercises.evidence.to_json` wrote there, or empty.
        raised: If there was nothing to observe: the class name of the exception that the cell of
            the answer, or the check, has raised.
        text: What that exception says.
        line: The line of the cell, or 0.
        code: That line.
        is_missing: Whether no cell of the page names what the check asks for.
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
    is_missing: bool = False
    output: str = ""
    seconds: float = 0.0


@dataclass(frozen=True)
class PageEvidence:
    """Hold what came out of a sandbox for a page.

    Attributes:
        exercises: The evidence of each exercise.
        remarks: What an answer has reached for, of what runs and observes it; a sentence each.
        seconds: How long the page took, by the clock on the wall.
    """

    exercises: Mapping[str, Evidence]
    remarks: tuple[str, ...] = ()
    seconds: float = 0.0


def lost(job: PageJob) -> PageEvidence:
    """Return the evidence of a page whose watcher was lost: nobody knows what it does."""
    return PageEvidence(dict.fromkeys(job.subjects, Evidence(LOST)))


def to_line(value: PageJob | PageEvidence) -> str:
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

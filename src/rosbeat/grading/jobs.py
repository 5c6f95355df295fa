"""Define what is sent into a sandbox and what comes out of it, each as a line of JSON.

Nothing of a judge goes in: no expected value, no solution, no other submission.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from rosbeat.errors import GradingError

#: How a run may end besides what `sandbox.Ending` says: the process that watched it is gone; what
#: came out of it is nothing that the course has written.
LOST, FORGED = "lost", "forged"


@dataclass(frozen=True)
class Job:
    """Describe one answer to observe.

    Attributes:
        exercise: The exercise's id.
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
        text: Its message.
        line: The line of the cell, or 0.
        code: That line.
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
    return json.dumps(asdict(value), sort_keys=True)


def read_job(line: str) -> Job:
    """Read a job.

    Raises:
        GradingError: If the line is not one.
    """
    found: Job = _made(Job, line)
    return found


def read_evidence(line: str) -> Evidence:
    """Read evidence.

    Raises:
        GradingError: If the line is none.
    """
    found: Evidence = _made(Evidence, line)
    return found


def _made(kind: Any, line: str) -> Any:  # noqa: ANN401 - one of the two above
    try:
        said = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise _refused(str(error)) from error
    if not isinstance(said, dict) or set(said) != {one.name for one in fields(kind)}:
        raise _refused("it has other fields")
    return kind(**{name: _value(one) for name, one in said.items()})


def _value(value: Any) -> Any:  # noqa: ANN401 - any field
    return tuple(value) if isinstance(value, list) else value


def _refused(why: str) -> GradingError:
    return GradingError(
        f"A line between two processes of the grader cannot be read: {why}.",
        "One of them was stopped while it wrote, or is of another version.",
        "Run the command again; what is graded already stays graded.",
    )

"""What is sent into a sandbox, and what comes out of it: plain data, a line of JSON each.

Nothing of a judge goes in: no expected value, no solution, no other submission.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from typing import Any

from rosbeat.errors import GradingError

#: How a run may end besides what `sandbox.running.Ending` says: the process that watched it is
#: gone; what came out of it is nothing that the course has written.
LOST, FORGED = "lost", "forged"
#: The first line of a worker, when it has imported all that it needs.
READY = '{"ready": true}'


@dataclass(frozen=True)
class Job:
    """One answer to observe.

    Attributes:
        exercise: The exercise's id.
        subject: The expression that the check cell hands over, such as `HumiditySensor`.
        answer: The text of the learner's cell; the last one, if the exercise has several.
        parts: The texts of those before.
        imports: The cell of imports of the course's page.
        earlier: Other cells, the learner's above the answer and then the course's, which are read
            only if the answer uses a name that is defined in one of them.
        replay: The cells of the page up to the check, in order, to be run as a kernel runs them;
            empty if the answer stands alone.
        page: The number of the page, whose workspace a replay starts from.
        kernel: The cells of the learner's page up to the answer, to be run in a kernel of Jupyter
            instead, with an empty workspace; empty if that is not asked for.
        given: What the scenario is handed besides the answer, as an object of JSON; it is plain
            data that the exercise makes from an instructor's files, such as numbers of a rubric.
    """

    exercise: str
    subject: str
    answer: str
    parts: tuple[str, ...] = ()
    imports: str = ""
    earlier: tuple[str, ...] = ()
    replay: tuple[str, ...] = ()
    page: str = ""
    kernel: tuple[str, ...] = ()
    given: str = "{}"


@dataclass(frozen=True)
class Observed:
    """What came out of a sandbox.

    Attributes:
        how: How the run ended: see `sandbox.running.Ending`, and `LOST` and `FORGED`.
        number: The exit code, or the number of the signal.
        evidence: What `scenarios.evidence.to_json` wrote there, or empty; hostile until parsed.
        raised: If the answer's own cell could not be run: the exception's class name.
        text: Its message.
        line: The line of the cell, or 0.
        code: That line.
        changed: What of the course or of Python was not as before when the answer had run.
        output: What was printed, cut off.
        seconds: How long it took, by the clock on the wall.
    """

    how: str
    number: int = 0
    evidence: str = ""
    raised: str = ""
    text: str = ""
    line: int = 0
    code: str = ""
    changed: tuple[str, ...] = ()
    output: str = ""
    seconds: float = 0.0


def write_line(value: Job | Observed) -> str:
    """A job, or what was observed, as one line of JSON; equal values give equal lines."""
    return json.dumps(asdict(value), sort_keys=True)


def read_job(line: str) -> Job:
    """Read a job.

    Raises:
        GradingError: If the line is not one.
    """
    found: Job = _made(Job, line)
    return found


def read_observed(line: str) -> Observed:
    """Read what was observed.

    Raises:
        GradingError: If the line is not one.
    """
    found: Observed = _made(Observed, line)
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

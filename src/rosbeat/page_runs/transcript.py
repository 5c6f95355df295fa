"""Read what the process of a page has written, and run the page again if it ended in the middle.

A transcript is lines, each a seal and an object of JSON: `cell` and `check` say what begins,
`evidence` holds what came of the check of an exercise, `remark` what an answer reached for, and
`done` that the page came to its end. All of it is hostile until a judge has read it.

If the process ends before `done`, what was begun last has ended it. The page is run again without
that cell, or without observing that answer, and what came before counts as it is seen then.
"""

from __future__ import annotations

import json
import secrets
import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from rosbeat.page_runs.jobs import FORGED, Evidence, PageEvidence, PageJob
from rosbeat.page_runs.page_process import Earlier, run_page
from rosbeat.page_runs.sandbox import Ending

#: How often a page is run anew, since a cell or an answer has ended its process.
_MOST_RUNS = 8
#: Seconds that all runs of a page may take together, by the clock on the wall; whoever waits for
#: a worker has more patience (`pool.PATIENCE`).
_MOST_SECONDS = 300.0
#: Of what an answer may have written itself, no more than the course writes is believed.
_MOST, _MOST_LINES, _MOST_REMARKS = 2_000, 1_000_000, 20
#: Runs a function in a sandbox, for so many seconds at most; the function gets the descriptor to
#: which it writes.
RunWork = Callable[[Callable[[int], None], float], Ending]


@dataclass
class Transcript:
    """Hold what a process has written.

    Attributes:
        evidence: The last evidence of each exercise.
        remarks: What answers reached for.
        cell: The number of the cell that was begun last, or -1.
        check: The exercise that was begun last and not ended; empty if there is none.
        is_done: Whether the page came to its end.
        is_stuck: Whether its process was ended because no interrupt has ended its cell.
        is_forged: Whether there is something that the course has not written.
    """

    evidence: dict[str, Evidence] = field(default_factory=dict)
    remarks: dict[str, None] = field(default_factory=dict)
    cell: int = -1
    check: str = ""
    is_done: bool = False
    is_stuck: bool = False
    is_forged: bool = False


def observe_page(job: PageJob, run: RunWork) -> PageEvidence:
    """Run a page in a sandbox, until it comes to its end, and return what was seen.

    Args:
        job: The page.
        run: Runs a function in the sandbox; each call in a process of its own.
    """
    earlier, seconds = Earlier(), 0.0
    remarks: dict[str, None] = {}
    is_retried = False
    for _ in range(_MOST_RUNS):
        seal = secrets.token_hex(16)
        ending = run(partial(run_page, job, earlier, seal), _MOST_SECONDS - seconds)
        seconds += ending.seconds
        transcript = read_transcript(ending.result, seal)
        remarks |= transcript.remarks
        if transcript.is_done or seconds >= _MOST_SECONDS:
            break
        is_killed = (ending.how, ending.number) == ("signal", signal.SIGKILL)
        if is_killed and not is_retried:
            # Somebody outside may have done that, such as a kernel that is out of memory. A page
            # that ends itself does so again.
            is_retried = True
            continue
        culprit = _without_culprit(job, earlier, transcript, ending)
        if culprit is None:
            break
        earlier = culprit
    rest = _ended(ending, transcript)
    exercises = {
        exercise: earlier.given_up.get(exercise) or transcript.evidence.get(exercise, rest)
        for exercise in job.subjects
    }
    return PageEvidence(exercises, tuple(remarks)[:_MOST_REMARKS], round(seconds, 3))


def _without_culprit(
    job: PageJob, earlier: Earlier, transcript: Transcript, ending: Ending
) -> Earlier | None:
    """Return how to run a page without what has ended its process; None if that is not known."""
    evidence = _ended(ending, transcript)
    is_late = evidence.how == "deadline"
    earlier = replace(earlier, lost=earlier.lost + (ending.seconds if is_late else 0.0))
    if transcript.check:
        return replace(earlier, given_up={**earlier.given_up, transcript.check: evidence})
    if 0 <= transcript.cell < len(job.cells):
        return replace(earlier, left_out={**earlier.left_out, transcript.cell: evidence})
    return None


def _ended(ending: Ending, transcript: Transcript) -> Evidence:
    """Return how a run has ended, as the evidence of what has ended it."""
    how = "exit" if ending.how == "ended" else ending.how
    if transcript.is_stuck:
        how = "deadline"
    elif transcript.is_forged:
        how = FORGED
    return Evidence(how, ending.number)


def read_transcript(result: bytes, seal: str) -> Transcript:
    """Read what a process has written.

    Args:
        result: All of it.
        seal: What each line has to begin with.
    """
    transcript = Transcript()
    lines = result.split(b"\n")
    # What comes after the last end of a line was broken off.
    for line in lines[:-1]:
        text = line.decode("utf-8", "replace")
        message = _object(text.removeprefix(seal)) if text.startswith(seal) else None
        if message is None:
            transcript.is_forged = True
        else:
            _take(transcript, message)
    return transcript


def _object(text: str) -> Mapping[str, Any] | None:
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def _take(transcript: Transcript, message: Mapping[str, Any]) -> None:
    match message:
        case {"cell": int(number)}:
            transcript.cell = number
        case {"check": str(exercise)}:
            transcript.check = exercise
        case {"evidence": str(exercise)}:
            transcript.evidence[exercise] = _evidence(message)
            transcript.check = ""
        case {"remark": str(remark)}:
            transcript.remarks[remark[:_MOST]] = None
        case {"done": True}:
            transcript.is_done = True
        case {"stuck": True}:
            transcript.is_stuck = True
        case _:
            transcript.is_forged = True


def _evidence(message: Mapping[str, Any]) -> Evidence:
    """Return evidence from what the page's process, or that of a check, has written."""
    seconds = message.get("seconds")
    seconds = float(seconds) if isinstance(seconds, int | float) else 0.0
    if "report" in message:
        report = _object(str(message["report"]))
        if report is None:
            return Evidence(FORGED, seconds=seconds)
        message = report
    return Evidence(
        _text(message, "how") or "ended",
        _number(message, "number"),
        _text(message, "seen", None),
        _text(message, "raised"),
        _text(message, "text"),
        _number(message, "line"),
        _text(message, "code"),
        message.get("is_missing") is True,
        _text(message, "output"),
        seconds,
    )


def _text(message: Mapping[str, Any], name: str, most: int | None = _MOST) -> str:
    value = message.get(name)
    return value[:most] if isinstance(value, str) else ""


def _number(message: Mapping[str, Any], name: str) -> int:
    value = message.get(name)
    return value if isinstance(value, int) and 0 <= value < _MOST_LINES else 0

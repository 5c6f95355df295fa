"""Turn the output of a sandbox into an outcome, without running any submitted code.

The output is read as JSON and validated field by field; the exercise's judge, a pure function,
gives the verdict. If there is no usable output, the way in which the run ended explains why.
"""

from __future__ import annotations

import signal
from dataclasses import replace
from typing import Any

from rosbeat.diagnosis.exceptions import first_sentence
from rosbeat.errors import RecordError
from rosbeat.exercises.evidence import from_json
from rosbeat.exercises.exercise import Exercise, before_judging, failed, not_attempted
from rosbeat.exercises.random_inputs import PAGE
from rosbeat.page_runs.jobs import FORGED, LOST, Evidence
from rosbeat.page_runs.submitted_page import NOT_THERE
from rosbeat.page_runs.traces import trace_of
from rosbeat.records import Fault, Observation, Outcome

_WHERE = "the cell"
#: Lists and objects in evidence. Long lists of records are written by columns, so there are few.
_MOST_NESTED = 2_000_000
#: Nanoseconds of a day. No run is as long, and some judges count each tick of a run.
_LONGEST = 86_400 * 10**9
#: What is said of an answer that took its watchers along; the next run tries it again.
WATCHER_LOST = "The process that watched the answer was lost."
#: Ids of what is said of a run that did not come to its end; see `diagnosis.mistakes`.
TIME, MEMORY, OUTPUT, CRASH = "too-long", "too-much-memory", "too-much-output", "crashed"
LEFT, UNREADABLE, NO_PYTHON = "left-early", "evidence-unreadable", "unreadable-cell"
#: What Python raises before the first line of a cell runs, and where to look then.
_UNREAD = {
    "SyntaxError": "Look at this line and at the end of the line above it: is there a colon, a "
    "bracket, a comma or a quotation mark too few, or one too many?",
    "IndentationError": "Lines that belong together begin in the same column, and those after a "
    "colon stand further to the right.",
    "TabError": "Lines that belong together begin with the same blanks, not here with a tab and "
    "there with blanks.",
}


def judge(exercise: Exercise[Any], evidence: Evidence, seed: int = PAGE) -> Outcome:
    """Say what an answer is worth."""
    return judge_and_trace(exercise, evidence, seed)[0]


def judge_and_trace(
    exercise: Exercise[Any], evidence: Evidence, seed: int = PAGE
) -> tuple[Outcome, str]:
    """Return what an answer is worth, and its trace for pages that show what it did."""
    early = _before_reading(exercise, evidence)
    outcome, trace = (early, "") if early else _read(exercise, evidence, seed)
    return replace(outcome, out_of=exercise.points), trace


def _before_reading(exercise: Exercise[Any], evidence: Evidence) -> Outcome | None:
    """Return what can be said before evidence is read; None if there is some."""
    if evidence.how == "ended" and evidence.seen:
        return None
    if evidence.how == "ended" and evidence.is_missing:
        return exercise.outcome(not_attempted(NOT_THERE))
    if evidence.how == "ended" and evidence.raised:
        return _raised(exercise, evidence)
    return _ended(exercise.id, evidence)


def _read(exercise: Exercise[Any], evidence: Evidence, seed: int) -> tuple[Outcome, str]:
    try:
        if evidence.seen.count("[") + evidence.seen.count("{") > _MOST_NESTED:
            return _forged(exercise.id, "it holds millions of lists"), ""
        seen = from_json(evidence.seen)
        if isinstance(seen, Observation) and seen.time_ns > _LONGEST:
            return _forged(exercise.id, f"it has lasted {seen.time_ns} ns"), ""
        return exercise.judged(seen, seed), trace_of(seen)
    except RecordError as error:
        return _forged(exercise.id, str(error.what)), ""
    except Exception as error:  # a judge may meet evidence that no scenario would have written
        return _forged(exercise.id, f"it has led to {type(error).__name__}"), ""


def _raised(exercise: Exercise[Any], evidence: Evidence) -> Outcome:
    """Say of a cell that could not be run what is said of any exception."""
    if evidence.raised == "KeyboardInterrupt":  # it was interrupted before it came to the class
        return failed(exercise.id, *_ENDINGS["deadline"])
    if evidence.raised in _UNREAD:
        return _unread(exercise.id, evidence)
    fault = Fault(
        *(0, "", _WHERE, evidence.raised, evidence.text, evidence.line, evidence.code),
    )
    verdict = before_judging(Observation(0, 0, faults=(fault,)))
    assert verdict is not None  # there is an exception
    return exercise.outcome(verdict)


def _unread(exercise: str, evidence: Evidence) -> Outcome:
    """Say where Python has refused the cell as a whole; on the page, running it shows that."""
    says = first_sentence(evidence.text) or evidence.raised
    where = f" Line {evidence.line}: `{evidence.code}`." if evidence.line and evidence.code else ""
    return failed(
        exercise,
        f"Python says: {says}.{where} So nothing of the cell has run.",
        _UNREAD[evidence.raised],
        NO_PYTHON,
    )


def _forged(exercise: str, why: str) -> Outcome:
    return failed(
        exercise,
        f"What the run has left cannot be what the course has written: {why}.",
        "Nothing was judged. An answer needs no files, pipes or processes of its own.",
        UNREADABLE,
    )


_TOO_MUCH = (
    "The answer used too much output.",
    "Look for a loop that prints or publishes without end.",
    OUTPUT,
)
#: What is said of runs that did not come to their end: evidence, hint, mistake.
_ENDINGS = {
    "deadline": (
        "The answer does not come to an end, and was stopped.",
        "Look for a loop that nothing ends, or a call that waits: spin, sleep, input.",
        TIME,
    ),
    "memory": (
        "The answer used too much memory.",
        "Look for a list that only grows, or a loop that makes nodes.",
        MEMORY,
    ),
    "output": _TOO_MUCH,
    "result": _TOO_MUCH,
    LOST: (WATCHER_LOST, "It was tried more than once. Your instructor can look at it.", CRASH),
}


def _ended(exercise: str, evidence: Evidence) -> Outcome:
    """Say why there is no evidence, by how the run ended."""
    how, number = evidence.how, evidence.number
    if how == FORGED:
        return _forged(exercise, "it bears no seal")
    if how == "signal" and number == signal.SIGXCPU:
        how = "deadline"
    if how in _ENDINGS:
        return failed(exercise, *_ENDINGS[how])
    if how == "signal":
        known = [one.name for one in signal.Signals if one == number]
        said = f"The process of the answer died ({known[0] if known else f'signal {number}'})."
        hint = "Something ended the process from below Python, or the answer ended it itself."
        return failed(exercise, said, hint, CRASH)
    left = f"with exit code {number}" if number else "before anything could be seen"
    hint = "Take out what ends the program: exit, quit, os._exit. The check runs the node."
    return failed(exercise, f"The answer ended its process {left}.", hint, LEFT)


def untouched(exercise: Exercise[Any]) -> Outcome:
    """Return the outcome of a cell that nobody has filled in."""
    return exercise.outcome(not_attempted())

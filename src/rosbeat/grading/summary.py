"""The few lines that `rosbeat grade` prints when it has finished."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading.cells import number
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Mark
from rosbeat.grading.remarks import Remark, printable
from rosbeat.grading.tally import cut_off, held

#: Statuses in the order in which they are told, and what they are called.
_CALLED = {
    PASSED: "right",
    FAILED: "wrong",
    NOT_ATTEMPTED: "not attempted",
    MISSING: "not handed in",
    LOOKED_AT: "looked at by you",
    HELD: "held",
}
#: Things of one kind that are named; of more, only how many there are is told.
_MOST_NAMED = 5


def summary(gradebook: Gradebook, out: Path) -> str:
    """What has come out, a few lines for a terminal.

    Args:
        gradebook: A class.
        out: The folder with the results.
    """
    return "\n".join(_lines(gradebook, out))


def _lines(gradebook: Gradebook, out: Path) -> Iterator[str]:
    marks = [mark for one in gradebook.learners for mark in one.marks]
    exercises = {mark.exercise for mark in marks}
    learners = _count(len(gradebook.learners), "learner")
    yield f"{learners}, {_count(len(exercises), 'exercise')}: {_by_status(marks)}."
    if gradebook.learners:
        reached = sum(one.points for one in gradebook.learners) / len(gradebook.learners)
        whole = max(one.out_of for one in gradebook.learners)
        yield f"On average {number(round(reached, 1))} of {number(whole)} points."
    yield from _mistake_lines(marks)
    yield from _remark_lines(gradebook)
    yield from _held_lines(gradebook, out)
    yield f"All results are in {printable(str(out), 1000)}; begin with class.html."


def _count(number_of: int, what: str) -> str:
    return f"{number_of} {what}" if number_of == 1 else f"{number_of} {what}s"


def _by_status(marks: Sequence[Mark]) -> str:
    found = Counter(mark.status for mark in marks)
    told = [f"{found[status]} {called}" for status, called in _CALLED.items() if found[status]]
    return ", ".join(told) or "nothing to grade"


def _mistake_lines(marks: Sequence[Mark]) -> Iterator[str]:
    found = Counter((mark.mistake, mark.exercise) for mark in marks if mark.mistake)
    ordered = sorted(found.items(), key=lambda one: (-one[1], one[0]))
    for (mistake, exercise), times in ordered[:1]:
        if times == 1:  # each is as frequent as any other
            return
        title = MISTAKES[mistake].title if mistake in MISTAKES else mistake
        yield f"The most frequent mistake: {printable(title)} ({times} times, in {exercise})."


def _remark_lines(gradebook: Gradebook) -> Iterator[str]:
    by_hand = [one for one in gradebook.remarks if one.about == "manual"]
    for one in by_hand[:_MOST_NAMED]:
        yield f"{printable(one.path)}: {printable(one.text, 1000)}"
    if len(by_hand) > _MOST_NAMED:
        yield f"  and {len(by_hand) - _MOST_NAMED} more such lines; class.html lists them all"
    files = [one for one in _remarks(gradebook) if one.about != "manual"]
    if files:
        kinds = Counter(printable(one.about) for one in files)
        told = ", ".join(f"{times} {about}" for about, times in sorted(kinds.items()))
        yield f"{_count(len(files), 'remark')} about files: {told}."


def _remarks(gradebook: Gradebook) -> list[Remark]:
    return [*gradebook.remarks, *(one for graded in gradebook.learners for one in graded.remarks)]


def _held_lines(gradebook: Gradebook, out: Path) -> Iterator[str]:
    named = [f"{printable(one.called, 60)} {mark.exercise}" for one, mark in held(gradebook)]
    if named:
        yield f"Held for you to look at: {_first(named)}."
        file = printable(str(out / "manual.csv"), 1000)
        yield f"  class.html shows them. Write their points into {file}"
        yield "  and run the command again, same options."
    half = [
        f"{printable(one.called, 60)} {', '.join(exercises)}"
        for one, _, exercises in cut_off(gradebook)
    ]
    if half:
        yield f"Half uploaded, so without points for these exercises: {_first(half, '; ')}."
        yield "  Ask for these files again."


def _first(names: Sequence[str], between: str = ", ") -> str:
    more = f"{between}and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
    return between.join(names[:_MOST_NAMED]) + more

"""A few answers run once more, in a real kernel of Jupyter, and must come out the same.

Answers are observed in processes that are forked from a prepared one, because that is fast. Whether
it is also what a learner's own kernel would have shown is looked at for a sample of each class. The
marks stay what they are; if the two differ, a remark says so, for a person to look.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256

from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.jobs import Job
from rosbeat.grading.judging import CRASH, LEFT
from rosbeat.grading.mending import find_answers
from rosbeat.grading.notebook import Cell
from rosbeat.grading.remarks import Remark, printable
from rosbeat.records import Outcome

#: How many answers of a class, if nothing else is said.
SAMPLE = 2
#: What a remark about a disagreement is about.
ABOUT = "sample"
#: A process that is gone leaves a kernel dead, whichever of these it is.
_GONE = frozenset((CRASH, LEFT))


@dataclass(frozen=True)
class Candidate:
    """An answer that may be chosen.

    Attributes:
        path: The file that it was handed in with, made safe to print.
        page: The course's page.
        cells: The cells that were handed in.
        job: What was observed in a prepared process.
    """

    path: str
    page: CoursePage
    cells: Sequence[Cell]
    job: Job


@dataclass(frozen=True)
class Sampled:
    """An answer that was chosen.

    Attributes:
        path: The file that it was handed in with.
        fast: What is observed in a prepared process.
        slow: The same for a kernel.
    """

    path: str
    fast: Job
    slow: Job


def choose(candidates: Iterable[Candidate], number: int) -> tuple[Sampled, ...]:
    """Choose answers, of as many different exercises as there are.

    It is by digest: who hands in the same class chooses the same, and nobody knows it beforehand.
    Pages with terminals are left out: they need a workspace, and minutes.

    Args:
        candidates: All answers.
        number: How many to choose.
    """
    turns: dict[str, int] = {}
    order: list[tuple[int, str, Candidate]] = []
    if number > 0:
        usable = (one for one in candidates if not one.job.replay and stands_alone(one.page))
        for digest, one in sorted(
            ((_digest(each), each) for each in usable), key=lambda two: two[0]
        ):
            turn = turns[one.job.exercise] = turns.get(one.job.exercise, 0) + 1
            order.append((turn, digest, one))
    chosen = sorted(order, key=lambda each: each[:2])[:number]
    return tuple(Sampled(one.path, one.job, in_a_kernel(one)) for _, _, one in chosen)


def _digest(one: Candidate) -> str:
    text = "\n".join((one.job.exercise, one.job.answer, one.path))
    return sha256(text.encode("utf-8", "backslashreplace")).hexdigest()


def stands_alone(page: CoursePage) -> bool:
    """Whether a page has no terminals, whose programs its nodes could wait for."""
    return not any("%%terminal" in one.source for one in page.cells if one.sort == "code")


def in_a_kernel(one: Candidate) -> Job:
    """The job for a kernel: the learner's cells up to the answer, as they were handed in.

    Args:
        one: The answer; what was mended counts as mended.
    """
    found = [
        answer
        for answer in find_answers(one.page.wanted, one.cells)
        if answer.exercise == one.job.exercise and answer.place >= 0
    ]
    mended = {answer.place: answer.source for answer in found}
    last = max(mended, default=-1)
    above = [
        mended.get(cell.place, cell.source)
        for cell in one.cells
        if cell.place <= last and (cell.place in mended or (cell.sort == "code" and not cell.check))
    ]
    return replace(one.job, kernel=tuple(above))


def disagreements(
    sampled: Iterable[Sampled], outcome_of: Callable[[Job], Outcome | None]
) -> tuple[Remark, ...]:
    """Say where a kernel has come to another outcome.

    Args:
        sampled: The answers.
        outcome_of: What was judged, of a job of either sort.
    """
    pairs = ((one, outcome_of(one.fast), outcome_of(one.slow)) for one in sampled)
    return tuple(
        _remark(one, fast, slow)
        for one, fast, slow in pairs
        if fast and slow and _known(fast) != _known(slow)
    )


def _known(outcome: Outcome) -> tuple[str, float, str]:
    """What has to be the same."""
    mistake = LEFT if outcome.mistake in _GONE else outcome.mistake
    return outcome.status, outcome.points, mistake


def _remark(one: Sampled, fast: Outcome, slow: Outcome) -> Remark:
    text = (
        f"Exercise {one.fast.exercise} was graded as {_told(fast)}; "
        f"a kernel of Jupyter, which is tried for a sample, says {_told(slow)}. "
        "The mark is the first one. Look at the page, and set another by hand if need be."
    )
    return Remark(ABOUT, one.path, text)


def _told(outcome: Outcome) -> str:
    named = f", {outcome.mistake}" if outcome.mistake else ""
    seen = printable(outcome.evidence.split("\n")[0], 150)
    return f"{outcome.status} with {outcome.points:g} of {outcome.out_of:g} points{named} ({seen})"

"""Tell what came of one submission: to a person, or to a program.

`docs/autograders.md` describes the JSON, which follows `$defs/submission` of
docs/results.schema.json. What the platforms of autograders read is in `platforms.autograders`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import SubmissionError
from rosbeat.exercises.exercise import FAILED
from rosbeat.exercises.outcome_display import LOOKS, OPEN, RIGHT, WRONG, clipped
from rosbeat.grading.files import number, printable
from rosbeat.grading.marks import HELD, Gradebook, Mark, late_note
from rosbeat.grading.remarks import Remark
from rosbeat.grading.results import VERSION, to_results

FORMAT = "rosbeat submission"
#: Characters of a line, and of all that is said of an exercise.
_MOST_OF_A_LINE, _MOST = 2_000, 4_000
_HELD = "A person has to look at this exercise, so it has no points yet."


@dataclass(frozen=True)
class Form:
    """Hold the two texts that go to one kind of reader.

    Attributes:
        result: Returns what came of the submission, from a gradebook with one learner, and the exit
            code of the command.
        refusal: Returns that the submission cannot be graded; empty if the error message is enough.
    """

    result: Callable[[Gradebook, int], str]
    refusal: Callable[[SubmissionError, int], str]


# For a person.


def _text(book: Gradebook, code: int) -> str:
    (graded,) = book.learners
    lines: list[str] = []
    for mark in graded.marks:
        lines += [_head(mark), *(f"  {line}" for line in finding(mark).splitlines())]
    for remark in remarks_of(book):
        lines += [f"{remark.about}: {remark.path}", f"  {remark.text}"]
    return plain([*lines, f"{number(graded.points)} of {number(graded.out_of)} points."])


def _head(mark: Mark) -> str:
    sign = LOOKS[mark.status][0] if mark.status in LOOKS else OPEN
    points = f"{number(mark.points)} of {number(mark.out_of)} points"
    return f"{sign} {mark.exercise} {mark.title}: {mark.status}, {points}."


def remarks_of(book: Gradebook) -> tuple[Remark, ...]:
    """Return what is worth telling about the files of a gradebook with one learner."""
    (graded,) = book.learners
    return (*book.remarks, *graded.remarks)


def finding(mark: Mark) -> str:
    """Return all that a learner should read of an exercise: evidence, name of the mistake, hint."""
    return plain(_finding(mark))[:_MOST]


def plain(lines: Iterable[str]) -> str:
    """Return lines that can be shown anywhere, without control characters."""
    return "\n".join(printable(line, _MOST_OF_A_LINE) for line in lines)


def _finding(mark: Mark) -> Iterator[str]:
    yield from clipped(mark.evidence or mark.cause).splitlines()
    known = MISTAKES.get(mark.mistake)
    if mark.status == FAILED and known:
        yield f"This is called: {known.heading}."
    for part in mark.parts:
        optional = " (optional)" if part.optional else ""
        yield f"{RIGHT if part.met else WRONG} {part.id}{optional}: {part.text}"
        yield from () if part.met else clipped(part.evidence).splitlines()
    if mark.hint:
        yield f"Hint: {mark.hint}"
    yield from (f"Remark: {remark}" for remark in mark.remarks)
    yield from filter(None, (mark.differs, late_note(mark), _HELD * (mark.status == HELD)))


# For programs.


def _json(book: Gradebook, code: int) -> str:
    document = json.loads(to_results(book))
    (graded,) = book.learners
    learner = document["learners"][0]
    return written(
        {
            **{"format": FORMAT, "version": VERSION, "exit": code, "course": book.course},
            **{"learner": graded.learner, "points": graded.points, "out_of": graded.out_of},
            "exercises": learner["marks"],
            "remarks": document["remarks"] + learner["remarks"],
        }
    )


def _json_refusal(error: SubmissionError, code: int) -> str:
    parts = {"what": error.what, "means": error.means, "to_try": error.to_try}
    return written({"format": FORMAT, "version": VERSION, "exit": code, "error": parts})


def written(document: Mapping[str, object]) -> str:
    """Return a document as JSON, in ASCII."""
    return json.dumps(document, indent=1, allow_nan=False)


#: The forms by what is typed after `--format`.
FORMS = {"text": Form(_text, lambda *_: ""), "json": Form(_json, _json_refusal)}

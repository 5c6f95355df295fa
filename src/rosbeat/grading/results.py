"""Write the results folder, and print a summary in the terminal.

`results.json` contains all results of a class, for programs; docs/results.schema.json is its
schema. The same gradebook gives the same bytes: the file contains neither dates nor durations, so a
run that was interrupted and resumed writes the same file as one that was not.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from rosbeat.errors import RecordError
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading import platforms
from rosbeat.grading.csv_exports import grades_csv
from rosbeat.grading.feedback import FOLDER as FEEDBACK
from rosbeat.grading.feedback import FeedbackZips, feedback, feedback_files
from rosbeat.grading.files import number, printable, write_whole
from rosbeat.grading.manual_marks import FILE as MANUAL
from rosbeat.grading.manual_marks import write_template
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Mark
from rosbeat.grading.remarks import Remark
from rosbeat.grading.report import class_report
from rosbeat.records_json import as_data, from_json
from rosbeat.viz.text_format import count, sentence_case

RESULTS = "results.json"
FORMAT = "rosbeat results"
#: Raised by one whenever a field is added, taken away or given another meaning.
VERSION = 3
#: Fields that are left out: those that differ from run to run, the texts of answers, and what they
#: did.
LEFT_OUT = {"mark": ("source", "trace"), "learner": ("files", "details"), "class": ("solutions",)}
_POINTS = ("points", "out_of", "judged")
_DIGITS = 6
#: Statuses in the order in which they are told, and what they are called.
_CALLED = {
    PASSED: "right",
    FAILED: "wrong",
    NOT_ATTEMPTED: "not attempted",
    MISSING: "not handed in",
    LOOKED_AT: "looked at by you",
    HELD: "held",
}
#: Remarks about lines that the instructor wrote, in `manual.csv` and in the roster.
_LINES = ("manual", "roster")
#: Things of one kind that are named; of more, only how many there are is told.
_MOST_NAMED = 5


# The folder.


def write_results(out: Path, gradebook: Gradebook, assignment: str = "rosbeat") -> None:
    """Write every file of results; what is equal already is not touched.

    Pages of learners who were there the last time and are not any more are taken away.

    Raises:
        GradingError: If one cannot be written.
    """
    before = feedback_files(previous_results(out))
    names, zips = feedback_files(gradebook), FeedbackZips()
    for one in gradebook.learners:
        page = feedback(one, gradebook.solutions)
        write_whole(out / FEEDBACK / names[one.learner], page)
        zips.add(one, page)
    files: dict[str, str | bytes] = {
        "class.html": class_report(gradebook),
        "grades.csv": grades_csv(gradebook),
    }
    for platform in platforms.PLATFORMS:
        if platform.has_free_names:
            continue
        theirs = [one for one in gradebook.learners if one.system == platform.name]
        table = platform.table(theirs, assignment) if theirs else ""
        files[f"{platform.name}.csv"] = table
        files[f"{platform.name}_feedback.zip"] = zips.zip_for(platform.name)
    for name, content in files.items():
        _write(out / name, content)
    for name in set(before.values()) - set(names.values()):
        (out / FEEDBACK / name).unlink(missing_ok=True)
    write_template(out / MANUAL, gradebook)
    # Last: where it is, all the others are.
    write_whole(out / RESULTS, to_results(gradebook))


def _write(path: Path, content: str | bytes) -> None:
    """Write a file; one without learners is none, and an older one would be wrong."""
    if content:
        write_whole(path, content)
    else:
        path.unlink(missing_ok=True)


def previous_results(out: Path) -> Gradebook:
    """Read what was written the last time; nothing, if there is nothing that can be read."""
    with suppress(OSError, RecordError):
        return from_json(Gradebook, (out / RESULTS).read_bytes(), "results")
    return Gradebook("", ())


# results.json.


def to_results(gradebook: Gradebook) -> str:
    """Write a gradebook as JSON, in ASCII, learners sorted."""
    document = {"format": FORMAT, "version": VERSION, **as_data(gradebook)}
    _leave_out(document, "class")
    document["learners"] = sorted(document["learners"], key=lambda graded: graded["learner"])
    for graded in document["learners"]:
        _leave_out(graded, "learner")
        for mark in graded["marks"]:
            _leave_out(mark, "mark")
            for name in _POINTS:  # 2 and 2.0 are one number, and so are 0 and -0
                mark[name] = round(float(mark[name]), _DIGITS) + 0.0
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


def _leave_out(document: dict[str, Any], kind: str) -> None:
    for name in LEFT_OUT[kind]:
        del document[name]


# What a terminal is told.


def summary(gradebook: Gradebook, out: Path) -> str:
    """Say what has come out, a few lines for a terminal."""
    return "\n".join(_lines(gradebook, out))


def _lines(gradebook: Gradebook, out: Path) -> Iterator[str]:
    marks = [mark for one in gradebook.learners for mark in one.marks]
    exercises = {mark.exercise for mark in marks}
    learners = count(len(gradebook.learners), "learner")
    said = f"{learners}, {count(len(exercises), 'exercise')}: {_by_status(marks)}."
    yield sentence_case(said)
    counted = gradebook.with_a_grade
    if counted:
        reached = sum(one.points for one in counted) / len(counted)
        whole = max(one.out_of for one in counted)
        waiting = sum(not one.is_settled for one in gradebook.learners)
        without = f", without {count(waiting, 'learner')} of whom something is held"
        average = f"On average {number(round(reached, 1))} of {number(whole)} points"
        yield f"{average}{without if waiting else ''}."
    remarks = [*gradebook.remarks, *(one for each in gradebook.learners for one in each.remarks)]
    yield from _line_lines([one for one in remarks if one.about in _LINES])
    files = Counter(printable(one.about) for one in remarks if one.about not in _LINES)
    if files:
        told = ", ".join(f"{times} {about}" for about, times in sorted(files.items()))
        yield f"{count(files.total(), 'remark')} about files: {told}."
    differ = sum(bool(mark.differs) for mark in marks)
    if differ:
        outcomes = count(differ, "exercise")
        yield f"Another outcome than the page shows: {outcomes}; class.html says which."
    held = sum(mark.status == HELD for mark in marks)
    if held:
        file = printable(str(out / MANUAL), 1000)
        yield f"Held for you to look at: {count(held, 'exercise')}; class.html says why."
        yield f"  Ask for files again, or mark with --review or in {file}."
        yield "  Then run the command again, same options."
    yield f"All results are in {printable(str(out), 1000)}; begin with class.html."


def _by_status(marks: Sequence[Mark]) -> str:
    found = Counter(mark.status for mark in marks)
    told = [f"{found[status]} {called}" for status, called in _CALLED.items() if found[status]]
    return ", ".join(told) or "nothing to grade"


def _line_lines(by_hand: Sequence[Remark]) -> Iterator[str]:
    for one in by_hand[:_MOST_NAMED]:
        yield f"{printable(one.path)}: {printable(one.text, 1000)}"
    if len(by_hand) > _MOST_NAMED:
        yield f"  and {len(by_hand) - _MOST_NAMED} more such lines; class.html lists them all"

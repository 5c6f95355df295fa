"""The folder of results: every file that grading writes, made from the gradebook."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from rosbeat.errors import GradingError, RecordError
from rosbeat.grading.class_report import class_report
from rosbeat.grading.feedback import FOLDER as FEEDBACK
from rosbeat.grading.feedback import feedback, feedback_files
from rosbeat.grading.manual import FILE as MANUAL
from rosbeat.grading.manual import write_template
from rosbeat.grading.marks import Gradebook
from rosbeat.grading.remarks import printable
from rosbeat.grading.results import from_results, to_results
from rosbeat.grading.tables import canvas_csv, grades_csv, moodle_csv
from rosbeat.grading.writing import write_whole

RESULTS = "results.json"


def require_folder(out: Path) -> None:
    """Refuse a place for results that is a file, or lies in one.

    Args:
        out: The folder, which need not be there yet.

    Raises:
        GradingError: If there is a file in its place.
    """
    there = next((one for one in (out, *out.parents) if one.exists()), None)
    if there is not None and not there.is_dir():
        raise GradingError(
            f"{printable(str(there), 1000)} is a file, not a folder.",
            "All results go into a folder, which need not be there yet; the file stays as it is.",
            "Name a folder:  --out ~/class/grades",
        )


def write_results(out: Path, gradebook: Gradebook, assignment: str = "rosbeat") -> None:
    """Write every file of results; what is equal already is not touched.

    Pages of learners who were there the last time and are not any more are taken away.

    Args:
        out: The folder.
        gradebook: The class.
        assignment: What the assignment is called in Canvas.

    Raises:
        GradingError: If one cannot be written.
    """
    before = feedback_files(previous_results(out))
    names = feedback_files(gradebook)
    for one in gradebook.learners:
        write_whole(out / FEEDBACK / names[one.learner], feedback(one))
    for name, content in (
        ("class.html", class_report(gradebook)),
        ("grades.csv", grades_csv(gradebook)),
        ("moodle.csv", moodle_csv(gradebook)),
        ("canvas.csv", canvas_csv(gradebook, assignment)),
    ):
        _write(out / name, content)
    for name in set(before.values()) - set(names.values()):
        (out / FEEDBACK / name).unlink(missing_ok=True)
    write_template(out / MANUAL, gradebook)
    # Last: whoever finds it finds all the others, too.
    write_whole(out / RESULTS, to_results(gradebook))


def _write(path: Path, content: str) -> None:
    """Write a table; one without learners is none, and an older one would be wrong."""
    if content:
        write_whole(path, content)
    else:
        path.unlink(missing_ok=True)


def previous_results(out: Path) -> Gradebook:
    """What was written the last time; nothing, if there is nothing that can be read.

    Args:
        out: The folder.
    """
    with suppress(OSError, RecordError, GradingError, ValueError):
        return from_results((out / RESULTS).read_text(encoding="utf-8"))
    return Gradebook("", ())

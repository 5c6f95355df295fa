"""Pages 03 and 12 in a course of nbgrader, arranged in every way: `arranged_course.py FOLDER`.

What nbgrader gives for each exercise is written into the folder, as JSON by arrangement.
"""

import json
import os
import shutil
import sys
from contextlib import suppress
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from a_course import run
from nbgrader.api import Gradebook
from nbgrader.apps import AutogradeApp, GenerateAssignmentApp

from arrangements import ARRANGEMENTS, ROOT, course, released

PAGES = ("03", "12")


def main(folder: Path) -> None:
    os.chdir(folder)
    shutil.copy(ROOT / "docs" / "nbgrader_config.py", folder)
    for number in PAGES:
        write(Path("source", f"page_{number}"), number, released(number))
        run(GenerateAssignmentApp, f"page_{number}")
        for name, arranged in ARRANGEMENTS.items():
            learner = name.replace(" ", "_")
            write(Path("submitted", learner, f"page_{number}"), number, arranged(number))
        with suppress(SystemExit):  # of pages that it cannot read, there are no points
            run(AutogradeApp, f"page_{number}")
    Path("marks.json").write_text(json.dumps(marks()))


def write(place: Path, number: str, page: dict) -> None:
    """Write a page without the cells that only show something: each would take time."""
    shows = {cell.id for cell in course()[number].cells if cell.shows}
    cells = [cell for cell in page["cells"] if cell.get("id") not in shows]
    place.mkdir(parents=True)
    path = place / f"{course()[number].lesson}.ipynb"
    path.write_text(json.dumps({**page, "cells": cells}), encoding="utf-8")


def marks():
    """The points of each exercise, and those that there are, by arrangement and page."""
    points = {}
    with Gradebook("sqlite:///gradebook.db") as book:
        for number in PAGES:
            for submission in book.assignment_submissions(f"page_{number}"):
                points[f"{submission.student.id.replace('_', ' ')} {number}"] = {
                    grade.name: [grade.auto_score, grade.max_score]
                    for notebook in submission.notebooks
                    for grade in notebook.grades
                }
    return points


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())

"""A class in a course of nbgrader, from the release to the feedback: `a_course.py FOLDER`.

A process of its own, because nbgrader warns of this and that, and one process for all, because
nbgrader takes seconds to load. Its commands are run as from a terminal in the course's folder. What
was seen is written into the folder, as JSON.
"""

import io
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import nbformat
from nbgrader.api import Gradebook
from nbgrader.apps import AutogradeApp, GenerateAssignmentApp, GenerateFeedbackApp, ValidateApp
from nbgrader.utils import is_grade
from nbgrader.validator import Validator

from bank.class_of_learners import (
    NAMES,
    PAGES,
    POINTS,
    answers_of,
    blank,
    filled,
    nbgrader_course,
)
from bank.pages import solution

#: Beside the pages: what the pages of this class do not do.
ODD = {
    "some-points": """
        from rosbeat.exercises.check import for_nbgrader
        from rosbeat.records import Outcome
        for_nbgrader(Outcome("13b", "failed", points=13, out_of=20), "autograde")""",
    "stderr": """
        import os, sys, warnings
        warnings.warn("this goes to stderr")
        print("and this", file=sys.stderr)
        os.write(2, b"and this, as C code would")
        for_nbgrader(Outcome("13b", "passed", points=20, out_of=20), "autograde")""",
    "home": """
        from rosbeat import workspace
        print(workspace.folder())""",
}


def main(folder: Path) -> None:
    os.chdir(folder)
    nbgrader_course(folder, "ps1")
    source = folder / "source" / "ps1"
    for page in source.glob("*.ipynb"):
        shorten(page)
    add_odd_page(source)
    run(GenerateAssignmentApp, "ps1")
    solutions = {name: solution(name) for name in POINTS if name[:2] in PAGES}
    hand_in("ada", solutions, "03")
    hand_in("bob", {name: one.text for name, one in answers_of(1).items()}, "03")
    hand_in("bob", {}, "04")  # untouched
    nbformat.write(filled(blank("03"), solutions), "whole.ipynb")
    files = ("whole.ipynb", f"submitted/bob/ps1/{NAMES['03']}.ipynb")
    said = [validated(file) for file in files]
    run(AutogradeApp, "ps1")
    run(GenerateFeedbackApp, "ps1")
    seen = {"validated": said, "marks": marks(), "home": home(folder)}
    (folder / "seen.json").write_text(json.dumps(seen))


def run(app, *typed):
    """One command, as typed in the current folder."""
    command = app()
    command.initialize(list(typed))
    command.start()


def shorten(path):
    """Leave out of a page what it shows and tries: each run of a page would take seconds more."""
    page = nbformat.read(path, as_version=4)
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    page.cells = [code[0], *(cell for cell in code[1:] if "nbgrader" in cell.metadata)]
    nbformat.write(page, path)


def add_odd_page(source):
    make = nbformat.v4
    cells = [make.new_code_cell("\n".join(one.strip() for one in text.strip().split("\n")))
             for text in ODD.values()]  # fmt: skip
    for name, cell in zip(ODD, cells, strict=True):
        cell.metadata.nbgrader = {
            **{"grade": True, "grade_id": name, "locked": True, "points": 20},
            **{"schema_version": 3, "solution": False, "task": False},
        }
    nbformat.write(make.new_notebook(cells=cells), source / "odd.ipynb")


def hand_in(learner, answers, *pages):
    """Fill in the released pages and put them where nbgrader looks for them."""
    place = Path("submitted", learner, "ps1")
    place.mkdir(parents=True, exist_ok=True)
    for name in [*(NAMES[page] for page in pages), *(["odd"] if learner == "ada" else [])]:
        page = nbformat.read(Path("release", "ps1", f"{name}.ipynb"), as_version=4)
        nbformat.write(filled(page, answers), place / f"{name}.ipynb")


def validated(file):
    """What `nbgrader validate` prints."""
    Validator.stream = io.StringIO()
    run(ValidateApp, file)
    return Validator.stream.getvalue()


def marks():
    """Of each learner and each check: the points, those that there are, whether a person must."""
    with Gradebook("sqlite:///gradebook.db") as book:
        return {
            one.student.id: {
                grade.name: [grade.auto_score, grade.max_score, grade.needs_manual_grade]
                for notebook in one.notebooks
                for grade in notebook.grades
            }
            for one in book.assignment_submissions("ps1")
        }


def home(folder):
    """Where the odd page found its workspace."""
    page = nbformat.read(folder / "autograded/ada/ps1/odd.ipynb", as_version=4)
    (cell,) = (cell for cell in page.cells if is_grade(cell) and "workspace" in cell.source)
    return "".join(output.get("text", "") for output in cell.outputs).strip()


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())

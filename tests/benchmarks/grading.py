"""The same class, graded by `rosbeat grade` in its sandbox and by `nbgrader autograde`.

Each learner hands in pages 03 and 04 whole, with answers of the bank, half of them wrong; no two
answers of the class are equal, so nothing is saved by an answer that was judged before. Measured is
one command each, from its start to its end. Both have to give every answer the same points. The 120
learners take nbgrader more than half an hour; `--quick` is a class of 6.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

from measuring import MB, Row, Use, use_of

sys.path.append(str(Path(__file__).resolve().parent.parent))

from bank.class_of_learners import distinct_texts_of, hand_in, nbgrader_course

#: How many times as many learners `rosbeat grade` has to do in a minute.
TARGET = 10
#: Bytes of memory of all processes of `rosbeat grade` together, at most.
MEMORY = 500 * MB
QUICK = 6
ASSIGNMENT = "ps1"

#: Points by learner and exercise.
Points = dict[tuple[str, str], float]


def measure(learners: int, quick: bool) -> list[Row]:
    """Learners in a minute, memory, and marks that agree.

    Args:
        learners: How many there are in the class.
        quick: Whether a class of `QUICK` is enough.
    """
    learners = QUICK if quick else learners
    with tempfile.TemporaryDirectory() as name:
        ours, our_points = _rosbeat(Path(name) / "rosbeat", learners)
        theirs, their_points = _nbgrader(Path(name) / "nbgrader", learners)
    ratio = theirs.seconds / ours.seconds
    same = sum(their_points.get(place) == points for place, points in our_points.items())
    marks = len(our_points | their_points)
    return [
        Row(f"nbgrader autograde, {learners} learners", _shown(learners, theirs)),
        Row(
            f"rosbeat grade, {learners} learners",
            _shown(learners, ours),
            f"{ratio:.1f} x nbgrader",
            "" if quick else f">= {TARGET} x",
            quick or ratio >= TARGET,
        ),
        Row(
            "memory of all its processes (PSS)",
            f"{ours.memory / MB:.0f} MB",
            f"{ours.memory / theirs.memory:.2f} x nbgrader",
            f"<= {MEMORY / MB:.0f} MB",
            ours.memory <= MEMORY,
        ),
        Row("marks that agree", f"{same} of {marks}", "", "all", same == marks > 0),
    ]


def _rosbeat(folder: Path, learners: int) -> tuple[Use, Points]:
    hand_in(folder / "submissions", learners, texts=distinct_texts_of)
    used = use_of(("rosbeat", "grade", "submissions", "--out", "grades"), folder)
    results = json.loads((folder / "grades" / "results.json").read_text())
    return used, {
        (one["learner"], mark["exercise"]): mark["points"]
        for one in results["learners"]
        for mark in one["marks"]
    }


def _nbgrader(folder: Path, learners: int) -> tuple[Use, Points]:
    nbgrader_course(folder, ASSIGNMENT)
    hand_in(folder / "submitted", learners, ASSIGNMENT, distinct_texts_of)
    use_of(("nbgrader", "generate_assignment", ASSIGNMENT), folder)
    used = use_of(("nbgrader", "autograde", ASSIGNMENT), folder)
    return used, _recorded(folder)


def _recorded(folder: Path) -> Points:
    """Return the points in nbgrader's database."""
    from nbgrader.api import Gradebook  # it takes seconds, and warns of this and that

    with Gradebook(f"sqlite:///{folder}/gradebook.db") as book:
        return {
            (one.student.id, grade.name.removesuffix("-check")): grade.score
            for one in book.assignment_submissions(ASSIGNMENT)
            for notebook in one.notebooks
            for grade in notebook.grades
        }


def _shown(learners: int, used: Use) -> str:
    return f"{60 * learners / used.seconds:.1f} learners/min, {used.seconds:.1f} s"

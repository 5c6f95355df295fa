"""The same class, graded by `rosbeat grade` in its sandbox and by `nbgrader autograde`.

Each learner hands in pages 03 and 04 whole, with answers of the bank, half of them wrong. Measured
is one command each, from its start to its end. Both have to give every learner the same points.
The 120 learners take nbgrader more than half an hour; `--quick` is a class of 6.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from measuring import Row

sys.path.append(str(Path(__file__).resolve().parent.parent))

from bank.class_of_learners import hand_in, nbgrader_course

#: Learners, and how many times as many of them `rosbeat grade` has to do in a minute.
TARGETS = {30: 10, 120: 20}
QUICK = {6: 0}
ASSIGNMENT = "ps1"
PROGRAMS = Path(sys.executable).parent

Points = dict[str, float]


def measure(quick: bool) -> list[Row]:
    """Learners in a minute, for classes of several sizes."""
    return [
        row
        for learners, target in (QUICK if quick else TARGETS).items()
        for row in _class_of(learners, target)
    ]


def _class_of(learners: int, target: int) -> list[Row]:
    with tempfile.TemporaryDirectory() as name:
        ours, our_points = _rosbeat(Path(name) / "rosbeat", learners)
        theirs, their_points = _nbgrader(Path(name) / "nbgrader", learners)
    _require_same(our_points, their_points, learners)
    ratio = theirs / ours
    wanted = f">= {target} x" if target else ""
    return [
        Row(f"nbgrader autograde, {learners} learners", _shown(learners, theirs)),
        Row(
            f"rosbeat grade, {learners} learners",
            _shown(learners, ours),
            f"{ratio:.1f} x nbgrader",
            wanted,
            ratio >= target,
        ),
    ]


def _rosbeat(folder: Path, learners: int) -> tuple[float, Points]:
    hand_in(folder / "submissions", learners)
    command = ("rosbeat", "grade", folder / "submissions", "--out", folder / "grades")
    seconds = _timed(command, folder)
    results = json.loads((folder / "grades" / "results.json").read_text())
    points = {
        one["learner"]: sum(mark["points"] for mark in one["marks"]) for one in results["learners"]
    }
    return seconds, points


def _nbgrader(folder: Path, learners: int) -> tuple[float, Points]:
    nbgrader_course(folder, ASSIGNMENT)
    hand_in(folder / "submitted", learners, ASSIGNMENT)
    _timed(("nbgrader", "generate_assignment", ASSIGNMENT), folder)
    seconds = _timed(("nbgrader", "autograde", ASSIGNMENT), folder)
    _timed(("nbgrader", "export"), folder)
    with (folder / "grades.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return seconds, {one["student_id"]: float(one["score"]) for one in rows}


def _timed(command: Sequence[str | Path], folder: Path) -> float:
    """Seconds that a command takes, in a folder and with the environment's own programs."""
    path = os.pathsep.join([str(PROGRAMS), os.environ.get("PATH", "")])
    begin = time.perf_counter()
    done = subprocess.run(
        [PROGRAMS / command[0], *command[1:]],
        cwd=folder,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
    )
    seconds = time.perf_counter() - begin
    if done.returncode:
        typed = " ".join(map(str, command))
        raise RuntimeError(f"{typed} ended with {done.returncode}:\n{done.stderr[-3000:]}")
    return seconds


def _require_same(ours: Points, theirs: Points, learners: int) -> None:
    differing = [
        f"{name}: {ours.get(name)} and {theirs.get(name)}"
        for name in sorted({*ours, *theirs})
        if ours.get(name) != theirs.get(name)
    ]
    if differing or len(ours) != learners:
        raise RuntimeError(f"rosbeat and nbgrader disagree: {differing}, {len(ours)} learners")


def _shown(learners: int, seconds: float) -> str:
    return f"{60 * learners / seconds:.1f} learners/min, {seconds:.1f} s"

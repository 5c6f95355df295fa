"""How the time and the memory of `rosbeat grade` grow with the class.

Each learner hands in page 03, and no two answers are the same: each has its learner's number in a
comment, so nothing is saved by an answer that was judged before. Memory is counted as the shares of
all processes of the command together (PSS): what forks share counts once.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
import time
from pathlib import Path

import psutil
from grading import PROGRAMS
from measuring import Row

from bank.class_of_learners import NAMES, answers_of, blank, filled
from rosbeat.authoring import pages

LEARNERS = (10, 100, 1_000)
QUICK = (2, 10)
#: How many times as long one more submission may take in a large class.
STEADY = 1.25
_PAGE = "03"
#: Seconds between two looks at the memory.
_LOOK = 0.5
_MB = 1_000_000


def measure(quick: bool) -> list[Row]:
    """Seconds and memory for classes of several sizes."""
    found = {learners: _graded(learners) for learners in (QUICK if quick else LEARNERS)}
    rows = [
        Row(
            f"rosbeat grade, {learners:,} submissions",
            f"{seconds:.1f} s, {memory / _MB:.0f} MB",
            f"{seconds / learners:.2f} s each",
        )
        for learners, (seconds, memory) in found.items()
    ]
    return rows if quick else [*rows, _further({n: seconds for n, (seconds, _) in found.items()})]


def _further(seconds: dict[int, float]) -> Row:
    """What one more submission costs in a large class, and in a small one."""
    small, middle, large = seconds
    late = (seconds[large] - seconds[middle]) / (large - middle)
    early = (seconds[middle] - seconds[small]) / (middle - small)
    return Row(
        f"one more, from {middle:,} to {large:,}",
        f"{late:.2f} s",
        f"{late / early:.2f} x one from {small} to {middle}",
        f"<= {STEADY} x",
        late / early <= STEADY,
    )


def hand_in(folder: Path, learners: int) -> None:
    """Write what a class hands in, each answer with its learner's number.

    Args:
        folder: Gets a folder for each learner.
        learners: How many there are.
    """
    for number in range(learners):
        place = folder / f"learner_{number:04}"
        place.mkdir(parents=True)
        texts = {
            exercise: f"{one.text}\n# learner {number}\n"
            for exercise, one in answers_of(number).items()
        }
        made = pages.to_bytes(filled(blank(_PAGE), texts))
        (place / f"{NAMES[_PAGE]}.ipynb").write_bytes(made)


def _graded(learners: int) -> tuple[float, int]:
    """Seconds that grading a class takes, and bytes of memory at most."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        hand_in(folder / "submissions", learners)
        command = [PROGRAMS / "rosbeat", "grade", "submissions", "--out", "grades"]
        begin = time.perf_counter()
        with (folder / "said.txt").open("wb") as said:
            process = subprocess.Popen(command, cwd=folder, stdout=said, stderr=said)
            memory = _watched(process)
        seconds = time.perf_counter() - begin
        if process.returncode:
            raise RuntimeError((folder / "said.txt").read_text()[-3000:])
        results = json.loads((folder / "grades" / "results.json").read_text())
        if len(results["learners"]) != learners:
            raise RuntimeError(f"{len(results['learners'])} of {learners} learners were graded")
        return seconds, memory


def _watched(process: subprocess.Popen[bytes]) -> int:
    """Bytes that a command had at most, by the time that it has ended."""
    most = 0
    while True:
        try:
            process.wait(_LOOK)
        except subprocess.TimeoutExpired:
            most = max(most, _pss(process.pid))
        else:
            return most


def _pss(pid: int) -> int:
    """The memory of a process and of all below it; what several share is divided among them."""
    total = 0
    try:
        parent = psutil.Process(pid)
        family = [parent, *parent.children(recursive=True)]
    except psutil.Error:
        return 0
    for one in family:
        try:
            total += one.memory_full_info().pss
        except (psutil.Error, OSError):
            continue  # it has just ended
    return total

"""How the time and the memory of `rosbeat grade` grow with the class.

Each learner hands in page 03. Of five learners, three hand in the same answers, as it is in a class
that works together; those of two learners are theirs alone. Memory is counted as the shares of all
processes of the command together (PSS).
"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

from measuring import MB, Row, Use, use_of

from bank.class_of_learners import distinct_texts_of, hand_in

LEARNERS = (100, 300, 1_000)
QUICK = (5, 10)
#: How many times as long one learner may take in a large class as in a small one.
STEADY = 1.25
_PAGE = "03"


def measure(quick: bool) -> list[Row]:
    """Seconds and memory for classes of several sizes."""
    rows: list[Row] = []
    small = 0.0
    for learners in QUICK if quick else LEARNERS:
        used = _graded(learners)
        each = used.seconds / learners
        small = small or each
        rows.append(
            Row(
                f"rosbeat grade, {learners:,} learners",
                f"{used.seconds:.1f} s, {used.memory / MB:.0f} MB",
                f"{each:.2f} s each, {each / small:.2f} x the smallest class",
                "" if quick else f"<= {STEADY} x",
                quick or each / small <= STEADY,
            )
        )
    return rows


def texts_of_a_group(number: int) -> dict[str, str]:
    """Return what a learner writes in a class where three of five learners share their answers."""
    place = number % 5
    return distinct_texts_of(number - place if place < 3 else number)


def _graded(learners: int) -> Use:
    """Grade a class, and return what that has used."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        hand_in(folder / "submissions", learners, texts=texts_of_a_group, numbers=[_PAGE])
        used = use_of(("rosbeat", "grade", "submissions", "--out", "grades"), folder)
        results = json.loads((folder / "grades" / "results.json").read_text())
    if len(results["learners"]) != learners:
        raise RuntimeError(f"{len(results['learners'])} of {learners} learners were graded")
    return used

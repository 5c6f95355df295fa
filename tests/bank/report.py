"""The mutants of the reference solutions that pass, as docs/mutants.md lists them.

The page is the only place where the reasons stand. This writes it anew, with a question mark for a
survivor that has no reason yet:

    PYTHONPATH=tests .venv/bin/python -m bank.report
"""

import os
import re
from functools import cache
from tempfile import TemporaryDirectory

from bank.mutants import Mutant, mutants
from bank.pages import NODE_EXERCISES, ROOT, solution, subject
from bank.running import outcome_of

PAGE = ROOT / "docs" / "mutants.md"

#: What stands for a reason that nobody has given yet.
OPEN = "?"

_HEAD = """# Mutants

A check is worth what it refuses. So each reference solution of an exercise about a node is changed
in one small way, in every place and in every way that `tests/bank/mutants.py` knows: comparisons,
numbers, names, arithmetic, conditions, arguments swapped or gone, statements swapped or gone, calls
where there were none and none where there were some. Each such program is handed to `check`.

A mutant that does what the exercise asks has to pass all the same. These are listed below, with the
reason. A test makes them again, and fails if another one passes, or if one of these does not.
Words inside of f-strings are left as they are: they are for people.

Written by `PYTHONPATH=tests .venv/bin/python -m bank.report`, which keeps the reasons.
"""


@cache
def mutants_of(exercise: str) -> tuple[Mutant, ...]:
    """The mutants of an exercise's reference solution."""
    return tuple(mutants(solution(exercise)))


@cache
def survivors_of(exercise: str) -> tuple[str, ...]:
    """The changes that `check` does not refuse, in order of place, each once."""
    name = subject(exercise)
    alive = (
        mutant.change
        for mutant in mutants_of(exercise)
        if outcome_of(exercise, mutant.text, name).status != "failed"
    )
    return tuple(dict.fromkeys(alive))


def read(page: str) -> dict[str, dict[str, str]]:
    """The reasons on a page, by exercise and change."""
    found: dict[str, dict[str, str]] = {}
    for part in page.split("\n## ")[1:]:
        rows = re.findall(r"^\| (line .*) \| (.*) \|$", part, re.MULTILINE)
        found[part.split()[0]] = {_plain(change): reason for change, reason in rows}
    return found


def counts(page: str) -> dict[str, tuple[int, int]]:
    """How many mutants and how many survivors a page claims for each exercise."""
    rows = re.findall(r"^\| (\d\d\w) \| (\d+) \| (\d+) \|$", page, re.MULTILINE)
    return {exercise: (int(made), int(alive)) for exercise, made, alive in rows}


def assert_listed(exercise: str) -> None:
    """Check that what survives stands on the page, each with a reason, and nothing else."""
    listed = read(PAGE.read_text(encoding="utf-8"))[exercise]
    assert sorted(survivors_of(exercise)) == sorted(listed)
    assert OPEN not in listed.values()


def write(page: str) -> str:
    """The page as it ought to be, with the reasons of the one that is there."""
    reasons = read(page)
    parts = [_HEAD, _table()]
    for exercise in NODE_EXERCISES:
        known = reasons.get(exercise, {})
        rows = [f"| {_in_table(one)} | {known.get(one, OPEN)} |" for one in survivors_of(exercise)]
        parts.append(
            "\n".join([f"## {exercise}\n", "| change | why it may pass |", "|---|---|", *rows, ""])
        )
    return "\n".join(parts)


def _table() -> str:
    rows = [
        f"| {exercise} | {len(mutants_of(exercise))} | {len(survivors_of(exercise))} |"
        for exercise in NODE_EXERCISES
    ]
    return "\n".join(["| exercise | mutants | pass |", "|---|---|---|", *rows, ""])


def _in_table(text: str) -> str:
    return text.replace("|", r"\|")


def _plain(text: str) -> str:
    return text.replace(r"\|", "|")


if __name__ == "__main__":
    before = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    with TemporaryDirectory() as folder:
        os.environ["ROSBEAT_PROGRESS_IN"] = folder  # these checks are nobody's progress
        PAGE.write_text(write(before), encoding="utf-8")

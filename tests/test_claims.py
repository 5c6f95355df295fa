"""docs/claims.md: each claim of the tutorial is tested on a page, in a cell that is there."""

import re
from pathlib import Path

import pytest

from rosbeat.exercises.registry import EXERCISES, PAGES

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "claims.md").read_text(encoding="utf-8")
ROW = re.compile(r"^\| (\d+) \| (.+?) \| (\d\d) \| (`+) ?(.+?) ?\4 \| (\w+) \| (.+) \|$")
#: What the tutorial is made of, in its order; each has claims of its own.
SECTIONS = (
    "What publish and subscribe is",
    "Why it matters: five claims",
    "Hello World",
    "The workspace",
    "The package",
    "The publisher",
    "The subscriber",
    "The two compared",
    "Executable files",
    "`setup.py` and the entry points",
    "Build, load and run",
)
LINES = [line for line in PAGE.splitlines() if re.match(r"\| \d+ \|", line)]
ROWS = [found.groups() for found in map(ROW.match, LINES) if found]


def lesson(number):
    (path,) = (ROOT / "src" / "lessons").glob(f"{number}_*.py")
    return path.read_text(encoding="utf-8")


def test_every_row_can_be_read_and_they_are_counted():
    assert len(ROWS) == len(LINES) >= 80
    assert [int(number) for number, *_ in ROWS] == list(range(1, len(ROWS) + 1))


def test_all_parts_of_the_tutorial_have_claims():
    assert tuple(re.findall(r"(?m)^## (.+)$", PAGE)) == SECTIONS
    for part in PAGE.split("\n## ")[1:]:
        assert re.search(r"(?m)^\| \d+ \|", part), part[:40]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]} on page {row[2]}")
def test_a_claim_stands_in_a_cell_and_has_a_check_or_an_output(row):
    _, claim, page, _, cell, check, found = row
    assert page in {one.number for one in PAGES}
    assert cell.replace("\\|", "|") in lesson(page)
    assert check == "output" or check in EXERCISES
    assert len(claim) > 10
    assert found.startswith(("True", "Partly", "Not true", "Only", "Once", "The exercise", "With"))

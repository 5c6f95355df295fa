"""Write the tables of docs/teaching.md: the lessons, and the mistakes to expect on each page.

The lessons come from the minutes of the pages, and the mistakes from the wrong answers of the bank.
What stands between two markers is written anew; the notes around it are kept:

    PYTHONPATH=tests .venv/bin/python -m bank.teaching
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

from bank.pages import ROOT
from bank.reading import Answer, answers, held_out
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.registry import PAGES, Page

DOCUMENT = ROOT / "docs" / "teaching.md"

#: How long a lesson is, in minutes.
LESSON = 90
#: Which pages are taught together; a page that is longer than a lesson takes several.
TOGETHER = (
    *(("00", "01"), ("02", "03"), ("04",), ("05", "06")),
    *((page.number,) for page in PAGES if page.elective),
)
_SHOWN = 5
_BLOCK = re.compile(r"(<!-- begin: (.+) -->\n)(?:.*\n)*?(<!-- end -->)")


def numbered() -> dict[str, Page]:
    """Return the pages of the course by their number."""
    return {page.number: page for page in PAGES if page.number}


def wrong_answers(page: str) -> tuple[Answer, ...]:
    """Return the wrong answers of the bank to the exercises of a page."""
    bank = (*answers(), *held_out())
    return tuple(one for one in bank if one.exercise[:2] == page and one.status == "failed")


def lessons() -> str:
    """Return the table of lessons."""
    rows, last = [], 0
    for group in TOGETHER:
        pages = [numbered()[number] for number in group]
        minutes = sum(page.minutes for page in pages)
        first, last = last + 1, last + -(-minutes // LESSON)
        label = f"{first}" if first == last else f"{first}, {last}"
        rows.append(f"| {label} | {'<br>'.join(map(_linked, pages))} | {minutes} |")
    head = ["| lesson | pages | minutes of the pages |", "|---|---|---|"]
    return "\n".join([*head, *rows, ""])


def _linked(page: Page) -> str:
    return f"[{page.heading}](../notebooks/{page.lesson}.ipynb)"


def mistakes(wrong: Iterable[Answer]) -> str:
    """Return the table of the most frequent mistakes in some wrong answers.

    An answer counts for each of its mistakes. Equally frequent ones come in the order of the
    catalogue, and a mistake that the course has no name for is left out.
    """
    wrong = tuple(wrong)
    counts = Counter(name for one in wrong for name in set(one.mistakes))
    named = [name for name in MISTAKES if counts[name]]
    rows = []
    for name in sorted(named, key=counts.__getitem__, reverse=True)[:_SHOWN]:
        where = sorted({one.exercise for one in wrong if name in one.mistakes})
        title = MISTAKES[name].title.replace("_", r"\_")
        rows.append(f"| {', '.join(where)} | {title} | {counts[name] / len(wrong):.0%} |")
    head = f"| exercise | mistake | share of {len(wrong)} wrong answers |"
    return "\n".join([head, "|---|---|---|", *rows, ""])


def write(text: str) -> str:
    """Return the document with each block between markers as it ought to be.

    Raises:
        KeyError: If a block has the name of no page.
    """
    made = {number: mistakes(wrong_answers(number)) for number in numbered()}
    made["lessons"] = lessons()
    return _BLOCK.sub(lambda found: f"{found[1]}\n{made[found[2]]}\n{found[3]}", text)


def blocks(text: str) -> list[str]:
    """Return the names of the blocks in a document, in order."""
    return [name for _, name, _ in _BLOCK.findall(text)]


if __name__ == "__main__":
    DOCUMENT.write_text(write(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")

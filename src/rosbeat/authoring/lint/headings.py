"""Headings: one title, no skipped levels, one way of numbering."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding, headings
from rosbeat.authoring.lint.exercises import mentioned
from rosbeat.authoring.lint.verbs import VERBS


def title(desk: Desk) -> Iterator[Finding]:
    """The page opens with its title, the only heading of level 1, and the title has a verb."""
    wanted = desk.lesson.header.title
    found = [(line, level, text) for cell in desk.markdown for line, level, text in headings(cell)]
    tops = [(line, text) for line, level, text in found if level == 1]
    first = desk.lesson.cells[0] if desk.lesson.cells else None
    if len(tops) != 1 or found[0][1] != 1 or not first or first.kind != "markdown":
        what = f"the page has {len(tops)} headings of level 1; it opens with exactly one."
        yield desk.finding("title", 1, what, f"Begin the first cell with '# # {wanted}'.")
    elif tops[0][1] != wanted:
        what = f"the heading {tops[0][1]!r} is not the title of the header, {wanted!r}."
        yield desk.finding("title", tops[0][0], what)
    if wanted.split(" ")[0].rstrip(",").lower() not in VERBS:
        what = f"the title {wanted!r} does not begin with a verb."
        yield desk.finding("title", 1, what, "Say what the learner does; verbs.py lists the verbs.")


def heading_levels(desk: Desk) -> Iterator[Finding]:
    """A heading is at most one level below the one before it."""
    above = 0
    for cell in desk.markdown:
        for line, level, text in headings(cell):
            if level > above + 1:
                what = f"{text!r} jumps from level {above} to level {level}."
                yield desk.finding("heading-levels", line, what)
            above = level


def heading_numbers(desk: Desk) -> Iterator[Finding]:
    """Numbers in headings count from 1, and exercises are called what they are."""
    count = 0
    exercises = {cell.exercise for cell in desk.lesson.cells}
    for cell in desk.markdown:
        for line, _, text in headings(cell):
            match = re.match(r"(\d+)[.):]? ", text)
            count += 1 if match else 0
            if match and int(match[1]) != count:
                what = f"{text!r} should have the number {count}."
                yield desk.finding("heading-numbers", line, what)
            for name in mentioned(text):
                if name not in exercises:
                    what = f"the page has no exercise {name}."
                    yield desk.finding("heading-numbers", line, what)

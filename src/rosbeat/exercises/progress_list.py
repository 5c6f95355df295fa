"""Show how far somebody is, as a list with links; `progress_widget` keeps it up to date.

On a page the list has the page's exercises, and the course as two lines; elsewhere, as in
`home.ipynb`, it has every page of the course. JupyterLab opens relative links of an output as it
does those of a markdown cell. In pages that are not trusted its sanitizer leaves neither `role` nor
`aria-label`, so the meaning of a mark is text, too, and colour only repeats it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.outcome_display import EDGES, LOOKS, OPEN, RIGHT, WRONG
from rosbeat.exercises.registry import EXERCISES, Page
from rosbeat.records import Outcome
from rosbeat.viz.text_format import count, listing, sentence_case
from rosbeat.workspace.location import steady_home

_LEFT = "text-align: left; vertical-align: top; white-space: normal"
_PLAIN = "list-style-type: none; padding: 0px; margin: 0px 0px 8px 0px"
#: The edges that the verdicts of checks have; a box would look like a button, a line like a link.
_EDGES = {
    PASSED: f"border-left: 4px solid {EDGES[RIGHT]}",
    FAILED: f"border-left: 4px dashed {EDGES[WRONG]}",
    NOT_ATTEMPTED: f"border-left: 4px solid {EDGES[OPEN]}",
}
_NUMBER = "display: inline-block; padding-left: 5px; margin: 1px 8px 1px 0px; white-space: nowrap"
_LEGEND = ", ".join(f"{sign} {word}" for sign, word in LOOKS.values())


@dataclass(frozen=True)
class Row:
    """Hold how far somebody is with a page.

    Attributes:
        page: The page.
        outcomes: The best outcome so far of each of its exercises, in order.
    """

    page: Page
    outcomes: Sequence[Outcome]

    @property
    def passed(self) -> int:
        """Return how many exercises are passed."""
        return sum(one.status == PASSED for one in self.outcomes)

    @property
    def open(self) -> list[str]:
        """Return the ids of the exercises that are not passed, in order."""
        return [one.exercise for one in self.outcomes if one.status != PASSED]


class ProgressList:
    """Show at the end of a cell how far somebody is.

    Args:
        rows: Returns how far somebody is now, for each page of the course in order.
        here: The page that is open, or None for a list of the whole course.
        folder: The folder of the page that is open: links lead to the pages that are in it.
    """

    def __init__(self, rows: Callable[[], Sequence[Row]], here: Page | None, folder: Path) -> None:
        self._rows, self._here, self._folder = rows, here, folder

    def __repr__(self) -> str:
        return self.description

    @property
    def description(self) -> str:
        """Return the same in one line of words."""
        return describe(self._rows())

    def html(self) -> str:
        """Return the list as HTML; it depends only on the outcomes and on which pages exist."""
        rows, link = self._rows(), _Links(self._folder)
        here = next((row for row in rows if row.page == self._here), None)
        shown = _of_a_page(rows, here, link) if here else _of_the_course(rows, link)
        return f'<div class="rosbeat-progress">\n{_head(rows, here, link)}\n{shown}\n</div>'

    def bundle(self) -> dict[str, str]:
        """Return the list as a MIME bundle."""
        return {"text/html": self.html(), "text/plain": self.description}

    def _ipython_display_(self) -> None:
        from IPython.display import display

        if not is_a_page():
            display(self.bundle(), raw=True)
            return
        # The widgets take a while to load, and only a notebook in a browser shows them.
        from rosbeat.exercises.progress_widget import live, stored

        live(lambda: self).show(self)
        for bundle in stored(self):
            display(bundle, raw=True)


def is_a_page() -> bool:
    """Return whether this is the kernel of a page that somebody works on: no program, no build."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return hasattr(shell, "kernel") and steady_home() is None


# In words.


def describe(rows: Sequence[Row]) -> str:
    """Tell in one line of words how far somebody is.

    Args:
        rows: How far somebody is, for each page.
    """
    every = [one for row in rows for one in row.outcomes]
    parts = [f"Your progress: {summary(rows)}."]
    for status, (_, word) in LOOKS.items():
        names = [one.exercise for one in every if one.status == status]
        if names:
            which = "all" if len(names) == len(every) else listing(names)
            parts.append(f"{sentence_case(word)}: {which}.")
    return " ".join(parts)


def summary(rows: Sequence[Row]) -> str:
    """Tell how many exercises are passed in words: the core first, and the electives once begun.

    Args:
        rows: How far somebody is, for each page.
    """
    (core_passed, core), (passed, electives) = (_counts(part) for part in _in_parts(rows))
    said = f"{core_passed} of {count(core, 'exercise')} in the core"
    if electives and (passed or core_passed == core):
        said += f", {passed} of {electives} in the electives"
    return said


def totals(rows: Sequence[Row]) -> dict[str, str]:
    """Tell how many exercises are passed and how many points reached, in each part of the course.

    Args:
        rows: How far somebody is, for each page.
    """
    return {name: _total(part) for name, part in _parts(rows)}


def _total(rows: Sequence[Row]) -> str:
    passed, every = _counts(rows)
    outcomes = [one for row in rows for one in row.outcomes]
    points, out_of = sum(one.points for one in outcomes), sum(one.out_of for one in outcomes)
    return f"{passed} of {count(every, 'exercise')} passed, {points} of {out_of} points"


def _counts(rows: Sequence[Row]) -> tuple[int, int]:
    """Return how many exercises of these pages are passed, and how many there are."""
    return sum(row.passed for row in rows), sum(len(row.outcomes) for row in rows)


def _in_parts(rows: Sequence[Row]) -> tuple[list[Row], list[Row]]:
    """Return the pages of the core, and the electives."""
    core, electives = ([row for row in rows if row.page.elective == one] for one in (False, True))
    return core, electives


def _parts(rows: Sequence[Row]) -> Iterator[tuple[str, list[Row]]]:
    """Generate the parts of the course that have pages, by name."""
    names = ("Core pages", "Electives")
    return ((name, part) for name, part in zip(names, _in_parts(rows), strict=True) if part)


# As HTML.


class _Links:
    """Make links to the pages that are in a folder; what leads nowhere stays text."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def __call__(self, page: Page, words: str) -> str:
        file = f"{page.lesson}.ipynb"
        if not page.lesson or not (self._folder / file).is_file():
            return escape(words)
        return f'<a href="{file}" title="{escape(page.title)}">{escape(words)}</a>'


def _head(rows: Sequence[Row], here: Row | None, link: _Links) -> str:
    in_order = [row for part in _in_parts(rows) for row in part]
    first = next((row for row in in_order if row.open), None)
    if first is None:
        onward = "Everything is passed."
    elif first is here:
        onward = f"Continue here: exercise {first.open[0]} on this page."
    else:
        onward = f"Continue here: <strong>{link(first.page, first.page.heading)}</strong>."
    return f"<p><strong>Your progress:</strong> {summary(rows)}. {onward}</p>"


def _of_a_page(rows: Sequence[Row], here: Row, link: _Links) -> str:
    items = "\n".join(
        f"<li>{_chip(one)} {escape(EXERCISES[one.exercise].title)}: {LOOKS[one.status][1]}, "
        f"{one.points} of {count(one.out_of, 'point')}</li>"
        for one in here.outcomes
    )
    lines = "\n".join(
        f"<p>{name}: {', '.join(_short(row, here, link) for row in part)}.</p>"
        for name, part in _parts(rows)
    )
    return f'<ul style="{_PLAIN}">\n{items}\n</ul>\n{lines}'


def _short(row: Row, here: Row, link: _Links) -> str:
    """Return a page of the course's line: its number, and how many exercises are passed."""
    every = len(row.outcomes)
    name = row.page.number or row.page.title.lower()
    shown = f"<strong>{name} (this page)</strong>" if row is here else link(row.page, name)
    mark = f"{RIGHT} " if row.passed == every else ""
    return f"{mark}{shown} {row.passed}/{every}"


def _of_the_course(rows: Sequence[Row], link: _Links) -> str:
    numbered = {row.page.number: row.page for row in rows}
    tables = [
        f'<table style="margin: 0px 0px 8px 0px">\n'
        f'<caption style="{_LEFT}; font-weight: 600">{name}: {_total(part)}</caption>\n'
        f'<thead><tr><th scope="col" style="{_LEFT}">page</th>'
        f'<th scope="col" style="{_LEFT}">exercises</th></tr></thead>\n<tbody>\n'
        + "\n".join(_line(row, numbered, link) for row in part)
        + "\n</tbody>\n</table>"
        for name, part in _parts(rows)
    ]
    return "\n".join([f"<p>{_LEGEND}</p>", *tables])


def _line(row: Row, numbered: dict[str, Page], link: _Links) -> str:
    page = row.page
    needs = ", ".join(link(numbered[number], number) for number in page.needs)
    about = [f"{page.minutes} minutes"] if page.minutes else []
    about += [f"needs {needs}"] if needs else []
    chips = " ".join(map(_chip, row.outcomes))
    return (
        f'<tr><th scope="row" style="{_LEFT}">{link(page, page.heading)}'
        f'<div style="font-weight: 400">{", ".join(about)}</div></th>'
        f'<td style="{_LEFT}">{chips}</td></tr>'
    )


def _chip(outcome: Outcome) -> str:
    sign, word = LOOKS[outcome.status]
    title = f"{EXERCISES[outcome.exercise].title}: {word}"
    style = f"{_NUMBER}; {_EDGES[outcome.status]}"
    return f'<span style="{style}" title="{escape(title)}">{sign} {outcome.exercise}</span>'

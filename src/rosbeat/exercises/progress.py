"""`progress`: how far somebody is with the course, as a picture for the end of a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosbeat.exercises.progress_file import Standings, progress_file
from rosbeat.exercises.registry import PAGES, Page
from rosbeat.exercises.standing import Standing
from rosbeat.records import Outcome

if TYPE_CHECKING:
    from rosbeat.viz.picture import Picture


def progress() -> Picture:
    """Draw how far you are: every exercise of the course so far, page by page.

    Returns:
        The picture, which Jupyter shows.
    """
    # Drawing is slow to import, and a check needs none.
    from rosbeat.viz.progress_map import progress_map

    standings = progress_file().standings()
    return progress_map([(heading(page), outcomes(page, standings)) for page in PAGES])


def heading(page: Page) -> str:
    """The page's number and title.

    Args:
        page: The page.
    """
    return f"{page.number} {page.title}".strip()


def outcomes(page: Page, standings: Standings) -> list[Outcome]:
    """The best outcome so far of each exercise of a page.

    Args:
        page: The page.
        standings: How far somebody is, by exercise.
    """
    found = [(one, standings.get(one.id, Standing())) for one in page.exercises]
    return [
        Outcome(one.id, at.status, mistake=at.mistake, points=at.points, out_of=one.points)
        for one, at in found
    ]

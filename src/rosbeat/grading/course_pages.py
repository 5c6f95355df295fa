"""Read the course's own pages, as far as grading needs them: the cells that expect an answer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.notebook import Cell, Notebook, read_notebook


@dataclass(frozen=True)
class Wanted:
    """Describe a cell of the course's own page that waits for an answer."""

    exercise: str
    id: str
    blank: str


@dataclass(frozen=True)
class CoursePage:
    """Describe one page of the course.

    Attributes:
        lesson: Its name, such as `03_write_a_publisher`.
        wanted: The cells that wait for an answer, in order.
    """

    lesson: str
    title: str
    wanted: tuple[Wanted, ...]
    ids: frozenset[str]
    cells: tuple[Cell, ...] = ()

    @property
    def number(self) -> str:
        """Return its two digits."""
        return self.lesson[:2]


def course_pages(folder: Path) -> tuple[CoursePage, ...]:
    """Read the course's pages.

    Raises:
        GradingError: If there are none.
    """
    pages = [_page(path) for path in sorted(folder.glob("[0-9][0-9]_*.ipynb"))]
    if not pages:
        raise GradingError(
            f"There are no pages of the course in {folder}.",
            "What was handed in is compared with the pages as learners got them.",
            "Run the command in the folder of the course.",
        )
    return tuple(pages)


def _page(path: Path) -> CoursePage:
    page = read_notebook(path.read_bytes())
    wanted = [Wanted(one.exercise, one.id, one.source) for one in page.cells if one.exercise]
    ids = frozenset(one.id for one in page.cells)
    return CoursePage(path.stem, _title(page), tuple(wanted), ids, page.cells)


def _title(page: Notebook) -> str:
    for cell in page.cells:
        for line in cell.source.splitlines():
            if cell.sort == "markdown" and line.startswith("# "):
                return line.removeprefix("# ").strip()
    return ""


def which_page(found: Notebook, file: str, pages: Iterable[CoursePage]) -> CoursePage | None:
    """Say which page of the course a notebook is, or None if it is none.

    What it is counts more than what it is called: its exercises, its cells, what it says of itself,
    its title, and last of all the name of its file.
    """
    return max(
        (page for page in pages if _points(found, file, page)),
        key=lambda page: _points(found, file, page),
        default=None,
    )


def _points(found: Notebook, file: str, page: CoursePage) -> tuple[int, ...]:
    """Return how much speaks for a page, the strongest first; empty if nothing does."""
    exercises = {one.exercise for one in found.cells} | {one.check for one in found.cells}
    points = (
        len(exercises & {one.exercise for one in page.wanted}),
        len({one.id for one in found.cells} & page.ids),
        int(found.lesson == page.lesson),
        int(bool(page.title) and _title(found) == page.title),
        int(page.lesson in file),
    )
    return points if any(points) else ()

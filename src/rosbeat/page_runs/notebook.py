"""Read a submitted notebook as untrusted input.

Nothing is executed. Of outputs, however large they are, only what a check said of an exercise is
read; of metadata, what identifies the page and the exercise of a cell.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from rosbeat.errors import GradingError
from rosbeat.exercises.cells import checks_in
from rosbeat.exercises.outcome_display import MIME

#: Cells of a notebook that are looked at; a page has fewer than fifty.
MOST_CELLS = 2_000
#: Characters of one cell, and values of a notebook, outputs included: each takes memory when it is
#: parsed. A print loop of 24 MB has three million lines.
MOST_OF_A_CELL, MOST_VALUES = 1_000_000, 10_000_000
#: Outputs of a cell that are looked at.
_MOST_OUTPUTS = 100


@dataclass(frozen=True)
class Cell:
    """Hold one cell.

    Attributes:
        place: Its place on the page, from 0.
        sort: `code`, `markdown` or `raw`.
        id: Its id, or empty.
        exercise: The exercise whose answer it says it is, or empty.
        check: The exercise whose check it says it is, or empty.
        shows: Whether the course marks it as a cell that only shows something.
        stored: What its stored outputs say of exercises: the id and the status of each.
    """

    place: int
    sort: str
    source: str
    id: str = ""
    exercise: str = ""
    check: str = ""
    shows: bool = False
    stored: tuple[tuple[str, str], ...] = ()

    @cached_property
    def checked(self) -> tuple[str, ...]:
        """Return the exercises that it checks, in order."""
        return checks_in(self.source) if self.sort == "code" else ()


@dataclass(frozen=True)
class Notebook:
    """Hold what could be read of a notebook.

    Attributes:
        lesson: The page that it says it is, such as `03_write_a_publisher`; or empty.
        problem: Why nothing could be read, a sentence; or empty.
    """

    cells: tuple[Cell, ...] = ()
    lesson: str = ""
    problem: str = ""


def read_notebook(data: bytes) -> Notebook:
    """Return what can be read of the file; with a `problem` and no cells if nothing can."""
    if not data.strip(b"\0 \t\r\n"):
        return Notebook(problem="The file is empty.")
    if sum(map(data.count, (b",", b"[", b"{"))) > MOST_VALUES:
        return Notebook(problem="The file has millions of values, more than any page.")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return Notebook(problem="The file is not a notebook: it is not UTF-8.")
    try:
        whole = json.loads(text)
    except (ValueError, RecursionError):
        problem = "The file is not a notebook: it is not JSON."
        if text.lstrip()[:1] == "{":
            problem = "The file is not whole: it breaks off, or is damaged somewhere."
        return Notebook(problem=problem)
    if not isinstance(whole, dict) or not isinstance(whole.get("cells"), list):
        return Notebook(problem="The file is JSON, but not a notebook: it has no cells.")
    return _made(whole["cells"], _name(_ours(whole).get("lesson")))


def _ours(of: dict[str, Any]) -> dict[str, Any]:
    """Return what this course wrote into the metadata of a page or of a cell."""
    metadata = of.get("metadata")
    ours = metadata.get("rosbeat") if isinstance(metadata, dict) else None
    return ours if isinstance(ours, dict) else {}


def _made(cells: list[Any], lesson: str) -> Notebook:
    if len(cells) > MOST_CELLS:
        return Notebook((), lesson, f"It has {len(cells)} cells, more than any page.")
    found = [_read_cell(n, one) for n, one in enumerate(cells) if isinstance(one, dict)]
    for one in found:
        if len(one.source) > MOST_OF_A_CELL:
            said = f"Cell {one.place + 1} has {len(one.source)} characters, more than any answer."
            return Notebook((), lesson, said)
    return Notebook(tuple(found), lesson)


def _read_cell(place: int, cell: dict[str, Any]) -> Cell:
    names = _ours(cell)
    sort = cell.get("cell_type")
    return Cell(
        place,
        sort if sort in ("code", "markdown", "raw") else "raw",
        _source(cell.get("source")),
        _name(cell.get("id")),
        _name(names.get("exercise")),
        _name(names.get("check")),
        names.get("shows") is True,
        tuple(_stored(cell.get("outputs"))),
    )


def _stored(outputs: Any) -> Iterator[tuple[str, str]]:  # noqa: ANN401 - unchecked
    """Yield what a check's outcome, as a page stores it, says: the exercise and its status."""
    for output in outputs[:_MOST_OUTPUTS] if isinstance(outputs, list) else ():
        data = output.get("data") if isinstance(output, dict) else None
        outcome = data.get(MIME) if isinstance(data, dict) else None
        if isinstance(outcome, dict):
            yield _name(outcome.get("exercise")), _name(outcome.get("status"))


def _source(value: Any) -> str:  # noqa: ANN401 - unchecked
    if isinstance(value, list):
        return "".join(one for one in value if isinstance(one, str))
    return value if isinstance(value, str) else ""


def _name(value: Any) -> str:  # noqa: ANN401 - unchecked
    return value[:100] if isinstance(value, str) else ""


# The course's own pages.


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
    and last of all the name of its file.
    """
    exercises = {one.exercise for one in found.cells} | {one.check for one in found.cells}
    ids = {one.id for one in found.cells}

    def points(page: CoursePage) -> tuple[int, ...]:
        return (
            len(exercises & {one.exercise for one in page.wanted}),
            len(ids & page.ids),
            int(found.lesson == page.lesson),
            int(page.lesson in file),
        )

    best = max(pages, key=points, default=None)
    return best if best is not None and any(points(best)) else None

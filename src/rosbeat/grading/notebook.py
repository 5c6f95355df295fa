"""A notebook that a stranger has written: read without trust, and mended where that is fair.

Nothing is run and nothing is believed: outputs are never looked at, and of the metadata only what
says which exercise a cell was.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import Any

#: Cells of a notebook that are looked at; a page has fewer than fifty.
MOST_CELLS = 2_000
#: Characters of one cell.
MOST_OF_A_CELL = 100_000


@dataclass(frozen=True)
class Cell:
    """One cell.

    Attributes:
        place: Its place on the page, from 0.
        sort: `code`, `markdown` or `raw`.
        source: Its text.
        id: Its id, or empty.
        exercise: The exercise whose answer it says it is, or empty.
        check: The exercise whose check it says it is, or empty.
    """

    place: int
    sort: str
    source: str
    id: str = ""
    exercise: str = ""
    check: str = ""


@dataclass(frozen=True)
class Notebook:
    """What could be read of a notebook.

    Attributes:
        cells: Its cells, in order.
        lesson: The page that it says it is, such as `03_write_a_publisher`; or empty.
        repairs: What was mended to read it, a sentence each.
        problem: Why nothing could be read, a sentence; or empty.
        cut: Whether the file breaks off, so that there may have been more cells.
    """

    cells: tuple[Cell, ...] = ()
    lesson: str = ""
    repairs: tuple[str, ...] = ()
    problem: str = ""
    cut: bool = False


def read_notebook(data: bytes) -> Notebook:
    """Read a notebook.

    Args:
        data: The file.
    """
    if not data.strip(b"\0 \t\r\n"):
        return Notebook(problem="The file is empty.")
    repairs: list[str] = []
    text = _text(data, repairs)
    try:
        whole = json.loads(text)
    except (ValueError, RecursionError):
        return _salvaged(text, repairs)
    cells = _cells_of(whole, repairs)
    if cells is None:
        return Notebook(problem="The file is JSON, and no notebook: it has no cells.")
    return Notebook(_read_cells(cells, repairs), _lesson(whole), tuple(repairs))


def _lesson(whole: dict[str, Any]) -> str:
    return _name(_ours(whole).get("lesson"))


def _ours(of: dict[str, Any]) -> dict[str, Any]:
    """What this course has written into the metadata of a page or of a cell."""
    metadata = of.get("metadata")
    ours = metadata.get("rosbeat") if isinstance(metadata, dict) else None
    return ours if isinstance(ours, dict) else {}


def _text(data: bytes, repairs: list[str]) -> str:
    for name in ("utf-8-sig", "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"):
        try:
            return data.decode(name)
        except UnicodeDecodeError:
            continue
    repairs.append("Its text is not UTF-8; what cannot be read was replaced.")
    return data.decode("utf-8", "replace")


def _cells_of(whole: Any, repairs: list[str]) -> list[Any] | None:  # noqa: ANN401 - unchecked
    if not isinstance(whole, dict):
        return None
    if isinstance(whole.get("cells"), list):
        found: list[Any] = whole["cells"]
        return found
    sheets = whole.get("worksheets")
    if not isinstance(sheets, list):
        return None
    repairs.append("It was saved in the notebook format 3, and read all the same.")
    sheets = [one for one in sheets if isinstance(one, dict)]
    return [cell for sheet in sheets for cell in sheet.get("cells") or ()]


def _salvaged(text: str, repairs: list[str]) -> Notebook:
    """The whole cells of a file that ends too early, or has been cut or joined somewhere."""
    start = text.find('"cells"')
    opening = text.find("[", start) if start >= 0 else -1
    if opening < 0:
        return Notebook(problem="The file is no notebook: it is not JSON, and has no cells.")
    found = _objects(text, opening + 1)
    if not found:
        return Notebook(problem="The file breaks off before its first cell ends.", cut=True)
    lesson = re.search(r'"lesson":\s*"(\w{1,100})"', text)
    cells = _read_cells(found, repairs)
    return Notebook(cells, lesson[1] if lesson else "", tuple(repairs), cut=True)


def _objects(text: str, place: int) -> list[Any]:
    decoder = json.JSONDecoder()
    found: list[Any] = []
    while len(found) < MOST_CELLS:
        while place < len(text) and text[place] in " \t\r\n,":
            place += 1
        try:
            one, end = decoder.raw_decode(text, place)
        except (ValueError, RecursionError):
            break
        if not isinstance(one, dict):
            break
        found.append(one)
        place = end
    return found


def _read_cells(cells: list[Any], repairs: list[str]) -> tuple[Cell, ...]:
    if len(cells) > MOST_CELLS:
        repairs.append(f"It has {len(cells)} cells; the first {MOST_CELLS} were read.")
    read = [_read_cell(n, one, repairs) for n, one in enumerate(cells[:MOST_CELLS])]
    return tuple(one for one in read if one is not None)


def _read_cell(place: int, cell: Any, repairs: list[str]) -> Cell | None:  # noqa: ANN401
    if not isinstance(cell, dict):
        repairs.append(f"Cell {place + 1} is no cell, and was left out.")
        return None
    source = _source(cell.get("source", cell.get("input", "")))
    if len(source) > MOST_OF_A_CELL:
        repairs.append(f"Cell {place + 1} has {len(source)} characters, and was left out.")
        return None
    names = _ours(cell)
    sort = cell.get("cell_type")
    return Cell(
        place,
        sort if sort in ("code", "markdown", "raw") else "raw",
        source,
        _name(cell.get("id")),
        _name(names.get("exercise")),
        _name(names.get("check")),
    )


def _source(value: Any) -> str:  # noqa: ANN401 - unchecked
    if isinstance(value, list):
        return "".join(one for one in value if isinstance(one, str))
    return value if isinstance(value, str) else ""


def _name(value: Any) -> str:  # noqa: ANN401 - unchecked
    return value[:100] if isinstance(value, str) else ""

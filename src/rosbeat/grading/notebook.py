"""Read a submitted notebook as untrusted input, and repair it where that is fair.

Nothing is executed. Outputs are dropped, however large they are, and the only metadata that is read
identifies the page and the exercise of a cell.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, replace
from typing import Any

#: Cells of a notebook that are looked at; a page has fewer than fifty.
MOST_CELLS = 2_000
#: Characters of one cell, and values of a notebook, outputs included: each takes memory when it is
#: parsed. A print loop of 24 MB has three million lines.
MOST_OF_A_CELL, MOST_VALUES = 1_000_000, 10_000_000


@dataclass(frozen=True)
class Cell:
    """Hold one cell.

    Attributes:
        place: Its place on the page, from 0.
        sort: `code`, `markdown` or `raw`.
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
    """Hold what could be read of a notebook.

    Attributes:
        lesson: The page that it says it is, such as `03_write_a_publisher`; or empty.
        repairs: What was repaired to read it, a sentence each.
        problem: Why nothing could be read, a sentence; or empty.
        cut: Whether the file breaks off, so that there may have been more cells.
    """

    cells: tuple[Cell, ...] = ()
    lesson: str = ""
    repairs: tuple[str, ...] = ()
    problem: str = ""
    cut: bool = False


def read_notebook(data: bytes) -> Notebook:
    """Return what can be read of the file; with a `problem` and no cells if nothing can."""
    if not data.strip(b"\0 \t\r\n"):
        return Notebook(problem="The file is empty.")
    if sum(map(data.count, (b",", b"[", b"{"))) > MOST_VALUES:
        return Notebook(problem="The file has millions of values, more than any page.")
    repairs: list[str] = []
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("utf-8", "replace")
        repairs.append("Its text is not UTF-8; what cannot be read was replaced.")
    try:
        whole = json.loads(text)
    except (ValueError, RecursionError):
        return _salvaged(text, repairs)
    if not isinstance(whole, dict) or not isinstance(whole.get("cells"), list):
        return Notebook(problem="The file is JSON, but not a notebook: it has no cells.")
    return _made(whole["cells"], _name(_ours(whole).get("lesson")), repairs)


def _ours(of: dict[str, Any]) -> dict[str, Any]:
    """Return what this course wrote into the metadata of a page or of a cell."""
    metadata = of.get("metadata")
    ours = metadata.get("rosbeat") if isinstance(metadata, dict) else None
    return ours if isinstance(ours, dict) else {}


def _salvaged(text: str, repairs: list[str]) -> Notebook:
    """Return the whole cells of a file that ends too early or is damaged somewhere."""
    start = text.find('"cells"')
    opening = text.find("[", start) if start >= 0 else -1
    if opening < 0:
        return Notebook(problem="The file is not a notebook: it is not JSON, and has no cells.")
    found = _objects(text, opening + 1)
    if not found:
        return Notebook(problem="The file breaks off before its first cell ends.", cut=True)
    lesson = re.search(r'"lesson":\s*"(\w{1,100})"', text)
    return replace(_made(found, lesson[1] if lesson else "", repairs), cut=True)


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


def _made(cells: list[Any], lesson: str, repairs: list[str]) -> Notebook:
    if len(cells) > MOST_CELLS:
        repairs.append(f"It has {len(cells)} cells; the first {MOST_CELLS} were read.")
    read = [_read_cell(n, one, repairs) for n, one in enumerate(cells[:MOST_CELLS])]
    found = tuple(one for one in read if one is not None)
    for one in found:
        if len(one.source) > MOST_OF_A_CELL:
            said = f"Cell {one.place + 1} has {len(one.source)} characters, more than any answer."
            return Notebook((), lesson, problem=said)
    return Notebook(found, lesson, tuple(repairs))


def _read_cell(place: int, cell: Any, repairs: list[str]) -> Cell | None:  # noqa: ANN401
    if not isinstance(cell, dict):
        repairs.append(f"Cell {place + 1} is not a cell, and was left out.")
        return None
    names = _ours(cell)
    sort = cell.get("cell_type")
    return Cell(
        place,
        sort if sort in ("code", "markdown", "raw") else "raw",
        _source(cell.get("source")),
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

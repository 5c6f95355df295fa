"""Read a submitted notebook as untrusted input, and repair it where that is fair.

Nothing is executed. Outputs are dropped before anything else, however large they are, and the only
metadata that is read identifies the page and the exercise of a cell.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, replace
from typing import Any

#: Cells of a notebook that are looked at; a page has fewer than fifty.
MOST_CELLS = 2_000
#: Characters of one cell, and bytes of a notebook without its outputs.
MOST_OF_A_CELL, MOST_BYTES = 1_000_000, 10_000_000
#: Bytes from which on outputs are cut out of the text; what is smaller is parsed with them.
_LARGE = 2_000_000
#: What is cut out: outputs, pasted pictures, and the state of widgets, which may show outputs.
_DROPPED = re.compile(rb'"(?:outputs|attachments|widgets)"\s*:\s*[\[{]')
_TOKEN = re.compile(rb'"[^"]*"|[\[\]{}]')


@dataclass(frozen=True)
class Cell:
    """Hold one cell.

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
    """Hold what could be read of a notebook.

    Attributes:
        cells: Its cells, in order.
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
    """Read a notebook.

    Args:
        data: The file.

    Returns:
        The notebook; one with a `problem` and no cells if nothing can be read.
    """
    if not data.strip(b"\0 \t\r\n"):
        return Notebook(problem="The file is empty.")
    if len(data) > _LARGE:
        data = without_outputs(data)
    if len(data) > MOST_BYTES:
        size = f"{len(data) / 1e6:.0f} MB"
        return Notebook(problem=f"The file has {size} without its outputs, more than any page.")
    repairs: list[str] = []
    text = _text(data, repairs)
    try:
        whole = json.loads(text)
    except (ValueError, RecursionError):
        return _salvaged(text, repairs)
    cells = _cells_of(whole)
    if cells is None:
        return Notebook(problem="The file is JSON, but not a notebook: it has no cells.")
    if "cells" not in whole:
        repairs.append("It was saved in notebook format 3, and was read as such.")
    return _made(cells, _lesson(whole), repairs)


def without_outputs(data: bytes) -> bytes:
    """Return a notebook's text without outputs, attachments and the state of widgets.

    The text is not parsed: that of a print loop can have 20 MB in two million lines.

    Args:
        data: JSON in an encoding that contains ASCII. Anything else comes back as it is, or cut
            in a place where it cannot be read anyway.
    """
    # Escaped backslashes and quotation marks are blanked: every other one is a delimiter then, and
    # what looks like a key inside a string does not any more.
    plain = data.replace(rb"\\", b"  ").replace(rb"\"", b"  ")
    kept: list[bytes] = []
    start = 0
    while found := _DROPPED.search(plain, start):
        kept.append(data[start : found.end()])
        start = _closing(plain, found.end())
    return b"".join((*kept, data[start:]))


def _closing(text: bytes, place: int) -> int:
    """Return where the bracket that is open at a place is closed; the end if it is not."""
    depth = 1
    for token in _TOKEN.finditer(text, place):
        if token[0] in (b"[", b"{"):
            depth += 1
        elif token[0] in (b"]", b"}"):
            depth -= 1
            if depth == 0:
                return token.start()
    return len(text)


def _lesson(whole: dict[str, Any]) -> str:
    return _name(_ours(whole).get("lesson"))


def _ours(of: dict[str, Any]) -> dict[str, Any]:
    """Return what this course wrote into the metadata of a page or of a cell."""
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


def _cells_of(whole: Any) -> list[Any] | None:  # noqa: ANN401 - unchecked
    if not isinstance(whole, dict):
        return None
    if isinstance(whole.get("cells"), list):
        found: list[Any] = whole["cells"]
        return found
    sheets = whole.get("worksheets")  # notebook format 3
    if not isinstance(sheets, list):
        return None
    lists = [one.get("cells") for one in sheets if isinstance(one, dict)]
    return [cell for cells in lists if isinstance(cells, list) for cell in cells]


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
        _source(cell.get("source", cell.get("input", ""))),
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

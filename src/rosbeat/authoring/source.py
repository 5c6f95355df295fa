"""A lesson source: jupytext's percent format, read into plain data."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jupytext

from rosbeat.authoring.cell_magics import SAVE, read_magic
from rosbeat.authoring.header import Header, split_header
from rosbeat.authoring.identity import cell_ids
from rosbeat.errors import LessonError

_FILE_NAME = re.compile(r"\d\d_[a-z0-9]+(_[a-z0-9]+)*\.py")
_MARKER = re.compile(r"# ?%%(\s|$)")
_KNOWN_KEYS = {"exercise", "check", "only", "predict", "tags", "terminal", "save"}
# jupytext would take `# ls` for a magic, and its comment sign away.
_FORMAT = {"extension": ".py", "format_name": "percent", "comment_magics": False}
_TREES = (None, "notebook", "solution")
# jupytext's note to itself about blank lines; it says nothing about the cell.
_JUPYTEXT_KEYS = {"lines_to_next_cell", "lines_to_end_of_cell_marker"}


@dataclass(frozen=True)
class SourceCell:
    """One cell of a lesson source, answer markers included.

    Attributes:
        id: The cell's id, the same in both trees.
        kind: ``"code"`` or ``"markdown"``.
        source: The text, with answers, blanks and their markers.
        line: The line of the source file on which the text begins.
        magic: The IPython magic that stands above the text on the page, or an empty text.
        exercise: The id of the exercise that is solved here, such as ``"03a"``.
        check: The id of the exercise that is checked here.
        only: ``"notebook"`` or ``"solution"`` if the cell appears in one tree only.
        tags: Jupyter's cell tags.
        predict: Whether a prediction is made here, which is compared with what the cell does.
    """

    id: str
    kind: str
    source: str
    line: int
    exercise: str | None = None
    check: str | None = None
    only: str | None = None
    tags: tuple[str, ...] = ()
    predict: bool = False
    magic: str = ""

    @property
    def page_text(self) -> str:
        """What the cell holds on a page, answer markers still included."""
        return f"{self.magic}\n{self.source}".strip("\n") if self.magic else self.source

    @property
    def saved_as(self) -> str:
        """The file of the workspace that this cell becomes, or an empty text."""
        return self.magic.removeprefix(SAVE) if self.magic.startswith(SAVE) else ""

    @property
    def is_python(self) -> bool:
        """Whether the text is Python: not commands for a terminal, not a file of another kind."""
        return self.kind == "code" and (not self.magic or Path(self.saved_as).suffix == ".py")

    @property
    def runs(self) -> bool:
        """Whether the kernel runs the text; of a saved file only if it is a module of a package."""
        return self.is_python and Path(self.saved_as).name != "setup.py"


@dataclass(frozen=True)
class Lesson:
    """A lesson source, read.

    Attributes:
        path: The source file.
        header: What the lesson says about itself.
        cells: Its cells, in order.
    """

    path: Path
    header: Header
    cells: tuple[SourceCell, ...]

    @property
    def name(self) -> str:
        """The stem of the file name, such as ``03_write_a_publisher``."""
        return self.path.stem

    @property
    def number(self) -> str:
        """The page's number, two digits."""
        return self.path.name[:2]


def read_lesson(path: Path) -> Lesson:
    """Read one lesson source.

    Args:
        path: A file named ``NN_slug.py``.

    Raises:
        LessonError: The name, the header or a cell breaks the format.
    """
    if not _FILE_NAME.fullmatch(path.name):
        what = f"{path.name}: a lesson is named NN_slug.py, in lower case."
        raise LessonError(what, "The number orders the pages.", "Rename it, as 03_write_nodes.py.")
    header, body, offset = split_header(path.read_text(encoding="utf-8"), path.name)
    lines = [n for n, text in enumerate(body.splitlines(), offset + 1) if _MARKER.match(text)]
    raw = jupytext.reads(body, fmt=_FORMAT).cells
    if len(raw) != len(lines) or not _MARKER.match(body):
        raise LessonError(
            f"{path.name}: {len(lines)} lines begin a cell, but jupytext sees {len(raw)} cells.",
            "Text stands before the first cell, or '# %%' or '# In[' stands inside a cell.",
            "Begin the text with '# %%', and use that at the start of a line for nothing else.",
        )
    rows = [_row(cell, line, path.name) for cell, line in zip(raw, lines, strict=True)]
    ids = cell_ids([_opening(row) for row in rows])
    cells = tuple(SourceCell(id=i, **row) for i, row in zip(ids, rows, strict=True))
    return Lesson(path, header, cells)


def _row(cell: Any, line: int, name: str) -> dict[str, Any]:  # noqa: ANN401 - untyped library
    metadata = {k: v for k, v in cell.metadata.items() if k not in _JUPYTEXT_KEYS}
    _refuse_unknown(cell.cell_type, metadata, f"{name}:{line}")
    blank = len(cell.source) - len(cell.source.lstrip("\n"))
    text, magic = read_magic(cell.source.strip("\n"), metadata, f"{name}:{line}")
    return {
        "kind": cell.cell_type,
        "source": text,
        "magic": magic,
        "line": line + 1 + blank,
        "exercise": metadata.get("exercise"),
        "check": metadata.get("check"),
        "only": metadata.get("only"),
        "tags": tuple(metadata.get("tags", ())),
        "predict": metadata.get("predict", False),
    }


def _opening(row: dict[str, Any]) -> tuple[str, str, str | None, str | None]:
    # Many cells begin with the same magic; what tells them apart is the line below it.
    text = f"{row['magic']} {row['source']}" if row["magic"] else row["source"]
    return row["kind"], text, row["exercise"], row["check"]


def _refuse_unknown(kind: str, metadata: dict[str, Any], where: str) -> None:
    unknown = sorted(set(metadata) - _KNOWN_KEYS)
    if kind not in ("code", "markdown"):
        raise LessonError(f"{where}: a page has no cells of the kind {kind!r}.")
    if unknown:
        raise LessonError(
            f"{where}: a cell marker does not know {', '.join(map(repr, unknown))}.",
            "Only what a page needs is kept, so that pages stay the same from build to build.",
            f"Use {', '.join(f'{key}=' for key in sorted(_KNOWN_KEYS))}; "
            "for prose write '# %% [markdown]'.",
        )
    if metadata.get("only") not in _TREES:
        what = f"{where}: only= is {metadata['only']!r}."
        raise LessonError(what, "", 'Write only="notebook" or only="solution".')
    if metadata.get("predict", True) is not True:
        what = f"{where}: predict= is {metadata['predict']!r}."
        raise LessonError(what, "", "Write predict=true, or leave it out.")

"""Outputs that could not be the same next time are refused here, not discovered by nbval later."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from nbformat import NotebookNode

from rosbeat.authoring.transforms.uncompared import UNCOMPARED
from rosbeat.errors import LessonError

_ADDRESS = re.compile(r"\b0x[0-9a-f]{6,}\b")
_COLOUR = re.compile(r"\x1b\[")


def refuse_unrepeatable(page: NotebookNode) -> NotebookNode:
    """Return the page if its outputs name no address, no folder of this machine and no colour.

    Raises:
        LessonError: A text output holds one of them.
    """
    for cell in page.cells:
        if cell.cell_type == "code" and UNCOMPARED not in cell.metadata.get("tags", ()):
            for text in output_texts(cell):
                _refuse(page, cell, text)
    return page


def output_texts(cell: Any) -> Iterator[str]:  # noqa: ANN401 - untyped library
    """Yield every text that a code cell's outputs show."""
    for output in cell.outputs:
        yield output.get("text", "")
        yield output.get("evalue", "")
        yield output.get("data", {}).get("text/plain", "")


def _refuse(page: NotebookNode, cell: Any, text: str) -> None:  # noqa: ANN401 - untyped library
    for line in text.splitlines():
        reason = _reason(line)
        if reason:
            where = f"{page.metadata.rosbeat.lesson}.py:{cell.metadata.line}"
            raise LessonError(
                f"{where}: the output shows {reason}: {line.strip()!r}.",
                "The page would be different on the next run or the next machine.",
                "Print a value instead of an object, or a path relative to the page.",
            )


def _reason(line: str) -> str | None:
    if _ADDRESS.search(line):
        return "a memory address"
    if _COLOUR.search(line):
        return "a terminal colour"
    if any(folder in line for folder in _folders()):
        return "a folder of this machine"
    return None


def _folders() -> list[str]:
    here = {str(Path.home()), os.getcwd(), tempfile.gettempdir()}
    return [folder + "/" for folder in here if folder not in ("/", "")]

"""Outputs that differ from run to run stay as they were, so that a rebuild changes nothing.

What two processes really say to each other cannot come out the same twice: which random number
comes first depends on when the second process is there. Such a cell is tagged, nothing compares
its output, another cell asserts what matters in it, and the page keeps the output it has.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode

from rosbeat.authoring.transforms import Transform

#: nbval's tag for a cell whose output is stored and not compared.
UNCOMPARED = "nbval-ignore-output"


def keep_uncompared(path: Path) -> Transform:
    """Make the step that takes outputs of tagged cells from the page that is there already.

    Args:
        path: The page; it need not exist, nor be readable.
    """

    def keep(page: NotebookNode) -> NotebookNode:
        before = _outputs(path)
        for cell in page.cells:
            kept = before.get((cell.id, cell.source)) if _is_tagged(cell) else None
            if kept and _kinds(kept) == _kinds(cell.outputs):
                cell.outputs = kept
        return page

    return keep


def _outputs(path: Path) -> dict[tuple[str, str], list[Any]]:
    try:
        page = nbformat.read(path, as_version=4)
    except Exception:  # whatever the file is, it holds nothing to keep
        return {}
    return {(cell.id, cell.source): cell.outputs for cell in page.cells if _is_tagged(cell)}


def _is_tagged(cell: Any) -> bool:  # noqa: ANN401 - untyped library
    return cell.cell_type == "code" and UNCOMPARED in cell.metadata.get("tags", ())


def _kinds(outputs: list[Any]) -> list[str]:
    return [output.output_type for output in outputs]

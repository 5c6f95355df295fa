"""A learner's work is never lost: a page that was worked in is kept before it is replaced."""

from __future__ import annotations

import shutil
from pathlib import Path

import nbformat

#: Where kept pages go, beside the page; git ignores it and no test runs it.
KEPT = "kept"


def keep_work(path: Path) -> Path | None:
    """Copy a page aside if somebody has worked in it.

    The builder writes pages for learners without outputs and execution counts. So a page that has
    any was run, and may hold answers.

    Args:
        path: A page of the learners' tree.

    Returns:
        The copy, or nothing if there was no work to keep.
    """
    if not path.exists() or not was_worked_in(path):
        return None
    folder = path.parent / KEPT
    folder.mkdir(exist_ok=True)
    copy = next(
        place
        for number in range(1, 1_000_000)
        if not (place := folder / f"{path.stem}-{number}.ipynb").exists()
    )
    shutil.copy2(path, copy)
    return copy


def was_worked_in(path: Path) -> bool:
    """Whether a page was run, or is no readable notebook any more (then better keep it)."""
    try:
        page = nbformat.read(path, as_version=4)
    except Exception:  # whatever the file is now, it is not what the builder wrote
        return True
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    return any(cell.outputs or cell.execution_count is not None for cell in code)

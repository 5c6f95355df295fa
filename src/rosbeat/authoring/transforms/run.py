"""The page gets its outputs."""

from __future__ import annotations

from pathlib import Path

from nbformat import NotebookNode

from rosbeat.authoring.execution import Deadlines, run_page
from rosbeat.authoring.transforms import Transform


def run_in(folder: Path, deadlines: Deadlines | None = None) -> Transform:
    """Make the step that runs a page in a fresh kernel.

    Args:
        folder: The kernel's current directory; it is made if it does not exist.
        deadlines: How long a page may take.
    """

    def run(page: NotebookNode) -> NotebookNode:
        folder.mkdir(parents=True, exist_ok=True)
        run_page(page, folder, deadlines)
        return page

    return run

"""Cells that belong to one tree only."""

from __future__ import annotations

from nbformat import NotebookNode

from rosbeat.authoring.transforms import Transform


def keep_cells_of(tree: str) -> Transform:
    """Make the step that drops cells meant for the other tree.

    Args:
        tree: ``"notebook"`` or ``"solution"``.
    """

    def keep(page: NotebookNode) -> NotebookNode:
        page.cells = [cell for cell in page.cells if cell.metadata.only in (None, tree)]
        return page

    return keep

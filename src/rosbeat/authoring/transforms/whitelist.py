"""Only what a page needs is written."""

from __future__ import annotations

from typing import Any

from nbformat import NotebookNode

_PAGE = ("kernelspec", "language_info", "title", "rosbeat")
_CELL = ("nbgrader", "rosbeat", "tags")


def keep_known_metadata(page: NotebookNode) -> NotebookNode:
    """Drop metadata that Jupyter, nbclient or the builder added on the way.

    Versions of Python, times of execution and editors' notes would change from build to build.
    """
    page.metadata = _only(page.metadata, _PAGE)
    page.metadata.language_info = {"name": "python"}
    for cell in page.cells:
        cell.metadata = _only(cell.metadata, _CELL)
        for output in cell.get("outputs", ()):
            if "metadata" in output:
                output.metadata = NotebookNode()
    return page


def _only(metadata: Any, names: tuple[str, ...]) -> NotebookNode:  # noqa: ANN401 - untyped
    return NotebookNode({name: metadata[name] for name in names if name in metadata})

"""The steps from a lesson source to a page, one per module; `pages` composes them in lists."""

from __future__ import annotations

from collections.abc import Callable

from nbformat import NotebookNode

Transform = Callable[[NotebookNode], NotebookNode]
"""Takes a page, changes it, and returns it."""

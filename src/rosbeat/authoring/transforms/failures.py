"""Errors that a page shows on purpose, without the machine they happened on."""

from __future__ import annotations

import re

from nbformat import NotebookNode

_CELL_FILE = re.compile(r"[^\s\"'(]*ipykernel_\d+[^\s\"')]*\.py|(?<=\()\d+\.py(?=, line)")
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")


def quiet_failures(page: NotebookNode) -> NotebookNode:
    """Reduce every traceback to the error's name and message.

    Frames name files of the machine and lines of the Python version that built the page.
    """
    for cell in page.cells:
        for output in cell.get("outputs", ()):
            if output.output_type == "error":
                output.evalue = quiet_message(output.evalue)
                output.traceback = f"{output.ename}: {output.evalue}".split("\n")
    return page


def quiet_message(message: str) -> str:
    """Replace the names of a kernel's temporary files, and drop colours.

    Args:
        message: An exception's text.
    """
    return _CELL_FILE.sub("cell", _COLOUR.sub("", message))

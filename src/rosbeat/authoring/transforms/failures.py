"""Errors that a page shows on purpose, without the machine they happened on."""

from __future__ import annotations

import re

from nbformat import NotebookNode

_CELL_FILE = re.compile(r"[^\s\"'(]*ipykernel_\d+[^\s\"')]*\.py|(?<=\()\d+\.py(?=, line)")
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
#: A frame of an installed library, with its line of code; and what marks a part of a line.
_LIBRARY_FRAME = re.compile(r'(?m)^  File "[^"\n]*site-packages[^"\n]*", line .*\n(?:    .*\n)*')
_MARKS = re.compile(r"(?m)^    [ ^~]*[\^~][ ^~]*\n")


def quiet_failures(page: NotebookNode) -> NotebookNode:
    """Reduce every traceback to the error's name and message.

    Frames name files of the machine and lines of the Python version that built the page. Of one
    that a simulated program printed, the learner's own lines stay.
    """
    for cell in page.cells:
        for output in cell.get("outputs", ()):
            if output.output_type == "error":
                output.evalue = quiet_message(output.evalue)
                output.traceback = f"{output.ename}: {output.evalue}".split("\n")
            elif output.output_type == "stream" and output.name == "stderr":
                output.text = quiet_traceback(output.text)
    return page


def quiet_message(message: str) -> str:
    """Replace the names of a kernel's temporary files, and drop colours.

    Args:
        message: An exception's text.
    """
    return _CELL_FILE.sub("cell", _COLOUR.sub("", message))


def quiet_traceback(printed: str) -> str:
    """Leave the learner's own frames in tracebacks that a program printed, without files.

    The frames of libraries are other ones in another version, and so are the marks below a line.

    Args:
        printed: What the program wrote to standard error.
    """
    return quiet_message(_MARKS.sub("", _LIBRARY_FRAME.sub("", printed)))

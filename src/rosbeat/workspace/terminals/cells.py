"""From the text of a cell to the lines that are typed."""

from __future__ import annotations

import re

from rosbeat.workspace.terminals import refusals

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")
_BLANK = re.compile(r"(?<!\w)____(?!\w)")


def lines_of(cell: str) -> list[str]:
    """Return the lines to type, without blank ones at the end.

    Args:
        cell: The cell below its magic.

    Raises:
        TerminalError: If there is a key among them.
    """
    cell = cell.replace("\r\n", "\n")
    key = _CONTROL.search(cell)
    if key:
        raise refusals.odd_character(key[0])
    return cell.rstrip().split("\n")


def line_with_blank(lines: list[str]) -> int:
    """Return the line of a cell, its magic counted, in which something is to be filled in; or 0.

    Args:
        lines: The lines below the magic.
    """
    return next((number for number, line in enumerate(lines, 2) if _BLANK.search(line)), 0)

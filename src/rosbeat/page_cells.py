"""Find the cell of a page that defines a name, in the page's file.

The kernel knows the file (`workspace.location.page_file`), and a front end sends the id of the cell
that runs. So a name that is missing, as all are when a kernel has started anew, leads to its cell.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from textwrap import shorten
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from IPython import get_ipython

from rosbeat.page_names import names_bound
from rosbeat.workspace.location import page_file

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

#: Characters of a cell's first line that are shown.
_LONGEST = 60
_HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.MULTILINE)
#: A file of Python that a cell saves, and runs on the page.
_SAVED = re.compile(r"%%save .*\n")
_UNKNOWN = re.compile(r"NameError: name '(\w+)' is not defined")
#: The cells that the running one links to when it has ended.
_LINKED: set[str] = set()


@dataclass(frozen=True)
class PageCell:
    """Hold where a cell of the page is.

    Attributes:
        id: The cell's id, which links lead to.
        text: What the cell has in it.
        heading: The heading that it is under, or an empty text.
        is_above: Whether it is above the cell that runs.
    """

    id: str
    text: str
    heading: str
    is_above: bool

    def __str__(self) -> str:
        lines = [line.strip() for line in self.text.split("\n")]
        first = next((line for line in lines if line and not line.startswith("#")), "")
        under = f', under the heading "{self.heading}"' if self.heading else ""
        return f"that begins with `{shorten(first, _LONGEST, placeholder=' ...')}`{under}"


def cell_that_defines(shell: InteractiveShell, name: str) -> PageCell | None:
    """Return the cell that defines a name for the cell that runs; None if the page's file has none.

    It is the nearest one above, or else the first one below.

    Args:
        shell: The page's shell.
        name: The name.
    """
    running = _running(shell)
    above: list[PageCell] = []
    below: list[PageCell] = []
    heading, is_above = "", True
    for cell in _saved_cells():
        text = cell.get("source", "")
        text = text if isinstance(text, str) else "".join(text)
        is_above = is_above and cell.get("id") != running
        if cell.get("cell_type") == "markdown":
            heading = [heading, *_HEADING.findall(text)][-1]
        elif cell.get("id") != running and name in _names(shell, text):
            known = above if is_above else below
            known.append(PageCell(str(cell.get("id", "")), text, heading, is_above))
    if is_above:  # the cell that runs is not in the file, so nobody knows what is above it
        return None
    return next(iter([*above[-1:], *below]), None)


def cell_to_run(error: str) -> PageCell | None:
    """Return the cell above that has to run before the name exists that an error is about.

    Args:
        error: Kind and text of an exception, such as `NameError: name 'String' is not defined`.

    Returns:
        None if it is about something else, or if the page has no such cell.
    """
    found, shell = _UNKNOWN.match(error), get_ipython()
    if found is None or shell is None or found[1] in shell.user_ns:
        return None
    cell = cell_that_defines(shell, found[1])
    return cell if cell is not None and cell.is_above else None


def link_below(cell: PageCell) -> None:
    """Link to a cell below all that the running one shows; several links to a cell are one.

    Args:
        cell: The cell.
    """
    if not cell.id or cell.id in _LINKED:
        return
    shell = get_ipython()
    _LINKED.add(cell.id)

    def show(_: object) -> None:
        shell.events.unregister("post_run_cell", show)
        _LINKED.discard(cell.id)
        shell.display_pub.publish({"text/html": link_to(cell), "text/plain": ""})

    shell.events.register("post_run_cell", show)


def link_to(cell: PageCell) -> str:
    """Return a link to a cell, as HTML; JupyterLab scrolls to it.

    Args:
        cell: The cell.
    """
    target = f"{quote(page_file().name)}#cell-id={quote(cell.id)}"
    return f'<a href="{escape(target)}">Go to that cell</a>'


def _running(shell: InteractiveShell) -> str:
    """Return the id of the cell that runs; an empty text if the front end has sent none."""
    parent: Mapping[str, Any] = getattr(shell, "get_parent", dict)() or {}
    return str((parent.get("metadata") or {}).get("cellId") or "")


def _saved_cells() -> Sequence[Mapping[str, Any]]:
    try:
        page = json.loads(page_file().read_text(encoding="utf-8"))
        return [cell for cell in page["cells"] if isinstance(cell, dict)]
    except (OSError, ValueError, TypeError, KeyError):
        return []  # no notebook, or one that is being written


def _names(shell: InteractiveShell, text: str) -> frozenset[str]:
    text = _SAVED.sub("", text, count=1) if text.startswith("%%save") else text
    return frozenset() if text.startswith("%%") else names_bound(shell.transform_cell(text))

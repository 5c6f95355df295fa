"""Pages run in any order: what earlier ones make and is missing is made, and said."""

from __future__ import annotations

import re
from pathlib import Path

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.place import workspace
from rosbeat.workspace.reports import Report
from rosbeat.workspace.stages import STAGES, InTheWay
from rosbeat.workspace.troubles import trouble

_PAGE = re.compile(r"(\d{1,2})(_\w*)?(\.ipynb)?")


def catch_up(page: str, root: Path | None = None) -> Report:
    """Make what the pages before this one leave in the workspace, as far as it is missing.

    What is there stays as it is. Only a `setup.py` without any entry point gets the two of the
    course, and the version before is kept.

    Args:
        page: The number of the page that needs it, as in `"05"`.
        root: The workspace, by default the learner's.

    Returns:
        What was made, and what stands in the way.

    Raises:
        WorkspaceError: If there is no such page, or the workspace cannot be written.
    """
    number = _number(page)
    base = root or workspace()
    try:
        base.mkdir(parents=True, exist_ok=True)
        return _through(number, base.resolve())
    except OSError as error:
        raise trouble("The workspace cannot be completed", error) from None


def _through(number: int, root: Path) -> Report:
    made: list[str] = []
    for page, stage in STAGES:
        if int(page) >= number:
            break
        try:
            made += filter(None, [stage(root)])
        except InTheWay as error:
            return Report(tuple(made), (str(error),))
    return Report(tuple(made))


def _number(page: str) -> int:
    found = _PAGE.fullmatch(str(page).strip())
    if not found:
        raise WorkspaceError(
            f"There is no page {page!r}.",
            "catch_up makes what the pages before a certain page make.",
            'Name the page by its number:  workspace.catch_up("05")',
        )
    return int(found[1])

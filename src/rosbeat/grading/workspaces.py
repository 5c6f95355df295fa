"""The workspace as a page finds it, to be put into a sandbox."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from rosbeat.errors import GradingError
from rosbeat.workspace.catching_up import catch_up


@cache
def files_before(page: str) -> Mapping[str, bytes]:
    """Make what the pages before this one leave, somewhere else, and read it.

    Args:
        page: The page's number, such as `05`.

    Returns:
        Content by path in the workspace; a folder's path ends with `/` and has none. It is made
        once in a process.

    Raises:
        GradingError: If it cannot be made on this machine.
    """
    with tempfile.TemporaryDirectory(prefix="rosbeat-") as root:
        report = catch_up(page, Path(root))
        if report.attention:
            raise GradingError(
                f"The workspace of page {page} cannot be made: {report.attention[0]}",
                "Exercises of that page are about what is typed in it.",
                "`course doctor` says what this computer lacks.",
            )
        found = sorted(Path(root).rglob("*"))
        return MappingProxyType(dict(_entry(path, Path(root)) for path in found))


def _entry(path: Path, root: Path) -> tuple[str, bytes]:
    name = path.relative_to(root).as_posix()
    return (f"{name}/", b"") if path.is_dir() else (name, path.read_bytes())

"""The workspace as a page finds it, to be put into a sandbox.

What makes it starts programs, which a prepared process cannot (see `sandbox.sandboxes`). So it is
made outside and sent there, a line of JSON for each page.
"""

from __future__ import annotations

import json
import tempfile
import threading
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from rosbeat.errors import GradingError
from rosbeat.workspace.catching_up import catch_up

_ONE_AT_A_TIME = threading.Lock()
_WORKSPACE, _FILES = "workspace", "files"


def workspace_line(page: str) -> str:
    """What the pages before one leave, as a line; threads that want the same wait for each other.

    Args:
        page: The page's number, such as `05`.

    Raises:
        GradingError: If it cannot be made on this machine.
    """
    with _ONE_AT_A_TIME:
        files = files_before(page)
    content = {name: data.decode("latin-1") for name, data in files.items()}
    return json.dumps({_WORKSPACE: page, _FILES: content})


def read_workspace(line: str) -> tuple[str, Mapping[str, bytes]] | None:
    """Read such a line: the page, and content by path; None if it is another one.

    Args:
        line: What comes from the process that has made it.
    """
    if not line.startswith(f'{{"{_WORKSPACE}": '):
        return None
    said = json.loads(line)
    return said[_WORKSPACE], {name: one.encode("latin-1") for name, one in said[_FILES].items()}


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

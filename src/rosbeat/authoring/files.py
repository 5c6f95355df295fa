"""Pages on disk: compared, written whole or not at all, removed only if they are ours."""

from __future__ import annotations

import difflib
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

import nbformat

from rosbeat.authoring.opened import only_opened
from rosbeat.authoring.pictures import without_pictures

_DIFF_LINES = 40
_LONGEST_LINE = 160


@dataclass(frozen=True)
class Change:
    """How a page on disk differs from what its source says.

    Attributes:
        path: The page.
        kind: ``"new"``, ``"changed"`` or ``"stale"``; ``"pictures"`` if only they differ, and
            ``"opened"`` if a learner's page was opened or run, and says what it said before.
        diff: The first lines of a unified diff.
    """

    path: Path
    kind: str
    diff: str = ""

    @property
    def matters(self) -> bool:
        """Whether the page says something else, not only looks different."""
        return self.kind not in ("pictures", "opened")


def compare(path: Path, content: bytes) -> Change | None:
    """Compare a page on disk with what it should be.

    Args:
        path: The page.
        content: What it should be.

    Returns:
        What differs, or nothing.
    """
    if not path.exists():
        return Change(path, "new")
    present = path.read_bytes()
    if present == content:
        return None
    if only_opened(present, content):
        return Change(path, "opened")
    old, new = without_pictures(present), without_pictures(content)
    return Change(path, "pictures") if old == new else Change(path, "changed", _diff(old, new))


def write(path: Path, content: bytes) -> None:
    """Replace a file in one step, so that nobody ever reads half of it.

    Args:
        path: The file; its folder is made if it does not exist.
        content: All of its bytes.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        # mkstemp makes files private; a page is readable like every other file of the checkout.
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def stale_pages(folder: Path, names: set[str]) -> list[Path]:
    """Find pages that the builder wrote and whose lesson is gone.

    Args:
        folder: A tree of pages.
        names: The names of the lessons that exist.
    """
    pages = sorted(folder.glob("*.ipynb"))
    return [page for page in pages if page.stem not in names and _is_ours(page)]


def _is_ours(path: Path) -> bool:
    try:
        page = nbformat.read(path, as_version=4)
    except (nbformat.reader.NotJSONError, UnicodeDecodeError):
        return False
    return bool(page.metadata.get("rosbeat", {}).get("lesson") == path.stem)


def _diff(present: bytes, content: bytes) -> str:
    old, new = (text.decode("utf-8", "replace").splitlines() for text in (present, content))
    lines = list(difflib.unified_diff(old, new, "on disk", "from source", n=1, lineterm=""))
    shown = [line[:_LONGEST_LINE] for line in lines[:_DIFF_LINES]]
    hidden = len(lines) - len(shown)
    return "\n".join([*shown, f"... {hidden} more lines"] if hidden else shown)

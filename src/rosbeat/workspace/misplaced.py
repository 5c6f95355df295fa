"""Where in the workspace a file of a package belongs, if its path misses a folder."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.stages import PACKAGE

#: Files of Python that lie beside the folder with the modules.
_BESIDE = ("setup.py", "conftest.py")


def refuse_other_place(relative: PurePosixPath, root: Path) -> None:
    """Refuse a path that leads beside a package instead of into it.

    Args:
        relative: The file, relative to the workspace.
        root: The workspace.

    Raises:
        WorkspaceError: If a folder is left out. It names the path that was meant.
    """
    meant = _meant(relative, root)
    if meant and not (root / relative).exists():
        raise WorkspaceError(
            f"{relative} is not saved: that is not where a package has its files.",
            "Packages lie in src, and the modules of one in a second folder of the same name.",
            f"Did you mean {meant}?",
        )


def _meant(relative: PurePosixPath, root: Path) -> PurePosixPath | None:
    parts = relative.parts
    if parts[0] == "src":
        return _inner(parts[1:], root)
    known = parts[0] == PACKAGE or (root / "src" / parts[0] / "package.xml").is_file()
    if len(parts) < 2 or not known or (root / parts[0]).exists():
        return None
    return _inner(parts, root) or PurePosixPath("src", *parts)


def _inner(parts: tuple[str, ...], root: Path) -> PurePosixPath | None:
    """The path of a module that was put beside the folder with the modules."""
    if len(parts) != 2 or not parts[1].endswith(".py") or parts[1] in _BESIDE:
        return None
    package = parts[0]
    if package != PACKAGE and not (root / "src" / package / package).is_dir():
        return None
    return PurePosixPath("src", package, package, parts[1])

"""`%%save PATH`: a cell becomes a file of the workspace, and a module runs on the page as well."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath
from typing import Any

from IPython.core.magic import no_var_expand

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.catching_up import catch_up
from rosbeat.workspace.locating import locate, nearest
from rosbeat.workspace.misplaced import refuse_other_place
from rosbeat.workspace.modules import blank_line, module_name, refuse_magics
from rosbeat.workspace.place import workspace
from rosbeat.workspace.running import run_as_module
from rosbeat.workspace.saving import save
from rosbeat.workspace.stages import PACKAGE

#: The first page on which the package is expected to be there.
_PAGE_AFTER_PACKAGE = "03"


def register(shell: Any) -> None:  # noqa: ANN401 - IPython carries no types
    """Make `%%save` known to a shell.

    Args:
        shell: A running IPython shell.
    """

    @no_var_expand  # type: ignore[untyped-decorator]  # a path is a path, whatever $ and {} mean elsewhere
    def cell_magic(line: str, cell: str) -> None:
        save_cell(shell, line, cell)

    shell.register_magic_function(cell_magic, magic_kind="cell", magic_name="save")
    if with_body not in shell.input_transformers_cleanup:
        shell.input_transformers_cleanup.append(with_body)


def with_body(lines: list[str]) -> list[str]:
    """Give a cell that is nothing but `%%save PATH` a body, so that we can say what is missing.

    Without one, IPython itself refuses, and proposes its own `%save`, which is something else.

    Args:
        lines: The lines of a cell.
    """
    alone = len(lines) == 1 and re.match(r"%%save\b", lines[0])
    return [lines[0].rstrip("\n") + "\n", "\n"] if alone else lines


def save_cell(shell: Any, line: str, cell: str) -> None:  # noqa: ANN401
    """Save the body of a cell, say so, and run it if it is a module of a package.

    Args:
        shell: The IPython shell of the page.
        line: What stands behind `%%save`: the file, relative to the workspace.
        cell: The body.

    Raises:
        WorkspaceError: If it cannot be saved; then nothing runs.
        BaseException: What the module's text raises; it is saved by then.
    """
    root = workspace()
    relative, target = locate(line, root)
    refuse_other_place(relative, root)
    _refuse_nothing(relative, cell)
    if relative.suffix == ".py":
        refuse_magics(cell, shell.transform_cell)
    _make_room(relative, root)
    blank = blank_line(cell)
    if blank:
        print(f"not saved: there is still a blank in line {blank} of {relative.name}")
    else:
        print(save(str(relative), cell, root))
    name = module_name(relative, root)
    if name:
        run_as_module(shell, cell, name, target, f"%%save {line}")


def _refuse_nothing(relative: PurePosixPath, cell: str) -> None:
    if not cell.strip():
        raise WorkspaceError(
            f"{relative} is not saved: there is nothing to save.",
            "What stands below the line with `%%save` becomes the file.",
            f"Write it there. For an empty file, type `touch {relative}` in a terminal.",
        )


def _make_room(relative: PurePosixPath, root: Path) -> None:
    """Make the package that a file goes into, if it is the package of the course."""
    if relative.parts[0] != "src" or len(relative.parts) < 3:
        return
    package = relative.parts[1]
    if relative.name == "package.xml" or (root / "src" / package / "package.xml").is_file():
        return
    if package != PACKAGE:
        raise _no_such_package(package, root)
    report = catch_up(_PAGE_AFTER_PACKAGE, root)
    print(report)
    if not (root / "src" / PACKAGE / "package.xml").is_file():
        raise WorkspaceError(
            f"{relative} is not saved: the package {PACKAGE} is not there.",
            "The file belongs into that package.",
            "Do what stands above, then run this cell again.",
        )


def _no_such_package(package: str, root: Path) -> WorkspaceError:
    there = sorted(one.parent.name for one in root.glob("src/*/package.xml"))
    meant = nearest(package, [*there, PACKAGE])
    return WorkspaceError(
        f"There is no package {package} in the folder src of your workspace.",
        "A file in src belongs to a package: a folder with a package.xml.",
        f"Did you mean {meant}?" if meant else "Make it with `ros2 pkg create` first.",
    )

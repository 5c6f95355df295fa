"""`%%save PATH`: save a cell as a file of the workspace, and run it on the page if a module.

`%%save PATH --with NAME ...` puts definitions from other cells of the page into the file, too.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path, PurePosixPath
from types import CodeType, TracebackType
from typing import TYPE_CHECKING, Any

from rosbeat.diagnosis.packages import nearest, parse
from rosbeat.errors import WorkspaceError
from rosbeat.page_names import names_relied_on, without_names
from rosbeat.workspace.location import workspace
from rosbeat.workspace.prerequisites import PACKAGE, catch_up
from rosbeat.workspace.saving import locate, save

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

_EXAMPLE = "%%save src/greenhouse/greenhouse/nodes.py --with VentControl"
_WITH = re.compile(r"(?:^|\s)--with(?:\s|$)")
# The first page on which the package is expected to exist.
_PAGE_AFTER_PACKAGE = "03"
# Files of Python that lie beside the folder with the modules.
_BESIDE = ("setup.py", "conftest.py")
_BLANK = re.compile(r"(?<!\w)_{4,}(?!\w)")
_ABSENT = object()


def save_cell(shell: InteractiveShell, line: str, cell: str) -> None:
    """Save the body of a cell, say so, and run it if it is a module of a package.

    Args:
        shell: The IPython shell of the page.
        line: What stands behind `%%save`: the file, relative to the workspace; perhaps `--with`
            and the names of what is to be copied from other cells.
        cell: The body. Only this part of the file runs on the page.

    Raises:
        WorkspaceError: If it cannot be saved; then nothing runs.
        BaseException: What the module's text raises; it is saved by then.
    """
    root = workspace()
    path, *wanted = _WITH.split(line, maxsplit=1)
    relative, target = locate(path, root)
    refuse_other_place(relative, root)
    if not cell.strip():
        raise WorkspaceError(
            f"{relative} is not saved: the cell has no text to save.",
            "The text below the `%%save` line becomes the file.",
            f"Write the text there. For an empty file, type `touch {relative}` in a terminal.",
        )
    if relative.suffix == ".py":
        refuse_magics(cell, shell.transform_cell)
    _make_room(relative, root)
    copied = " ".join(wanted).replace(",", " ").split()
    text = with_definitions(cell, copied, shell.user_ns.get("In", ())) if wanted else cell
    blank = blank_line(text)
    if blank:
        print(f"not saved: there is still a blank in {relative.name}, in the line `{blank}`")
    else:
        print(save(str(relative), text, root))
    relied_on = names_relied_on(shell, text) if relative.suffix == ".py" and not blank else []
    if relied_on:
        names = ", ".join(relied_on)
        print(f"# {relative.name} has no import for {names}: only cells of a page need none.")
    name = module_name(relative, root)
    if name:
        run_as_module(shell, cell, name, target, f"%%save {line}")


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
            f"{relative} is not saved: the package {PACKAGE} does not exist.",
            "The file belongs in that package.",
            "Follow the instructions above, then run this cell again.",
        )


def _no_such_package(package: str, root: Path) -> WorkspaceError:
    there = sorted(one.parent.name for one in root.glob("src/*/package.xml"))
    meant = nearest(package, [*there, PACKAGE])
    return WorkspaceError(
        f"There is no package {package} in the src folder of your workspace.",
        "A file in src belongs to a package: a folder with a package.xml.",
        f"Did you mean {meant}?" if meant else "Create it with `ros2 pkg create` first.",
    )


# Where the file belongs.


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
            f"{relative} is not saved: a package does not keep its files there.",
            "Packages are in src, and a package's modules are in an inner folder of the same name.",
            f"Did you mean {meant}?",
        )


def _meant(relative: PurePosixPath, root: Path) -> PurePosixPath | None:
    parts = relative.parts[1:] if relative.parts[0] == "src" else relative.parts
    if len(parts) < 2:
        return None
    if parts[0] != PACKAGE and not (root / "src" / parts[0] / "package.xml").is_file():
        return None
    is_module = len(parts) == 2 and parts[1].endswith(".py") and parts[1] not in _BESIDE
    inner = parts[:1] if is_module else ()
    meant = PurePosixPath("src", parts[0], *inner, *parts[1:])
    return None if meant == relative else meant


# What is in the cell.


def module_name(relative: PurePosixPath, root: Path) -> str | None:
    """Return the name under which nodes import a file, or None if it is no module of a package.

    Args:
        relative: The file, relative to the workspace.
        root: The workspace.
    """
    package = next(
        (one for one in relative.parents if (root / one / "package.xml").is_file()), None
    )
    if package is None or relative.suffix != ".py":
        return None
    inside = relative.relative_to(package).with_suffix("")
    folders = inside.parts[:-1]
    is_inside = folders[:1] == (package.name,) and all(one.isidentifier() for one in inside.parts)
    return ".".join(folders if inside.name == "__init__" else inside.parts) if is_inside else None


def blank_line(text: str) -> str:
    """Return the first line that holds a blank `____`, or nothing if there is none."""
    return next((line.strip() for line in text.splitlines() if _BLANK.search(line)), "")


def is_python(text: str) -> bool:
    """Return whether a text can be read as Python."""
    try:
        parse(text)
    except (SyntaxError, ValueError):
        return False
    return True


def refuse_magics(text: str, transform: Callable[[str], str]) -> None:
    """Refuse a text that only IPython understands.

    Args:
        text: What is to become a file.
        transform: What IPython makes of a cell before Python reads it.

    Raises:
        WorkspaceError: If a line is a command of the notebook.
    """
    if not is_python(text) and is_python(transform(text)):
        raise WorkspaceError(
            "Nothing was saved: the text has a line that only a notebook understands.",
            "Lines with % or ! or ? are notebook commands, which Python on a robot does not have.",
            "Put that line in a separate cell.",
        )


# What other cells define, for `--with`.


def with_definitions(text: str, names: Sequence[str], cells: Iterable[str]) -> str:
    """Return a module's text with definitions from a page below its first imports.

    Args:
        text: The module's own text.
        names: Classes, functions and variables, in the order in which they are to stand.
        cells: The cells that ran, the oldest first. The last definition of a name counts.

    Raises:
        WorkspaceError: If the text is not Python, no name is given, or one is not defined at the
            top level of any cell.
    """
    head, rest = _split(text)
    known = _definitions(cells)
    missing = next((name for name in names if name not in known), None)
    if missing is not None or not names:
        raise _not_defined(missing, known)
    # One definition may bind several names, and is copied once.
    copied = dict.fromkeys(known[name] for name in names)
    parts = [part.strip("\n") for part in (head, *copied, rest)]
    return "\n\n\n".join(part for part in parts if part) + "\n"


def _split(text: str) -> tuple[str, str]:
    """Cut a module's text below its docstring and its first imports."""
    try:
        body = parse(text).body
    except (SyntaxError, ValueError) as error:
        raise WorkspaceError(
            f"Nothing was saved: the text of this cell is not Python ({error}).",
            "Definitions from other cells go below its imports, so it has to be readable.",
            "Correct the line, then run the cell again.",
        ) from None
    end = 0
    for statement in body:
        is_docstring = isinstance(statement, ast.Expr) and not end
        if not (is_docstring or isinstance(statement, ast.Import | ast.ImportFrom)):
            break
        end = statement.end_lineno or end
    lines = text.split("\n")
    return "\n".join(lines[:end]), "\n".join(lines[end:])


def _definitions(cells: Iterable[str]) -> dict[str, str]:
    """Return the source of the last definition of each name at the top level of a cell."""
    found: dict[str, str] = {}
    for cell in cells:
        try:
            body = parse(cell).body
        except (SyntaxError, ValueError):
            continue
        lines = cell.split("\n")
        for statement in body:
            decorators = getattr(statement, "decorator_list", ())
            first = min(one.lineno for one in (statement, *decorators))
            source = "\n".join(lines[first - 1 : statement.end_lineno])
            found.update(dict.fromkeys(_bound(statement), source))
    return found


def _bound(statement: ast.stmt) -> list[str]:
    """Return the names that a definition or an assignment binds."""
    if isinstance(statement, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
        return [statement.name]
    if isinstance(statement, ast.Assign | ast.AnnAssign):
        targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
        parts = (part for target in targets for part in ast.walk(target))
        names = [part for part in parts if isinstance(part, ast.Name)]
        return [part.id for part in names if isinstance(part.ctx, ast.Store)]
    return []


def _not_defined(name: str | None, known: Iterable[str]) -> WorkspaceError:
    if name is None:
        return WorkspaceError(
            "`--with` was given no name.",
            "It copies what you name from the cells that have run on this page.",
            f"Write the names after it:  {_EXAMPLE}",
        )
    meant = nearest(name, sorted(known))
    return WorkspaceError(
        f"Nothing was saved: no cell that has run on this page defines `{name}`.",
        "`--with` copies classes, functions and variables from these cells.",
        f"Did you mean `{meant}`?" if meant else "Run the cell that defines it, then this one.",
    )


# Running a module's text on the page, without its `main`.


def run_as_module(
    shell: InteractiveShell, text: str, name: str, path: Path, first_line: str
) -> None:
    """Run a module's text in the namespace of the page.

    While it runs, `__name__` is the module's name, so `if __name__ == "__main__":` is not met.

    Args:
        shell: The IPython shell of the page.
        text: The module's text.
        name: The module's name.
        path: The module's file.
        first_line: The line of the cell before the text, so that the numbers of lines that an error
            shows are those of the cell.

    Raises:
        BadSyntax: If it is no Python.
        BaseException: What the text raises. A page shows it without frames that are not the page's.
    """
    source = f"# {first_line}\n{text}"
    try:
        code = _compiled(shell, source)
    except SyntaxError as error:
        raise _shown(shell, error) from None
    with _as_module(shell, name, path), without_names(shell):
        try:
            exec(code, shell.user_ns)
        except BaseException as error:
            trace = error.__traceback__
            _render(shell, error, trace.tb_next if trace else None)
            raise


class BadSyntax(Exception):  # noqa: N818 - it stands for a SyntaxError
    """Show a `SyntaxError` in the text of a module as IPython shows one in a cell.

    IPython shows a real one that comes from a command with every frame of the command.

    Args:
        message: What Python says.
        shown: The lines that a page shows.

    Attributes:
        of_text: The error of the text.
    """

    of_text: SyntaxError | None = None

    def __init__(self, message: str, shown: list[str]) -> None:
        super().__init__(message)
        self._shown = shown

    def _render_traceback_(self) -> list[str]:
        return self._shown


BadSyntax.__name__ = "SyntaxError"


def _shown(shell: InteractiveShell, error: SyntaxError) -> BadSyntax:
    shown = shell.SyntaxTB.structured_traceback(type(error), error, [])
    bad = BadSyntax(str(error), shown)
    bad.of_text = error
    return bad


def _number_of_cell(shell: InteractiveShell) -> int:
    """Return the number of the running cell; the shell may count the next one by now."""
    numbers = getattr(shell.compile, "_filename_map", {})
    frame = sys._getframe()
    while frame.f_back is not None:
        frame = frame.f_back
        if frame.f_code.co_filename in numbers:
            return int(numbers[frame.f_code.co_filename])
    return int(shell.execution_count)


def _compiled(shell: InteractiveShell, source: str) -> CodeType:
    filename = shell.compile.cache(source, _number_of_cell(shell), raw_code=source)
    code: CodeType = shell.compile(source, filename, "exec")
    return code


@contextmanager
def _as_module(shell: InteractiveShell, name: str, path: Path) -> Iterator[None]:
    """Give the page a module's name while a module's text runs on it.

    The page is found under that name too: decorators such as `dataclass` look there.
    """
    names, modules = shell.user_ns, sys.modules
    before = {key: names.get(key, _ABSENT) for key in ("__name__", "__file__")}
    imported = modules.get(name, _ABSENT)
    names.update(__name__=name, __file__=str(path))
    modules[name] = shell.user_module
    try:
        yield
    finally:
        _put_back(names, before)
        _put_back(modules, {name: imported})


def _put_back(target: dict[str, Any], before: dict[str, Any]) -> None:
    for key, value in before.items():
        if value is _ABSENT:
            target.pop(key, None)
        else:
            target[key] = value


def _render(shell: InteractiveShell, error: BaseException, trace: TracebackType | None) -> None:
    """Make IPython show an exception from the learner's own first frame on."""
    if hasattr(error, "_render_traceback_") or isinstance(error, SyntaxError):
        return
    shown = shell.InteractiveTB.structured_traceback(type(error), error, trace, tb_offset=0)
    with suppress(AttributeError, TypeError):  # an exception may refuse attributes
        error._render_traceback_ = lambda: shown  # type: ignore[attr-defined]  # IPython's protocol

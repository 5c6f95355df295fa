"""Runs the text of a module on the page, as if it had been imported: its `main` is not started."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import CodeType, TracebackType
from typing import Any

_ABSENT = object()


def run_as_module(shell: Any, text: str, name: str, path: Path, first_line: str) -> None:  # noqa: ANN401
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
    with _as_module(shell, name, path):
        try:
            exec(code, shell.user_ns)
        except BaseException as error:
            trace = error.__traceback__
            _render(shell, error, trace.tb_next if trace else None)
            raise


class BadSyntax(Exception):  # noqa: N818 - it stands for a SyntaxError
    """A `SyntaxError` in the text of a module, shown as IPython shows one in a cell.

    IPython shows a real one that comes from a command with every frame of the command.

    Args:
        message: What Python says.
        shown: The lines that a page shows.
    """

    def __init__(self, message: str, shown: list[str]) -> None:
        super().__init__(message)
        self._shown = shown

    def _render_traceback_(self) -> list[str]:
        return self._shown


BadSyntax.__name__ = "SyntaxError"


def _shown(shell: Any, error: SyntaxError) -> BadSyntax:  # noqa: ANN401
    return BadSyntax(str(error), shell.SyntaxTB.structured_traceback(type(error), error, []))


def _number_of_cell(shell: Any) -> int:  # noqa: ANN401
    """The number that the running cell has on the page; the shell may count the next one by now."""
    numbers = getattr(shell.compile, "_filename_map", {})
    frame = sys._getframe()
    while frame.f_back is not None:
        frame = frame.f_back
        if frame.f_code.co_filename in numbers:
            return int(numbers[frame.f_code.co_filename])
    return int(shell.execution_count)


def _compiled(shell: Any, source: str) -> CodeType:  # noqa: ANN401
    filename = shell.compile.cache(source, _number_of_cell(shell), raw_code=source)
    code: CodeType = shell.compile(source, filename, "exec")
    return code


@contextmanager
def _as_module(shell: Any, name: str, path: Path) -> Iterator[None]:  # noqa: ANN401
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


def _render(shell: Any, error: BaseException, trace: TracebackType | None) -> None:  # noqa: ANN401
    """Have IPython show an exception from the learner's own first frame on."""
    if hasattr(error, "_render_traceback_") or isinstance(error, SyntaxError):
        return
    shown = shell.InteractiveTB.structured_traceback(type(error), error, trace, tb_offset=0)
    with suppress(AttributeError, TypeError):  # an exception may refuse attributes
        error._render_traceback_ = lambda: shown  # type: ignore[attr-defined]

"""Explain an exception that a cell of a page raises: say what it means and what to try."""

from __future__ import annotations

import linecache
import re
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING

from rosbeat.errors import RosbeatError, explain_interrupt
from rosbeat.page_cells import PageCell, cell_that_defines, link_below
from rosbeat.page_names import learners_names, names_of

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

#: Commands of the course that begin a cell.
_MAGICS = ("terminal", "save")
_RUN = "Run, Run All Above Selected Cell in the menu."
_UNKNOWN = (
    "The cell stopped at the line that is marked; the lines below it didn't run.",
    f"Compare that line with the page. If a cell above hasn't run yet, choose {_RUN}",
)


def register(shell: InteractiveShell) -> None:
    """Explain what a cell raises; a second time changes nothing.

    A handler for exceptions that somebody else has set stays.

    Args:
        shell: The running shell.
    """
    shell.showsyntaxerror = partial(_show_unread, shell)
    if not shell.custom_exceptions:
        shell.set_custom_exc((Exception, KeyboardInterrupt), _show)


def _show(
    shell: InteractiveShell,
    kind: type[BaseException],
    error: BaseException,
    trace: TracebackType | None,
    tb_offset: int | None = None,
) -> None:
    """Show an exception as IPython does, with two lines below it."""
    mine = _lines_of_the_page(shell, trace)
    if isinstance(error, KeyboardInterrupt) and not hasattr(error, "_render_traceback_"):
        _explain_interrupt(error, mine)
    is_unknown = isinstance(error, NameError) and mine and mine[-1][2]
    cell = cell_that_defines(shell, getattr(error, "name", "") or "") if is_unknown else None
    means = _explained(shell, error, mine, cell) if isinstance(error, Exception) else None
    if means is None:
        shell.showtraceback((kind, error, trace), tb_offset=tb_offset)
        return
    if isinstance(error, SyntaxError) and not mine:
        shown = shell.SyntaxTB.structured_traceback(kind, error, [])
    elif hasattr(error, "_render_traceback_"):  # IPython's protocol
        shown = list(error._render_traceback_())
    else:
        shown = shell.InteractiveTB.structured_traceback(kind, error, trace, tb_offset)
    below = [f"  What it means: {means[0]}", f"  What to try:   {means[1]}"]
    # Not by `showtraceback`: an error that is raised again would keep these lines.
    shell._showtraceback(kind, error, [*shown, *below])
    if cell is not None:
        link_below(cell)


def _show_unread(shell: InteractiveShell, *_: object, **__: object) -> None:
    """Show the error of a cell that Python could not read, wherever IPython has met it."""
    kind, error, trace = shell._get_exc_info()  # of the preparation of a cell, the last one
    if kind is not None and isinstance(error, SyntaxError):
        _show(shell, kind, error, trace)


def _explain_interrupt(error: KeyboardInterrupt, mine: list[tuple[FrameType, int, bool]]) -> None:
    """Say where Interrupt has stopped a cell, instead of a stack."""
    where = ""
    if mine:
        frame, line, _ = mine[-1]
        code = linecache.getline(frame.f_code.co_filename, line).strip()
        where = f" in line {line}" + (f": {code}" if code else "")
    explain_interrupt(
        error,
        f"you stopped the cell{where}",
        "Nothing is broken: the lines above have run, and what they defined is still there.",
        "If the cell would never have ended by itself, look at the condition of its loop. "
        "Otherwise run it again, and give it more time.",
    )


def _lines_of_the_page(
    shell: InteractiveShell, trace: TracebackType | None
) -> list[tuple[FrameType, int, bool]]:
    """Return the frames of cells, with the line, and whether nothing was called from there."""
    found = []
    while trace is not None:
        if trace.tb_frame.f_globals is shell.user_ns:
            found.append((trace.tb_frame, trace.tb_lineno, trace.tb_next is None))
        trace = trace.tb_next
    return found


def _explained(
    shell: InteractiveShell,
    error: Exception,
    mine: list[tuple[FrameType, int, bool]],
    cell: PageCell | None,
) -> tuple[str, str] | None:
    """Return what an exception means and what to try; None if it says so itself."""
    from IPython.core.error import UsageError

    if isinstance(error, UsageError):
        return _about_magic(str(error), _raw_cell(shell))
    if isinstance(error, RosbeatError):
        return None
    unread = getattr(error, "of_text", error)  # `%%save` reads the text of a file
    if isinstance(unread, SyntaxError) and (unread is not error or not mine):
        from rosbeat.diagnosis.syntax import about_syntax

        return about_syntax(unread, _cell_of(shell))
    if not mine:  # before the cell ran, or in code that no cell has called
        return None
    frame, line, is_last = mine[-1]
    if isinstance(error, (ImportError, AttributeError)) and (found := _about_files(error)):
        return found
    if type(error) is NameError:
        found = _about_command(shell, error) or _about_constant(error.name)
        if found and cell is None:
            return found
        return _about_name(shell, error, cell) if is_last else None
    code = linecache.getline(frame.f_code.co_filename, line).strip()
    return _known(error, line, code) or _UNKNOWN


def _about_magic(text: str, cell: str) -> tuple[str, str] | None:
    """Return the same for a command of the notebook that does not exist."""
    found = re.search(r"magic(?: function)? `%+(\w+)` not found", text)
    if found is None or f"%{found[1]}" not in cell:
        return None
    near = get_close_matches(found[1].lower(), _MAGICS, 1)
    to_try = f"Did you mean `%%{near[0]}`?" if near else "Those of the course are `%%terminal` "
    return (
        f"A line that begins with `%` is a command of the notebook, and none is called {found[1]}.",
        to_try if near else f"{to_try}and `%%save`. Compare the cell's first line with the page.",
    )


def _about_command(shell: InteractiveShell, error: NameError) -> tuple[str, str] | None:
    """Return the same for a command of a terminal that Python has read as names, as in `ls -l`."""
    from rosbeat.diagnosis.syntax import COMMANDS, command_in

    return command_in(_cell_of(shell)) if error.name in COMMANDS else None


def _about_constant(name: str | None) -> tuple[str, str] | None:
    """Return the same for a value that other languages write in small letters."""
    right = {"true": "True", "false": "False", "none": "None", "null": "None", "nil": "None"}
    if name not in right:
        return None
    return (
        f"Python does not know `{name}`.",
        f"It is called `{right[name]}`, with a capital letter.",
    )


def _cell_of(shell: InteractiveShell) -> str:
    """Return the text of the cell that runs; empty if it begins with a magic."""
    cell = _raw_cell(shell)
    return "" if cell.startswith("%") else cell


def _raw_cell(shell: InteractiveShell) -> str:
    """Return the text of the cell that runs, with its magics."""
    cells = shell.history_manager.input_hist_raw if shell.history_manager else [""]
    return str(cells[-1])


def _about_name(
    shell: InteractiveShell, error: NameError, cell: PageCell | None
) -> tuple[str, str] | None:
    """Return the same for a name that code of the page does not find.

    Args:
        shell: The running shell.
        error: The error.
        cell: The cell that defines the name; None if the page has none.
    """
    name = error.name
    # A blank, `____`, is no mistake yet.
    if not name or not name.strip("_"):
        return None
    if name in names_of(shell):  # cells find it, so this is the text of a file
        means = f"Only the cells of a page know `{name}` without an import; this text is a file's."
        return means, f"A file imports what it uses: `from rosbeat import {name}`."
    means = f"No cell that has run since the kernel started defines `{name}`."
    if cell is not None:
        place = "above" if cell.is_above else "further down"
        to_try = f"Run the cell {place} {cell}, then this cell again."
        return means, f"{to_try} Or choose {_RUN}" if cell.is_above else to_try
    # What the learner has named comes first.
    for known in (learners_names(shell), names_of(shell)):
        near = get_close_matches(name, sorted(known), 1)
        if near:
            return means, f"Did you mean `{near[0]}`? If not, choose {_RUN}"
    return means, f"Choose {_RUN} If that doesn't help, check the spelling."


def _about_files(error: Exception) -> tuple[str, str] | None:
    """Return the same for a module that a file of the learner's hides, or that is one itself."""
    from rosbeat.diagnosis.modules import about_hidden, about_neighbor

    then = "Then restart the kernel, which has loaded the file already: Kernel, Restart Kernel."
    # A workspace lies beside the pages.
    files = Path.cwd().glob("*/src/*/*/*.py") if "No module" in str(error) else ()
    found = about_hidden(str(error), [Path.cwd()], then) or about_neighbor(
        str(error), [(file.parent.name, file.stem) for file in files]
    )
    return None if found is None else (found.evidence, found.hint)


def _known(error: Exception, line: int, code: str) -> tuple[str, str] | None:
    """Return the meaning of an exception that a mistake of the catalogue raises."""
    # The rules are many, and most cells raise nothing.
    from rosbeat.diagnosis.exceptions import meaning_of
    from rosbeat.records import Fault

    text = str(error)
    if isinstance(error, AttributeError) and "Did you mean" not in text and error.name:
        near = get_close_matches(error.name, dir(error.obj), 1, 0.7)
        text += f". Did you mean: '{near[0]}'?" if near else ""
    found = meaning_of(Fault(0, "", "", type(error).__name__, text, line, code))
    return None if found is None else (found.evidence, found.hint)

"""Explain an exception that a cell of a page raises: say what it means and what to try."""

from __future__ import annotations

import linecache
from difflib import get_close_matches
from types import FrameType, TracebackType
from typing import TYPE_CHECKING

from rosbeat.errors import RosbeatError, explain_interrupt

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

_RUN = "Run, Run All Above Selected Cell in the menu."
_SYNTAX = (
    "Python can't read this cell, so none of its lines ran.",
    "Look at the place that is marked, and at the end of the line above it: a quote, a bracket, a "
    "comma or a colon may be missing.",
)
_INDENTATION = (
    "Python can't read this cell, so none of its lines ran: the spaces at the beginning of a line "
    "don't match the lines around it.",
    "Lines of one block begin with the same number of spaces. After a line that ends with a colon, "
    "indent by four more.",
)
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
    means = _explained(shell, error, mine) if isinstance(error, Exception) else None
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
    shell: InteractiveShell, error: Exception, mine: list[tuple[FrameType, int, bool]]
) -> tuple[str, str] | None:
    """Return what an exception means and what to try; None if it says so itself."""
    from IPython.core.error import UsageError

    if isinstance(error, (RosbeatError, UsageError)):
        return None
    if not mine:  # before the cell ran, or in code that no cell has called
        if not isinstance(error, SyntaxError):
            return None
        return _INDENTATION if isinstance(error, IndentationError) else _SYNTAX
    frame, line, is_last = mine[-1]
    if type(error) is NameError:
        return _about_name(shell, error) if is_last else None
    code = linecache.getline(frame.f_code.co_filename, line).strip()
    return _known(error, line, code) or _UNKNOWN


def _about_name(shell: InteractiveShell, error: NameError) -> tuple[str, str] | None:
    """Return the same for a name that code of the page does not find."""
    name = error.name
    # A blank, `____`, is no mistake yet.
    if not name or not name.strip("_"):
        return None
    known = [one for one in shell.user_ns if not one.startswith("_")]
    near = get_close_matches(name, known, 1)
    to_try = f"Choose {_RUN} If that doesn't help, check the spelling."
    if near:
        to_try = f"Did you mean `{near[0]}`? If not, choose {_RUN}"
    return f"No cell that has run since the kernel started defines `{name}`.", to_try


def _known(error: Exception, line: int, code: str) -> tuple[str, str] | None:
    """Return the meaning of an exception that a mistake of the catalogue raises."""
    # The rules are many, and most cells raise nothing.
    from rosbeat.diagnosis.exceptions import meaning_of
    from rosbeat.records import Fault

    found = meaning_of(Fault(0, "", "", type(error).__name__, str(error), line, code))
    return None if found is None else (found.evidence, found.hint)

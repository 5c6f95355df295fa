"""Explain a `NameError` on a page: say which cells to run again."""

from __future__ import annotations

from difflib import get_close_matches
from types import TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell


def register(shell: InteractiveShell) -> None:
    """Explain names that no cell has defined; a second time changes nothing.

    A handler for exceptions that somebody else has set stays.

    Args:
        shell: The running shell.
    """
    if not shell.custom_exceptions:
        shell.set_custom_exc((NameError,), _show)


def _show(
    shell: InteractiveShell,
    kind: type[NameError],
    error: NameError,
    trace: TracebackType,
    tb_offset: int | None = None,
) -> None:
    """Show a `NameError` as IPython does, with two lines behind it if a cell has raised it."""
    more = _explained(shell, error, trace)
    if more:
        render = getattr(error, "_render_traceback_", None) or (
            lambda: shell.InteractiveTB.structured_traceback(kind, error, trace, tb_offset)
        )
        shown = [*render(), *more]
        error._render_traceback_ = lambda: shown  # type: ignore[attr-defined] # IPython's protocol
    shell.showtraceback((kind, error, trace))


def _explained(shell: InteractiveShell, error: NameError, trace: TracebackType) -> list[str]:
    """Return the second and the third part of the error, if code of the page raised it."""
    while trace.tb_next is not None:
        trace = trace.tb_next
    name = error.name
    # A local variable without a value is another mistake, and so is a blank, `____`.
    if type(error) is not NameError or not name or not name.strip("_"):
        return []
    if trace.tb_frame.f_globals is not shell.user_ns:
        return []
    known = [one for one in shell.user_ns if not one.startswith("_")]
    near = get_close_matches(name, known, 1)
    run = "Run, Run All Above Selected Cell in the menu."
    to_try = f"Choose {run} If that doesn't help, check the spelling."
    if near:
        to_try = f"Did you mean `{near[0]}`? If not, choose {run}"
    return [
        f"  What it means: No cell that has run since the kernel started defines `{name}`.",
        f"  What to try:   {to_try}",
    ]

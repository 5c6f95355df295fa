"""`%%terminal NAME` types a cell into a terminal; `%terminal NAME` looks at one."""

from __future__ import annotations

from typing import Any

from IPython.core.error import UsageError
from IPython.core.magic import no_var_expand

from rosbeat.workspace.terminals.options import Options, parse
from rosbeat.workspace.terminals.registry import Terminals, terminals_of


def register(shell: Any) -> None:  # noqa: ANN401 - IPython carries no types
    """Make `%%terminal` and `%terminal` known to a shell; a second call changes nothing.

    Args:
        shell: The IPython shell of a page.
    """

    def magic(line: str, cell: str | None = None) -> None:
        """Type the cell into a terminal, or look at one; any wrong option shows the right ones."""
        run(shell, line, cell)

    # `$HOME` is for bash, and IPython is not to put a variable of the page in its place.
    shell.register_magic_function(no_var_expand(magic), "line_cell", "terminal")


def run(shell: Any, line: str, cell: str | None) -> None:  # noqa: ANN401
    """Do what `%%terminal` or `%terminal` asks.

    Args:
        shell: The IPython shell of the page, which holds the terminals.
        line: The terminal's name and options.
        cell: The commands; None for `%terminal`.

    Raises:
        UsageError: If the line or the cell cannot be understood.
        TerminalError: If the terminal cannot do it.
        KeyboardInterrupt: If the cell is interrupted.
    """
    options = parse(line, cell is not None)
    terminals = terminals_of(shell)
    if cell is not None:
        _type(terminals, options, cell)
    elif options.name:
        _look(terminals, options)
    else:
        _list(terminals)


def _type(terminals: Terminals, options: Options, cell: str) -> None:
    if not cell.strip():
        raise UsageError("There is nothing to type: write the commands below `%%terminal NAME`.")
    terminal = terminals.get(options.name)
    act = terminal.answer if options.action == "answer" else terminal.type
    act(cell, **options.watching())  # type: ignore[arg-type] # the names fit


def _look(terminals: Terminals, options: Options) -> None:
    terminal = terminals.find(options.name)
    if terminal is None:
        raise UsageError(
            f"There is no terminal `{options.name}`. {_names(terminals)} "
            f"`%%terminal {options.name}` with commands below opens it."
        )
    if options.action:
        getattr(terminal, options.action)(**options.ending())
    else:
        terminal.look(**options.watching())  # type: ignore[arg-type] # the names fit


def _names(terminals: Terminals) -> str:
    names = ", ".join(f"`{one.name}`" for one in terminals)
    return f"There is: {names}." if names else "None is open."


def _list(terminals: Terminals) -> None:
    rows = list(terminals)
    width = max((len(one.name) for one in rows), default=0)
    for one in rows:
        print(f"{one.name:<{width}}  {one.state}")
    if not rows:
        print("No terminal is open. `%%terminal NAME` with commands below it opens one.")

"""Define `%%terminal NAME`, which types a cell into a terminal, and `%terminal NAME`, its view."""

from __future__ import annotations

import argparse
import re
import shlex
from typing import TYPE_CHECKING, NoReturn

from IPython.core.error import UsageError

from rosbeat.workspace.terminals.terminal import Terminals, terminals_of

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_-]*")
_USAGE = """\
%%terminal NAME [--until TEXT [--lines N]] [--for SECONDS] [--timeout SECONDS] [--answer]
    types the cell into the terminal NAME
%terminal NAME [--until TEXT [--lines N]] [--for SECONDS] [--timeout SECONDS]
    shows the output since the last time
%terminal NAME --ctrl-c | --ctrl-d | --kill [--timeout SECONDS]
    presses a key, or kills the running program
%terminal NAME --close
    ends the terminal
%terminal
    lists the terminals"""


def run(shell: InteractiveShell, line: str, cell: str | None) -> None:
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
    given = _parse(line, cell is not None)
    watching = {name: getattr(given, name) for name in ("until", "lines", "seconds", "timeout")}
    terminals = terminals_of(shell)
    if cell is not None:
        if not cell.strip():
            raise UsageError("The cell has no commands: write them below `%%terminal NAME`.")
        terminal = terminals.get(given.name)
        (terminal.answer if given.action else terminal.type)(cell, **watching)
    elif not given.name:
        _list(terminals)
    elif (found := terminals.find(given.name)) is None:
        raise UsageError(
            f"There is no terminal `{given.name}`. {_names(terminals)} `%%terminal {given.name}` "
            "with commands below it opens that terminal."
        )
    elif given.action:
        ending = {} if given.timeout is None else {"timeout": given.timeout}
        getattr(found, given.action)(**ending)
    else:
        found.look(**watching)


def _names(terminals: Terminals) -> str:
    names = ", ".join(f"`{one.name}`" for one in terminals)
    return f"Open terminals: {names}." if names else "No terminal is open."


def _list(terminals: Terminals) -> None:
    rows = list(terminals)
    width = max((len(one.name) for one in rows), default=0)
    for one in rows:
        print(f"{one.name:<{width}}  {one.state}")
    if not rows:
        print("No terminal is open. `%%terminal NAME` with commands below it opens one.")


# Options.


class _Parser(argparse.ArgumentParser):
    """Raise errors in the words of the pages, and never end the kernel."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message[:1].upper()}{message[1:]}.\n{_USAGE}")


def _parse(line: str, in_cell: bool) -> argparse.Namespace:
    """Return the options of a line.

    Args:
        line: What stands behind the magic's name.
        in_cell: Whether it is `%%terminal`.

    Raises:
        UsageError: If it cannot be understood; the text says what can.
    """
    try:
        words = shlex.split(line)
    except ValueError:
        raise UsageError(f"A quote is not closed: {line.strip()}\n{_USAGE}") from None
    given = _parser().parse_args(words)
    _require_sense(given, given.action or "", in_cell)
    return given


def _parser() -> _Parser:
    parser = _Parser(add_help=False, allow_abbrev=False, prog="terminal")
    parser.add_argument("name", nargs="?", default="")
    parser.add_argument("--until")
    parser.add_argument("--lines", type=_count, default=1)
    parser.add_argument("--for", dest="seconds", type=_seconds)
    parser.add_argument("--timeout", type=_seconds)
    actions = parser.add_mutually_exclusive_group()
    for action in ("answer", "ctrl-c", "ctrl-d", "kill", "close"):
        value = action.replace("-", "_")
        actions.add_argument(f"--{action}", dest="action", action="store_const", const=value)
    return parser


def _count(text: str) -> int:
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"`{text}` is not a number of lines, such as 3")
    return int(text)


def _seconds(text: str) -> float:
    try:
        seconds = float(text.removesuffix("s"))
    except ValueError:
        seconds = -1.0
    if not 0 <= seconds < float("inf"):
        raise argparse.ArgumentTypeError(f"`{text}` is not a number of seconds, such as 2.5")
    return seconds


def _require_sense(given: argparse.Namespace, action: str, in_cell: bool) -> None:
    """Refuse what does not go together.

    Raises:
        UsageError: Then.
    """
    name, option, sign = given.name, f"--{action.replace('_', '-')}", "%%" if in_cell else "%"
    is_end = action not in ("", "answer")
    # A program is not watched in the same line in which it is ended.
    watching = {"until": given.until, "for": given.seconds}
    if action == "close":
        watching["timeout"] = given.timeout
    useless = [one for one, value in watching.items() if is_end and value is not None]
    asked = in_cell or action or given.until or given.seconds is not None
    refusals = (
        (not name and asked,
         f"The terminal's name is missing. Give it one, as in `{sign}terminal sensor`.\n{_USAGE}"),
        (name and not _NAME.fullmatch(name),
         f"`{name}` is not a valid name: use letters, digits, `-` and `_`."),
        (in_cell and is_end,
         f"`{option}` works only in a line of its own: `%terminal {name} {option}`."),
        (action == "answer" and not in_cell,
         "`--answer` types the rest of the cell, so it needs `%%terminal`."),
        (useless, f"`--{''.join(useless[:1])}` cannot be combined with `{option}`.\n{_USAGE}"),
        (given.until == "", "`--until` needs a text to wait for."),
        (given.lines > 1 and given.until is None,
         "`--lines` counts lines with a text: it needs `--until TEXT`."),
    )  # fmt: skip
    for holds, said in refusals:
        if holds:
            raise UsageError(said)

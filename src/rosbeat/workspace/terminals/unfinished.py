"""Commands that do not end: an open quote, a loop without `done`."""

from __future__ import annotations

import subprocess

from rosbeat.errors import TerminalError

_MISSING = {
    "`\"'": 'a closing quote `"`',
    "`''": "a closing quote `'`",
    "`)'": "a closing bracket `)`",
    "`}'": "a closing brace `}`",
    "``'": "a closing backquote",
}
_WITHIN = 10.0


def unfinished(command: str) -> TerminalError:
    """Return what is missing in a command for which bash still waits.

    Args:
        command: The whole command, so far.
    """
    return TerminalError(
        f"The command is not finished: {_missing(command)} is missing.",
        "bash waited for the rest of it. The command was dropped, and nothing of it ran.",
        "Complete the command in the cell, then run the cell again.",
    )


def _missing(command: str) -> str:
    """Return what bash itself says about the command, in words."""
    if command.rstrip("\n").endswith("\\"):
        return "the line after the last backslash `\\`"
    said = _complaint(command)
    if "wanted `" in said:
        return "the line " + said.rsplit("wanted ", 1)[1].split("'")[0] + "` that ends the text"
    wanted = said.rsplit("looking for matching ", 1)[-1].strip().splitlines()
    return _MISSING.get(wanted[0] if wanted else "", _keyword(command))


def _complaint(command: str) -> str:
    asked = subprocess.run(
        ["bash", "--norc", "-n"],
        input=command + "\n",
        capture_output=True,
        text=True,
        timeout=_WITHIN,
        env={"LC_ALL": "C", "PATH": "/usr/local/bin:/usr/bin:/bin"},
        check=False,
    )
    return asked.stderr


def _keyword(command: str) -> str:
    words = command.split()
    for opening, closing in (("do", "done"), ("then", "fi"), ("case", "esac"), ("{", "}")):
        if words.count(opening) > words.count(closing):
            return f"`{closing}`"
    return "its end (`done`, `fi`, `}` or the like)"

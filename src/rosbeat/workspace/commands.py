"""Say why a command is not typed, and what the outcome of another one means."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
from itertools import dropwhile
from pathlib import Path
from typing import TYPE_CHECKING

from rosbeat.diagnosis import terminal
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.errors import TerminalError
from rosbeat.workspace.location import steady_home

if TYPE_CHECKING:
    from rosbeat.diagnosis.packages import Package

_SHORT = 60
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")
_BLANK = re.compile(r"(?<!\w)____(?!\w)")


def short(command: str) -> str:
    """Return the first line of a command, cut to 60 characters."""
    line, *more = command.strip().splitlines() or [""]
    cut = line if len(line) <= _SHORT else f"{line[: _SHORT - 4]} ..."
    return f"{cut} ..." if more and cut == line else cut


def lines_of(cell: str) -> list[str]:
    """Return the lines of a cell to type, without blank ones at the end.

    Args:
        cell: The cell below its magic.

    Raises:
        TerminalError: If it holds a control character, which would be a key of its own.
    """
    cell = cell.replace("\r\n", "\n")
    key = _CONTROL.search(cell)
    if key:
        raise TerminalError(
            f"The cell contains the control character {key[0]!r}.",
            "In a terminal, such a character is a key press and not part of the command.",
            "Delete it; `%terminal NAME --ctrl-c` sends Ctrl+C.",
        )
    return cell.rstrip().split("\n")


# Commands that are not typed: each function returns why, or an empty text.


def blank_in(lines: list[str]) -> str:
    """Return why a cell is not typed in which something is still to be filled in.

    Args:
        lines: The lines below the magic.
    """
    numbers = [number for number, line in enumerate(lines, 2) if _BLANK.search(line)]
    return f"there is still a blank, ____, in line {numbers[0]}" if numbers else ""


_BUILDS = re.compile(r"colcon(?: --log-(?:base|level)[= ]\S+)* (?:build|test)(?= |$)")
# Whoever names the folders knows them; help reads none.
_CHOSEN = re.compile(r"(?<!\S)(?:--base-paths|--paths|--help|-h)(?=[\s=]|$)")
#: Words that may stand before a program in a line.
_BEFORE = {"sudo", "exec", "command", "time", "env", "nice", "(", "{", "!", "do", "then", "else"}


def build_outside(line: str, folder: Path, workspace: Path, here: str) -> str:
    """Return why a `colcon build` is not typed in a folder that is no workspace.

    colcon reads whatever lies below the folder it is called in, and runs every setup.py that it
    finds: one `cd ..` too many, and that is the whole checkout of the course.

    Args:
        line: The commands; a `cd` before colcon counts.
        folder: The folder of the terminal.
        workspace: The learner's workspace.
        here: The folder as the prompt names it.
    """
    builds = [
        call
        for call in _situation(_plain(line), "", 0, folder, workspace).calls
        if _BUILDS.match(" ".join(call.words)) and not _CHOSEN.search(" ".join(call.words))
    ]
    if not builds:
        return ""
    place, exists, workspace = builds[0].place.resolve(), workspace.is_dir(), workspace.resolve()
    is_here = place == folder.resolve()
    if os.pathsep in str(place):
        return (
            f"the path of `{place}` contains a `:`, which separates folders in lists such as PATH. "
            "colcon would install the packages elsewhere. Rename that folder first."
        )
    around = {workspace, *workspace.parents}  # a folder around the learner's own is none
    above = (place, *place.parents)
    if workspace in above or any(_holds_package(one) for one in above if one not in around):
        return ""
    way = 'Go there first: `cd "$ROS2_WORKSPACE"`.' if exists else "Page 01 creates the workspace."
    return (
        f"{f'the terminal is in `{here}`' if is_here else f'the line leads to `{place}`'}, which "
        f"is outside of your workspace. colcon would build every package below that folder. {way}"
    )


def _plain(line: str) -> str:
    """Return a line without the words that may stand before a program."""
    parts = (list(dropwhile(_BEFORE.__contains__, one)) for one in terminal.commands_in(line))
    return ";".join(shlex.join(words) for words in parts if words)


def _holds_package(folder: Path) -> bool:
    try:
        return any(any((folder / "src").glob(f"{depth}/package.xml")) for depth in ("*", "*/*"))
    except OSError:  # a folder that nobody may read is no workspace
        return False


_EDITORS = {"vi", "vim", "nvim", "view", "nano", "pico", "emacs"}
_PAGERS = {"less", "more", "most"}
_CLEARS = {"clear", "reset"}
_FULL_SCREEN = (
    {"top", "htop", "btop", "watch", "tmux", "screen", "mc"} | _EDITORS | _PAGERS | _CLEARS
)
# With one of these they print something and end.
_PRINTS = {"--version", "--help", "-h", "-V", "-b", "-bn1"}


def full_screen(line: str) -> str:
    """Return why a program that needs a whole screen is not started in a page.

    Args:
        line: The command, one line of it.
    """
    for words in terminal.split_commands(line):
        rest = [word for word in words if word not in _BEFORE]
        name = Path(rest[0]).name if rest else ""
        if name in _FULL_SCREEN and not _PRINTS & set(rest[1:]):
            instead = "JupyterLab's own terminal can do that: choose File, New, Terminal."
            if name in _CLEARS:
                return f"`{name}` has nothing to clear: a page shows only what its cells print."
            if name in _EDITORS:
                instead = "To edit a file, double-click it in JupyterLab's file browser."
            elif name in _PAGERS:
                instead = "`cat FILE` prints a whole file into the page."
            return f"`{name}` needs a full-screen terminal, which a page does not have. {instead}"
    return ""


_UNFINISHED = re.compile(
    r"(?m)^bash: (?:line \d+: )?(.*(?:unexpected end of file|looking for matching|wanted `).*)$"
)


def refuse_unfinished(lines: list[str]) -> None:
    """Refuse a cell whose rest bash would still wait for; `bash -n` reads it and runs nothing.

    Args:
        lines: The commands.

    Raises:
        TerminalError: If it has no end. What is missing is said as bash says it.
    """
    asked = subprocess.run(
        ["bash", "--norc", "-n"],
        input="\n".join(lines) + "\n", capture_output=True, text=True, timeout=10, check=False,
        env={"LC_ALL": "C", "PATH": "/usr/local/bin:/usr/bin:/bin"},
    )  # fmt: skip
    found = _UNFINISHED.search(asked.stderr)
    if found is None and not re.search(r"(?<!\\)(\\\\)*\\$", lines[-1]):
        return
    sign = found and re.search(r"looking for matching `(.)'", found[1])
    said = f' It says "{found[1]}".' if found else ""
    if sign:
        said = f" A closing `{sign[1]}` is missing."
    raise TerminalError(
        "The command is not finished: its end is missing.",
        f"bash would wait for the rest.{said} Nothing of the cell was typed.",
        "Complete the command in the cell, then run the cell again.",
    )


# The outcome, by the rules of `rosbeat.diagnosis.terminal`.


def recognise(
    command: str, output: str, code: int, folder: Path, workspace: Path
) -> Diagnosis | None:
    """Return the mistake behind a command's outcome, or None if nothing is known for sure.

    Args:
        command: The command as it was typed.
        output: The text that the terminal showed.
        code: The exit code.
        folder: The folder in which the terminal was.
        workspace: The learner's workspace; its files are read.
    """
    return terminal.recognise(_situation(command, output, code, folder, workspace))


def explain(command: str, output: str, code: int, folder: Path, workspace: Path) -> str | None:
    """Return two or three sentences about a command's outcome; the arguments of `recognise`.

    Returns:
        What it means and what to try; None if nothing is known for sure, or if the output says the
        same itself.
    """
    return terminal.explain(_situation(command, output, code, folder, workspace))


def _situation(
    command: str, output: str, code: int, folder: Path, workspace: Path
) -> terminal.Situation:
    home = steady_home() or Path.home()

    def packages() -> tuple[Package, ...]:
        # Loaded when a rule asks: the first prompt does not wait for it.
        from rosbeat.workspace.packages import find_packages, read_package

        folders = find_packages(workspace) if workspace.is_dir() else []
        return tuple(read_package(one, workspace) for one in folders)

    return terminal.Situation(command, output, code, folder, workspace, home, packages)

"""What is known after a command of a terminal has ended."""

from __future__ import annotations

import re
import shlex
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from rosbeat.workspace.packages import Package, find_packages, read_package
from rosbeat.workspace.place import steady_home

_SEPARATORS = {";", "&&", "||", "|", "&"}
_COLOUR = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


@dataclass(frozen=True)
class Call:
    """One command of a line.

    Attributes:
        words: The program and its arguments.
        place: The folder it ran in.
    """

    words: tuple[str, ...]
    place: Path


@dataclass(frozen=True)
class Situation:
    """A command that has ended, and what can be seen of it.

    Attributes:
        command: What was typed; several lines, or several commands in a line, are fine.
        output: What the terminal showed.
        code: The exit code of the last command.
        folder: The folder that the terminal was in.
        workspace: The learner's workspace.
    """

    command: str
    output: str
    code: int
    folder: Path
    workspace: Path

    @cached_property
    def text(self) -> str:
        """The output without colours, with one kind of line end and one kind of quote."""
        plain = _COLOUR.sub("", self.output).replace("\r\n", "\n").replace("\r", "\n")
        return plain.replace("‘", "'").replace("’", "'")

    @cached_property
    def calls(self) -> tuple[Call, ...]:
        """The commands one by one, each with the folder that `cd` had led to."""
        place = self.folder
        found = []
        for words in _commands(self.command):
            found.append(Call(words, place))
            if words[0] == "cd":
                place = _after_cd(place, words)
        return tuple(found)

    def call(self, *start: str) -> Call | None:
        """Return the last command that begins with certain words, or None."""
        count = len(start)
        fitting = [one for one in self.calls if one.words[:count] == start]
        return fitting[-1] if fitting else None

    @cached_property
    def packages(self) -> tuple[Package, ...]:
        """Every package of the workspace."""
        folders = find_packages(self.workspace) if self.workspace.is_dir() else []
        return tuple(read_package(one, self.workspace) for one in folders)

    def package(self, name: str) -> Package | None:
        """Return the package of a name, or None."""
        return next((one for one in self.packages if one.name == name), None)


def _commands(text: str) -> list[tuple[str, ...]]:
    found: list[tuple[str, ...]] = []
    for line in text.replace("\\\n", " ").splitlines():
        try:
            lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
            lexer.whitespace_split = True
            words = list(lexer)
        except ValueError:  # a quote is not closed
            words = line.split()
        found += _split(words)
    return found


def _split(words: list[str]) -> list[tuple[str, ...]]:
    found: list[list[str]] = [[]]
    for word in words:
        if word in _SEPARATORS:
            found.append([])
        else:
            found[-1].append(word)
    return [tuple(one) for one in found if one]


def _after_cd(place: Path, words: tuple[str, ...]) -> Path:
    """Where `cd` leads; nowhere else if there is no such folder, for then it failed."""
    home = steady_home() or Path.home()
    typed = words[1] if len(words) > 1 else "~"
    path = home / typed[1:].lstrip("/") if typed.split("/")[0] == "~" else place / typed
    return path.resolve() if path.is_dir() else place

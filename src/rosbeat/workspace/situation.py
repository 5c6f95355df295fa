"""Hold what is known after a command of a terminal has ended.

`Situation` splits what was typed into its commands, each with the folder that it ran in, and reads
the output and the packages of the workspace when somebody asks for them.
"""

from __future__ import annotations

import os
import re
import shlex
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from rosbeat.workspace.packages import Package, find_packages, read_package
from rosbeat.workspace.place import VARIABLE, steady_home

#: A program in Python: a script, or what `ros2 run` starts.
PYTHON = r"(?:\S*/)?python[\d.]*|\S*\.py|ros2 run"
_SEPARATORS = {";", "&&", "||", "|", "&"}
_SETTING = re.compile(r"[A-Za-z_]\w*=")
_TIME = re.compile(r"\d+(\.\d*)?[smhd]?")
_TRACEBACK = "Traceback (most recent call last)"
_ERROR = re.compile(r"^[A-Za-z_][\w.]*(?:Error|Exception|Interrupt|Exit)\b.*$", re.M)
_COLOUR = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


@dataclass(frozen=True)
class Call:
    """Hold one command of a line.

    Attributes:
        words: The program and its arguments.
        place: The folder it ran in.
    """

    words: tuple[str, ...]
    place: Path

    def after(self, option: str) -> list[str]:
        """Return the words behind an option, or an empty list if it was not given."""
        found = option in self.words
        return list(self.words[self.words.index(option) + 1 :]) if found else []


@dataclass(frozen=True)
class Situation:
    """Hold a command that has ended, and what can be seen of it.

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
        """Return the output without colours, with one kind of line end and one kind of quote."""
        plain = _COLOUR.sub("", self.output).replace("\r\n", "\n").replace("\r", "\n")
        return plain.replace("‘", "'").replace("’", "'")

    @cached_property
    def calls(self) -> tuple[Call, ...]:
        """Return the commands one by one, each with the folder that `cd` had led to."""
        place = self.folder
        found = []
        for words in _commands(self.command):
            found.append(Call(words, place))
            if words[0] == "cd":
                place = _after_cd(place, words, self.workspace)
        return tuple(found)

    def call(self, pattern: str) -> Call | None:
        r"""Return the last command whose first words match a regular expression, or None.

        Args:
            pattern: The expression, as in `ros2 run` or `python[\d.]*`; it ends with a word.
        """
        start = re.compile(rf"(?:{pattern})(?= |$)")
        return next((one for one in self.calls[::-1] if start.match(" ".join(one.words))), None)

    @cached_property
    def traceback(self) -> str:
        """Return what a program in Python shows of its error, or an empty text.

        The text of a traceback in a file that is only read does not count.
        """
        start = self.text.find(_TRACEBACK) if self.call(PYTHON) else -1
        return self.text[start:] if start >= 0 else ""

    @cached_property
    def error(self) -> str:
        """Return the last line of the traceback: the error's name and text."""
        lines = _ERROR.findall(self.traceback)
        return lines[-1] if lines else ""

    @property
    def about_ros(self) -> bool:
        """Whether the traceback is that of a node."""
        return bool(self.traceback) and (
            "rclpy" in self.traceback or self.call("ros2 run") is not None
        )

    @cached_property
    def packages(self) -> tuple[Package, ...]:
        """Return every package of the workspace."""
        folders = find_packages(self.workspace) if self.workspace.is_dir() else []
        return tuple(read_package(one, self.workspace) for one in folders)

    def package(self, name: str) -> Package | None:
        """Return the package of a name, or None."""
        return next((one for one in self.packages if one.name == name), None)


def home() -> Path:
    """Return the folder that a terminal calls `~`."""
    return steady_home() or Path.home()


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
    return [tuple(_from_the_program(one)) for one in found if one]


def _from_the_program(words: list[str]) -> list[str]:
    """Return the words without `NAME=value` or `timeout 5` in front: neither is the program."""
    start = next((at for at, word in enumerate(words) if not _SETTING.match(word)), 0)
    rest = words[start:]
    if rest[0] == "timeout":
        rest = rest[next((at for at, word in enumerate(rest) if _TIME.fullmatch(word)), -1) + 1 :]
    return rest or words


def _after_cd(place: Path, words: tuple[str, ...], workspace: Path) -> Path:
    """Return where `cd` leads: the same place if there is no such folder, for then it failed."""
    typed = words[1] if len(words) > 1 else "~"
    first, _, rest = typed.partition("/")
    known = {"~": home(), f"${VARIABLE}": workspace, f"${{{VARIABLE}}}": workspace}
    path = known[first] / rest.lstrip("/") if first in known else place / typed
    path = Path(os.path.normpath(path))  # `..` leads out of a folder that has gone, too
    return path.resolve() if path.is_dir() else place

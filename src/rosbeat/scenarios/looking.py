"""Scenarios that look: at a workspace, or at a terminal. Nothing of a learner's is run here."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rosbeat.errors import ExerciseError
from rosbeat.workspace.meanings import recognise
from rosbeat.workspace.packages import Package, find_packages, read_package

#: What colcon makes; it belongs to no exercise.
_BUILT = {"build", "install", "log", "kept"}
#: A line that was typed, behind its prompt.
_TYPED = re.compile(r"^(\S+)\$ (.+)$", re.MULTILINE)


@dataclass(frozen=True)
class Workspace:
    """What is in a workspace.

    Attributes:
        folders: Every folder, relative to the workspace, without what colcon makes.
        packages: Every package, wherever it lies.
    """

    folders: tuple[str, ...]
    packages: dict[str, Package]

    def place_of(self, name: str, root: str = "src") -> str:
        """Where a package lies that is not in `root`, or an empty text."""
        package = self.packages.get(name)
        parent = package.folder.parent.as_posix() if package else root
        return "" if parent == root else parent.replace(".", "the workspace itself")


@dataclass(frozen=True)
class CommandMeaning:
    """What a command's outcome means, as `workspace.meanings` recognised it on the spot.

    The files that a command was about are gone when the evidence is judged.

    Attributes:
        mistake: The mistake's id.
        evidence: What shows it.
        hint: What to try.
    """

    mistake: str
    evidence: str
    hint: str


@dataclass(frozen=True)
class TypedIn:
    """What was typed in a terminal, and where that led.

    Attributes:
        folder: The folder it is in, relative to the workspace; absolute if that is outside.
        commands: Each line that was typed, with the folder it was typed in, as the prompt said it.
        exit_code: Of the last command that ended.
        text: All that it shows.
        meaning: What a line that was typed has led to, if it is a known mistake.
    """

    folder: str
    commands: tuple[tuple[str, str], ...]
    exit_code: int | None
    text: str
    meaning: CommandMeaning | None = None


def look_at_workspace(answer: Any) -> Workspace:  # noqa: ANN401 - whatever a learner hands over
    """Look at a workspace.

    Args:
        answer: Its folder; `workspace.folder()` on a page.

    Raises:
        ExerciseError: If that is no folder.
    """
    # An empty text would be the folder of the notebook.
    root = Path(answer) if isinstance(answer, (str, Path)) and str(answer).strip() else None
    if root is None or not root.is_dir():
        raise ExerciseError(
            f"There is no workspace at {root or repr(answer)}.",
            "This check looks at the folders of your workspace.",
            "Write workspace.folder(), and run the cells above first: they make it.",
        )
    found = [_relative(read_package(folder, root), root) for folder in find_packages(root)]
    # Of two with one name, the one in src under that name counts; a backup has its name, too.
    packages = sorted(found, key=lambda one: one.folder.as_posix() == f"src/{one.name}")
    return Workspace(_folders(root), {package.name: package for package in packages})


def look_at_terminal(answer: Any, root: Path, about: str = "") -> TypedIn:  # noqa: ANN401
    """Look at a terminal of the page.

    Args:
        answer: The terminal; `workspace.terminal("one")` on a page.
        root: The workspace.
        about: What the line holds whose meaning is asked for; of several the last one. By default,
            and if there is none, it is the last line of all.

    Raises:
        ExerciseError: If that is no terminal.
    """
    if not all(hasattr(answer, name) for name in ("folder", "text", "exit_code")):
        raise ExerciseError(
            f"{answer!r} is not a terminal.",
            "This check looks at a terminal of the page.",
            'Write workspace.terminal("...") with the name of the terminal in the cell above.',
        )
    folder, text, code = Path(answer.folder), answer.text, answer.exit_code
    typed = list(_TYPED.finditer(text))
    at = max((at for at, one in enumerate(typed) if about in one[2]), default=len(typed) - 1)
    return TypedIn(
        _inside(folder, root),
        tuple((one[1], one[2]) for one in typed),
        code,
        text,
        _meaning(typed[at:], text, code, folder, root) if typed else None,
    )


def meaning_of(
    command: str, output: str, code: int, folder: Path, root: Path
) -> CommandMeaning | None:
    """Name the mistake behind a command's outcome, if it is one of the known ones.

    Args:
        command: What was typed.
        output: What the terminal showed.
        code: The exit code.
        folder: The folder in which the terminal was.
        root: The workspace; its files are looked at, and nothing is run.
    """
    found = recognise(command, output, code, folder, root)
    return CommandMeaning(found.mistake, found.evidence, found.hint) if found else None


def _meaning(
    lines: list[re.Match[str]], text: str, code: int | None, folder: Path, root: Path
) -> CommandMeaning | None:
    """What the first of some lines has led to. Of an earlier one the exit code is not known."""
    end = lines[1].start() if len(lines) > 1 else len(text)
    output = text[lines[0].end() : end]
    return meaning_of(lines[0][2], output, 1 if len(lines) > 1 else code or 0, folder, root)


def _folders(root: Path) -> tuple[str, ...]:
    found = (path.relative_to(root) for path in root.rglob("*") if path.is_dir())
    return tuple(sorted(path.as_posix() for path in found if path.parts[0] not in _BUILT))


def _relative(package: Package, root: Path) -> Package:
    return replace(package, folder=package.folder.relative_to(root))


def _inside(folder: Path, root: Path) -> str:
    folder, root = folder.resolve(), root.resolve()
    return folder.relative_to(root).as_posix() if root in (folder, *folder.parents) else str(folder)

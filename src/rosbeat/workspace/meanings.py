"""Explain the outcome of a command in a terminal, by the rules of `rosbeat.diagnosis.terminal`."""

from __future__ import annotations

from pathlib import Path

from rosbeat.diagnosis import terminal
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.packages import Package
from rosbeat.workspace.packages import find_packages, read_package
from rosbeat.workspace.place import steady_home


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
        folders = find_packages(workspace) if workspace.is_dir() else []
        return tuple(read_package(one, workspace) for one in folders)

    return terminal.Situation(command, output, code, folder, workspace, home, packages)

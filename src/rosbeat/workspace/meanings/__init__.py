"""What a command that failed means, and one that went wrong without saying so."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rosbeat.workspace.meanings import (
    building,
    creating,
    ending,
    folders,
    python_errors,
    running,
    shell,
    words,
)
from rosbeat.workspace.meanings.situation import Situation

__all__ = ["explain"]

#: One mistake, one function. The first that recognises a situation speaks.
_MEANINGS: tuple[Callable[[Situation], str | None], ...] = (
    folders.folder_gone,
    folders.cd_without_a_blank,
    shell.command_not_found,
    folders.mkdir_failed,
    folders.cd_failed,
    shell.chmod_failed,
    shell.script_missing,
    shell.source_failed,
    shell.not_executable,
    creating.options_missing,
    creating.commas_between_names,
    words.unknown_word,
    words.run_without_two_names,
    words.unknown_option,
    words.missing_word,
    creating.exists_already,
    creating.without_build_type,
    creating.bad_name,
    creating.in_the_wrong_folder,
    building.inside_src,
    building.unknown_package,
    building.twice_the_same,
    building.no_packages,
    building.setup_not_readable,
    building.parts_missing,
    building.wrong_entry_point,
    building.marker_missing,
    building.module_not_readable,
    running.package_not_found,
    running.no_executable,
    python_errors.no_rclpy,
    running.linked_since,
    running.wrong_target,
    ending.ended_twice,
    ending.not_caught,
    running.the_build_before,
    running.not_rebuilt,
    python_errors.in_a_node,
)


def explain(command: str, output: str, code: int, folder: Path, workspace: Path) -> str | None:
    """Say what a command's outcome means, if it is one of the known mistakes.

    Args:
        command: What was typed.
        output: What the terminal showed.
        code: The exit code.
        folder: The folder in which the terminal was.
        workspace: The learner's workspace; its files are looked at, and nothing is run.

    Returns:
        Two or three sentences, what it means and what to try; None if nothing is known for sure.
    """
    seen = Situation(command, output, code, folder, workspace)
    for meaning in _MEANINGS:
        with suppress(OSError):  # the workspace changes while it is looked at
            words_for_it = meaning(seen)
            if words_for_it:
                return words_for_it
    return None

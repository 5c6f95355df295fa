"""What a command that failed means, and one that went wrong without saying so."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rosbeat.diagnosis.mistakes import Diagnosis
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

__all__ = ["explain", "recognise"]

#: One mistake, one function. The first that recognises a situation speaks.
_MEANINGS: tuple[Callable[[Situation], Diagnosis | None], ...] = (
    folders.folder_gone,
    folders.cd_without_a_blank,
    shell.setup_run,
    shell.command_not_found,
    folders.mkdir_failed,
    shell.mkdir_misused,
    folders.cd_with_backslashes,
    folders.cd_failed,
    folders.cd_with_a_blank_too_many,
    folders.cd_to_a_file,
    shell.chmod_failed,
    shell.chmod_misused,
    shell.rm_of_a_folder,
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
    creating.another_build_type,
    creating.bad_name,
    creating.inside_a_package,
    creating.in_the_wrong_folder,
    building.inside_src,
    building.unknown_package,
    building.twice_the_same,
    building.no_packages,
    building.another_kind,
    building.setup_not_readable,
    building.setup_not_called,
    building.parts_missing,
    building.wrong_entry_point,
    building.nothing_to_install,
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
_ASKED = re.compile(r"Did you mean:? '([^']+)'")
_PROPOSAL = re.compile(r"Did you mean `?([\w.-]+)`?\?")
_LISTED = "' has: "
#: Mistakes with a word of the command itself: the course's `ros2` often proposes the right one.
_ABOUT_A_WORD = (
    "executable-misspelled",
    "package-misspelled",
    "word-misspelled",
    "option-misspelled",
    "build-type",
)


def recognise(
    command: str, output: str, code: int, folder: Path, workspace: Path
) -> Diagnosis | None:
    """Name the mistake behind a command's outcome, if it is one of the known ones.

    Args:
        command: What was typed.
        output: What the terminal showed.
        code: The exit code.
        folder: The folder in which the terminal was.
        workspace: The learner's workspace; its files are looked at, and nothing is run.

    Returns:
        The mistake, what shows it and what to try; None if nothing is known for sure.
    """
    return _recognised(Situation(command, output, code, folder, workspace))


def explain(command: str, output: str, code: int, folder: Path, workspace: Path) -> str | None:
    """Say what a command's outcome means, if it is one of the known mistakes.

    Args:
        command: What was typed.
        output: What the terminal showed.
        code: The exit code.
        folder: The folder in which the terminal was.
        workspace: The learner's workspace; its files are looked at, and nothing is run.

    Returns:
        Two or three sentences, what it means and what to try; None if nothing is known for sure,
        or if the output says the same itself.
    """
    seen = Situation(command, output, code, folder, workspace)
    found = _recognised(seen)
    if found is None or _says_it_itself(seen, found):
        return None
    return " ".join(text for text in (found.evidence, found.hint) if text)


def _recognised(seen: Situation) -> Diagnosis | None:
    for meaning in _MEANINGS:
        with suppress(OSError):  # the workspace changes while it is looked at
            found = meaning(seen)
            if found:
                return found
    return None


def _says_it_itself(seen: Situation, found: Diagnosis) -> bool:
    """Whether the program itself has said already what we would say."""
    if creating.INSIDE in seen.text:
        return found.mistake == "wrong-folder"
    if found.mistake not in _ABOUT_A_WORD:
        return False
    if not (match := _PROPOSAL.match(found.hint)):
        return _LISTED in seen.text and found.hint.startswith("It has: ")
    return match[1] in _ASKED.findall(seen.text)

"""Page 01, create a workspace: a folder in a folder, and a way from here to there."""

from __future__ import annotations

import posixpath
import re
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.terminal import commands_in
from rosbeat.exercises.exercise import Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.model import Suspect, name_mistake
from rosbeat.exercises.scenarios import (
    Answer,
    CommandMeaning,
    TypedIn,
    Workspace,
    look_at_terminal,
    look_at_workspace,
    typed_about,
)
from rosbeat.exercises.workspace_model import alike, diagnosis_of, in_workspace
from rosbeat.workspace.location import NAME, workspace
from rosbeat.workspace.prerequisites import FOLDERS

#: Returns the words of each command in a line; a backslash stays to be seen.
_commands = partial(commands_in, escape="")

# 01a, a folder in a folder: what is in the workspace, and what was typed to make it.

_ALARM, _PARENT, _CHILD = "resources/sounds/alarm", "sounds", "alarm"
_RUNS_THROUGH = "resources/sounds"
#: What the page's own cells make; whoever makes something else has tried.
_OF_THE_PAGE = {
    *("-p", "$ROS2_WORKSPACE", "src", "docs", "scripts", "resources/images"),
    *("resources/maps/kitchen", f"/Documents/{NAME}/"),
}
#: Commands that make no folder.
_LOOKING = {"ls", "cd", "pwd", "cat", "find", "tree", "stat", "echo", "rm", "rmdir"}


@dataclass(frozen=True)
class FolderMaking:
    """Record the folders of a workspace, and the lines that were typed to make one of them.

    Attributes:
        workspace: What is in the workspace.
        obstacle: What is where the folder was asked for, if it is none: `a link`, `a file`, `behind
            a link` or empty.
        is_older: Whether the folder that was asked for has been there longer than this page runs.
        tried: Each line about that folder, and each that makes another one than the page does,
            with the folder it was typed in, as the prompt said it. Empty where a page has no
            terminals.
        meaning: What the last of these lines has led to, if it is a known mistake.
    """

    workspace: Workspace
    obstacle: str = ""
    is_older: bool = False
    tried: tuple[tuple[str, str], ...] = ()
    meaning: CommandMeaning | None = None


#: This module is imported by the first cell of a page.
_PAGE_BEGAN = time.time()


def _look_at_making(answer: Answer) -> FolderMaking:
    found, root = look_at_workspace(answer), Path(answer)
    tried, meaning = typed_about(root, _is_try)
    place = root / _ALARM
    obstacle = "a link" if place.is_symlink() else "a file" if place.is_file() else ""
    if (root / _RUNS_THROUGH).is_symlink():
        obstacle = "behind a link"
    is_older = place.is_dir() and place.stat().st_mtime < _PAGE_BEGAN
    return FolderMaking(found, obstacle, is_older, tried, meaning)


def _is_about(line: str) -> bool:
    commands = _commands(line)
    near = any(_is_near(word) for words in commands for word in words)
    return near and any(words[0] not in _LOOKING for words in commands)


def _is_try(line: str) -> bool:
    return _is_about(line) or any(
        alike(words[0], "mkdir") and not _OF_THE_PAGE.issuperset(words[1:] or ["nothing"])
        for words in _commands(line)
    )


def _made_by(place: str, line: str) -> set[str] | None:
    """Return the folders that a line is to make, relative to the workspace, by simulating `mkdir`.

    Args:
        place: Where it was typed, as the prompt said it.
        line: The line.

    Returns:
        None if only a shell could tell, or the line does something else.
    """
    words = next(iter(_commands(line)), [""])
    _, inside, below = f"{place}/".partition(f"{NAME}/")
    plain = not re.search(r"[^\w\s./'\"-]", line) and words[0] == "mkdir" and inside
    options = {one for one in words if one.startswith("-")}
    if not plain or options - {"-p", "-v", "-pv", "-vp", "--parents", "--verbose"}:
        return None
    return {posixpath.normpath(posixpath.join(below, one)) for one in words[1:]
            if one not in options}  # fmt: skip


def _judge_folder(seen: FolderMaking) -> Verdict:
    simulated = [_made_by(*one) for one in seen.tried if _is_about(one[1])]
    certain = [one for paths in simulated if paths is not None for one in paths]
    # Of a folder from before, what was typed now counts, if it is certain what that makes.
    is_old = seen.is_older and bool(simulated) and None not in simulated
    is_old = is_old and not any(f"{one}/".startswith(f"{_ALARM}/") for one in certain)
    if _ALARM in seen.workspace.folders and not is_old:
        return passed(f"{_ALARM} is there.")
    typed = {one for one in (simulated[-1] or () if simulated else ()) if _is_near(one)}
    there = {one for one in seen.workspace.folders if _is_near(one) and one != _ALARM}
    known = diagnosis_of(seen.meaning)
    if seen.obstacle:
        # Behind a link, the link is what has to go.
        path = _RUNS_THROUGH if "behind" in seen.obstacle else _ALARM
        said = (
            f"{_ALARM} is {seen.obstacle}, and a folder of this workspace was asked for. "
            f"`rm {in_workspace(path)}` removes it."
        )
        hint = "Remove it, and make the folder with `mkdir`: it makes a new, empty one."
        return Diagnosis("not-a-folder", said, hint)
    if known and known.mistake != "folder-exists":  # which is no mistake here
        hint = _PWD if _ALARM in known.hint else known.hint
        return Diagnosis(known.mistake, known.evidence, hint)
    if typed or there:
        return _diagnose_making(typed, there, seen)
    if not seen.tried:
        return not_attempted(f"There is no folder {_ALARM} yet.")
    said = f"You typed `{seen.tried[-1][1]}`, and there is no folder {_ALARM} in the workspace."
    if set(seen.workspace.folders).intersection(_made_by(*seen.tried[-1]) or ()):
        return Diagnosis("wrong-folder", said, "Compare the path with the one that is asked for.")
    if _commands(seen.tried[-1][1])[-1][0] == "touch":
        return Diagnosis("not-a-folder", said, "touch makes empty files. What makes folders?")
    return Diagnosis(UNKNOWN, said, _PWD)


def _is_near(folder: str) -> bool:
    names = folder.lower().replace("\\", "/").split("/")
    known = any(alike(name, goal) for name in names for goal in (_PARENT, _CHILD))
    return known or _BOTH in _letters(folder)


def _letters(path: str) -> str:
    """Return the letters and digits of a path, small: what is left if no sign between counts."""
    return "".join(sign for sign in path.lower() if sign.isalnum())


_BOTH = _PARENT + _CHILD
_PWD = "A relative path starts from the terminal's current folder; pwd prints it."
_ONE_LEVEL = "One level is missing. A path can contain several folders: outer/inner."
_BETWEEN = "One level is missing: which folder is between the two?"
_SIDE_BY_SIDE = (
    "Names with a space between them become folders side by side; `/` puts one inside the other. A "
    "relative path begins where the terminal is."
)
_OUTER_FIRST = "Write the outer folder first, then the one inside it."


def _makes(mistake: str, hint: str, *paths: str) -> Suspect:
    """Return a suspect who makes these folders, and what is around them."""
    return Suspect(mistake, hint, lambda _: dict.fromkeys(paths, ("made",)))


#: Those who make most come first: of what they make, others make a part.
_SUSPECTS = (
    *(
        _makes("folders-side-by-side", _SIDE_BY_SIDE, parent, child)
        for parent, child in (
            (_PARENT, _CHILD),
            (_RUNS_THROUGH, _CHILD),
            *((f"{place}/{_PARENT}", f"{place}/{_CHILD}") for place in ("resources", *FOLDERS)),
        )
    ),
    _makes("levels-miscounted", _ONE_LEVEL, _RUNS_THROUGH),
    _makes("levels-miscounted", _BETWEEN, f"resources/{_CHILD}"),
    *(
        _makes("folders-swapped", _OUTER_FIRST, posixpath.join(place, _CHILD, _PARENT))
        for place in ("", "resources", *FOLDERS)
    ),
)


def _diagnose_making(typed: set[str], there: set[str], seen: FolderMaking) -> Diagnosis:
    """Return what is wrong with folders that are nearly the right one.

    Args:
        typed: Those that the last line was to make, as far as that can be simulated.
        there: Those that are in the workspace.
        seen: The evidence.
    """
    near = max(typed or there, key=_nearness)
    if near == _ALARM and _ALARM not in seen.workspace.folders:
        said = f"What you typed makes {_ALARM}, and it is not there any more."
        return Diagnosis(
            UNKNOWN, said, "What did you type after that? Create the folder once more."
        )
    if near.startswith("/"):
        said = f"{near} starts with `/`, the root of the file system: it isn't in your workspace."
        return Diagnosis("tilde-missing", said, _PWD)
    evidence = f"There is {near}, but not {_ALARM}."
    if near not in there:  # where a learner may create it, or outside the workspace
        evidence = f"What you typed names {near}. The workspace has no {_ALARM}."
    if _ALARM in seen.workspace.folders:
        evidence = f"What you typed makes {near}. {_ALARM} is there from before."
    # Only what a suspect makes counts: a workspace keeps what was tried before, too.
    fit = [one for one in _SUSPECTS if near in one.model(None) and one.model(None).keys() <= there]
    found = name_mistake(fit[:1], Diagnosis(*_of_spelling(near, evidence)))
    return Diagnosis(found.mistake, evidence, found.hint)


def _of_spelling(near: str, evidence: str) -> tuple[str, str, str]:
    """Return the mistake in a path that no suspect makes; how it is spelled cannot be listed."""
    if "\\" in near or _BOTH in _letters(near.rpartition("/")[2]):
        hint = "On Linux, paths always use `/` between two names."
        return "path-separator", evidence, hint
    for wanted in (_ALARM, _RUNS_THROUGH):
        parts, goals = near.split("/"), wanted.split("/")
        unlike = sum(not alike(part, goal) for part, goal in zip(parts, goals, strict=False))
        if len(parts) == len(goals) and unlike <= (wanted == _ALARM and parts[0] == goals[0]):
            hint = "Compare the path letter by letter, including capital letters."
            return "path-misspelled", evidence, hint
    return "wrong-folder", evidence, _PWD


def _nearness(folder: str) -> tuple[int, bool, int, str]:
    """Return how near a folder is to the right one: an old slip must not hide a better try."""
    parts = folder.split("/")
    close = sum(any(alike(part, goal) for part in parts) for goal in _ALARM.split("/"))
    return close, _letters(folder) == _letters(_ALARM), folder.count("/"), folder


# 01b, from here to there: where a terminal is, and what was typed on the way.

_START, _GOAL = "resources/images", "src"


def _look_at_way(answer: Answer) -> TypedIn:
    return look_at_terminal(answer, workspace())


def _judge_way(seen: TypedIn) -> Verdict:
    tried = _tried(seen)
    place = "the workspace itself" if seen.folder == "." else seen.folder
    if seen.folder == _GOAL:
        # What was typed before the line that left the start did not lead away.
        left = max((at for at, (place, _) in enumerate(tried) if place.endswith(_START)), default=0)
        texts = [text for _, text in tried]
        return _judge_kind_of_path(texts[left:], _variables(texts))
    if not tried and seen.folder == _START:
        return not_attempted(f"The terminal is still in {_START}.")
    if not tried:
        said = f"The terminal is in {place}, and no way from {_START} has been typed yet."
        return not_attempted(said)
    words = [words for _, text in tried for words in _commands(text)] or [[""]]
    mistake, hint = _of_words(words[-1], seen.folder)
    evidence = f"The terminal is in {place} now, and {_GOAL} was the goal."
    return Diagnosis(mistake, evidence, hint)


def _tried(seen: TypedIn) -> list[tuple[str, str]]:
    """Return what was typed since the terminal came to the folder where the exercise begins."""
    starts = [at for at, (place, _) in enumerate(seen.commands) if place.endswith(_START)]
    first = next((at for at in reversed(starts) if at - 1 not in starts), len(seen.commands))
    # `pwd` only looks, and the page's own line goes to the start.
    return [
        (place, text)
        for place, text in seen.commands[first:]
        if text.strip() != "pwd" and not text.rstrip(" \"'/").endswith(_START)
    ]


def _variables(lines: list[str]) -> dict[str, str]:
    """Return the variables that the lines set, such as `UP=../..`, by name."""
    words = [words[0] for line in lines for words in _commands(line) if len(words) == 1]
    return dict(word.split("=", 1) for word in words if re.match(r"[A-Za-z_]\w*=", word))


def _judge_kind_of_path(lines: list[str], variables: Mapping[str, str]) -> Verdict:
    def filled(word: str) -> str:
        return re.sub(r"\$\{?(\w+)\}?", lambda found: variables.get(found[1], found[0]), word)

    went = [
        [filled(word) for word in words[1:]]
        for line in lines
        for words in _commands(line)
        if words[0] in ("cd", "pushd")
    ]
    if any(_is_absolute(words) for words in went):
        evidence = f"The terminal is in {_GOAL}, by an absolute path."
        return Diagnosis("absolute-path", evidence, _RELATIVE)
    if len(went) > 1:
        said = f"You went in {len(went)} steps. One path may name all of them, joined with `/`."
        return passed(f"The terminal is in {_GOAL}.", said)
    return passed(f"The terminal is in {_GOAL}.")


def _is_absolute(words: Sequence[str]) -> bool:
    """Return whether `cd` with these words leads to the same place from everywhere."""
    path = next((word for word in words if not word.startswith("-")), "")
    return not path or path.startswith(("/", "~", "$"))


_UPWARDS = (
    f"From {_START}, two folders up is the workspace. `..` is one folder up, and paths are "
    "joined with `/`. The first line of the cell goes back to the start each time."
)
_RELATIVE = (
    "A relative path begins where you are, with `..` for one folder up. It still works "
    f"when somebody else has {NAME} in another place."
)


def _of_words(words: list[str], folder: str) -> tuple[str, str]:
    """Return the mistake in a command that did not lead to the goal, and a hint.

    The command itself shows it: only its path is simulated, as there may be any other in it.

    Args:
        words: The command.
        folder: Where the terminal is now.
    """
    first, rest = words[0], words[1:]
    if first == "(":
        hint = "Parentheses run a command in a shell of its own: this terminal stays where it is."
        return "wrong-folder", hint
    if first.startswith("cd") and first[2:3] in tuple("./~\\"):
        return "space-missing", "Put a space between `cd` and the path."
    if "\\" in " ".join(words):
        return "path-separator", "On Linux, paths always use `/` between two names."
    if first.startswith((".", "/")):
        return "word-missing", ("A path alone isn't a command. Which command changes the folder?")
    if first not in ("cd", "pushd"):
        return ("command-misspelled" if alike(first, "cd") else UNKNOWN), _UPWARDS
    if not rest:
        return "word-missing", "`cd` alone goes to your home folder. Write the path behind it."
    if rest[0] == first:
        return "word-misspelled", f"`{first}` stands there twice. Once is enough."
    if len(rest) > 1 and not rest[0].startswith("-"):
        hint = "`cd` takes one path: `/` joins its parts, with no spaces between them."
        return "space-too-many", hint
    if _is_absolute(rest):
        return "absolute-path", _RELATIVE
    # Where the path leads from the start, whether there is such a folder or not.
    goal = posixpath.normpath(posixpath.join(_START, rest[-1]))
    name = goal.rpartition("/")[2]
    if name == _GOAL or goal in (".", "..", "resources") or goal.strip("./") == "":
        return "levels-miscounted", _UPWARDS
    if goal != _GOAL and alike(name, _GOAL) and folder == _START:
        return "path-misspelled", "Compare the name letter by letter, including capital letters."
    return ("folder-not-found" if folder == _START else "wrong-folder"), _UPWARDS


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("01a", _look_at_making, _judge_folder, title="a folder in a folder", hints=(
        "One `mkdir` can create several folders, one inside another.",
        "In a path, `/` separates the outer folder from the one inside it.",
        "If a parent folder is missing, too, you need the option that is short for parents.",
    )),
    Exercise("01b", _look_at_way, _judge_way, title="from here to there", hints=(
        "`..` is the folder that contains the current one.",
        f"Count the levels from {_START} up to the workspace.",
        "Go up that many levels and then down into the folder you want, all in one path.",
    )),
)  # fmt: skip

"""Page 01, create a workspace: a folder in a folder, and a way from here to there."""

from __future__ import annotations

from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.exercise import Exercise, failed, failed_by, not_attempted, passed
from rosbeat.exercises.page_01_scenarios import SCENARIOS
from rosbeat.exercises.paths import (
    alike,
    closeness,
    commands,
    is_absolute,
    led_to,
    letters,
    misspelled,
    moves,
)
from rosbeat.exercises.scenarios import TypedIn, Workspace
from rosbeat.records import Outcome
from rosbeat.workspace.place import NAME
from rosbeat.workspace.stages import FOLDERS

_WANTED, _PARENT, _CHILD = "resources/sounds/alarm", "sounds", "alarm"
_START, _GOAL = "resources/images", "src"


def _judge_folder(seen: Workspace) -> Outcome:
    if _WANTED in seen.folders:
        return passed("01a", f"{_WANTED} is there.")
    near = [one for one in seen.folders if _is_near(one)]
    if not near:
        return not_attempted("01a", f"There is no folder {_WANTED} yet.")
    nearest = max(near, key=_fitness)
    mistake, hint = _what_is_wrong(nearest, set(seen.folders))
    evidence = f"There is {nearest}, but not {_WANTED}."
    return failed("01a", evidence, hint + _on_what_is_left(near, seen), mistake)


def _fitness(folder: str) -> tuple[int, bool, int, str]:
    """How near a folder is to the right one: a slip of long ago must not hide a better try."""
    same = letters(folder) == letters(_WANTED)
    return closeness(folder, _WANTED), same, folder.count("/"), folder


def _on_what_is_left(near: list[str], seen: Workspace) -> str:
    """How to be rid of folders that lead nowhere; none that was there before, nor a package's."""
    packages = [package.folder.as_posix() for package in seen.packages.values()]
    astray = sorted({_astray(one) for one in near} - {""})
    left = [one for one in astray if not any(f"{one}/" in f"{here}/" for here in packages)]
    if not left:
        return ""
    named = " and ".join(_named(one) for one in left)
    return (
        f" You do not need {named}: `rmdir` removes an empty folder, and `rm -r` one with all "
        "that is in it."
    )


def _named(folder: str) -> str:
    """A folder in words: as a path, it may have the one in it that is asked for."""
    place, _, name = folder.rpartition("/")
    return f"{name} in {place}" if place else name


def _astray(folder: str) -> str:
    """The outermost part of a path that is neither of the page nor on the way to the goal."""
    names = folder.split("/")
    outer = ["/".join(names[: at + 1]) for at in range(len(names))]
    known = (*FOLDERS, "resources", f"resources/{_PARENT}")
    return next((one for one in outer if one not in known), "")


def _is_near(folder: str) -> bool:
    names = folder.lower().replace("\\", "/").split("/")
    known = any(alike(name, goal) for name in names for goal in (_PARENT, _CHILD))
    return known or letters(folder) == letters(_WANTED) or letters(names[-1]) == _BOTH


_BOTH = _PARENT + _CHILD
_PWD = "A relative path begins where the terminal is. pwd says where that is."


def _what_is_wrong(near: str, folders: set[str]) -> tuple[str, str]:
    """The mistake behind a folder that is nearly the right one, and a hint."""
    last = near.rpartition("/")[2]
    if "\\" in near or letters(last) in (_BOTH, letters(_WANTED)):
        return "path-separator", "Paths use `/` between two names, on Linux everywhere."
    if misspelled(near, _WANTED) or misspelled(near, f"resources/{_PARENT}"):
        return "path-misspelled", "Compare the path letter by letter; capital letters count, too."
    if near == f"resources/{_PARENT}" and not {_CHILD, f"resources/{_CHILD}"} & folders:
        return (
            "levels-miscounted",
            "One level is missing. A path may name several folders: outer/inner.",
        )
    return _misplaced(near, folders)


def _misplaced(near: str, folders: set[str]) -> tuple[str, str]:
    if near.endswith(f"{_CHILD}/{_PARENT}"):
        return "folders-swapped", "The outer folder comes first, then the one that is in it."
    siblings = {near.rpartition("/")[0] + one for one in (f"/{_PARENT}", f"/{_CHILD}")}
    split = _CHILD in folders and {_PARENT, f"resources/{_PARENT}"} & folders
    if split or siblings <= folders:
        return (
            "folders-side-by-side",
            "Names with a blank between them become folders side by side; `/` puts one inside the "
            "other. A relative path begins where the terminal is.",
        )
    if near == f"resources/{_CHILD}":
        return "levels-miscounted", "One level is missing: what lies between the two?"
    return "wrong-folder", _PWD


def _judge_way(seen: TypedIn) -> Outcome:
    tried = _tried(seen)
    if seen.folder == _GOAL:
        return _judge_kind_of_path(moves(_that_led_away(tried)))
    if not tried:
        return not_attempted("01b", _of_no_way(seen.folder))
    return failed_by("01b", _of_a_way(seen, [text for _, text in tried]))


def _of_no_way(folder: str) -> str:
    if folder == _START:
        return f"The terminal is still in {_START}."
    return f"The terminal is in {_place(folder)}, and no way from {_START} has been typed yet."


def _tried(seen: TypedIn) -> list[tuple[str, str]]:
    """What was typed since the terminal came to the folder where the exercise begins."""
    starts = [at for at, (place, _) in enumerate(seen.commands) if place.endswith(_START)]
    first = next((at for at in reversed(starts) if at - 1 not in starts), len(seen.commands))
    return [(place, text) for place, text in seen.commands[first:] if not _is_no_try(text)]


def _is_no_try(line: str) -> bool:
    """Whether a line only looks, or is the one of the page that goes to the start."""
    return line.strip() == "pwd" or line.rstrip(" \"'/").endswith(_START)


def _that_led_away(tried: list[tuple[str, str]]) -> list[str]:
    """The lines from the one that left the start: what was typed before it did not lead away."""
    last = max((at for at, (place, _) in enumerate(tried) if place.endswith(_START)), default=0)
    return [text for _, text in tried[last:]]


def _place(folder: str) -> str:
    return "the workspace itself" if folder == "." else folder


_UPWARDS = (
    f"From {_START}, two folders up is the workspace. `..` is one folder up, and paths are "
    "joined with `/`. Run the cell above first: it goes back to the start."
)
_RELATIVE = (
    "A relative path begins where you are, with `..` for one folder up. It still works "
    f"when somebody else has {NAME} in another place."
)


def _of_a_way(seen: TypedIn, tried: list[str]) -> Diagnosis:
    words = (commands(tried) or [[""]])[-1]
    evidence = f"The terminal is in {_place(seen.folder)} now, and {_GOAL} was the goal."
    mistake, hint = _of_words(words, seen.folder)
    return Diagnosis(mistake, evidence, hint)


def _of_words(words: list[str], folder: str) -> tuple[str, str]:
    """The mistake in a command that did not lead to the goal, and a hint."""
    first, rest = words[0], words[1:]
    if first.startswith("cd") and first[2:3] in tuple("./~\\"):
        return "space-missing", "A blank belongs between `cd` and the path."
    if "\\" in " ".join(words):
        return "path-separator", "Paths use `/` between two names, on Linux everywhere."
    if first not in ("cd", "pushd"):
        return ("command-misspelled" if alike(first, "cd") else UNKNOWN), _UPWARDS
    if len(rest) > 1 and not rest[0].startswith("-"):
        return "space-too-many", "A path has no blank in it: `/` joins its parts."
    if is_absolute(rest):
        return "absolute-path", _RELATIVE
    return _of_path(rest[-1], folder)


def _of_path(path: str, folder: str) -> tuple[str, str]:
    goal = led_to(_START, path)
    name = goal.rpartition("/")[2]
    if name == _GOAL or goal in (".", "..", "resources") or goal.strip("./") == "":
        return "levels-miscounted", _UPWARDS
    if goal != _GOAL and alike(name, _GOAL) and folder == _START:
        return "path-misspelled", "Compare the name letter by letter; capital letters count, too."
    if folder != _START:
        return "wrong-folder", _UPWARDS
    return "folder-not-found", _UPWARDS


def _judge_kind_of_path(went: list[list[str]]) -> Outcome:
    if any(is_absolute(words) for words in went):
        evidence = f"The terminal is in {_GOAL}, by an absolute path."
        return failed("01b", evidence, _RELATIVE, "absolute-path")
    if len(went) > 1:
        said = f"You went in {len(went)} steps. One path may name all of them, joined with `/`."
        return passed("01b", f"The terminal is in {_GOAL}.", said)
    return passed("01b", f"The terminal is in {_GOAL}.")


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "01a",
        SCENARIOS["01a"],
        _judge_folder,
        title="a folder in a folder",
        points=1,
        hints=(
            "One `mkdir` may make several folders, one in another.",
            "In a path, `/` stands between the outer folder and the one in it.",
            "A folder in between that is missing, too, needs the option that stands for parents.",
        ),
    ),
    Exercise(
        "01b",
        SCENARIOS["01b"],
        _judge_way,
        title="from here to there",
        points=1,
        hints=(
            "`..` stands for the folder around the one where you are.",
            f"Count the levels from {_START} up to the workspace.",
            "Go up as often as that, and then down into the folder that you want, in one path.",
        ),
    ),
)

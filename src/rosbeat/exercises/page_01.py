"""Page 01, create a workspace: a folder in a folder, and a way from here to there."""

from __future__ import annotations

from typing import Any

from rosbeat.checks.verdicts import failed, not_attempted, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.looking import TypedIn, Workspace, look_at_terminal, look_at_workspace
from rosbeat.records import Outcome
from rosbeat.workspace.place import NAME, workspace

_WANTED, _PARENT, _CHILD = "resources/sounds/alarm", "sounds", "alarm"
_START, _GOAL = "resources/images", "src"


def _judge_folder(seen: Workspace) -> Outcome:
    if _WANTED in seen.folders:
        return passed("01a", f"{_WANTED} is there.")
    near = [one for one in seen.folders if {_PARENT, _CHILD} & set(_names(one))]
    if not near:
        return not_attempted("01a", f"There is no folder {_WANTED} yet.")
    deepest = max(near, key=lambda one: (one.count("/"), one))
    return failed("01a", f"There is {deepest}, but not {_WANTED}.", _folder_hint(deepest))


def _names(folder: str) -> list[str]:
    return folder.lower().replace("\\", "/").split("/")


def _folder_hint(near: str) -> str:
    if "\\" in near:
        return "Paths use `/` between two names, on Linux everywhere."
    if near == f"resources/{_PARENT}":
        return "One level is missing. A path may name several folders: outer/inner."
    if near in (_PARENT, _CHILD):
        return (
            "Names with a blank between them become folders side by side; `/` puts one inside the "
            "other. A relative path begins where the terminal is."
        )
    if near.startswith("resources/"):
        return "Compare the path letter by letter; capital letters count, too."
    return "A relative path begins where the terminal is. pwd says where that is."


def _in_terminal(answer: Any) -> TypedIn:  # noqa: ANN401 - whatever a learner hands over
    return look_at_terminal(answer, workspace())


def _judge_way(seen: TypedIn) -> Outcome:
    tried = [text for place, text in seen.commands if place.endswith(_START) and text != "pwd"]
    if seen.folder == _GOAL:
        return _judge_kind_of_path(tried)
    if seen.folder == _START and not tried:
        return not_attempted("01b", f"The terminal is still in {_START}.")
    return failed(
        "01b",
        f"The terminal is in {_place(seen.folder)} now, and {_GOAL} was the goal.",
        f"From {_START}, two folders up is the workspace. `..` is one folder up, and paths are "
        "joined with `/`. Run the cell above first: it goes back to the start.",
    )


def _place(folder: str) -> str:
    return "the workspace itself" if folder == "." else folder


def _judge_kind_of_path(tried: list[str]) -> Outcome:
    last = tried[-1] if tried else ""
    if last.removeprefix("cd").strip(" \"'").startswith(("/", "~", "$")):
        return failed(
            "01b",
            f"The terminal is in {_GOAL}, by an absolute path.",
            "A relative path begins where you are, with `..` for one folder up. It still works "
            f"when somebody else has {NAME} in another place.",
        )
    return passed("01b", f"The terminal is in {_GOAL}.")


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("01a", look_at_workspace, _judge_folder),
    Exercise("01b", _in_terminal, _judge_way),
)

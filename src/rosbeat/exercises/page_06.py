"""Page 06, build, source, run: a second monitor by another name, and links instead of copies."""

from __future__ import annotations

import re
from typing import Any

from rosbeat.checks.verdicts import failed, not_attempted, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.looking import TypedIn, Workspace, look_at_terminal, look_at_workspace
from rosbeat.records import Outcome
from rosbeat.workspace.place import workspace

_NAME = "second_monitor"
#: As ROS prints a log line, with a stamp or without: [INFO] [1732212345.123] [name]: text.
_LOG_NAME = re.compile(r"^\[[A-Z]+\] (?:\[[\d.]+\] )?\[([\w./]+)\]: ", re.MULTILINE)
_PACKAGE = "sensor_simulator"


def _in_terminal(answer: Any) -> TypedIn:  # noqa: ANN401 - whatever a learner hands over
    return look_at_terminal(answer, workspace())


def _judge_monitor(seen: TypedIn) -> Outcome:
    runs = [text for _, text in seen.commands if "ros2 run" in text]
    if not runs:
        return not_attempted("06a", "Nothing was run in this terminal yet.")
    names = _names_since(seen.text, runs[-1])
    return _judge_names(names, seen.text.rpartition(runs[-1])[2], runs[-1])


def _names_since(text: str, command: str) -> set[str]:
    """The nodes that have logged since a command was typed for the last time."""
    return set(_LOG_NAME.findall(text.rpartition(command)[2]))


def _judge_names(names: set[str], text: str, command: str) -> Outcome:
    if _NAME in names and f"[{_NAME}]: Temperature:" in text:
        return passed("06a", f"{_NAME} hears what the first monitor hears.")
    if _NAME in names:
        return failed("06a", f"{_NAME} runs and has heard nothing.", _IS_THE_SENSOR_THERE)
    if names:
        found = ", ".join(sorted(names))
        return failed("06a", f"The node that runs here is called {found}.", _RENAME)
    return failed("06a", f"No node has started here. The last line typed: {command}", _WHICH)


_IS_THE_SENSOR_THERE = (
    "Is it the temperature_subscriber, and is the sensor still running in its own terminal? "
    "Look there with %terminal sensor."
)
_RENAME = f"After `--ros-args` comes `-r __node:={_NAME}`, with two underscores before `node`."
_WHICH = "After ros2 run come two names: the package, and the executable from setup.py."


def _judge_links(seen: Workspace) -> Outcome:
    package = seen.packages.get(_PACKAGE)
    installed = package.installed if package else None
    if installed is None:
        return not_attempted("06b", f"{_PACKAGE} is not built yet.")
    if not installed.linked:
        return not_attempted("06b", f"{_PACKAGE} is installed as a copy so far.")
    return passed("06b", f"{_PACKAGE} is installed as a link to src.")


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("06a", _in_terminal, _judge_monitor),
    Exercise("06b", look_at_workspace, _judge_links),
)

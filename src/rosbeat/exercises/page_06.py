"""Page 06, build, source, run: a second monitor by another name, and links instead of copies."""

from __future__ import annotations

import re
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.exercises.entries import diagnose_name, diagnose_script
from rosbeat.exercises.exercise import Exercise, failed_by, not_attempted, passed
from rosbeat.exercises.meanings import diagnosis_of
from rosbeat.exercises.page_06_scenarios import RUN, SCENARIOS
from rosbeat.exercises.paths import alike
from rosbeat.exercises.scenarios import TypedIn, Workspace
from rosbeat.records import Outcome
from rosbeat.workspace.meanings.flaws import diagnose_flaw
from rosbeat.workspace.packages import Package

_NAME = "second_monitor"
#: As ROS prints a log line, with a stamp or without: [INFO] [1732212345.123] [name]: text.
_LOG = re.compile(r"^\[[A-Z]+\] (?:\[[\d.]+\] )?\[([\w./]+)\]: (.*)", re.MULTILINE)
_PACKAGE = "sensor_simulator"
_SENSOR = "Publishing"


def _judge_monitor(seen: TypedIn) -> Outcome:
    runs = [text for _, text in seen.commands if RUN in text]
    if not runs:
        return _judge_other_commands(seen)
    # What the nodes have said since a command was typed for the last time.
    said = _LOG.findall(seen.text.rpartition(runs[-1])[2])
    of_the_second = [text for name, text in said if name == _NAME]
    if any(re.search(r"\d", text) and not text.startswith(_SENSOR) for text in of_the_second):
        return passed("06a", f"{_NAME} hears what the first monitor hears.")
    return failed_by("06a", _of_run(seen, runs[-1], said))


def _judge_other_commands(seen: TypedIn) -> Outcome:
    """Nothing was run: perhaps because the command was not one."""
    typed = seen.commands[-1][1] if seen.commands else ""
    meaning = diagnosis_of(seen.meaning)
    if meaning and alike(typed[: len(RUN)], RUN):
        return failed_by("06a", meaning)
    return not_attempted("06a", "Nothing was run in this terminal yet.")


def _of_run(seen: TypedIn, command: str, said: list[tuple[str, str]]) -> Diagnosis:
    names = sorted({name for name, _ in said})
    if _NAME in names:
        return _deaf([text for name, text in said if name == _NAME])
    if names:
        found = ", ".join(names)
        mistake, hint = _of_name(command)
        return Diagnosis(mistake, f"The node that runs here is called {found}.", hint)
    evidence = f"No node has started here. The last line typed: {command}"
    return diagnosis_of(seen.meaning) or Diagnosis(UNKNOWN, evidence, _WHICH)


def _deaf(said: list[str]) -> Diagnosis:
    if any(text.startswith(_SENSOR) for text in said):
        return Diagnosis(
            "other-executable",
            f"{_NAME} runs and has heard nothing: it publishes.",
            "A second monitor was asked for. Which of the two executables is the monitor?",
        )
    return Diagnosis(
        "nobody-publishes", f"{_NAME} runs and has heard nothing.", _IS_THE_SENSOR_THERE
    )


def _of_name(command: str) -> tuple[str, str]:
    """What is wrong with how a command renames its node, and a hint."""
    for_ros = command.partition("--ros-args")[2]
    renames = "__node:=" in for_ros or "__name:=" in for_ros
    if renames and re.search(r"(?<!\S)(-r|--remap)\s", for_ros):
        return _of_new_name(for_ros)
    if renames or (not for_ros and "__node:=" in command):
        return "option-missing", f"An option is missing. {_RENAME}"
    return ("option-misspelled" if "node" in for_ros else "not-renamed"), _RENAME


def _of_new_name(for_ros: str) -> tuple[str, str]:
    """What is wrong where the option is right, and a hint."""
    given = re.findall(r"__(?:node|name):=[\"']?([^\s\"']*)", for_ros)[-1]
    if given == _NAME:
        hint = f"Before `__node`, no other name is needed. {_RENAME}"
        return "option-misspelled", hint
    said = f"is {given}" if given else "is missing"
    return (
        "wrong-node-name",
        f"The option is right. The name behind `:=` {said}, and {_NAME} was asked for: compare "
        "letter by letter.",
    )


_IS_THE_SENSOR_THERE = (
    "Is the sensor still running in its own terminal? Look there with %terminal sensor."
)
_RENAME = (
    "After `--ros-args` comes `-r`, and then `__node`, with two underscores before it, `:=` and "
    "the name."
)
_WHICH = "After ros2 run come two names: the package, and the executable from setup.py."


def _judge_links(seen: Workspace) -> Outcome:
    package = seen.packages.get(_PACKAGE)
    if package is None:
        return not_attempted("06b", f"There is no package {_PACKAGE} in src yet.")
    if package.installed and package.installed.linked:
        return passed("06b", f"{_PACKAGE} is installed as a link to src.")
    found = _of_build(seen, package)
    if found:
        return failed_by("06b", found)
    if package.installed is None:
        return not_attempted("06b", f"{_PACKAGE} is not built yet.")
    return not_attempted("06b", f"{_PACKAGE} is installed as a copy so far.")


def _of_build(seen: Workspace, package: Package) -> Diagnosis | None:
    """What went wrong with a build whose traces are there."""
    stray = next((one for one in seen.folders if one.endswith(f"install/{_PACKAGE}")), "")
    if stray:
        place = stray.removesuffix(f"/install/{_PACKAGE}")
        return Diagnosis(
            "wrong-folder",
            f"There is a folder install in {place}: the build was made there.",
            "colcon builds into the folder where it is typed. Remove build, install and log there, "
            "and build in the workspace.",
        )
    flaw = next((one for one in package.flaws if one.kind in ("missing-comma", "slash")), None)
    broken = diagnose_script(package.setup) or diagnose_name(package)
    return broken or (diagnose_flaw(flaw) if flaw else None) or _other_package(seen)


def _other_package(seen: Workspace) -> Diagnosis | None:
    others = [name for name, one in seen.packages.items() if one.installed and one.installed.linked]
    if not others:
        return None
    return Diagnosis(
        "other-package",
        f"{others[0]} is installed as a link, and {_PACKAGE} is not.",
        "`--packages-select` is followed by the package that is to be built.",
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "06a",
        SCENARIOS["06a"],
        _judge_monitor,
        title="one more monitor",
        points=1,
        hints=(
            "The second monitor is the same program as the first one, run once more.",
            "After `ros2 run` come two names: the package, and the executable.",
            "Look at what was typed in the terminal `monitor`.",
        ),
    ),
    Exercise(
        "06b",
        SCENARIOS["06b"],
        _judge_links,
        title="link instead of copy",
        points=1,
        hints=(
            "colcon has an option for it, and its own help says what the option is called.",
            "The line above the cell looks for a word in that help. An option begins with two "
            "dashes.",
        ),
    ),
)

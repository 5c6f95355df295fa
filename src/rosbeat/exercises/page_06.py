"""Page 06, build, source, run: a second monitor by another name, and links instead of copies."""

from __future__ import annotations

import re
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.packages import diagnose_flaw
from rosbeat.exercises.exercise import Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.scenarios import (
    Answer,
    TypedIn,
    Workspace,
    look_at_terminal,
    look_at_workspace,
)
from rosbeat.exercises.workspace_model import alike, diagnose_script, diagnosis_of
from rosbeat.workspace.packages import Package
from rosbeat.workspace.place import workspace

# 06a, one more monitor: what a terminal has run, and what its node has said.

_NAME = "second_monitor"
#: How the commands begin whose outcome is looked at.
_RUN = "ros2 run"
#: As ROS prints a log line, with a stamp or without: [INFO] [1732212345.123] [name]: text.
_LOG = re.compile(r"^\[[A-Z]+\] (?:\[[\d.]+\] )?\[([\w./]+)\]: (.*)", re.MULTILINE)
_SENSOR = "Publishing"


def _look_at_run(answer: Answer) -> TypedIn:
    return look_at_terminal(answer, workspace(), _RUN)


def _judge_monitor(seen: TypedIn) -> Verdict:
    runs = [text for _, text in seen.commands if _RUN in text]
    if not runs:
        # Nothing was run: perhaps because what was typed was not a command.
        typed = seen.commands[-1][1] if seen.commands else ""
        meaning = diagnosis_of(seen.meaning)
        if meaning and alike(typed[: len(_RUN)], _RUN):
            return meaning
        return not_attempted("Nothing has been run in this terminal yet.")
    # What the nodes have said since a command was typed for the last time.
    said = _LOG.findall(seen.text.rpartition(runs[-1])[2])
    heard = [text for name, text in said if name == _NAME]
    if any(re.search(r"\d", text) and not text.startswith(_SENSOR) for text in heard):
        return passed(f"{_NAME} hears what the first monitor hears.")
    if heard:
        return _diagnose_silence(heard)
    if said:
        names = ", ".join(sorted({name for name, _ in said}))
        mistake, hint = _diagnose_renaming(runs[-1])
        evidence = f"The node that runs here is called {names}."
        return Diagnosis(mistake, evidence, hint)
    evidence = f"No node has started here. The last line typed: {runs[-1]}"
    hint = "After ros2 run come two names: the package, and the executable from setup.py."
    return diagnosis_of(seen.meaning) or Diagnosis(UNKNOWN, evidence, hint)


def _diagnose_silence(said: list[str]) -> Diagnosis:
    if any(text.startswith(_SENSOR) for text in said):
        return Diagnosis(
            "other-executable",
            f"{_NAME} runs and has heard nothing: it publishes.",
            ("Start a second monitor. Which of the two executables is the monitor?"),
        )
    return Diagnosis(
        "nobody-publishes",
        f"{_NAME} runs and has heard nothing.",
        "Is the sensor still running in its own terminal? Look there with %terminal sensor.",
    )


_RENAME = (
    "After `--ros-args`, write `-r`, then `__node` with two underscores, then `:=` and the name."
)


def _diagnose_renaming(command: str) -> tuple[str, str]:
    """Return the mistake in how a command renames its node, and a hint.

    The command itself tells it, and its node no more than a name: there is nothing to simulate.
    """
    for_ros = command.partition("--ros-args")[2]
    given = re.findall(r"__(?:node|name):=[\"']?([^\s\"']*)", for_ros)
    if not given and (for_ros or "__node:=" not in command):
        return ("option-misspelled" if "node" in for_ros else "not-renamed"), _RENAME
    if not re.search(r"(?<!\S)(-r|--remap)\s", for_ros):
        # Behind `--ros-args` the option alone is missing; without it, both are.
        return "option-missing", f"An option is missing. {_RENAME}"
    if given[-1] == _NAME:
        return "option-misspelled", f"Before `__node`, no other name is needed. {_RENAME}"
    said = f"is {given[-1]}" if given[-1] else "is missing"
    return (
        "wrong-node-name",
        f"The option is right. The name behind `:=` {said}, and {_NAME} was asked for: compare "
        "letter by letter.",
    )


# 06b, link instead of copy: how the package is installed.

_PACKAGE = "sensor_simulator"


def _judge_links(seen: Workspace) -> Verdict:
    package = seen.packages.get(_PACKAGE)
    if package is None:
        return not_attempted(f"There is no package {_PACKAGE} in src yet.")
    if package.installed and package.installed.linked:
        return passed(f"{_PACKAGE} is installed as a link to src.")
    found = _diagnose_build(seen, package)
    if found:
        return found
    if package.installed is None:
        return not_attempted(f"{_PACKAGE} is not built yet.")
    return not_attempted(f"{_PACKAGE} is installed as a copy so far.")


def _diagnose_build(seen: Workspace, package: Package) -> Diagnosis | None:
    """Return what went wrong with a build whose traces are there."""
    stray = next((one for one in seen.folders if one.endswith(f"install/{_PACKAGE}")), "")
    if stray:
        place = stray.removesuffix(f"/install/{_PACKAGE}")
        return Diagnosis(
            "wrong-folder",
            f"There is a folder install in {place}: the build was made there.",
            "colcon builds into the folder where it is typed. Remove build, install and log there, "
            "and build in the workspace.",
        )
    flaws = [one for one in package.flaws if one.kind in ("missing-comma", "slash")]
    broken = diagnose_script(package) or (diagnose_flaw(flaws[0]) if flaws else None)
    others = [name for name, one in seen.packages.items() if one.installed and one.installed.linked]
    if broken or not others:
        return broken
    return Diagnosis(
        "other-package",
        f"{others[0]} is installed as a link, and {_PACKAGE} is not.",
        "`--packages-select` is followed by the package that is to be built.",
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "06a",
        _look_at_run,
        _judge_monitor,
        title="one more monitor",
        hints=(
            ("The second monitor is the same program as the first one, started once more."),
            "`ros2 run` takes two names: the package and the executable.",
            "Look at the command in the terminal `monitor`.",
        ),
    ),
    Exercise(
        "06b",
        look_at_workspace,
        _judge_links,
        title="link instead of copy",
        hints=(
            ("colcon has an option for this, and its help lists the option's name."),
            (
                "The line above the cell searches that help for a word. An option "
                "begins with two dashes."
            ),
        ),
    ),
)

"""Page 02, create a package: fill in a manifest, and make a package alone."""

from __future__ import annotations

from typing import Any

from rosbeat.checks.verdicts import BLANK, failed, not_attempted, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.looking import Workspace, look_at_workspace
from rosbeat.records import Outcome
from rosbeat.workspace.manifest import Manifest
from rosbeat.workspace.packages import Package

_FIRST, _SECOND = "sensor_simulator", "room_display"
_NEEDS = ("rclpy", "sensor_msgs")
_MANIFEST = "src/sensor_simulator/package.xml"


def _judge_manifest(seen: Workspace) -> Outcome:
    here = [one for one in seen.packages.values() if one.folder.as_posix() == f"src/{_FIRST}"]
    if not here:
        return not_attempted("02a", f"There is no package {_FIRST} in src yet.")
    manifest = here[0].manifest
    if manifest.problem:
        return failed("02a", f"{_MANIFEST} cannot be read: {manifest.problem}.", _XML)
    wanted = {"description": manifest.description, "license": manifest.license}
    todo = [name for name, text in wanted.items() if _is_open(text)]
    if len(todo) == len(wanted):
        return not_attempted("02a", f"{_MANIFEST} has no description and no license yet.")
    if todo:
        return failed("02a", f"The {todo[0]} in {_MANIFEST} is still open.", _TODO)
    return _judge_rest(manifest)


_XML = (
    "In XML, what is opened with <tag> is closed with </tag>. `<` and `&` in a text are "
    "written &lt; and &amp;."
)
_SAME_NAME = f"<name> has to be {_FIRST}, like the folder and the Python package in it."
_TODO = f"Put a text of your own between <tag> and </tag>, in place of TODO or {BLANK}."


def _is_open(text: str) -> bool:
    return text.lower() in ("", "none", "todo") or "TODO" in text or BLANK in text


def _judge_rest(manifest: Manifest) -> Outcome:
    if manifest.name != _FIRST:
        return failed("02a", f"The manifest names another package: {manifest.name}.", _SAME_NAME)
    missing = [one for one in ("rclpy", "std_msgs") if one not in manifest.depends]
    if missing:
        return failed(
            "02a",
            f"Description and license are there. The dependency {missing[0]} is gone.",
            f"Put <depend>{missing[0]}</depend> back: the nodes import it.",
        )
    if manifest.build_type != "ament_python":
        return failed(
            "02a",
            "Description and license are there. The build type is gone.",
            "<build_type>ament_python</build_type>, between <export> and </export>, tells colcon "
            "how to build the package.",
        )
    return passed("02a", f"Licensed under {manifest.license}: {manifest.description}")


def _judge_second(seen: Workspace) -> Outcome:
    package = seen.packages.get(_SECOND)
    if package is None:
        return not_attempted("02b", f"There is no package {_SECOND} yet.")
    place = seen.place_of(_SECOND)
    if place:
        return failed(
            "02b",
            f"{_SECOND} lies in {place}, and packages belong in src.",
            "Remove it there (rm -r), go to src with cd, and make it again.",
        )
    return _judge_kind(package)


def _said(manifest: Manifest) -> str:
    return ", ".join(manifest.depends) or "none"


def _judge_kind(package: Package) -> Outcome:
    manifest = package.manifest
    again = f"Remove the folder (rm -r src/{_SECOND}) and make the package again, with "
    if manifest.build_type != "ament_python":
        kind = manifest.build_type or "of an unknown kind"
        return failed(
            "02b", f"{_SECOND} is {kind}.", f"{again}--build-type ament_python: a Python package."
        )
    missing = [one for one in _NEEDS if one not in manifest.depends]
    if missing:
        return failed(
            "02b",
            f"{_SECOND} does not say that it needs {' and '.join(missing)}.",
            f"{again}--dependencies and both names after it. It says now: {_said(manifest)}.",
        )
    return passed("02b", f"{_SECOND} is a Python package that needs {' and '.join(_NEEDS)}.")


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("02a", look_at_workspace, _judge_manifest),
    Exercise("02b", look_at_workspace, _judge_second),
)

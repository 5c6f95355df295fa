"""Page 02, create a package: fill in a manifest, and make a package alone."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.exercise import BLANK, Exercise, failed, failed_by, not_attempted, passed
from rosbeat.exercises.manifests import (
    diagnose_dependencies,
    diagnose_tags,
    diagnose_values,
    hint_on_xml,
    is_open,
    remark_on_license,
)
from rosbeat.exercises.page_02_scenarios import SCENARIOS
from rosbeat.exercises.paths import alike
from rosbeat.exercises.scenarios import Workspace
from rosbeat.records import Outcome
from rosbeat.workspace.manifest import Manifest
from rosbeat.workspace.packages import Package

_FIRST, _SECOND = "sensor_simulator", "room_display"
_FIRST_NEEDS, _NEEDS = ("rclpy", "std_msgs"), ("rclpy", "sensor_msgs")
_MANIFEST = "src/sensor_simulator/package.xml"


def _judge_manifest(seen: Workspace) -> Outcome:
    here = [one for one in seen.packages.values() if one.folder.as_posix() == f"src/{_FIRST}"]
    if not here:
        return not_attempted("02a", f"There is no package {_FIRST} in src yet.")
    manifest = here[0].manifest
    if manifest.problem:
        evidence = f"{_MANIFEST} cannot be read: {manifest.problem}."
        return failed("02a", evidence, hint_on_xml(manifest.problem), "manifest-unreadable")
    wanted = {"description": manifest.description, "licence": manifest.license}
    todo = [name for name, text in wanted.items() if is_open(text)]
    slip = diagnose_tags(manifest, _MANIFEST)
    if slip:
        return failed_by("02a", slip)
    if len(todo) == len(wanted):
        return not_attempted("02a", f"{_MANIFEST} has no description and no licence yet.")
    if todo:
        evidence = f"The {todo[0]} in {_MANIFEST} is still open."
        return failed("02a", evidence, _TODO, "manifest-open")
    return _judge_rest(manifest)


_SAME_NAME = f"<name> has to be {_FIRST}, like the folder and the Python package in it."
_TODO = f"Put a text of your own between <tag> and </tag>, in place of TODO or {BLANK}."


def _judge_rest(manifest: Manifest) -> Outcome:
    if manifest.name != _FIRST:
        evidence = f"The manifest names another package: {manifest.name}."
        return failed("02a", evidence, _SAME_NAME, "package-renamed")
    found = diagnose_dependencies(manifest, _FIRST_NEEDS) or diagnose_values(manifest)
    if found:
        return failed_by("02a", found)
    if manifest.build_type != "ament_python":
        return _another_build_type(manifest.build_type)
    said = f"Licensed under {manifest.license}: {manifest.description}"
    return passed("02a", said, *remark_on_license(manifest.license))


def _another_build_type(found: str) -> Outcome:
    said = f"The build type is {found}." if found else "The build type is gone."
    return failed(
        "02a",
        f"Description and licence are there. {said}",
        "<build_type>, between <export> and </export>, tells colcon how to build the package: "
        "here, one for Python.",
        "build-type",
    )


def _judge_second(seen: Workspace) -> Outcome:
    package = seen.packages.get(_SECOND)
    if package is None:
        return _judge_absence(seen)
    place = seen.place_of(_SECOND)
    if place:
        return _misplaced(place)
    return _judge_kind(package)


def _misplaced(place: str) -> Outcome:
    return failed(
        "02b",
        f"{_SECOND} lies in {place}, and packages belong in src.",
        "Remove it there (rm -r), go to src with cd, and make it again.",
        "wrong-folder",
    )


def _judge_absence(seen: Workspace) -> Outcome:
    """What there is, if there is no such package: one nearly so called, or only its folder."""
    inside = [one for one in seen.folders if one.rpartition("/")[2] == _SECOND]
    for folder in inside:
        place = folder.rpartition("/")[0]
        if place and any(_is_in(place, one) for one in seen.packages.values()):
            return _misplaced(place)
    if inside:
        return failed(
            "02b",
            f"There is a folder {inside[0]}, and no package.xml in it.",
            "`ros2 pkg create` makes the folder and all that belongs in it. Remove the folder "
            "first: `rmdir` removes an empty one.",
            "no-manifest",
        )
    near = [name for name in seen.packages if alike(name, _SECOND) and name != _FIRST]
    if near:
        return failed(
            "02b",
            f"There is a package {near[0]}, and none called {_SECOND}.",
            f"Names count letter by letter. Remove the folder (rm -r) of {near[0]}, and make it "
            "again.",
            "package-misspelled",
        )
    return not_attempted("02b", f"There is no package {_SECOND} yet.")


def _is_in(place: str, package: Package) -> bool:
    folder = package.folder.as_posix()
    return place == folder or place.startswith(f"{folder}/")


def _judge_kind(package: Package) -> Outcome:
    manifest = package.manifest
    again = f"Remove the folder (rm -r src/{_SECOND}) and make the package again, with "
    if manifest.problem:
        evidence = f"The package.xml of {_SECOND} cannot be read: {manifest.problem}."
        return failed("02b", evidence, hint_on_xml(manifest.problem), "manifest-unreadable")
    if manifest.build_type != "ament_python":
        kind = manifest.build_type or "of an unknown kind"
        hint = f"{again}--build-type: a Python package was asked for."
        return failed("02b", f"{_SECOND} is {kind}.", hint, "build-type")
    found = diagnose_dependencies(manifest, _NEEDS)
    if found:
        hint = f"{found.hint} {again}--dependencies and both names after it."
        return failed("02b", found.evidence, hint, found.mistake)
    return _judge_files(package)


def _judge_files(package: Package) -> Outcome:
    """Whether what every Python package needs is there; one made by hand may lack some of it."""
    there = {
        "setup.py": not package.setup.problem,
        f"resource/{_SECOND}": package.has_marker,
        f"{_SECOND}/__init__.py": package.has_init,
    }
    gone = [name for name, is_there in there.items() if not is_there]
    if gone:
        return failed(
            "02b",
            f"{_SECOND} has no {gone[0]} that colcon could use.",
            f"Compare it with the files of {_FIRST}: every Python package has the same ones.",
            "marker-missing",
        )
    return passed("02b", f"{_SECOND} is a Python package that needs {' and '.join(_NEEDS)}.")


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "02a",
        SCENARIOS["02a"],
        _judge_manifest,
        title="fill in the manifest",
        points=2,
        hints=(
            "Two places of the manifest are still open. Look for the blanks.",
            "One says in a sentence what the package does; the other says what others may do "
            "with it.",
            "A licence is named by its short name, without blanks. ROS itself uses one of them, "
            "and the text above the cell names it.",
        ),
    ),
    Exercise(
        "02b",
        SCENARIOS["02b"],
        _judge_second,
        title="a second package",
        points=2,
        hints=(
            "It is the command that made the first package, with other names.",
            "One blank says what kind of package it is, the other one what it needs.",
            "Both blanks begin with an option, two dashes and a word, as in the table above.",
        ),
    ),
)

"""Page 02, create a package: fill in a manifest, and make a package alone."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from packaging.licenses import InvalidLicenseExpression, canonicalize_license_expression

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.packages import Manifest
from rosbeat.exercises.exercise import BLANK, NOT_SAVED, Exercise, Verdict, not_attempted, passed
from rosbeat.exercises.scenarios import (
    Answer,
    CommandMeaning,
    Workspace,
    look_at_workspace,
    typed_about,
)
from rosbeat.exercises.workspace_model import (
    about_stray,
    alike,
    diagnosis_of,
    in_workspace,
    remarks_on_strays,
)
from rosbeat.workspace.packages import Package

# A manifest is text, and what is wrong with a text is told by looking at it: nothing is simulated
# on this page. Each judge generates what is wrong, the causes before what follows from them, and
# the first counts.

# 02a, complete the manifest.

_FIRST, _FIRST_NEEDS = "sensor_simulator", ("rclpy", "std_msgs")
_MANIFEST = "src/sensor_simulator/package.xml"
_TODO = re.compile(r"\W*todo\W*$|\W*todo\s*:", re.IGNORECASE)
#: Texts that say no more than the tag around them, such as those of the manifest as it is made.
_EMPTY = re.compile(
    r"(todo|the|a|an|my|your|package|license|licence|description|declaration|tbd|fixme|none|\W)*",
    re.IGNORECASE,
)
#: ROS Enhancement Proposal 140 and 149: two of the tags of a package.xml, in formats 2 and 3.
_FORMATS = ("2", "3")
#: As catkin_pkg has it, which reads manifests for colcon.
_EMAIL = re.compile(r"[-\w%+]+(\.[-\w%+]+)*@[-\w%]+(\.[-\w%]+)*\.[a-zA-Z]{2,}", re.ASCII)
_VERSION = re.compile(r"\d+\.\d+\.\d+")
#: Tags that a manifest needs.
_TAGS = ("name", "version", "description", "maintainer", "license", "export")


def _judge_manifest(seen: Workspace) -> Verdict:
    here = [one for one in seen.packages.values() if one.folder.as_posix() == f"src/{_FIRST}"]
    if not here and _FIRST in seen.packages:
        return _misplaced(_FIRST, seen.place_of(_FIRST))
    if not here and seen.strays:
        return about_stray(seen.strays[0])
    if not here:
        return not_attempted(f"There is no package {_FIRST} in src yet.")
    manifest = here[0].manifest
    todo = _open_texts(manifest)
    slip = next(_slips_of_form(manifest, _MANIFEST), None)
    if not slip and todo and seen.strays:
        return about_stray(seen.strays[0])  # what was filled in is there
    if not slip and len(todo) == 2:
        said = f"{_MANIFEST} has no description and no licence yet. {NOT_SAVED}"
        return not_attempted(said)
    slip = slip or next(_slips_of_values(manifest, todo), None)
    if slip:
        return slip
    said = f"Licensed under {manifest.license}: {manifest.description}"
    return passed(said, *_remark_on_license(manifest.license), *remarks_on_strays(seen.strays))


def _open_texts(manifest: Manifest) -> list[str]:
    """Return which texts are none yet: empty, a TODO, a blank, signs, or the tag's own words."""
    texts = {"description": manifest.description, "licence": manifest.license}
    return [
        name
        for name, text in texts.items()
        if _TODO.match(text) or BLANK in text or _EMPTY.fullmatch(text)
    ]


def _slips_of_form(manifest: Manifest, path: str) -> Iterator[Diagnosis]:
    """Generate what keeps a file from being a manifest that can be read."""
    problem = manifest.problem
    if problem:
        yield Diagnosis(
            "manifest-unreadable",
            f"{path} cannot be read: {problem}.",
            "`<?xml` has to be the very first line, with nothing before it, not even a space."
            if "declaration not at start" in problem
            else "In XML, what is opened with <tag> is closed with </tag>. `<` and `&` in a text "
            "are written &lt; and &amp;.",
        )
    for wanted in _TAGS:
        near = [tag for tag in manifest.tags if alike(tag, wanted) and tag not in _TAGS]
        if wanted not in manifest.tags and near:
            yield Diagnosis(
                "tag-misspelled",
                f"{path} has a tag <{near[0]}>, and ROS knows none of that name.",
                "Compare it, letter by letter, with the manifest that the page shows above.",
            )


def _slips_of_values(manifest: Manifest, todo: list[str]) -> Iterator[Diagnosis]:
    """Generate what is wrong with the values of a manifest that can be read."""
    if todo:
        yield Diagnosis(
            "manifest-open",
            f"The {todo[0]} in {_MANIFEST} is still open.",
            f"Put a text of your own between <tag> and </tag>, in place of TODO or {BLANK}.",
        )
    if _is_known_license(manifest.description) and not _is_known_license(manifest.license):
        yield Diagnosis(
            "manifest-value",
            f"The description is {manifest.description}, the short name of a licence.",
            "Each text belongs between the tags that name it: <description> says what the package "
            "is for, and <license> holds the licence.",
        )
    if manifest.name != _FIRST:
        yield Diagnosis(
            "package-renamed",
            f"The manifest names another package: {manifest.name}.",
            f"<name> has to be {_FIRST}, like the folder and the Python package in it.",
        )
    yield from _slips_of_dependencies(manifest, _FIRST_NEEDS)
    if manifest.format not in _FORMATS:
        yield Diagnosis(
            "manifest-value",
            f"The format of the manifest is {manifest.format or 'not given'}.",
            f"ROS 2 reads the formats {' and '.join(_FORMATS)}; <package> says which one it is.",
        )
    if not _VERSION.fullmatch(manifest.version):
        yield Diagnosis(
            "manifest-value",
            f"The version is {manifest.version or 'not given'}.",
            "A version consists of three numbers, separated by dots. Without one, colcon doesn't "
            "build the package.",
        )
    if not manifest.maintainer or not _EMAIL.fullmatch(manifest.email):
        yield Diagnosis(
            "manifest-value",
            _about_maintainer(manifest),
            "<maintainer> holds a name, and its email an address such as you@example.com.",
        )
    if manifest.build_type != "ament_python":
        kind = f"is {manifest.build_type}" if manifest.build_type else "is gone"
        yield Diagnosis(
            "build-type",
            f"Description and licence are there. The build type {kind}.",
            "<build_type>, between <export> and </export>, tells colcon how to build the package: "
            "here, one for Python.",
        )


def _about_maintainer(manifest: Manifest) -> str:
    """Say what a manifest lacks that names no maintainer, or an address that colcon refuses."""
    if not manifest.maintainer:
        return "The manifest names no maintainer."
    if not manifest.email:
        return "The maintainer in the manifest has no address."
    said = f"colcon doesn't accept the maintainer's address, {manifest.email!r}"
    foreign = list(dict.fromkeys(sign for sign in manifest.email if not sign.isascii()))
    if foreign:
        return f"{said}: it may not contain {' or '.join(foreign)}, only the letters a to z."
    return f"{said}."


def _slips_of_dependencies(
    manifest: Manifest, needs: tuple[str, ...], again: str = ""
) -> Iterator[Diagnosis]:
    """Generate a dependency that is missing, or nearly there.

    Args:
        manifest: What the file says.
        needs: The packages that it should depend on.
        again: How to write them down, besides what every hint says.
    """
    missing = [one for one in needs if one not in manifest.depends]
    if not missing:
        return
    glued = [one for one in manifest.depends if "," in one or " " in one]
    near = [one for one in manifest.depends if alike(one, missing[0]) and one not in needs]
    if glued or near:
        yield Diagnosis(
            "dependency-misspelled",
            f"It depends on {(glued or near)[0]}, and no package is called that.",
            f"Names of packages count letter by letter, and each stands alone. {again}".strip(),
        )
    yield Diagnosis(
        "dependency-missing",
        f"It does not say that it needs {' and '.join(missing)}. It says now: "
        f"{', '.join(manifest.depends) or 'none'}.",
        f"Every package that the nodes import is a dependency. {again}".strip(),
    )


def _remark_on_license(text: str) -> tuple[str, ...]:
    """Return a remark if one of several licences, with commas between them, has no short name."""
    unknown = next((one for one in text.split(", ") if not _is_known_license(one)), "")
    if not unknown:
        return ()
    return (
        f"Programs do not know a licence {unknown}. spdx.org/licenses lists the short "
        "names that they know, such as MIT.",
    )


def _is_known_license(text: str) -> bool:
    try:
        return bool(canonicalize_license_expression(text))
    except InvalidLicenseExpression:
        return False


# 02b, a second package.

_SECOND, _NEEDS = "room_display", ("rclpy", "sensor_msgs")


@dataclass(frozen=True)
class PackageMaking:
    """Record the packages of a workspace, and what was typed to make one.

    Attributes:
        workspace: What is in the workspace.
        tried: The last line that was to make another package than the page does; empty where a
            page has no terminals.
        meaning: What that line has led to, if it is a known mistake.
    """

    workspace: Workspace
    tried: str = ""
    meaning: CommandMeaning | None = None


def _look_at_package_making(answer: Answer) -> PackageMaking:
    found = look_at_workspace(answer)
    typed, meaning = typed_about(Path(answer), _is_try)
    return PackageMaking(found, typed[-1][1] if typed else "", meaning)


def _is_try(line: str) -> bool:
    """Return whether a line is to make the second package, whatever it is called there."""
    words = re.split(r"[\s=,'\"]+", line.strip())
    looks = words[0] in ("ls", "cat", "cd", "find", "rm", "rmdir", "echo", "tree")
    creates = "ros2" in words and "create" in words and _FIRST not in words
    return not looks and (creates or any(alike(word, _SECOND) for word in words))


def _judge_second(made: PackageMaking) -> Verdict:
    seen = made.workspace
    package = seen.packages.get(_SECOND)
    slips = _slips_of_absence(made) if package is None else _slips_of_package(made, package)
    slip = next(slips, None)
    if slip:
        return slip
    if package is None:
        return diagnosis_of(made.meaning) or _nothing_made(made.tried, seen.packages)
    said = f"{_SECOND} is a Python package that needs {' and '.join(_NEEDS)}."
    return passed(said, *remarks_on_strays(seen.strays))


def _nothing_made(tried: str, packages: Mapping[str, Package]) -> Verdict:
    if not tried:
        return not_attempted(f"There is no package {_SECOND} yet.")
    other = next((name for name in re.split(r"[\s=,'\"]+", tried) if name in packages), "")
    if other:
        return Diagnosis(
            "other-package",
            f"There is a package {other}, and none called {_SECOND}.",
            f"The exercise says what the package is called. {_removed(packages[other])}, and make "
            "it again.",
        )
    return Diagnosis(
        UNKNOWN,
        f"You typed `{tried}`, and there is no package {_SECOND}.",
        "The last lines that the command printed say what went wrong.",
    )


def _misplaced(package: str, place: str) -> Diagnosis:
    return Diagnosis(
        "wrong-folder",
        f"{package} lies in {place}, and packages belong in src.",
        f"Move it there: `mv {in_workspace('' if place == 'the workspace itself' else place + '/')}"
        f"{package} {in_workspace('src/')}`",
    )


def _slips_of_absence(made: PackageMaking) -> Iterator[Diagnosis]:
    """Generate what is there if the package is not: only its folder, or one nearly so called."""
    seen = made.workspace
    inside = [one for one in seen.folders if one.rpartition("/")[2] == _SECOND]
    packages = [f"{one.folder.as_posix()}/" for one in seen.packages.values()]
    for folder in inside:
        place = folder.rpartition("/")[0]
        if place and any(f"{place}/".startswith(package) for package in packages):
            yield _misplaced(_SECOND, place)
    if inside:
        yield Diagnosis(
            "no-manifest",
            f"There is a folder {inside[0]}, and no package.xml in it.",
            "`ros2 pkg create` makes the folder and all that belongs in it. Remove the folder "
            f"first: `rm -r {in_workspace(inside[0])}`.",
        )
    for name in seen.packages:
        if alike(name, _SECOND) and name != _FIRST:
            yield Diagnosis(
                "package-misspelled",
                f"There is a package {name}, and none called {_SECOND}.",
                f"Names count letter by letter. {_removed(seen.packages[name])}, and make it "
                "again.",
            )


def _removed(package: Package) -> str:
    """Return how to remove a package, from wherever a terminal is."""
    return f"Remove the folder with `rm -r {in_workspace(package.folder.as_posix())}`"


def _slips_of_package(made: PackageMaking, package: Package) -> Iterator[Diagnosis]:
    """Generate what is wrong with the package that is there."""
    place, manifest = made.workspace.place_of(_SECOND), package.manifest
    again = f"{_removed(package)}, and make the package again, with "
    if place:
        yield _misplaced(_SECOND, place)
    anew = f"To begin anew: {_removed(package)}."
    for slip in _slips_of_form(manifest, f"src/{_SECOND}/package.xml"):
        yield replace(slip, hint=f"{slip.hint} {anew}")
    if manifest.build_type != "ament_python":
        kind = manifest.build_type or "of an unknown kind"
        hint = f"{again}--build-type: a Python package was asked for."
        yield Diagnosis("build-type", f"{_SECOND} is {kind}.", hint)
    both = f"{again}--dependencies and both names after it."
    yield from _slips_of_dependencies(manifest, _NEEDS, both)
    # What every Python package needs: one made by hand may lack some of it.
    there = {
        "setup.py": not package.setup.problem,
        f"resource/{_SECOND}": package.has_marker,
        f"{_SECOND}/__init__.py": package.has_init,
    }
    for name, is_there in there.items():
        if not is_there:
            yield Diagnosis(
                "marker-missing",
                f"{_SECOND} has no {name} that colcon could use.",
                f"Compare it with the files of {_FIRST}: every Python package has the same ones. "
                f"{anew}",
            )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("02a", look_at_workspace, _judge_manifest, title="complete the manifest",
        points=2, hints=(
        "Two entries of the manifest are still open. Look for the blanks.",
        "One describes the package in a sentence; the other says what others may do with it.",
        "A licence is named by its short name, without spaces. ROS itself uses one of them, "
        "and the text above the cell names it.",
    )),
    Exercise("02b", _look_at_package_making, _judge_second, title="a second package",
        points=2, hints=(
        "It's the command that created the first package, with other names.",
        "One blank is for the kind of package, the other for its dependencies.",
        "Both blanks begin with an option: two dashes and a word, as in the table above.",
    )),
)  # fmt: skip

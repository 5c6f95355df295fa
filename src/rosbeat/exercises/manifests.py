"""What can be wrong with the texts of a manifest."""

from __future__ import annotations

import re
from difflib import get_close_matches

from packaging.licenses import InvalidLicenseExpression, canonicalize_license_expression

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import BLANK
from rosbeat.exercises.paths import alike
from rosbeat.workspace.manifest import Manifest

_TODO = re.compile(r"\W*todo\W*$|\W*todo\s*:", re.IGNORECASE)
#: ROS Enhancement Proposal 140 and 149: two of the tags of a package.xml, in formats 2 and 3.
_FORMATS = ("2", "3")
#: As catkin_pkg has it, which reads manifests for colcon.
_EMAIL = re.compile(r"[-\w%+]+(\.[-\w%+]+)*@[-\w%]+(\.[-\w%]+)*\.[a-zA-Z]{2,}", re.ASCII)
_VERSION = re.compile(r"\d+\.\d+\.\d+")
#: Tags that a manifest needs.
_TAGS = ("name", "version", "description", "maintainer", "license", "export")
#: Short names of licences that ROS packages often have, to be compared with a misspelled one.
_COMMON = (
    "Apache-2.0", "MIT", "BSD-2-Clause", "BSD-3-Clause", "GPL-3.0-only", "GPL-3.0-or-later",
    "LGPL-3.0-only", "LGPL-3.0-or-later", "AGPL-3.0-only", "MPL-2.0", "EPL-2.0", "BSL-1.0", "ISC",
    "CC-BY-4.0", "CC0-1.0", "Unlicense",
)  # fmt: skip


def hint_on_xml(problem: str) -> str:
    """Return what to do about a manifest that is no XML.

    Args:
        problem: What the reader of XML says of it.
    """
    if "declaration not at start" in problem:
        return "`<?xml` has to be the very first line, with nothing before it, not even a blank."
    return (
        "In XML, what is opened with <tag> is closed with </tag>. `<` and `&` in a text are "
        "written &lt; and &amp;."
    )


def is_open(text: str) -> bool:
    """Whether a text is none yet: empty, a TODO, a blank, or only signs."""
    todo = bool(_TODO.match(text)) or text.lower() in ("", "none")
    return todo or BLANK in text or not any(sign.isalnum() for sign in text)


def diagnose_tags(manifest: Manifest, path: str) -> Diagnosis | None:
    """Recognise a tag that is nearly one that manifests have, such as `licence`.

    Args:
        manifest: What the file says.
        path: The file, as the learner knows it.
    """
    for wanted in _TAGS:
        near = [tag for tag in manifest.tags if alike(tag, wanted) and tag not in _TAGS]
        if wanted not in manifest.tags and near:
            return Diagnosis(
                "tag-misspelled",
                f"{path} has a tag <{near[0]}>, and ROS knows none of that name.",
                "Compare it, letter by letter, with the manifest that the page shows above.",
            )
    return None


def diagnose_dependencies(manifest: Manifest, needs: tuple[str, ...]) -> Diagnosis | None:
    """Recognise a dependency that is missing, or nearly there.

    Args:
        manifest: What the file says.
        needs: The packages that it should depend on.
    """
    missing = [one for one in needs if one not in manifest.depends]
    if not missing:
        return None
    said = ", ".join(manifest.depends) or "none"
    glued = [one for one in manifest.depends if "," in one or " " in one]
    near = [one for one in manifest.depends if alike(one, missing[0]) and one not in needs]
    if glued or near:
        return Diagnosis(
            "dependency-misspelled",
            f"It depends on {(glued or near)[0]}, and no package is called that.",
            "Names of packages count letter by letter, and each stands alone.",
        )
    return Diagnosis(
        "dependency-missing",
        f"It does not say that it needs {' and '.join(missing)}. It says now: {said}.",
        "Every package that the nodes import is a dependency.",
    )


def diagnose_values(manifest: Manifest) -> Diagnosis | None:
    """Recognise a format or a version that colcon refuses.

    Args:
        manifest: What the file says.
    """
    if manifest.format not in _FORMATS:
        return Diagnosis(
            "manifest-value",
            f"The format of the manifest is {manifest.format or 'not given'}.",
            f"ROS 2 reads the formats {' and '.join(_FORMATS)}; <package> says which one it is.",
        )
    if not _VERSION.fullmatch(manifest.version):
        return Diagnosis(
            "manifest-value",
            f"The version is {manifest.version or 'not given'}.",
            "A version is three numbers with dots between them, and colcon builds nothing without.",
        )
    if not manifest.maintainer or not _EMAIL.fullmatch(manifest.email):
        return Diagnosis(
            "manifest-value",
            "The manifest names no maintainer with an address.",
            "<maintainer> holds a name, and its email an address such as you@example.com.",
        )
    return None


def remark_on_license(text: str) -> tuple[str, ...]:
    """Return a remark if a licence is none of the list that programs know, else nothing.

    Args:
        text: One licence, or several with commas between them.
    """
    unknown = [one for one in text.split(", ") if not _is_known(one)]
    if not unknown:
        return ()
    near = _nearest(unknown[0])
    asked = f"Did you mean {near}? " if near else ""
    return (
        f"Programs do not know a licence {unknown[0]}. {asked}spdx.org/licenses lists the short "
        "names that they know, such as MIT.",
    )


def _nearest(text: str) -> str:
    """The short name that a text may be a misspelling of, or an empty text."""
    names = {one.lower(): one for one in _COMMON}
    return next((names[one] for one in get_close_matches(text.lower(), names, 1, 0.75)), "")


def _is_known(text: str) -> bool:
    try:
        return bool(canonicalize_license_expression(text))
    except InvalidLicenseExpression:
        return False

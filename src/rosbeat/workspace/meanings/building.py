"""Mistakes at `colcon build`, also those about which it says nothing."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.flaws import flaw_in_words, syntax_error_in_words
from rosbeat.workspace.meanings.folders import way_to
from rosbeat.workspace.meanings.situation import Call, Situation
from rosbeat.workspace.packages import Package

_UNKNOWN = re.compile(r"ignoring unknown package '(?P<name>[^']+)'")
_NO_PACKAGES = re.compile(r"Summary: 0 packages finished")
_DID = {"build": "built", "test": "tested", "list": "listed"}
_STILL = "Nothing new was installed; if there was a build before, `ros2 run` still starts that."


def _build(seen: Situation) -> Call | None:
    return seen.call("colcon", "build")


def _built(seen: Situation) -> Sequence[Package]:
    """The packages that a build was asked for."""
    call = _build(seen)
    if call is None:
        return ()
    words = call.words
    if "--packages-select" not in words:
        return seen.packages
    start = words.index("--packages-select") + 1
    names = [word for word in words[start:] if not word.startswith("-")]
    return [one for one in seen.packages if one.name in names]


def inside_src(seen: Situation) -> str | None:
    """`colcon build` in `src`, or deeper (mistake 26)."""
    call = _build(seen)
    source = (seen.workspace / "src").resolve()
    if not call or not call.place.resolve().is_relative_to(source) or "usage:" in seen.text:
        return None
    if not (call.place / "log").is_dir():
        return None
    name = call.place.relative_to(call.place.parent)
    return (
        f"You built inside the folder {name}, so build, install and log are there now, where "
        f"nobody looks for them. Go to the workspace with `{way_to()}` and build there; "
        f"you may remove the three folders from {name}."
    )


def unknown_package(seen: Situation) -> str | None:
    """`--packages-select` names no package (mistake 13)."""
    found = _UNKNOWN.search(seen.text)
    call = seen.call("colcon")
    if not found or not call:
        return None
    did = _DID.get(call.words[1], "did") if len(call.words) > 1 else "did"
    name = found["name"].replace("_", "-")
    if name in ("symlink-install", "packages-select"):
        return f"`{found['name']}` was taken for a package: an option begins with two dashes."
    meant = nearest(found["name"], [one.name for one in seen.packages])
    hint = f"Did you mean {meant}?" if meant else "`colcon list` shows the packages that it sees."
    return f"colcon found no package {found['name']}, so it {did} nothing. {hint}"


def no_packages(seen: Situation) -> str | None:
    """Nothing was there to build."""
    call = _build(seen)
    if not call or not _NO_PACKAGES.search(seen.text) or "failed" in seen.text:
        return None
    if seen.packages and call.place.resolve() != seen.workspace.resolve():
        return (
            f"colcon looked in {call.place.name or '/'} and found no package there. "
            f"Go to the workspace with `{way_to()}` and build there."
        )
    if seen.packages:
        return None
    return (
        "colcon found no package: no folder below here holds a package.xml. "
        "Make one in src with `ros2 pkg create` first."
    )


def twice_the_same(seen: Situation) -> str | None:
    """Two folders hold a package of one name."""
    if not seen.call("colcon"):
        return None
    if "Duplicate package names" not in seen.text and "have the same name" not in seen.text:
        return None
    names = [one.name for one in seen.packages]
    twice = next((one for one in seen.packages if names.count(one.name) > 1), None)
    if not twice:
        return None
    places = [
        str(one.folder.relative_to(seen.workspace))
        for one in seen.packages
        if one.name == twice.name
    ]
    return (
        f"Two folders hold a package {twice.name}: {' and '.join(places)}. colcon cannot tell "
        "which one you mean. Move one of them out of the workspace."
    )


def setup_not_readable(seen: Situation) -> str | None:
    """Python gives up on a `setup.py` (mistake 22)."""
    for package in _built(seen):
        if package.setup.line:
            return (
                f"Python cannot read setup.py of {package.name}: {package.setup.problem}, at line "
                f"{package.setup.line} or just before it. Look for a quote, a comma or a bracket "
                f"that is missing there. {_STILL}"
            )
    return None


def wrong_entry_point(seen: Situation) -> str | None:
    """An entry point leads nowhere (mistakes 21 and 22), or to a file with an error (28)."""
    if not _build(seen):
        return None
    for package in _built(seen):
        for flaw in package.flaws:
            silent = "" if seen.code else " The build does not notice; `ros2 run` would."
            end = f" {_STILL}" if seen.code else silent
            return flaw_in_words(flaw) + ("" if flaw.kind == "syntax-error" else end)
    return None


def module_not_readable(seen: Situation) -> str | None:
    """A file of a package has a syntax error (mistake 28)."""
    for package in _built(seen):
        found = package.module_with_syntax_error()
        if found:
            return syntax_error_in_words(f"{package.name}/{found[0]}.py", found[1])
    return None


def parts_missing(seen: Situation) -> str | None:
    """A file that `ros2 pkg create` made is gone (mistake 27)."""
    for package in _built(seen):
        if package.manifest.build_type != "ament_python" or package.manifest.problem:
            continue
        words = missing_part(package)
        if words:
            return words
    return None


def missing_part(package: Package) -> str | None:
    """Say which part of a package is gone and what follows, or return None.

    Args:
        package: A package for Python.
    """
    name = package.name
    if not (package.folder / "setup.py").is_file():
        return (
            f"The package {name} has no setup.py, so colcon cannot build it. "
            "Write it again as page 05 shows it."
        )
    if (package.folder / name).is_dir() and not package.has_init:
        return (
            f"The file {name}/__init__.py is gone from the package {name}, so Python does not see "
            "that folder as a package, and its modules are not installed. Make an empty one: "
            f"touch src/{name}/{name}/__init__.py"
        )
    if not package.scripts_are_found:
        return (
            f"setup.cfg of the package {name} is gone or changed. It says that executables go to "
            f"lib/{name}, the only place where `ros2 run` looks. It needs the two lines "
            f"`[install]` and `install_scripts=$base/lib/{name}`."
        )
    return None


def marker_missing(seen: Situation) -> str | None:
    """The file by which ROS knows a package is gone (mistake 27)."""
    if not seen.code:
        return None  # a setup.py may name another file than the usual one
    for package in _built(seen):
        name = package.name
        if not package.has_marker:
            return (
                f"The file resource/{name} is gone from the package {name}. It is empty, and by it "
                f"ROS knows that the package exists. Make it again in the folder of the package: "
                f"touch resource/{name}"
            )
    return None

"""Mistakes at `colcon build`, also those about which it says nothing."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.flaws import diagnose_flaw, diagnose_syntax_error
from rosbeat.workspace.meanings.folders import way_to
from rosbeat.workspace.meanings.situation import Call, Situation
from rosbeat.workspace.packages import Package
from rosbeat.workspace.setup_script import NO_CALL

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


def inside_src(seen: Situation) -> Diagnosis | None:
    """`colcon build` in `src`, or deeper (mistake 26)."""
    call = _build(seen)
    source = (seen.workspace / "src").resolve()
    if not call or not call.place.resolve().is_relative_to(source) or "usage:" in seen.text:
        return None
    if not (call.place / "log").is_dir():
        return None
    name = call.place.relative_to(call.place.parent)
    return Diagnosis(
        "wrong-folder",
        f"You built inside the folder {name}, so build, install and log are there now, where "
        "nobody looks for them.",
        f"Go to the workspace with `{way_to()}` and build there; "
        f"you may remove the three folders from {name}.",
    )


def unknown_package(seen: Situation) -> Diagnosis | None:
    """`--packages-select` names no package (mistake 13)."""
    found = _UNKNOWN.search(seen.text)
    call = seen.call("colcon")
    if not found or not call:
        return None
    did = _DID.get(call.words[1], "did") if len(call.words) > 1 else "did"
    name = found["name"].replace("_", "-")
    if name in ("symlink-install", "packages-select"):
        said = f"`{found['name']}` was taken for a package:"
        return Diagnosis("option-misspelled", said, "an option begins with two dashes.")
    meant = nearest(found["name"], [one.name for one in seen.packages])
    hint = f"Did you mean {meant}?" if meant else "`colcon list` shows the packages that it sees."
    said = f"colcon found no package {found['name']}, so it {did} nothing."
    return Diagnosis("package-misspelled", said, hint)


def no_packages(seen: Situation) -> Diagnosis | None:
    """Nothing was there to build."""
    call = _build(seen)
    if not call or not _NO_PACKAGES.search(seen.text) or "failed" in seen.text:
        return None
    if seen.packages and call.place.resolve() != seen.workspace.resolve():
        return Diagnosis(
            "wrong-folder",
            f"colcon looked in {call.place.name or '/'} and found no package there.",
            f"Go to the workspace with `{way_to()}` and build there.",
        )
    if seen.packages:
        return None
    return Diagnosis(
        "no-packages",
        "colcon found no package: no folder below here holds a package.xml.",
        "Make one in src with `ros2 pkg create` first.",
    )


def twice_the_same(seen: Situation) -> Diagnosis | None:
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
    return Diagnosis(
        "package-twice",
        f"Two folders hold a package {twice.name}: {' and '.join(places)}. colcon cannot tell "
        "which one you mean.",
        "Move one of them out of the workspace.",
    )


def setup_not_readable(seen: Situation) -> Diagnosis | None:
    """Python gives up on a `setup.py` (mistake 22)."""
    for package in _built(seen):
        if package.setup.line:
            return Diagnosis(
                "syntax-error",
                f"Python cannot read setup.py of {package.name}: {package.setup.problem}, at line "
                f"{package.setup.line} or just before it.",
                f"Look for a quote, a comma or a bracket that is missing there. {_STILL}",
            )
    return None


def setup_not_called(seen: Situation) -> Diagnosis | None:
    """A `setup.py` that never calls `setup`."""
    for package in _built(seen):
        if package.setup.problem == NO_CALL and seen.code:
            return Diagnosis(
                "no-setup-call",
                f"setup.py of {package.name} can be read, and {package.setup.problem}.",
                f"The call begins at the left margin: setup( ... ). {_STILL}",
            )
    return None


def nothing_to_install(seen: Situation) -> Diagnosis | None:
    """A `setup.py` whose `packages` leaves the package out, or is not there."""
    for package in _built(seen):
        python = package.manifest.build_type == "ament_python" and not package.setup.problem
        if python and package.modules and not package.setup.installs(package.name):
            return diagnose_packages(package)
    return None


def diagnose_packages(package: Package) -> Diagnosis:
    """Say that a build script does not install the code of its package.

    Args:
        package: The package.
    """
    return Diagnosis(
        "packages-missing",
        f"setup.py of {package.name} does not install the folder {package.name} with its modules: "
        "`packages` leaves it out.",
        "Write packages=find_packages(exclude=['test']), and build again.",
    )


def wrong_entry_point(seen: Situation) -> Diagnosis | None:
    """An entry point leads nowhere (mistakes 21 and 22), or to a file with an error (28)."""
    if not _build(seen):
        return None
    for package in _built(seen):
        for flaw in package.flaws:
            return _with_the_rest(diagnose_flaw(flaw), seen.code)
    return None


def _with_the_rest(found: Diagnosis, code: int) -> Diagnosis:
    if found.mistake == "syntax-error":  # its words say already that a build does not notice
        return found
    rest = _STILL if code else "The build does not notice; `ros2 run` would."
    return replace(found, hint=f"{found.hint} {rest}")


def another_kind(seen: Situation) -> Diagnosis | None:
    """A package for C++ does not build here (mistake 25)."""
    if not seen.code:
        return None
    for package in _built(seen):
        name = package.name
        if package.manifest.build_type.endswith("cmake") and f"Failed   <<< {name}" in seen.text:
            return diagnose_cmake(package)
    return None


def diagnose_cmake(package: Package) -> Diagnosis:
    """Say that a package is one for C++.

    Args:
        package: The package.
    """
    name = package.name
    return Diagnosis(
        "build-type",
        f"{name} is a package for C++: its package.xml says {package.manifest.build_type}.",
        f"A package for Python is made with `--build-type ament_python`. Rename the folder {name} "
        "or move it away, then make the package again with that option.",
    )


def module_not_readable(seen: Situation) -> Diagnosis | None:
    """A file of a package has a syntax error (mistake 28)."""
    for package in _built(seen):
        found = package.module_with_syntax_error()
        if found:
            return diagnose_syntax_error(f"{package.name}/{found[0]}.py", found[1])
    return None


def parts_missing(seen: Situation) -> Diagnosis | None:
    """A file that `ros2 pkg create` made is gone (mistake 27)."""
    for package in _built(seen):
        if package.manifest.build_type != "ament_python" or package.manifest.problem:
            continue
        found = diagnose_missing_part(package)
        if found:
            return found
    return None


def diagnose_missing_part(package: Package) -> Diagnosis | None:
    """Say which part of a package is gone and what follows, or return None.

    Args:
        package: A package for Python.
    """
    name = package.name
    if not (package.folder / "setup.py").is_file():
        return Diagnosis(
            "marker-missing",
            f"The package {name} has no setup.py, so colcon cannot build it.",
            "Write it again as page 05 shows it.",
        )
    if (package.folder / name).is_dir() and not package.has_init:
        return _no_init(name)
    return None if package.scripts_are_found else _no_configuration(name)


def _no_init(name: str) -> Diagnosis:
    return Diagnosis(
        "marker-missing",
        f"The file {name}/__init__.py is gone from the package {name}, so Python does not see "
        "that folder as a package, and its modules are not installed.",
        f"Make an empty one: touch src/{name}/{name}/__init__.py",
    )


def _no_configuration(name: str) -> Diagnosis:
    return Diagnosis(
        "marker-missing",
        f"setup.cfg of the package {name} is gone or changed. It says that executables go to "
        f"lib/{name}, the only place where `ros2 run` looks.",
        f"It needs the two lines `[install]` and `install_scripts=$base/lib/{name}`.",
    )


def marker_missing(seen: Situation) -> Diagnosis | None:
    """The file by which ROS knows a package is gone (mistake 27)."""
    if not seen.code:
        return None  # a setup.py may name another file than the usual one
    for package in _built(seen):
        name = package.name
        if not package.has_marker:
            return Diagnosis(
                "marker-missing",
                f"The file resource/{name} is gone from the package {name}. It is empty, and by it "
                "ROS knows that the package exists.",
                f"Make it again in the folder of the package: touch resource/{name}",
            )
    return None

"""Mistakes at `ros2 run`."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import takewhile

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.workspace.locating import nearest
from rosbeat.workspace.meanings.building import (
    diagnose_cmake,
    diagnose_missing_part,
    diagnose_packages,
)
from rosbeat.workspace.meanings.flaws import diagnose_flaw, diagnose_syntax_error
from rosbeat.workspace.meanings.situation import Situation
from rosbeat.workspace.packages import Package

_NOT_FOUND = re.compile(r"Package '(?P<name>[^']+)' not found")
_ASKED = re.compile(r"Did you mean '(?P<name>[^']+)'")
_BEFORE = "A build fails because of that, so what ran here is the build before."
_AGAIN = "Build again with `colcon build` in the workspace."


def _asked_for(seen: Situation) -> tuple[str, str] | None:
    """The package and the executable of the last `ros2 run`."""
    words = names_to_run(seen) or []
    return (words[0], words[1]) if len(words) > 1 else None


def names_to_run(seen: Situation) -> list[str] | None:
    """Return the names behind the last `ros2 run`; None if there was none.

    Args:
        seen: A command that has ended.
    """
    call = seen.call("ros2", "run")
    if not call:
        return None
    own = takewhile(lambda word: word != "--ros-args", call.words[2:])
    return [word for word in own if not word.startswith("-")]


def _package(seen: Situation) -> tuple[Package, str] | None:
    asked = _asked_for(seen)
    package = seen.package(asked[0]) if asked else None
    return (package, asked[1]) if asked and package else None


def package_not_found(seen: Situation) -> Diagnosis | None:
    """Not sourced, not built, or misspelt (mistakes 23 and 13)."""
    found = _NOT_FOUND.search(seen.text)
    if not found or not seen.call("ros2"):
        return None
    package = seen.package(found["name"])
    if package is None:
        return _no_such_package(seen, found["name"])
    if package.installed is None:
        return Diagnosis(
            "not-built",
            f"The package {package.name} is in src and has not been built yet.",
            "In the workspace, run `colcon build` and then `source install/setup.bash`.",
        )
    return Diagnosis(
        "not-sourced",
        f"The package {package.name} is built, and this terminal does not know it yet.",
        "Every new terminal has to be told: run `source install/setup.bash` in the workspace, "
        "then try again.",
    )


def _no_such_package(seen: Situation, name: str) -> Diagnosis | None:
    asked = _ASKED.search(seen.text)
    meant = nearest(name, [one.name for one in seen.packages]) or (asked and asked["name"])
    if not meant:
        return None
    return Diagnosis(
        "package-misspelled",
        f"There is no package {name} in your workspace.",
        f"Did you mean {meant}?",
    )


def no_executable(seen: Situation) -> Diagnosis | None:
    """The entry point is not there, or is called otherwise (mistakes 20, 24 and 27)."""
    found = _package(seen)
    if not found or "No executable found" not in seen.text:
        return None
    package, name = found
    if package.manifest.build_type.endswith("cmake"):
        return diagnose_cmake(package)
    part = diagnose_missing_part(package)
    if part:
        return part
    flaw = next((one for one in package.flaws if one.kind in ("missing-comma", "slash")), None)
    if flaw:
        return diagnose_flaw(flaw)
    known = [one.executable for one in package.setup.entry_points]
    if name in known:
        return Diagnosis(
            "not-rebuilt",
            f"setup.py has the entry point {name}, and the build in install is older than that.",
            _AGAIN,
        )
    return _not_an_entry_point(package, name)


def _names_a_node(package: Package, name: str) -> bool:
    """Whether a module of the package calls a node, or the class of one, by this name."""
    sign = re.compile(rf"__init__\(\s*['\"]{re.escape(name)}['\"]|class {re.escape(name)}\(")
    files = (package.folder / package.name / f"{module}.py" for module in package.modules)
    return any(sign.search(path.read_text(errors="replace")) for path in files)


def _not_an_entry_point(package: Package, name: str) -> Diagnosis | None:
    if package.setup.incomplete:
        return None
    if package.setup.misspelled_group:
        return Diagnosis(
            "group-misspelled",
            f"setup.py puts its entries under {package.setup.misspelled_group}, and nobody looks "
            "for them there.",
            f"Compare that word with page 05, letter by letter. {_AGAIN}",
        )
    known = [one.executable for one in package.setup.entry_points]
    stem = name.removesuffix(".py")
    if stem in package.modules and stem not in known:
        return _no_entry_for(stem)
    if _names_a_node(package, name):
        return Diagnosis(
            "executable-misspelled",
            f"{name} is the name of a node or its class.",
            "`ros2 run` wants the executable, the name before the `=` in setup.py.",
        )
    meant = stem if stem in known else nearest(name, known)
    return Diagnosis(
        "executable-misspelled" if known else "entry-point-missing",
        f"The package {package.name} has no executable {name}.",
        _what_it_has(meant, known),
    )


def _no_entry_for(module: str) -> Diagnosis:
    return Diagnosis(
        "entry-point-missing",
        f"{module}.py is in the package, and setup.py has no entry point for it, so there is "
        "nothing that `ros2 run` could start.",
        "Add one, 'executable = package.module:function', and build again.",
    )


def _what_it_has(meant: str | None, known: list[str]) -> str:
    if meant:
        return f"Did you mean {meant}? The name is the one before the `=` in setup.py."
    return f"It has: {', '.join(known)}." if known else "I see no entry point in its setup.py."


def linked_since(seen: Situation) -> Diagnosis | None:
    """A build has put a link in the place of the copy that this terminal was told of."""
    found = _package(seen)
    last = last_error(seen.traceback)
    if not found or "PackageNotFoundError: No package metadata was found for" not in last:
        return None
    installed = found[0].installed
    if not installed or not installed.linked or found[0].name.replace("_", "-") not in last:
        return None
    return Diagnosis(
        "not-sourced",
        "The package is installed as a link now, and this terminal was loaded before that.",
        "Run `source install/setup.bash` again.",
    )


def wrong_target(seen: Situation) -> Diagnosis | None:
    """The executable starts and finds no module or no function (mistakes 21, 27 and 28)."""
    found = _package(seen)
    if not found or "Traceback" not in seen.text:
        return None
    package, name = found
    last = last_error(seen.text)
    if last.startswith(("ModuleNotFoundError", "ImportError")) and package.name in last:
        part = diagnose_missing_part(package)
        if part or not package.setup.installs(package.name):
            return part or diagnose_packages(package)
    if not _is_about_loading(last):
        return None
    flaw = next((one for one in package.flaws if one.entry.executable == name), None)
    if flaw:
        return diagnose_flaw(flaw)
    return _syntax(package, last)


def _is_about_loading(last: str) -> bool:
    return (
        last.startswith(
            ("ModuleNotFoundError", "ImportError", "SyntaxError", "IndentationError", "TabError")
        )
        or ("has no attribute" in last and last.startswith("AttributeError: module"))
        or "'module' object is not callable" in last
    )


def _syntax(package: Package, last: str) -> Diagnosis | None:
    broken = package.module_with_syntax_error()
    if not broken or not last.startswith(("SyntaxError", "IndentationError", "TabError")):
        return None
    return diagnose_syntax_error(f"{package.name}/{broken[0]}.py", broken[1])


def the_build_before(seen: Situation) -> Diagnosis | None:
    """A build of this source fails, so an older one runs (mistake 22)."""
    found = _package(seen)
    if not found or not found[0].installed or seen.call("colcon", "build"):
        return None
    package = found[0]
    flaw = next((one for one in package.flaws if one.kind in ("missing-comma", "slash")), None)
    if package.setup.line:
        said = (
            f"Python cannot read setup.py: {package.setup.problem}, at line {package.setup.line}."
        )
        return Diagnosis("syntax-error", said, _BEFORE)
    if not flaw:
        return None
    why = diagnose_flaw(flaw)
    return replace(why, hint=f"{why.hint} {_BEFORE}")


def not_rebuilt(seen: Situation) -> Diagnosis | None:
    """What runs is older than what is written (mistake 24)."""
    found = _package(seen)
    if not found or not found[0].installed or seen.call("colcon", "build"):
        return None
    package, name = found
    modules = [one.module for one in package.setup.entry_points if one.executable == name]
    files = [module.replace(".", "/") + ".py" for module in modules]
    edited = [one for one in files if one in found[0].installed.changed]
    if not edited:
        return None
    return Diagnosis(
        "not-rebuilt",
        f"{edited[0]} has been edited since the last build, and `ros2 run` starts the copy in "
        "install: what you see is the old version.",
        f"{_AGAIN} With `--symlink-install`, edits count without a build.",
    )


def last_error(text: str) -> str:
    """Return the last line of a traceback: the error's name and text.

    Args:
        text: The output of a program.
    """
    lines = [
        line
        for line in text.splitlines()
        if re.match(
            r"[A-Za-z_][\w.]*(Error|Exception|"
            r"Interrupt|Exit)\b",
            line,
        )
    ]
    return lines[-1] if lines else ""

"""Run other programs, in an environment without another ROS.

A machine may have a ROS of its own sourced. Its libraries and the course's do not mix, so our
processes get the user's environment without the entries that lead into the other one.
"""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from course_tool.layout import COURSE_ROS, Layout
from course_tool.problems import say

_LISTS = (
    "AMENT_PREFIX_PATH",
    "CMAKE_PREFIX_PATH",
    "COLCON_PREFIX_PATH",
    "LD_LIBRARY_PATH",
    "PATH",
    "PKG_CONFIG_PATH",
    "PYTHONPATH",
)
_SCALARS = ("ROS_DISTRO", "ROS_VERSION", "ROS_PYTHON_VERSION", "ROS_ETC_DIR", "ROS_PACKAGE_PATH")
#: Under these names an environment of this checkout tells Fast DDS its settings. Which of them it
#: reads depends on the distribution, so each environment sets its own.
_PROFILES = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
_INDEX = os.path.join("share", "ament_index", "resource_index", "packages", "rclpy")


@dataclass(frozen=True)
class Result:
    """How a program ended.

    Attributes:
        ok: Whether its exit code was 0.
        text: What it printed, errors too.
    """

    ok: bool
    text: str

    @property
    def last_line(self) -> str:
        """Return the last line that it printed."""
        return (self.text.strip().splitlines() or ["it printed nothing"])[-1]


def quiet(
    command: Sequence[str | Path],
    env: Mapping[str, str],
    timeout: float | None = None,
    cwd: Path | None = None,
) -> Result:
    """Run a program without showing anything; one that takes longer than `timeout` s failed."""
    try:
        done = subprocess.run(
            [str(part) for part in command],
            env=dict(env),
            cwd=cwd,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=timeout,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return Result(False, str(error))
    return Result(done.returncode == 0, done.stdout)


@dataclass(frozen=True)
class Environment:
    """The user's environment without another ROS, and what was left out of it."""

    environ: dict[str, str]
    other_ros: tuple[str, ...]
    notes: tuple[str, ...]


def cleaned(environ: Mapping[str, str], layout: Layout) -> Environment:
    """Return the environment without another ROS."""
    others = other_roots(environ, layout)
    gone = {
        # Set by the Python of some environment, perhaps not ours; ours sets it again for itself.
        "_ROS_WHEELS_BOOTSTRAP_COMPLETE",
        # Would send the Python of .venv to another standard library.
        "PYTHONHOME",
        *(_SCALARS if others else ()),
        *(name for name in _PROFILES if _within(environ.get(name, ""), str(layout.root))),
    }
    kept = {name: value for name, value in environ.items() if name not in gone}
    notes = []
    if others:
        named = ", ".join(others)
        own = layout.venv.name
        notes.append(f"Another ROS is sourced ({named}); here the course uses its own, in {own}.")
        for name in _LISTS:
            entries = _split(kept.pop(name, ""))
            left = [one for one in entries if not any(_within(one, root) for root in others)]
            kept |= {name: os.pathsep.join(left)} if left else {}
    middleware, libraries = kept.get("RMW_IMPLEMENTATION"), layout.venv / "lib"
    if middleware and libraries.exists() and not (libraries / f"lib{middleware}.so").exists():
        # It would end every node at once.
        del kept["RMW_IMPLEMENTATION"]
        instead = "is not part of this ROS; using rmw_fastrtps_cpp here."
        notes.append(f"RMW_IMPLEMENTATION={middleware} {instead}")
    return Environment(kept, tuple(others), tuple(notes))


def other_roots(environ: Mapping[str, str], layout: Layout) -> list[str]:
    """Return the prefixes of a ROS that is not the course's, and of what was built on it."""
    listed = [entry for name in _LISTS for entry in _split(environ.get(name, ""))]
    system = {"/".join(entry.split("/")[:4]) for entry in listed if entry.startswith("/opt/ros/")}
    prefixes = [
        one
        for one in _split(environ.get("AMENT_PREFIX_PATH", ""))
        if not _is_ours(os.path.realpath(one), layout)
    ]
    if system or any(os.path.exists(os.path.join(entry, _INDEX)) for entry in prefixes):
        # Workspaces on top of the other ROS go with it: they were built for its Python.
        system.update(prefixes)
    return sorted(system)


def _is_ours(entry: str, layout: Layout) -> bool:
    """Tell whether a prefix is of this checkout, and for the distribution of a layout.

    The workspaces of the course are for the distribution of the course.
    """
    root = os.path.realpath(layout.root)
    if layout.ros != COURSE_ROS:
        return _within(entry, os.path.realpath(layout.venv))
    return _within(entry, root) and not entry.startswith(os.path.join(root, ".venv-"))


def _within(entry: str, root: str) -> bool:
    return Path(entry).is_relative_to(root)


def _split(value: str) -> list[str]:
    return [entry for entry in value.split(os.pathsep) if entry]


def inside(environ: Mapping[str, str], layout: Layout) -> dict[str, str]:
    """Return a (cleaned) environment as it is with `.venv` active."""
    active = dict(environ)
    ours = str(layout.venv / "bin")
    parts = environ.get("PATH", os.defpath).split(os.pathsep)
    active["PATH"] = os.pathsep.join([ours, *(part for part in parts if part != ours)])
    active["VIRTUAL_ENV"] = str(layout.venv)
    # A kernel "python3" in the user's home would otherwise win over the course's.
    active.setdefault("JUPYTER_PREFER_ENV_PATH", "1")
    # colcon would show a warning for each package that it builds.
    active.pop("PYTHONDONTWRITEBYTECODE", None)
    return active


def with_ros(environ: Mapping[str, str], layout: Layout) -> dict[str, str]:
    """Return an environment completed with what nodes need, for programs that are not Python."""
    complete = dict(environ)
    _of_rosbeat(layout, "environment").apply(complete, str(layout.venv))
    return complete


def lease_domain(environ: dict[str, str], layout: Layout) -> None:
    """Lease the ROS domain of this user's terminals, and set it in an environment.

    It is held by this process, by the program that it becomes, and by what that one starts.
    """
    domains, errors = (_of_rosbeat(layout, name) for name in ("domains", "errors"))
    try:
        lease = domains.lease_terminal_domain(environ, str(layout.venv))
    except errors.DomainsExhaustedError as error:
        say(str(error))
        return
    if lease is not None:
        lease.keep_across_exec()


def _of_rosbeat(layout: Layout, name: str) -> Any:  # noqa: ANN401 - a module
    """Import a module of the helper package, which is not installed for this Python.

    What the package does when it is itself imported is left out: it would be for this Python.
    """
    package = ModuleType("rosbeat")
    package.__path__ = [str(layout.root / "src" / "rosbeat")]
    sys.modules.setdefault("rosbeat", package)
    return importlib.import_module(f"rosbeat.{name}")

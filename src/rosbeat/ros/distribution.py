"""Refuse a release of rclpy that this engine was not tried with.

Virtual time uses private parts of rclpy (`docs/architecture.md` lists them), and each distribution
of ROS changes some. What differs between the supported ones is in `differences`, and
`docs/distributions.md` says how to take up the next. This module is imported before rclpy, and also
where there is none.
"""

from __future__ import annotations

import importlib
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from rosbeat.errors import UnsupportedRclpyError

#: The distributions that this engine runs on, and the first two numbers of their rclpy.
SUPPORTED = {"Jazzy": "7.1", "Kilted": "9.1"}
#: What an rclpy that does not tell its release must have to be used at all, by module.
_NEEDED = {
    "rclpy.executors": (
        "await_or_execute",
        "Executor._make_handler",
        "Executor.wait_for_ready_callbacks",
    ),
    "rclpy.event_handler": ("EventHandler",),
    "rclpy.subscription": ("Subscription.CallbackType",),
    "rclpy.utilities": ("g_default_context", "g_context_lock"),
    "rclpy.task": ("Task.executing", "Future._set_executor"),
}


def check() -> None:
    """Look at the rclpy that would be imported; there may be none.

    Raises:
        UnsupportedRclpyError: If it is neither that of Jazzy nor that of Kilted.
    """
    try:
        spec = find_spec("rclpy")
    except ValueError:  # a stand-in that a test has put into sys.modules
        return
    if spec is None or spec.origin is None:
        return
    file = Path(spec.origin)
    release = release_of(file)
    if release is None:
        missing = _missing()
        if missing:
            raise _refusal(
                f"The rclpy in {file.parent} has no `{missing}`, and no release is named."
            )
    elif ".".join(release.split(".")[:2]) not in SUPPORTED.values():
        raise _refusal(f"The rclpy in {file.parent} is release {release}.")


def release_of(file: Path) -> str | None:
    """Return the release of an rclpy, or None if nothing tells.

    The package.xml in its prefix tells for packages of a robot's system, of a workspace and of pip
    alike; what pip knows of a package is asked only where there is none.

    Args:
        file: The `__init__.py` of the package.
    """
    for folder in file.parents:
        try:
            text = (folder / "share" / "rclpy" / "package.xml").read_text(encoding="utf-8")
        except (OSError, ValueError):
            continue
        release = text.partition("<version>")[2].partition("</version>")[0].strip()
        if release:
            return release
    try:
        return version("rclpy")
    except PackageNotFoundError:
        return None


def _missing() -> str:
    """Return the first thing that this rclpy lacks of what is needed."""
    for module, names in _NEEDED.items():
        for name in names:
            try:
                place = importlib.import_module(module)
                for part in name.split("."):
                    place = getattr(place, part)
            except (ImportError, AttributeError):
                return f"{module}.{name}"
    return ""


def _refusal(what: str) -> UnsupportedRclpyError:
    known = " and ".join(f"{name}'s ({release}.x)" for name, release in SUPPORTED.items())
    return UnsupportedRclpyError(
        what,
        f"rosbeat runs nodes in virtual time with private parts of rclpy, and it knows {known}. "
        "With another release, nodes might behave otherwise than on a robot, so nothing is run.",
        "Source ROS 2 Jazzy or Kilted. On Linux on x86-64, pip can also install one, in a new "
        'virtual environment and with no ROS sourced: `pip install "rosbeat[ros]"` for Jazzy, '
        '`pip install "rosbeat[kilted]"` for Kilted.',
    )

"""Define errors that say what happened, what it means and what to try.

What happened is in the words of the original, where it has a sentence for it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from typing import NoReturn


class LaunchError(Exception):
    """Say that a launch description cannot be read or carried out.

    Args:
        what: What happened.
        meaning: What it means here.
        advice: What to try.
    """

    def __init__(self, what: str, meaning: str, advice: str) -> None:
        super().__init__(what)
        self.what, self.meaning, self.advice = what, meaning, advice

    def __str__(self) -> str:
        return self.what


class SubstitutionFailure(LaunchError):  # noqa: N818 - the name that launch files catch
    """Say that a substitution has no value."""

    def __init__(
        self,
        what: str,
        meaning: str = "A substitution in the launch file has no value.",
        advice: str = "Correct the substitution, or give it a default.",
    ) -> None:
        super().__init__(what, meaning, advice)


class InvalidConditionExpressionError(LaunchError):
    """Say that a condition is neither true nor false."""


class InvalidLaunchFileError(LaunchError):
    """Say that a launch file cannot be read."""


class LeftOutError(LaunchError, ImportError):
    """Say that this subset of launch does not have something that the original has."""


def refuse(what: str, advice: str) -> NoReturn:
    """Refuse something that the original has, by its name."""
    raise LeftOutError(
        f"{what} is left out here",
        "This is the part of launch for ROS 2 installed with pip that nodes in Python need.",
        advice,
    )


#: What to do instead of what is left out.
_INSTEAD = {
    "ComposableNodeContainer": "Start each node as a process, with `Node(package=..., "
    "executable=...)`; components are written in C++.",
    "LifecycleNode": "Start it with `Node(...)`, and change its state with `ros2 service call "
    "/NAME/change_state`.",
    "OpaqueCoroutine": "Use `OpaqueFunction`, or a node of your own.",
    "RosTimer": "Use `TimerAction`, which counts the seconds of the clock on the wall.",
    "SetUseSimTime": "Use `SetParameter('use_sim_time', True)`, which gives it to every node.",
}
_INSTEAD |= {
    "ComposableNode": _INSTEAD["ComposableNodeContainer"],
    "LoadComposableNodes": _INSTEAD["ComposableNodeContainer"],
    "LifecycleTransition": _INSTEAD["LifecycleNode"],
    "OnStateTransition": _INSTEAD["LifecycleNode"],
    "lifecycle": _INSTEAD["LifecycleNode"],
    "ROSTimer": _INSTEAD["RosTimer"],
}
_OTHERWISE = "Leave it out of the launch file, or run the file with a full ROS 2 installation."


def left_out(module: str, *names: str) -> Callable[[str], NoReturn]:
    """Return the `__getattr__` of a module, which refuses some names of the original.

    Args:
        module: Its name.
        *names: What it leaves out.
    """

    def get(name: str) -> NoReturn:
        if name in names:
            refuse(f"`{module}.{name}`", _INSTEAD.get(name, _OTHERWISE))
        raise AttributeError(f"module {module!r} has no attribute {name!r}")

    return get


def alias_submodules(module: str, names: Iterable[str]) -> None:
    """Let `from launch.actions.log_info import LogInfo` find what `launch.actions` holds.

    The original has a module for each class, and editors complete imports to these.
    """
    for name in names:
        letters = [
            f"_{letter.lower()}" if letter.isupper() and i and name[i - 1].islower() else letter
            for i, letter in enumerate(name)
        ]
        sys.modules.setdefault(f"{module}.{''.join(letters).lower()}", sys.modules[module])

"""Define what may happen while a launch runs."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.errors import alias_submodules

if TYPE_CHECKING:
    from launch.action import Action
    from launch.actions import TimerAction
    from launch.launch_description import LaunchDescription

__all__ = ["Event", "ExecutionComplete", "IncludeLaunchDescription", "Shutdown", "TimerEvent",
           "matches_action"]  # fmt: skip


class Event:
    """Say that something happened."""

    name = "launch.Event"


class Shutdown(Event):
    """Ask everything to end.

    Args:
        reason: Why.
        due_to_sigint: Whether a Ctrl+C is the reason, which the processes have got as well.
    """

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.reason, self.due_to_sigint = reason, due_to_sigint


class IncludeLaunchDescription(Event):
    """Ask for a launch description to be carried out."""

    name = "launch.events.IncludeLaunchDescription"

    def __init__(self, launch_description: LaunchDescription) -> None:
        self.launch_description = launch_description


class ExecutionComplete(Event):
    """Say that an action has ended."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: Action) -> None:
        self.action = action


class TimerEvent(Event):
    """Say that the time of a `TimerAction` has come."""

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: TimerAction) -> None:
        self.timer_action = timer_action


def matches_action(target: Action) -> Callable[[Action], bool]:
    """Return what tells whether an action is this one."""
    return lambda action: action is target


alias_submodules(__name__, ["Shutdown", "ExecutionComplete", "TimerEvent", "Matchers"])

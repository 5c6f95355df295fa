"""Describe what to start, and start it: the part of ROS 2's `launch` that nodes in Python need.

The names are those of ROS 2, so that launch files run unchanged. A launch description is data:
actions, substitutions, conditions and event handlers. `launch_service` visits it against a host,
which has the processes, the clock and the log: `real_host` those of this machine.
"""

from launch import (
    actions,
    conditions,
    event_handlers,
    events,
    frontend,
    launch_description_sources,
    logging,
    substitutions,
)
from launch.action import Action, LaunchDescriptionEntity
from launch.conditions import Condition
from launch.errors import InvalidLaunchFileError, LaunchError, alias_submodules, left_out
from launch.event_handlers import EventHandler
from launch.events import Event
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.launch_description_sources import LaunchDescriptionSource
from launch.launch_introspector import LaunchIntrospector
from launch.launch_service import LaunchService
from launch.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
    Substitution,
)

__all__ = [
    "Action", "Condition", "Event", "EventHandler", "InvalidLaunchFileError", "LaunchContext",
    "LaunchDescription", "LaunchDescriptionEntity", "LaunchDescriptionSource", "LaunchError",
    "LaunchIntrospector", "LaunchService", "SomeSubstitutionsType",
    "SomeSubstitutionsType_types_tuple", "Substitution", "actions", "conditions",
    "event_handlers", "events", "frontend", "launch_description_sources", "logging",
    "substitutions",
]  # fmt: skip

__getattr__ = left_out(__name__, "descriptions")
# Where the original has a module for each class.
alias_submodules(__name__, ["LaunchDescriptionEntity", "LaunchDescriptionSource", "Condition",
                            "EventHandler", "Event", "InvalidLaunchFileError"])  # fmt: skip

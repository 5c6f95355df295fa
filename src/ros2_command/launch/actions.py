"""Define the actions of `launch.actions` besides those that start processes."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ros2_command.untyped import Untyped

from launch.action import Action, LaunchDescriptionEntity
from launch.errors import LaunchError, alias_submodules, left_out
from launch.event_handlers import BaseEventHandler, OnShutdown
from launch.events import Event, TimerEvent
from launch.events import Shutdown as ShutdownEvent
from launch.events.process import ProcessExited
from launch.launch_context import LaunchContext
from launch.launch_description_sources import AnyLaunchDescriptionSource, LaunchDescriptionSource
from launch.processes import ExecuteLocal, ExecuteProcess
from launch.substitution import (
    SomeSubstitutionsType,
    described,
    normalize_to_list_of_substitutions,
    performed,
    performed_as,
    performed_flag,
)

__all__ = [
    "AppendEnvironmentVariable", "DeclareLaunchArgument", "EmitEvent", "ExecuteLocal",
    "ExecuteProcess", "GroupAction", "IncludeLaunchDescription", "LogInfo", "OpaqueFunction",
    "PopEnvironment", "PopLaunchConfigurations", "PushEnvironment", "PushLaunchConfigurations",
    "RegisterEventHandler", "ResetEnvironment", "ResetLaunchConfigurations",
    "SetEnvironmentVariable", "SetLaunchConfiguration", "Shutdown", "TimerAction",
    "UnregisterEventHandler", "UnsetEnvironmentVariable", "UnsetLaunchConfiguration",
]  # fmt: skip

__getattr__ = left_out(__name__, "OpaqueCoroutine")

Pairs = Mapping[Any, SomeSubstitutionsType]
#: How many launch files may include each other.
_DEEPEST = 100


class LogInfo(Action):
    """Log a line."""

    def __init__(self, *, msg: SomeSubstitutionsType, **action: Untyped) -> None:
        super().__init__(**action)
        self.msg = normalize_to_list_of_substitutions(msg)

    def execute(self, context: LaunchContext) -> None:
        """Log it."""
        context.host.log(logging.INFO, "launch.user", performed(context, self.msg))


class DeclareLaunchArgument(Action):
    """Declare an argument of the launch file, and give it its default.

    Args:
        name: Its name.
        default_value: Its value if nothing else gives one; without it, one must be given.
        description: What it is for.
        choices: The only values that it may have.
        condition: When to declare it.
    """

    def __init__(
        self, name: str, *, default_value: SomeSubstitutionsType | None = None,
        description: str | None = None, choices: list[str] | None = None, **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(**action)
        self.name, self.choices = name, choices
        self.default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )
        #: Whether only some launches declare it, as far as that is known.
        self.conditionally_included = False
        if choices is not None:
            if not choices:
                raise ValueError(
                    "Provided choices arg is empty. Use None to ignore the choice list."
                )
            if isinstance(default_value, str) and default_value not in choices:
                raise ValueError(
                    f'Provided default_value "{default_value}" is not in provided choices '
                    f'"{choices}".'
                )
        if description is None:
            self.description = f"One of: {choices}" if choices else "no description given"
        else:
            stop = "" if description.endswith(".") else "."
            more = f"{stop} Valid choices are: {choices}" if choices else ""
            self.description = description + more

    def execute(self, context: LaunchContext) -> None:
        """Give the argument its default, and check its value."""
        values = context.launch_configurations
        if self.name not in values:
            if self.default_value is None:
                self._log(
                    context,
                    f'Required launch argument "{self.name}" (description: "{self.description}") '
                    "was not provided",
                )
                raise LaunchError(
                    f'Required launch argument "{self.name}" was not provided.',
                    f"The argument has no default. It is for: {self.description}",
                    f"Type its value behind the launch file:  {self.name}:=VALUE",
                )
            values[self.name] = performed(context, self.default_value)
        if self.choices is not None and values[self.name] not in self.choices:
            what = (
                f'Argument "{self.name}" provided value "{values[self.name]}" is not valid. Valid '
                f"options are: {self.choices}"
            )
            self._log(context, what)
            raise LaunchError(
                what,
                "The launch file takes only these values for this argument.",
                f"Type one of them, as in {self.name}:={self.choices[0]}",
            )

    def _log(self, context: LaunchContext, text: str) -> None:
        context.host.log(logging.ERROR, "launch.actions.declare_launch_argument", text)


class SetLaunchConfiguration(Action):
    """Give a launch configuration a value."""

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **action: Untyped
    ) -> None:
        super().__init__(**action)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)

    def execute(self, context: LaunchContext) -> None:
        """Give it the value."""
        context.launch_configurations[performed(context, self.name)] = performed(
            context, self.value
        )


class UnsetLaunchConfiguration(Action):
    """Take a launch configuration away."""

    def __init__(self, name: SomeSubstitutionsType, **action: Untyped) -> None:
        super().__init__(**action)
        self.name = normalize_to_list_of_substitutions(name)

    def execute(self, context: LaunchContext) -> None:
        """Take it away."""
        context.launch_configurations.pop(performed(context, self.name), None)


class SetEnvironmentVariable(Action):
    """Set an environment variable for the processes that start after it."""

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **action: Untyped
    ) -> None:
        super().__init__(**action)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        context.environment[performed(context, self.name)] = performed(context, self.value)


class AppendEnvironmentVariable(SetEnvironmentVariable):
    """Add to an environment variable, behind or before what it holds."""

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = os.pathsep, **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(name, value, **action)
        self.prepend, self.separator = prepend, separator

    def execute(self, context: LaunchContext) -> None:
        """Add to it."""
        name, value = performed(context, self.name), performed(context, self.value)
        parts = [context.environment[name], value] if name in context.environment else [value]
        if performed_flag(context, self.prepend):
            parts.reverse()
        context.environment[name] = performed(context, self.separator).join(parts)


class UnsetEnvironmentVariable(Action):
    """Take an environment variable away."""

    def __init__(self, name: SomeSubstitutionsType, **action: Untyped) -> None:
        super().__init__(**action)
        self.name = normalize_to_list_of_substitutions(name)

    def execute(self, context: LaunchContext) -> None:
        """Take it away."""
        context.environment.pop(performed(context, self.name), None)


class PushLaunchConfigurations(Action):
    """Keep the launch configurations."""

    def execute(self, context: LaunchContext) -> None:
        """Keep them."""
        context.push_launch_configurations()


class PopLaunchConfigurations(Action):
    """Bring the launch configurations back that were kept."""

    def execute(self, context: LaunchContext) -> None:
        """Bring them back."""
        context.pop_launch_configurations()


class PushEnvironment(Action):
    """Keep the environment."""

    def execute(self, context: LaunchContext) -> None:
        """Keep it."""
        context.push_environment()


class PopEnvironment(Action):
    """Bring the environment back that was kept."""

    def execute(self, context: LaunchContext) -> None:
        """Bring it back."""
        context.pop_environment()


class ResetEnvironment(Action):
    """Bring the environment back that the launch began with."""

    def execute(self, context: LaunchContext) -> None:
        """Bring it back."""
        context.reset_environment()


class ResetLaunchConfigurations(Action):
    """Forget all launch configurations but some."""

    def __init__(self, launch_configurations: Pairs | None = None, **action: Untyped) -> None:
        super().__init__(**action)
        self.launch_configurations = launch_configurations or {}

    def execute(self, context: LaunchContext) -> None:
        """Forget them."""
        kept = {
            performed(context, name): performed(context, value)
            for name, value in self.launch_configurations.items()
        }
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)


class GroupAction(Action):
    """Do some actions together.

    Args:
        actions: The actions.
        scoped: Whether what they set ends with them.
        forwarding: Whether they see what was set before.
        launch_configurations: What to set for them.
        condition: When to do them.
    """

    def __init__(
        self, actions: Iterable[LaunchDescriptionEntity], *, scoped: bool = True,
        forwarding: bool = True, launch_configurations: Pairs | None = None, **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(**action)
        self._actions, self._scoped, self._forwarding = list(actions), scoped, forwarding
        self._set = launch_configurations or {}

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions, and those that make a scope of them."""
        start: list[LaunchDescriptionEntity] = [
            SetLaunchConfiguration(name, value) for name, value in self._set.items()
        ]
        if not self._scoped:
            return [*start, *self._actions]
        if not self._forwarding:
            start = [ResetEnvironment(), ResetLaunchConfigurations(self._set)]
        return [
            PushLaunchConfigurations(), PushEnvironment(), *start, *self._actions,
            PopEnvironment(), PopLaunchConfigurations(),
        ]  # fmt: skip

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions."""
        del context
        return self.get_sub_entities()


class IncludeLaunchDescription(Action):
    """Do what another launch file says.

    Args:
        launch_description_source: The launch file.
        launch_arguments: Its arguments, as pairs.
        condition: When to do it.
    """

    def __init__(
        self, launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType, *,
        launch_arguments: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]] | None
        = None,
        **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(**action)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self.launch_description_source = launch_description_source
        if isinstance(launch_arguments, Mapping):
            raise TypeError("launch_arguments must be pairs, not a dictionary; write {...}.items()")
        self.launch_arguments = tuple(launch_arguments or ())

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return what the launch file says, as far as that is known before the launch."""
        description = self.launch_description_source.try_get_launch_description_without_context()
        return [] if description is None else [description]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return what the launch file says, and what sets its arguments."""
        known = context.get_locals_as_dict()
        above: tuple[str, ...] = known.get("including_launch_files", ())
        description = self.launch_description_source.get_launch_description(context)
        path = os.path.abspath(self.launch_description_source.location)
        if len(above) > _DEEPEST and path in above:
            again = next(place for place, file in enumerate(above) if file in above[:place])
            circle = above[above.index(above[again]) : again + 1]
            raise LaunchError(
                "maximum recursion depth exceeded: launch files include each other without end",
                "The files include each other in this order: "
                + " -> ".join(map(os.path.basename, circle)),
                "Take one of these includes away, or give it a condition.",
            )
        names = [performed(context, name) for name, _ in self.launch_arguments]
        for argument, includes in description.arguments_with_includes():
            if argument.conditionally_included or argument.default_value is not None:
                continue
            inner = [name for include in includes for name, _ in include.launch_arguments]
            given = [*names, *(name for name in inner if isinstance(name, str))]
            if argument.name not in given and argument.name not in context.launch_configurations:
                raise LaunchError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(given)}]",
                    f"'{os.path.basename(path)}' declares this argument without a default, and "
                    "nothing gives it a value.",
                    f"Type its value behind the launch file:  {argument.name}:=VALUE",
                )
        here = {
            "current_launch_file_path": path,
            "current_launch_file_directory": os.path.dirname(path),
        }
        before = {name: known.get(name) for name in here}
        return [
            _Locals({**here, "including_launch_files": (*above, path)}),
            *(SetLaunchConfiguration(name, value) for name, value in self.launch_arguments),
            description,
            _Locals({**before, "including_launch_files": above}),
        ]


class _Locals(Action):
    """Set what is known to the actions that follow."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        super().__init__()
        self._values = values

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        context.extend_locals(self._values)


class OpaqueFunction(Action):
    """Call a function, and do the actions that it returns.

    Args:
        function: Is called with the context.
        args: More arguments.
        kwargs: More arguments, by name.
        condition: When to call it.
    """

    def __init__(
        self, *, function: Callable[..., Any], args: Sequence[Any] | None = None,
        kwargs: Mapping[str, Any] | None = None, **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(**action)
        if not callable(function):
            raise TypeError(f"OpaqueFunction expected a function, but got '{type(function)}'")
        self._function, self._args, self._kwargs = function, args or (), kwargs or {}

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Call it, and return the actions."""
        actions = self._function(context, *self._args, **self._kwargs)
        return None if actions is None else list(actions)


class EmitEvent(Action):
    """Make an event happen."""

    def __init__(self, *, event: Event, **action: Untyped) -> None:
        super().__init__(**action)
        if not isinstance(event, Event):
            raise TypeError(
                f"EmitEvent expected 'event' to be an event, as launch.events.Shutdown(), but got "
                f"'{type(event)}'"
            )
        self.event = event

    def execute(self, context: LaunchContext) -> None:
        """Make it happen."""
        context.emit_event(self.event)


class Shutdown(EmitEvent):
    """End the launch."""

    def __init__(self, *, reason: str = "reason not given", **action: Untyped) -> None:
        super().__init__(event=ShutdownEvent(reason=reason), **action)

    def execute(self, context: LaunchContext) -> None:
        """End it."""
        event = context.get_locals_as_dict().get("event")
        if isinstance(event, ProcessExited):
            context.host.log(
                logging.INFO, "launch",
                f"process[{event.process_name}] was required: shutting down launched system",
            )  # fmt: skip
        super().execute(context)


class RegisterEventHandler(Action):
    """Let an event handler handle events from now on."""

    def __init__(self, event_handler: BaseEventHandler, **action: Untyped) -> None:
        super().__init__(**action)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> None:
        """Register it."""
        context.register_event_handler(self.event_handler)

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions that follow an event."""
        description, actions = self.event_handler.describe()
        return [(description, actions)] if actions else []


class UnregisterEventHandler(RegisterEventHandler):
    """Let an event handler handle no more events."""

    def execute(self, context: LaunchContext) -> None:
        """Take it away."""
        context.unregister_event_handler(self.event_handler)


class TimerAction(Action):
    """Do actions after some seconds.

    Args:
        period: The seconds.
        actions: The actions.
        cancel_on_shutdown: Whether they are not done if the launch ends before.
        condition: When to wait at all.
    """

    def __init__(
        self, *, period: float | SomeSubstitutionsType, actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True, **action: Untyped,
    ) -> None:  # fmt: skip
        super().__init__(**action)
        self.period, self.actions = period, list(actions)
        self._cancel_on_shutdown = cancel_on_shutdown
        self._canceled = False
        self._stop: Callable[[], None] | None = None

    def describe(self) -> str:
        """Return a description of it."""
        return f"TimerAction(period={self._period()}, actions=<actions>)"

    def _period(self) -> str:
        return str(self.period) if isinstance(self.period, int | float) else described(self.period)

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions."""
        return [(f"{self._period()} seconds pass without being canceled", self.actions)]

    def execute(self, context: LaunchContext) -> None:
        """Begin to wait."""
        if self._canceled:
            return
        seconds = float(performed_as(context, self.period, float))
        known = context.get_locals_as_dict()
        context.begin(self)

        def fire() -> None:
            context.emit_event(TimerEvent(timer_action=self))
            context.end(self)

        cancel = context.host.call_later(seconds, fire)

        def stop() -> None:
            if self in context.running:
                cancel()
                context.end(self)

        self._stop = stop
        context.register_event_handler(_OnTime(self, known))
        if performed_flag(context, self._cancel_on_shutdown):
            context.register_event_handler(OnShutdown(on_shutdown=lambda event, context: stop()))

    def cancel(self) -> None:
        """Wait no longer, and do nothing."""
        self._canceled = True
        if self._stop is not None:
            self._stop()


class _OnTime(BaseEventHandler):
    """Do the actions of one timer."""

    def __init__(self, timer: TimerAction, known: Mapping[str, Any]) -> None:
        super().__init__(
            matcher=lambda event: isinstance(event, TimerEvent) and event.timer_action is timer,
            handle_once=True,
        )
        self._timer, self._known = timer, known

    def handle(self, event: Event, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions; what was known at the timer is known to them."""
        super().handle(event, context)
        context.extend_locals(self._known)
        return self._timer.actions


alias_submodules(__name__, [*__all__, "ShutdownAction"])

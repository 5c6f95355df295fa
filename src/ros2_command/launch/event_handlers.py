"""Define what follows an event."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeAlias

from ros2_command.untyped import Untyped

from launch.action import Action, LaunchDescriptionEntity
from launch.errors import LaunchError, alias_submodules
from launch.events import Event, ExecutionComplete, IncludeLaunchDescription, Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = [
    "BaseEventHandler", "EventHandler", "OnExecutionComplete", "OnIncludeLaunchDescription",
    "OnProcessExit", "OnProcessIO", "OnProcessStart", "OnShutdown",
]  # fmt: skip

SomeEntities: TypeAlias = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]
#: What to do at an event, or a function of the event and the context that returns it.
Handled: TypeAlias = SomeEntities | Callable[[Any, "LaunchContext"], SomeEntities | None]


class BaseEventHandler:
    """Handle the events that a function picks.

    Args:
        matcher: Says whether an event is one.
        handle_once: Whether only the first one is handled.
    """

    #: What `ros2 launch --print` says of the matcher and of what follows.
    matcher_description: str | None = None
    handler_description: str | None = None

    def __init__(self, *, matcher: Callable[[Any], bool], handle_once: bool = False) -> None:
        self._matcher, self.handle_once = matcher, handle_once

    def matches(self, event: Event) -> bool:
        """Return whether the event is handled here."""
        return self._matcher(event)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description of it, and the actions that follow."""
        text = (
            f"{type(self).__name__}(matcher='{self.matcher_description}', "
            f"handler='{self.handler_description}', handle_once={self.handle_once})"
        )
        return text, []

    def handle(self, event: Event, context: LaunchContext) -> SomeEntities | None:
        """Return what follows the event."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """Do something at each event that a function picks."""

    def __init__(
        self, *, matcher: Callable[[Any], bool], entities: SomeEntities | None = None,
        handle_once: bool = False,
    ) -> None:  # fmt: skip
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.entities = entities

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description of it, and the actions that follow."""
        return super().describe()[0], _listed(self.entities)

    def handle(self, event: Event, context: LaunchContext) -> SomeEntities | None:
        """Return what follows the event."""
        super().handle(event, context)
        return self.entities


class _OnEvent(BaseEventHandler):
    """Do something at each event of a class."""

    def __init__(
        self, event_class: type[Event], on_event: Handled, matcher: Callable[[Any], bool],
        **options: bool,
    ) -> None:  # fmt: skip
        super().__init__(
            matcher=lambda event: isinstance(event, event_class) and matcher(event), **options
        )
        self._event_class, self._on_event = event_class, on_event
        if not callable(on_event):
            for entity in _listed(on_event):
                if not isinstance(entity, LaunchDescriptionEntity):
                    raise TypeError(
                        f"{type(self).__name__} expected actions or a function, but got "
                        f"'{type(entity)}'"
                    )

    @property
    def matcher_description(self) -> str:  # type: ignore[override] # known when it is made
        """Return which events these are."""
        return f"event == {self._event_class.__name__}"

    @property
    def handler_description(self) -> str:  # type: ignore[override] # known when it is made
        """Return what follows."""
        return str(self._on_event) if callable(self._on_event) else "<actions>"

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description of it, and the actions that follow."""
        return super().describe()[0], [] if callable(self._on_event) else _listed(self._on_event)

    def handle(self, event: Event, context: LaunchContext) -> SomeEntities | None:
        """Return what follows the event."""
        super().handle(event, context)
        if callable(self._on_event):
            return self._on_event(event, context)
        return self._on_event


class _OnAction(_OnEvent):
    """Do something at each event of a class that tells of one action, or of any."""

    def __init__(
        self, event_class: type[Event], action_class: type[Action], name: str, on_event: Handled,
        target_action: Action | Callable[[Any], bool] | None, **options: bool,
    ) -> None:  # fmt: skip
        is_function = callable(target_action) and not isinstance(target_action, Action)
        if (
            target_action is not None
            and not is_function
            and not isinstance(target_action, action_class)
        ):
            raise LaunchError(
                f"{name} must be a '{action_class.__name__}' instance or a callable",
                f"{type(self).__name__} waits for an event of this action, and "
                f"'{type(target_action).__name__}' has none.",
                "Pass the action itself, as in target_action=talker.",
            )
        self._action_class, self._target = action_class, target_action
        super().__init__(event_class, on_event, self._is_meant, **options)

    def _is_meant(self, event: Untyped) -> bool:
        if self._target is None or isinstance(self._target, Action):
            return self._target in (None, event.action)
        return bool(self._target(event.action))

    @property
    def matcher_description(self) -> str:  # type: ignore[override] # known when it is made
        """Return which events these are."""
        text = super().matcher_description
        if self._target is None:
            return text
        return f"{text} and {self._action_class.__name__}(event.action)"


def _process_class() -> type[Action]:
    from launch.processes import ExecuteLocal  # which needs this module

    return ExecuteLocal


def _program_class() -> type[Action]:
    from launch.processes import ExecuteProcess

    return ExecuteProcess


class OnProcessExit(_OnAction):
    """Do something when a process has ended; when any has, without `target_action`."""

    def __init__(
        self,
        *,
        target_action: Untyped = None,
        on_exit: Handled,
        **options: bool,
    ) -> None:
        super().__init__(
            ProcessExited, _process_class(), "target_action", on_exit, target_action, **options
        )


class OnProcessStart(_OnAction):
    """Do something when a process has started; when any has, without `target_action`."""

    def __init__(
        self,
        *,
        target_action: Untyped = None,
        on_start: Handled,
        **options: bool,
    ) -> None:
        super().__init__(
            ProcessStarted, _program_class(), "target_action", on_start, target_action, **options
        )


class OnProcessIO(_OnAction):
    """Call a function with what a process prints; with what any prints, without `target_action`."""

    def __init__(
        self, *, target_action: Untyped = None, on_stdin: Callable[[Any], Any] | None = None,
        on_stdout: Callable[[Any], Any] | None = None,
        on_stderr: Callable[[Any], Any] | None = None, **options: bool,
    ) -> None:  # fmt: skip
        functions = {0: on_stdin, 1: on_stdout, 2: on_stderr}

        def handle(event: ProcessIO, context: LaunchContext) -> SomeEntities | None:
            del context
            function = functions[event.fd]
            return function(event) if function is not None else None

        super().__init__(
            ProcessIO, _process_class(), "target_action", handle, target_action, **options
        )


class OnExecutionComplete(_OnAction):
    """Do something when an action is done; when any is, without `target_action`."""

    def __init__(
        self,
        *,
        target_action: Untyped = None,
        on_completion: Handled,
        **options: bool,
    ) -> None:
        super().__init__(
            ExecutionComplete, Action, "target_action", on_completion, target_action, **options
        )


class OnShutdown(_OnEvent):
    """Do something when the launch begins to end."""

    def __init__(self, *, on_shutdown: Handled, **options: bool) -> None:
        super().__init__(Shutdown, on_shutdown, lambda _: True, **options)

    @property
    def matcher_description(self) -> str:  # type: ignore[override] # known when it is made
        """Return which events these are."""
        return "event issubclass of launch.events.Shutdown"


class OnIncludeLaunchDescription(BaseEventHandler):
    """Carry out the launch descriptions that events ask for."""

    def __init__(self) -> None:
        super().__init__(matcher=lambda event: isinstance(event, IncludeLaunchDescription))

    def handle(self, event: Event, context: LaunchContext) -> SomeEntities:
        """Return the launch description."""
        super().handle(event, context)
        assert isinstance(event, IncludeLaunchDescription)
        return event.launch_description


def _listed(entities: SomeEntities | None) -> list[LaunchDescriptionEntity]:
    if entities is None:
        return []
    return [entities] if isinstance(entities, LaunchDescriptionEntity) else list(entities)


alias_submodules(__name__, __all__)

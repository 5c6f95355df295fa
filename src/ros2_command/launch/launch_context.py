"""Hold what substitutions and actions may ask for while a launch runs."""

from __future__ import annotations

import shutil
import tempfile
from collections import deque
from collections.abc import Callable, Iterable, Mapping, MutableMapping
from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import finalize

from ros2_command.untyped import Untyped

from launch.host import Host, SilentHost
from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.event_handlers import BaseEventHandler
    from launch.events import Event


class Locals:
    """Give the locals of a context as attributes."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.__dict__.update(values)

    def __getattr__(self, name: str) -> Untyped:
        raise AttributeError(
            f"context.locals does not contain attribute '{name}', it contains: "
            f"[{', '.join(self.__dict__)}]"
        )


class LaunchContext:
    """Hold launch configurations, the environment, event handlers and locals.

    Args:
        argv: The arguments of the launch.
        noninteractive: Whether Ctrl+C may not reach the processes by itself.
        host: Where processes run; by default nowhere.
    """

    def __init__(
        self, *, argv: Iterable[str] | None = None, noninteractive: bool = False,
        host: Host | None = None,
    ) -> None:  # fmt: skip
        self.argv = list(argv or ())
        self.noninteractive = noninteractive
        self.host = host or SilentHost()
        self.environment: MutableMapping[str, str] = self.host.environment
        self.launch_configurations: dict[str, Any] = {}
        self.is_shutdown = False
        #: What runs when the events that wait have been handled; a process starts so.
        self.later: deque[Callable[[], None]] = deque()
        self.events: deque[Event] = deque()
        self._first_environment = dict(self.environment)
        self._environments: list[dict[str, str]] = []
        self._configurations: list[dict[str, Any]] = []
        self._handlers: deque[BaseEventHandler] = deque()
        self._globals: dict[str, Any] = {}
        self._locals: dict[str, Any] = {}
        self._locals_before: list[dict[str, Any]] = []
        #: Actions that have begun and not ended, each with what to call at its end.
        self.running: dict[object, list[Callable[[], None]]] = {}
        self._process_count = 0
        self._folder: Path | None = None
        #: Removes the files that `write_file` has written; the launch calls it at its end.
        self.remove_files: Callable[[], object] = lambda: None

    # Locals.

    @property
    def locals(self) -> Locals:
        """Return what is known in the place of the launch description that is visited."""
        return Locals(self.get_locals_as_dict())

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return the locals by name."""
        return {**self._globals, **self._locals}

    def extend_globals(self, values: Mapping[str, Any]) -> None:
        """Add locals for good."""
        self._globals.update(values)

    def extend_locals(self, values: Mapping[str, Any]) -> None:
        """Add locals until those before come back."""
        self._locals.update(values)

    def push_locals(self) -> None:
        """Keep the locals, to be brought back by `pop_locals`."""
        self._locals_before.append(dict(self._locals))

    def pop_locals(self) -> None:
        """Bring the locals back."""
        self._locals = self._locals_before.pop()

    # Scopes.

    def push_launch_configurations(self) -> None:
        """Keep the launch configurations, to be brought back by `pop_launch_configurations`."""
        self._configurations.append(_copy(self.launch_configurations))

    def pop_launch_configurations(self) -> None:
        """Bring the launch configurations back."""
        self.launch_configurations = self._configurations.pop()

    def push_environment(self) -> None:
        """Keep the environment, to be brought back by `pop_environment`."""
        self._environments.append(dict(self.environment))

    def pop_environment(self) -> None:
        """Bring the environment back."""
        self._set_environment(self._environments.pop())

    def reset_environment(self) -> None:
        """Bring the environment back that the launch began with."""
        self._set_environment(self._first_environment)

    def _set_environment(self, values: Mapping[str, str]) -> None:
        self.environment.clear()
        self.environment.update(values)

    # Events.

    def emit_event(self, event: Event) -> None:
        """Add an event to those that wait to be handled."""
        self.events.append(event)
        self.host.wake()

    emit_event_sync = emit_event

    def register_event_handler(self, handler: BaseEventHandler, append: bool = False) -> None:
        """Add an event handler, before those that are there or after them."""
        if append:
            self._handlers.append(handler)
        else:
            self._handlers.appendleft(handler)

    def unregister_event_handler(self, handler: BaseEventHandler) -> None:
        """Take an event handler away."""
        self._handlers.remove(handler)

    def handlers_of(self, event: Event) -> list[BaseEventHandler]:
        """Return the handlers of an event, in the order in which they get it."""
        return [handler for handler in self._handlers if handler.matches(event)]

    def would_handle_event(self, event: Event) -> bool:
        """Return whether an event has a handler."""
        return bool(self.handlers_of(event))

    # Actions that take time.

    def begin(self, action: object) -> None:
        """Let the launch run on until `end` is called."""
        self.running[action] = []

    def end(self, action: object) -> None:
        """Say that an action that took time has ended."""
        for call in self.running.pop(action, ()):
            call()
        self.host.wake()

    def next_process_number(self) -> int:
        """Return the number behind the name of the next process, from 1."""
        self._process_count += 1
        return self._process_count

    def write_file(self, text: str) -> Path:
        """Write a file that is there as long as the launch, and return its path."""
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="launch_params_"))
            self.remove_files = finalize(self, shutil.rmtree, self._folder, True)
        path = self._folder / f"{len(list(self._folder.iterdir())) + 1}.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def perform_substitution(self, substitution: Substitution) -> str:
        """Return the text that a substitution stands for."""
        return substitution.perform(self)


def _copy(configurations: Mapping[str, Any]) -> dict[str, Any]:
    # Parameters and remappings for all nodes are lists, which a group must not share.
    return {
        name: list(value) if isinstance(value, list) else value
        for name, value in configurations.items()
    }

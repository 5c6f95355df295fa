"""Carry out launch descriptions: the engine of a launch."""

from __future__ import annotations

import logging
import os
import traceback
from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch.action import LaunchDescriptionEntity
from launch.errors import LaunchError
from launch.event_handlers import OnIncludeLaunchDescription
from launch.events import Event, IncludeLaunchDescription, Shutdown
from launch.host import Host
from launch.launch_context import LaunchContext

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription
    from launch.real_host import RealHost

_OWN = os.path.dirname(os.path.dirname(__file__)) + os.sep


class Engine:
    """Handle the events of a launch, one after the other, until nothing is left to do.

    A host calls `work` when it is woken, and reads `finished` and `return_code`.

    Args:
        context: What the launch knows.
        shutdown_when_idle: Whether to end when nothing runs any more.
    """

    def __init__(self, context: LaunchContext, shutdown_when_idle: bool = True) -> None:
        self.context = context
        self.return_code = 0
        self.finished = False
        #: What went wrong first, if something did.
        self.error: Exception | None = None
        self._shutdown_when_idle = shutdown_when_idle
        context.register_event_handler(OnIncludeLaunchDescription())

    def work(self) -> None:
        """Do all that can be done now."""
        context = self.context
        while not self.finished:
            try:
                if context.events:
                    self._handle(context.events.popleft())
                elif context.later:
                    context.later.popleft()()
                elif context.running:
                    return
                elif context.is_shutdown:
                    self.finished = True
                    context.remove_files()
                elif self._shutdown_when_idle:
                    self.shut_down("idle")
                else:
                    return
            except Exception as error:
                self._fail(error)

    def shut_down(self, reason: str, *, due_to_sigint: bool = False) -> None:
        """Ask everything to end, unless that has been done."""
        if not self.context.is_shutdown:
            self.context.is_shutdown = True
            self.context.emit_event(Shutdown(reason=reason, due_to_sigint=due_to_sigint))

    def _handle(self, event: Event) -> None:
        context = self.context
        if isinstance(event, Shutdown):
            context.is_shutdown = True
        for handler in context.handlers_of(event):
            context.push_locals()
            try:
                entities = handler.handle(event, context)
                for entity in _listed(entities):
                    self._visit(entity)
            finally:
                context.pop_locals()

    def _visit(self, entity: LaunchDescriptionEntity) -> None:
        if not isinstance(entity, LaunchDescriptionEntity):
            raise LaunchError(
                f"expected a LaunchDescriptionEntity, got '{entity}'",
                "A launch description and what a handler or a function returns hold actions only.",
                "Compare the list: a name without parentheses, or a list in the list?",
            )
        for inner in entity.visit(self.context) or ():
            self._visit(inner)

    def _fail(self, error: Exception) -> None:
        self.error = self.error or error
        self.return_code = 1
        message = f"Caught exception in launch (see debug for traceback): {error}"
        log = self.context.host.log
        log(logging.DEBUG, "launch", "".join(traceback.format_exception(error)))
        log(logging.ERROR, "launch", message)
        self.context.host.note(*explained(error))
        self.shut_down(message)


def explained(error: Exception) -> list[str]:
    """Return what an error means and what to try."""
    if isinstance(error, LaunchError):
        return [*error.meaning.splitlines(), error.advice]
    frames = traceback.extract_tb(error.__traceback__)
    frame = ([frame for frame in frames if not frame.filename.startswith(_OWN)] or frames)[-1]
    where = f"line {frame.lineno} of '{os.path.basename(frame.filename)}': {frame.line}"
    return [
        f"Python raised {type(error).__name__} in {where}",
        "Correct the launch file there; `ros2 launch --debug` shows the whole traceback.",
    ]


def _listed(
    entities: LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity] | None,
) -> list[LaunchDescriptionEntity]:
    if entities is None:
        return []
    if isinstance(entities, LaunchDescriptionEntity) or not isinstance(entities, Iterable):
        return [entities]
    return [entity for entity in entities if entity is not None]


class LaunchService:
    """Carry out launch descriptions on this machine.

    Args:
        argv: The arguments of the launch.
        noninteractive: Whether Ctrl+C may not reach the processes by itself.
        debug: Whether to log more.
        host: Where the launch runs; by default on this machine.
    """

    def __init__(
        self, *, argv: Iterable[str] | None = None, noninteractive: bool = False,
        debug: bool = False, host: RealHost | None = None,
    ) -> None:  # fmt: skip
        from launch.real_host import RealHost

        self._host = host or RealHost(debug)
        self.context = LaunchContext(argv=argv, noninteractive=noninteractive, host=self._host)
        self._engine: Engine | None = None

    @property
    def error(self) -> Exception | None:
        """Return what went wrong first, if something did."""
        return self._engine.error if self._engine else None

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Carry out a launch description once the launch runs."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def emit_event(self, event: Event) -> None:
        """Let an event happen once the launch runs."""
        self.context.emit_event(event)

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Run until everything has ended, and return the exit code."""
        self._engine = Engine(self.context, shutdown_when_idle)
        return self._host.run(self._engine)

    def shutdown(self, force_sync: bool = False) -> None:
        """Ask everything to end."""
        del force_sync
        if self._engine is not None:
            self._engine.shut_down("LaunchService.shutdown() called")


__all__ = ["Engine", "Host", "LaunchService"]

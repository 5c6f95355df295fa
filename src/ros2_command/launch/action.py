"""Define what an action is: something that a launch description does."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.events import ExecutionComplete
from ros2_command.names import nearest

if TYPE_CHECKING:
    from launch.conditions import Condition
    from launch.launch_context import LaunchContext


class LaunchDescriptionEntity:
    """Be a part of a launch description."""

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Do it, and return the parts to visit next."""
        raise NotImplementedError

    def describe(self) -> str:
        """Return a description of it."""
        return repr(self)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the parts that it certainly leads to."""
        return []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the parts that it may lead to, and when."""
        return []


class Action(LaunchDescriptionEntity):
    """Be something that a launch description does.

    Args:
        condition: When to do it; always by default.
        **unknown: No other argument is known.
    """

    def __init__(self, *, condition: Condition | None = None, **unknown: Any) -> None:
        for name in unknown:
            meant = nearest(name, _argument_names(type(self)))
            hint = f"; did you mean '{meant}'?" if meant else ""
            raise TypeError(
                f"{type(self).__name__}() got an unexpected keyword argument '{name}'{hint}"
            )
        self.condition = condition

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the parts that it leads to."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the parts that it certainly leads to."""
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the parts that it may lead to, and when."""
        if self.condition is None:
            return []
        return [(f"Conditionally included by {self.describe()}", self.get_sub_entities())]

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Do it, if its condition is true."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            complete = ExecutionComplete(action=self)
            if context.would_handle_event(complete):
                if self in context.running:
                    context.running[self].append(lambda: context.emit_event(complete))
                else:
                    context.emit_event(complete)

    def execute(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Do it, and return the parts to visit next."""
        del context
        return None


def _argument_names(action_class: type) -> list[str]:
    """Return the names of the arguments that an action takes, those of its bases included."""
    parameters = [
        parameter
        for base in action_class.__mro__
        if "__init__" in vars(base)
        for parameter in inspect.signature(base.__init__).parameters.values()  # type: ignore[misc]
    ]
    return [
        parameter.name for parameter in parameters
        if parameter.kind is parameter.KEYWORD_ONLY or parameter.name not in (
            "self", "args", "kwargs", "unknown", "action", "local", "process")
    ]  # fmt: skip

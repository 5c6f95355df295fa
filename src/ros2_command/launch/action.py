"""Define what an action is: something that a launch description does."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ros2_command.names import did_you_mean
from ros2_command.untyped import Untyped

from launch.events import ExecutionComplete

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

    def __init__(self, *, condition: Condition | None = None, **unknown: Untyped) -> None:
        for name in unknown:
            raise ArgumentNameError(name, type(self))
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


class ArgumentNameError(TypeError):
    """Say that an action has no argument of a name."""

    def __init__(self, name: str, action_class: type[Action]) -> None:
        super().__init__(f"Action.__init__() got an unexpected keyword argument '{name}'")
        self.meaning = f"`{action_class.__name__}` has no argument `{name}`."
        self.advice = did_you_mean(
            name, _argument_names(action_class), "Compare it with the documentation of the action."
        )


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

"""Define when an action is done at all."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from launch.errors import InvalidConditionExpressionError, alias_submodules
from launch.substitution import (
    SomeSubstitutionsType,
    Substitution,
    described,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    performed,
)

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = [
    "Condition", "IfCondition", "InvalidConditionExpressionError", "LaunchConfigurationEquals",
    "LaunchConfigurationNotEquals", "UnlessCondition", "evaluate_condition_expression",
]  # fmt: skip


class Condition:
    """Be true or false when the launch runs.

    Args:
        predicate: Says which.
    """

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """Return a description of it."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether it is true."""
        return self._predicate is not None and bool(self._predicate(context))


def evaluate_condition_expression(
    context: LaunchContext, expression: Iterable[Substitution]
) -> bool:
    """Return whether an expression says true or false.

    Raises:
        InvalidConditionExpressionError: If it says neither.
    """
    parts = list(expression)
    text = perform_substitutions(context, parts).strip().lower()
    if text in ("true", "1", "false", "0"):
        return text in ("true", "1")
    raise InvalidConditionExpressionError(
        "invalid condition expression, expected one of [true, 1, false, 0] but got "
        f"'{text}', expanded from '{described(parts)}'",
        "A condition decides whether an action is done, and this one says neither yes nor no.",
        "Write true or false; compare texts with EqualsSubstitution or PythonExpression.",
    )


class IfCondition(Condition):
    """Be true if an expression says so."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        self._expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__()

    def describe(self) -> str:
        """Return a description of it."""
        return f"{type(self).__name__}({described(self._expression)})"

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether the expression says true."""
        return evaluate_condition_expression(context, self._expression)


class UnlessCondition(IfCondition):
    """Be true if an expression says false."""

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether the expression says false."""
        return not super().evaluate(context)


class LaunchConfigurationEquals(Condition):
    """Be true if a launch configuration has a value; None if it has none."""

    def __init__(
        self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None
    ) -> None:
        super().__init__()
        self._name, self._expected = launch_configuration_name, expected_value

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether it has that value."""
        wanted = None if self._expected is None else performed(context, self._expected)
        return bool(context.launch_configurations.get(self._name) == wanted)


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Be true if a launch configuration has another value."""

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether it has another value."""
        return not super().evaluate(context)


alias_submodules(__name__, __all__)

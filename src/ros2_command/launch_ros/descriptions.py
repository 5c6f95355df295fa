"""Describe parameters: `launch_ros.descriptions` and `launch_ros.parameter_descriptions`."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml
from launch.errors import LaunchError, left_out
from launch.substitution import (
    SomeSubstitutionsType,
    Substitution,
    from_text,
    is_substitution,
    is_uniform,
    performed,
    performed_as,
    performed_flag,
)
from ros2_command.untyped import Untyped

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = ["Parameter", "ParameterFile", "ParameterValue"]

__getattr__ = left_out(__name__, "ComposableNode")


class ParameterValue:
    """Be the value of a parameter, of a kind that is said.

    Args:
        value: The value, or substitutions that stand for it.
        value_type: Its kind, such as `str` or `List[int]`; without it as YAML reads it.
    """

    def __init__(self, value: Untyped, *, value_type: object = None) -> None:
        self.value, self.value_type = value, value_type

    def evaluate(self, context: LaunchContext) -> Untyped:
        """Return the value."""
        if isinstance(self.value, str) and not self.value_type:
            return self.value
        try:
            return performed_as(context, self.value, self.value_type)
        except ValueError as error:
            raise LaunchError(
                str(error),
                f"A parameter's value is not of the kind {self.value_type}.",
                "Correct the value, or value_type.",
            ) from None


class Parameter(ParameterValue):
    """Be one parameter of a node.

    Args:
        name: Its name.
        value: Its value, or substitutions that stand for it.
        value_type: Its kind.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: Untyped,
        *,
        value_type: object = None,
    ) -> None:
        super().__init__(value, value_type=value_type)
        self.name = name

    def rule(self, context: LaunchContext) -> str:
        """Return it as a command line gives it."""
        value = yaml.dump(plain(self.evaluate(context)))
        return f"{performed(context, self.name)}:={value}"


class ParameterFile:
    """Be a file with parameters.

    Args:
        param_file: Its path.
        allow_substs: Whether the file holds substitutions as those of XML, `$(var name)`.
    """

    def __init__(
        self, param_file: SomeSubstitutionsType | os.PathLike[str], *,
        allow_substs: bool | SomeSubstitutionsType = False,
    ) -> None:  # fmt: skip
        self.param_file, self.allow_substs = param_file, allow_substs

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path of the file, or of the one that has the substitutions' texts."""
        from launch.frontend import parse_substitution

        if isinstance(self.param_file, os.PathLike):
            path = Path(self.param_file)
        else:
            path = Path(performed(context, self.param_file))
        if not performed_flag(context, self.allow_substs) or not path.is_file():
            return path
        text = performed(context, parse_substitution(path.read_text(encoding="utf-8")))
        return context.write_file(text)


def plain(value: object) -> object:
    """Return a value with lists in the place of tuples, as YAML has them."""
    return list(value) if isinstance(value, tuple) else value


def parameter_values(
    context: LaunchContext, values: Mapping[Any, Any], prefix: str = ""
) -> Iterator[tuple[str, Any]]:
    """Return the parameters of a dictionary, with a dot for each dictionary within.

    Raises:
        LaunchError: If a value is none that a parameter can have.
    """
    for key, value in values.items():
        name = prefix + performed(context, key)
        if isinstance(value, Mapping):
            yield from parameter_values(context, value, f"{name}.")
        else:
            yield name, _value_of(context, name, value)


def _value_of(context: LaunchContext, name: str, value: Untyped) -> Untyped:
    if isinstance(value, ParameterValue):
        return plain(value.evaluate(context))
    if isinstance(value, bool | int | float | str | bytes):
        return value
    if is_substitution(value):
        return _as_yaml(name, performed(context, value))
    if not isinstance(value, list | tuple):
        raise _no_value(name, value)
    items = [_as_yaml(name, performed(context, item)) if _is_open(item) else item for item in value]
    if all(isinstance(item, int | float) and not isinstance(item, bool) for item in items):
        kind = int if all(isinstance(item, int) for item in items) else float
        items = [kind(item) for item in items]
    if not is_uniform(items):
        raise _no_value(name, value)
    return items


def _is_open(item: object) -> bool:
    """Return whether an item of a list stands for a text that is known later."""
    return isinstance(item, list | tuple | Substitution)


def _as_yaml(name: str, text: str) -> Untyped:
    try:
        return from_text(text)
    except ValueError:
        raise _no_value(name, text) from None


def _no_value(name: str, value: object) -> LaunchError:
    return LaunchError(
        "Expected a non-empty sequence, with items of uniform type. Allowed sequence item types "
        f'are bool, int, float, str. Got inconsistent input for "{name}"',
        f"The parameter `{name}` cannot be {value!r}: it is a truth, a number, a text or a list of "
        "one kind of these.",
        "Correct the value. A text that looks like something else becomes one with "
        "ParameterValue(value, value_type=str).",
    )

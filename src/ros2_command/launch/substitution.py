"""Define what a substitution is: a text that is known when the launch runs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, TypeAlias

import yaml
from ros2_command.untyped import Untyped

from launch.errors import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Substitution:
    """Stand for a text that is known when the launch runs."""

    def describe(self) -> str:
        """Return a description of it."""
        return repr(self)

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        raise NotImplementedError


class TextSubstitution(Substitution):
    """Stand for a text that is known already."""

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(
                f"TextSubstitution expected 'text' to be of type 'str', but got '{type(text)}'"
            )
        self.text = text

    def describe(self) -> str:
        """Return the text in quotes."""
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        del context
        return self.text


#: What may be given where a text is wanted.
SomeSubstitutionsType: TypeAlias = str | Substitution | Iterable[str | Substitution]
SomeSubstitutionsType_types_tuple = (str, Substitution, Iterable)


def normalize_to_list_of_substitutions(value: SomeSubstitutionsType) -> list[Substitution]:
    """Return the substitutions whose texts together make up one text."""
    if isinstance(value, str):
        return [TextSubstitution(text=value)]
    if isinstance(value, Substitution):
        return [value]
    if isinstance(value, Iterable):
        return [part for item in value for part in normalize_to_list_of_substitutions(item)]
    raise TypeError(
        f"Failed to normalize given item of type '{type(value)}', when only 'str' or "
        "'launch.Substitution' were expected."
    )


def perform_substitutions(context: LaunchContext, substitutions: Iterable[Substitution]) -> str:
    """Return the text that substitutions make up."""
    return "".join(part.perform(context) for part in substitutions)


def performed(context: LaunchContext, value: SomeSubstitutionsType) -> str:
    """Return the text of whatever may be given where one is wanted."""
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))


def described(value: SomeSubstitutionsType) -> str:
    """Return a description of whatever may be given where a text is wanted."""
    return " + ".join(part.describe() for part in normalize_to_list_of_substitutions(value))


def is_substitution(value: object) -> bool:
    """Return whether a value stands for one text that is known only when the launch runs."""
    if isinstance(value, Substitution):
        return True
    parts = list(value) if isinstance(value, list | tuple) else []
    return any(isinstance(part, Substitution) for part in parts) and all(
        isinstance(part, str | Substitution) for part in parts
    )


#: The kinds of values that a parameter has, or a list of one kind of them.
Scalar: TypeAlias = bool | int | float | str


def from_text(text: str, kind: object = None) -> Untyped:
    """Return the value that a text stands for.

    Args:
        text: The text.
        kind: `bool`, `int`, `float`, `str` or a list of one, such as `List[int]`; None to read it
            as YAML does.

    Raises:
        ValueError: If it stands for no such value.
    """
    if kind is str:
        return text
    if kind in (int, float):
        return kind(text)
    if kind is bool:
        text = {"1": "true", "0": "false"}.get(text.strip(), text)
    try:
        value = yaml.safe_load(text) if text else text
    except yaml.YAMLError as error:
        raise ValueError(f"Failed to convert '{text}' using yaml rules: {error}") from None
    kinds = getattr(kind, "__args__", None)
    if kind is None:
        fits = isinstance(value, Scalar) or is_uniform(value)
    elif kinds:
        fits = isinstance(value, list) and all(isinstance(item, kinds[0]) for item in value)
    else:
        fits = isinstance(value, bool)
    if not fits:
        raise ValueError(f"Cannot convert value '{text}' to '{kind or 'a value of YAML'}'")
    return value


def is_uniform(values: object) -> bool:
    """Return whether these are values of one kind that a parameter may be a list of."""
    if not isinstance(values, Sequence) or isinstance(values, str | bytes) or not values:
        return False
    kind = type(values[0])
    return kind in (bool, int, float, str) and all(type(value) is kind for value in values)


def performed_as(context: LaunchContext, value: Untyped, kind: object) -> Untyped:
    """Return a value, or the one that its substitutions stand for; see `from_text`."""
    if is_substitution(value) or (isinstance(value, str) and kind is not None):
        return from_text(performed(context, value), kind)
    if isinstance(value, list | tuple):
        kinds = getattr(kind, "__args__", (None,))
        return [performed_as(context, item, kinds[0]) for item in value]
    return value


def performed_flag(context: LaunchContext, value: bool | SomeSubstitutionsType) -> bool:
    """Return a bool, or the one that substitutions stand for.

    Raises:
        SubstitutionFailure: If they stand for neither.
    """
    if isinstance(value, bool):
        return value
    text = performed(context, value)
    try:
        return bool(from_text(text, bool))
    except ValueError:
        raise SubstitutionFailure(
            f"Cannot convert value '{text}' to '{bool}'",
            "A value that switches something on or off is neither true nor false.",
            "Write true or false.",
        ) from None

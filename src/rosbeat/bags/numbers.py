"""Find and change the number in a message that a fault affects."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from rosbeat.bags import refusals
from rosbeat.records import Sample


def changed(sample: Sample, field: str | None, change: Callable[[float], float]) -> Sample:
    """Return a copy of a message with one number changed; an integer stays an integer.

    Args:
        sample: The message, which is not modified.
        field: Name of the number, nested fields with dots, such as `linear.x`; None if there is
            only one.
        change: Function from the old number to the new one.

    Raises:
        BagError: If there is no such number, or several, or NaN would replace an integer.
    """
    path = _path(sample, field)
    return replace(sample, data=_put(sample, sample.data, path.split("."), change))


def _path(sample: Sample, field: str | None) -> str:
    known = list(_numbers(sample.data))
    if field in known:
        return str(field)
    if field is None and len(known) == 1:
        return known[0]
    raise refusals.no_such_number(sample, field, known)


def _numbers(data: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Dotted names of all numbers in a message, those in arrays left out."""
    for name, value in data.items():
        if isinstance(value, Mapping):
            yield from _numbers(value, f"{prefix}{name}.")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield prefix + name


def _put(
    sample: Sample, data: Mapping[str, Any], path: list[str], change: Callable[[float], float]
) -> dict[str, Any]:
    name, *rest = path
    value = data[name]
    return {
        **data,
        name: _put(sample, value, rest, change) if rest else _new(sample, value, change),
    }


def _new(sample: Sample, value: float, change: Callable[[float], float]) -> float:
    made = change(value)
    if isinstance(value, float):
        return made
    if made != made:
        raise refusals.whole_numbers_only(sample)
    return round(made)

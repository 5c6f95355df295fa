"""Numbers out of messages: one series per topic and publisher."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from rosbeat.errors import PictureError
from rosbeat.records import Sample
from rosbeat.viz.words import listing


@dataclass(frozen=True)
class Series:
    """One line of a values picture.

    Attributes:
        topic: Full name of the topic.
        node: Full name of the node that published.
        times: In seconds of virtual time, ascending.
        values: The numbers, maybe some that are not finite.
    """

    topic: str
    node: str
    times: tuple[float, ...]
    values: tuple[float, ...]

    @property
    def finite(self) -> list[float]:
        """The values that can be drawn."""
        return [value for value in self.values if isfinite(value)]


def series(samples: Sequence[Sample], field: str | None = None) -> list[Series]:
    """One series for each topic and publisher, in order of first message.

    Args:
        samples: The messages.
        field: Name of the field to read, nested ones with dots, such as `position.x`. None for the
            only field of the message.

    Raises:
        PictureError: If there is no such field or it is not a number.
    """
    groups: dict[tuple[str, str], list[Sample]] = {}
    for one in samples:
        groups.setdefault((one.topic, one.node), []).append(one)
    return [
        Series(topic, node, tuple(s.time for s in group), tuple(read(s, field) for s in group))
        for (topic, node), group in groups.items()
    ]


def read(sample: Sample, field: str | None = None) -> float:
    """The number in one message; truth values count as 0 and 1.

    Args:
        sample: The message.
        field: As for `series`.

    Raises:
        PictureError: If there is no such field or it is not a number.
    """
    value = sample.value if field is None else _follow(sample, field)
    if isinstance(value, (bool, int, float)):
        return float(value)
    numeric = [name for name, inside in paths(sample.data) if isinstance(inside, (int, float))]
    raise PictureError(
        f"{field or 'The message'!s} on {sample.topic} is not a number.",
        f"A {sample.type_name} message here holds {_short(value)}; only numbers have a place on an "
        "axis.",
        f"Choose a field: {listing(map(repr, numeric), 'or')}."
        if numeric
        else "Choose a topic that carries numbers.",
    )


def paths(data: Mapping[str, Any], prefix: str = "") -> list[tuple[str, Any]]:
    """Every field of a message with its dotted path, nested messages resolved."""
    found: list[tuple[str, Any]] = []
    for name, value in data.items():
        inside = isinstance(value, Mapping)
        found += paths(value, f"{prefix}{name}.") if inside else [(prefix + name, value)]
    return found


def _follow(sample: Sample, field: str) -> Any:  # noqa: ANN401 - a field may be of any plain type
    value: Any = sample.data
    for part in field.split("."):
        if not isinstance(value, Mapping) or part not in value:
            known = listing(repr(name) for name, _ in paths(sample.data))
            raise PictureError(
                f"Messages on {sample.topic} have no field {field!r}.",
                f"A {sample.type_name} message has {known or 'no fields'}.",
                "Choose one of these.",
            )
        value = value[part]
    return value


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:37]}..."

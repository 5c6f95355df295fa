"""Read the arguments of pictures, with a helpful error for those that cannot be read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from rosbeat.comparisons import Observer
from rosbeat.errors import PictureError
from rosbeat.records import INFRASTRUCTURE_TOPICS, GraphSnapshot, Observation, Sample
from rosbeat.viz.text_format import listing, nearest

#: Whatever `timeline` can draw from: a session, or what it observed.
Observed = Observation | Observer
#: Whatever `values` can take its messages from.
Samples = Observed | Sequence[Sample]


def snapshot(source: object) -> GraphSnapshot:
    """Return the graph in an observation, or the graph itself.

    Raises:
        PictureError: If `source` is neither.
    """
    if isinstance(source, GraphSnapshot):
        return source
    return observed(source, "an Observation or a GraphSnapshot").graph


def observed(source: object, wanted: str = "an Observation") -> Observation:
    """Return the observation itself, or the one of a session as far as it has run.

    Args:
        source: The observation or the session.
        wanted: What an error says that is needed.

    Raises:
        PictureError: If it is neither.
    """
    if isinstance(source, Observation):
        return source
    if isinstance(source, Observer) and not isinstance(source, type):
        return source.observation()
    raise PictureError(
        f"A picture cannot be drawn from {type(source).__name__!r}.",
        f"It is drawn from recorded data: {wanted}.",
        "Give it the session, or what the session observed: `ros.observation()`.",
    )


def samples(source: object) -> tuple[Sample, ...]:
    """Return the messages in an observation or a sequence.

    Raises:
        PictureError: If `source` is neither, or holds anything but `Sample` records.
    """
    wanted = "an Observation or a sequence of Sample records"
    if isinstance(source, Iterable) and not isinstance(source, str | Observer):
        items = tuple(source)
        if all(isinstance(one, Sample) for one in items):
            return items
    return observed(source, wanted).samples


def topic_names(wanted: str | Iterable[str] | None, known: Sequence[str]) -> tuple[str, ...]:
    """Return full names of the topics wanted; a missing leading slash is forgiven.

    Args:
        wanted: One name, several, or None for all but the infrastructure topics.
        known: The names that the source has.

    Raises:
        PictureError: If a name is not among the known ones, or is not a text.
    """
    if wanted is None:
        return tuple(name for name in known if name not in INFRASTRUCTURE_TOPICS)
    return tuple(dict.fromkeys(known_name(name, known, "topic") for name in names_in(wanted)))


def names_in(wanted: str | Iterable[str]) -> list[str]:
    """Return one name or several as a list.

    Raises:
        PictureError: If it is neither a text nor texts.
    """
    if isinstance(wanted, str):
        return [wanted]
    names = list(wanted) if isinstance(wanted, Iterable) else [wanted]
    for name in names:
        if not isinstance(name, str):
            raise PictureError(
                f"{name!r} is not the name of a topic or a node.",
                "What a picture shows is chosen by name, and a name is a text.",
                'Put it in quotation marks: `"temperature"`.',
            )
    return names


def known_name(name: str, known: Sequence[str], kind: str) -> str:
    """Return the full name for `name`, with or without its leading slash.

    Raises:
        PictureError: If it is not among `known`; it suggests the nearest one.
    """
    for candidate in (name, f"/{name}"):
        if candidate in known:
            return candidate
    guess = nearest(name, known)
    raise PictureError(
        f"There is no {kind} {name!r} in what was recorded.",
        f"Recorded: {listing(known)}." if known else f"No {kind} was recorded at all.",
        f"Did you mean {guess!r}?" if guess else "Check the name, or run the session longer.",
    )


def number_in(sample: Sample, field: str | None = None) -> float:
    """Return the number in one message; truth values count as 0 and 1.

    Args:
        sample: The message.
        field: Name of the field to read, nested ones with dots, such as `position.x`. None for the
            only field of the message.

    Raises:
        PictureError: If there is no such field or it is not a number.
    """
    value = sample.value if field is None else _field(sample, field)
    if isinstance(value, (bool, int, float)):
        return float(value)
    numeric = [
        repr(name) for name, inside in paths(sample.data) if isinstance(inside, (int, float))
    ]
    text = repr(value)
    raise PictureError(
        f"{field or 'The message'} on {sample.topic} is not a number.",
        f"A {sample.type_name} message here holds "
        f"{text if len(text) <= 40 else f'{text[:37]}...'}; only numbers have a place on an axis.",
        f"Choose a field: {listing(numeric, 'or')}."
        if numeric
        else "Choose a topic that carries numbers.",
    )


def paths(data: Mapping[str, Any], prefix: str = "") -> list[tuple[str, Any]]:
    """Return every field of a message with its dotted path, nested messages resolved."""
    found: list[tuple[str, Any]] = []
    for name, value in data.items():
        inside = isinstance(value, Mapping)
        found += paths(value, f"{prefix}{name}.") if inside else [(prefix + name, value)]
    return found


def _field(sample: Sample, field: str) -> Any:  # noqa: ANN401 - a field may be of any plain type
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

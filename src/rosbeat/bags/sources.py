"""Get the observation from a session, a bag or an observation, and select its topics."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Protocol, runtime_checkable

from rosbeat.bags import refusals
from rosbeat.records import INFRASTRUCTURE_TOPICS, Observation, Sample


@runtime_checkable
class Observer(Protocol):
    """Define the interface of objects with an observation, such as a session or a bag."""

    def observation(self) -> Observation:
        """Return what has been observed so far."""
        ...


#: Whatever can be recorded and replayed.
Run = Observation | Observer


def observed(source: Run) -> Observation:
    """Return an observation as it is, or the observation of a session or a bag.

    Raises:
        BagError: If `source` is none of these.
    """
    if isinstance(source, Observation):
        return source
    if isinstance(source, Observer) and not isinstance(source, type):
        return source.observation()
    raise refusals.no_observation(source)


def full_name(topic: object) -> str:
    """Return a topic's full name, adding a missing leading slash.

    Raises:
        BagError: If the topic is not a string.
    """
    if not isinstance(topic, str):
        raise refusals.not_a_name(topic)
    return f"/{topic.lstrip('/')}"


def types_of(seen: Observation, topics: str | Iterable[str] | None = None) -> dict[str, str]:
    """Return the type of each selected topic, ordered by publisher, then by message.

    Args:
        seen: The observation.
        topics: Names, or None for all topics except those that every node has.

    Raises:
        BagError: If a topic was not observed, or had messages of two types.
    """
    ends = ((end.name, end.type_name) for end in seen.graph.endpoints if end.kind == "publisher")
    types: dict[str, list[str]] = {}
    for name, kind in (*ends, *((one.topic, one.type_name) for one in seen.samples)):
        if kind not in types.setdefault(name, []):
            types[name].append(kind)
    wanted = [name for name in types if name not in INFRASTRUCTURE_TOPICS]
    if topics is not None:
        wanted = [
            _known(topic, types) for topic in ([topics] if isinstance(topics, str) else topics)
        ]
    for name in wanted:
        if len(types[name]) > 1:
            raise refusals.two_types(name, types[name])
    return {name: types[name][0] for name in wanted}


def chosen(seen: Observation, types: Iterable[str]) -> list[Sample]:
    """Return the messages on the given topics, in order."""
    names = set(types)
    return [one for one in seen.samples if one.topic in names]


def place(folder: object) -> Path:
    """Return the path of a recording, which need not exist yet.

    Raises:
        BagError: If it is not the name of a folder.
    """
    if isinstance(folder, (str, Path)) and str(folder).strip() and "\0" not in str(folder):
        return Path(folder).expanduser()
    raise refusals.no_place(folder)


def _known(topic: object, known: Iterable[str]) -> str:
    name = full_name(topic)
    if name not in known:
        raise refusals.unknown_topic(name, known)
    return name

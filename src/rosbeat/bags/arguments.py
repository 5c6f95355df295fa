"""Read the arguments of this folder's functions: runs, topic names and paths of bags."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path

from rosbeat.comparisons import Observer
from rosbeat.errors import BagError
from rosbeat.records import INFRASTRUCTURE_TOPICS, Observation

#: Whatever can be recorded and replayed.
Run = Observation | Observer


def observation_of(source: object) -> Observation:
    """Return an observation as it is, or the observation of a session or a bag.

    Raises:
        BagError: If `source` is none of these.
    """
    if isinstance(source, Observation):
        return source
    if isinstance(source, Observer) and not isinstance(source, type):
        return source.observation()
    raise BagError(
        f"{type(source).__name__!r} is not a run.",
        "A run is a session, a session's observation, or a recording.",
        "Pass the session itself, as in `record(ros, ...)`, or `ros.observation()`.",
    )


def full_name(topic: object) -> str:
    """Return a topic's full name, adding a missing leading slash.

    Raises:
        BagError: If the topic is not a string.
    """
    if isinstance(topic, str):
        return f"/{topic.lstrip('/')}"
    raise BagError(
        f"{topic!r} is not the name of a topic, but of type {type(topic).__name__}.",
        "The argument is a topic name, and a name is a string.",
        'Put it in quotation marks: `bag.messages("temperature")`.',
    )


def known_topic(topic: object, known: Iterable[str]) -> str:
    """Return a topic's full name.

    Raises:
        BagError: If the topic is not a string, or is not in the recording.
    """
    name, names = full_name(topic), sorted(known)
    if name in names:
        return name
    near = get_close_matches(name, names, n=1)
    raise BagError(
        f"The recording has no topic {name!r}.",
        f"Recorded topics: {', '.join(names)}." if names else "The recording has no topics.",
        f"Did you mean {near[0]!r}?"
        if near
        else "Choose one of the recorded topics, or record this one first.",
    )


def topic_types(seen: Observation, topics: str | Iterable[str] | None = None) -> dict[str, str]:
    """Return the type of each selected topic, ordered by publisher, then by message.

    Args:
        seen: The observation.
        topics: Names, or None for all topics except those that every node has.

    Raises:
        BagError: If a topic was not observed, or had messages of two types.
    """
    types: dict[str, dict[str, None]] = {}
    for end in seen.graph.endpoints:
        if end.kind == "publisher":
            types.setdefault(end.name, {})[end.type_name] = None
    for one in seen.samples:
        types.setdefault(one.topic, {})[one.type_name] = None
    if topics is None:
        wanted = [name for name in types if name not in INFRASTRUCTURE_TOPICS]
    else:
        given = [topics] if isinstance(topics, str) else topics
        wanted = [known_topic(topic, types) for topic in given]
    for name in wanted:
        if len(types[name]) > 1:
            raise BagError(
                f"The topic {name} has messages of two types: {' and '.join(types[name])}.",
                "In a recording, each topic has one type, as it should in a running system.",
                "Use the same type in all its publishers, or leave the topic out with "
                "`topics=[...]`.",
            )
    return {name: next(iter(types[name])) for name in wanted}


def path_of(folder: object) -> Path:
    """Return the path of a recording, which need not exist yet.

    Raises:
        BagError: If it is not the name of a folder.
    """
    if isinstance(folder, (str, Path)) and str(folder).strip() and "\0" not in str(folder):
        return Path(folder).expanduser()
    raise BagError(
        f"{folder!r} is not the name of a folder.",
        "The name of a recording's folder is a string or a `Path`.",
        'For example, write `record(ros, "first_run")`.',
    )


def reason(error: Exception) -> str:
    """Return what an error of a library says, as the end of a sentence."""
    text = str(error).strip().rstrip(".").partition("\n")[0]
    return text if " " in text else f"{type(error).__name__} {text}".strip()

"""Describe a recording in sentences, with the content of `ros2 bag info`."""

from __future__ import annotations

from datetime import datetime, timezone

from rosbeat.bags.reading import Contents, Topic
from rosbeat.records import NANOSECONDS, QoS

_STORAGES = {"mcap": "MCAP", "sqlite3": "SQLite"}


def describe(name: str, found: Contents) -> str:
    """Return a summary of a recording in a few lines of text."""
    total = sum(one.count for one in found.topics)
    head = (
        f"Recording {name}, stored as {_STORAGES[found.storage]}: {_count(total, 'message')} on "
        f"{_count(len(found.topics), 'topic')}."
    )
    return "\n".join([head, _time(found, total), *map(_topic, found.topics)])


def _time(found: Contents, total: int) -> str:
    last = found.first_ns + found.duration_ns
    if found.notes:
        ran = f"The session ran for {_seconds(found.notes.length_ns)} of virtual time"
        came = f" and published messages {_span(found.first_ns, last)}" if total else ""
        return f"{ran}{came}."
    if not total:
        return "It has no timestamps."
    began = datetime.fromtimestamp(found.first_ns // NANOSECONDS, timezone.utc)
    return f"It lasts {_seconds(found.duration_ns)} and begins at {began:%Y-%m-%d %H:%M:%S} UTC."


def _span(first: int, last: int) -> str:
    return (
        f"at {_seconds(first)}" if first == last else f"from {_seconds(first)} to {_seconds(last)}"
    )


def _topic(topic: Topic) -> str:
    said = f"  {topic.name}: {_count(topic.count, 'message')} of type {topic.type_name}"
    said += f" from {' and '.join(topic.nodes)}" if topic.nodes else ""
    offers = dict.fromkeys(map(_quality, topic.qos))
    return f"{said} ({'; '.join(offers)})" if offers else said


def _quality(qos: QoS) -> str:
    kept = f"keep last {qos.depth}" if qos.history == "KEEP_LAST" else qos.history
    words = (qos.reliability, qos.durability, kept)
    return ", ".join(word.lower().replace("_", " ") for word in words)


def _count(number: int, noun: str) -> str:
    return f"{number or 'no'} {noun if number == 1 else noun + 's'}"


def _seconds(time_ns: int) -> str:
    return f"{time_ns / NANOSECONDS:.9f}".rstrip("0").rstrip(".") + " s"

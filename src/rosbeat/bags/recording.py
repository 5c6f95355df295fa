"""Write what a session published as a rosbag2 bag."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from uuid import uuid4

from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.errors import WriterError
from rosbags.typesys.store import Typestore

from rosbeat.bags.arguments import Run, observation_of, path_of, reason, topic_types
from rosbeat.bags.bag import PUBLISHERS, SEED, SESSION_NS, Bag
from rosbeat.bags.serialization import installed_types, serialized
from rosbeat.errors import BagError, called_as
from rosbeat.records import NANOSECONDS, Observation, QoS

_STORAGES = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}
# The name does not follow the folder's: so one observation gives the same bytes wherever it goes.
_DATA = "messages"
# How ROS writes "no limit": the longest time that it can express.
_NO_LIMIT = QosTime(9223372036, 854775807)


@called_as('bags.record(ros, "first_run")')
def record(
    source: Run,
    folder: str | Path,
    *,
    storage: str = "mcap",
    topics: str | Iterable[str] | None = None,
    keep_old: bool = False,
) -> Bag:
    """Write what was published as a rosbag2 bag (metadata version 9, as in ROS 2 Jazzy).

    Each message is stamped with the virtual time at which it was published. The types' definitions
    and the publishers' quality of service are in the bag, so that other tools can read and replay
    it. The same observation gives the same bytes.

    Args:
        source: A session, what it observed, or another bag.
        folder: Where the bag shall be: a new folder.
        storage: `mcap` or `sqlite3`.
        topics: Names of the topics to record; all but those that every node brings by default.
        keep_old: Rename a recording that is there already, `run` to `run-1`, instead of refusing.

    Returns:
        The bag.

    Raises:
        BagError: If there is something at that place, it cannot be written there, a topic was not
            observed, or a message does not fit its type.
    """
    if storage not in _STORAGES:
        raise BagError(
            f"A recording cannot be stored as {storage!r}.",
            "There are two storage formats: MCAP, which is the default in ROS 2, and SQLite.",
            'Write `storage="mcap"` or `storage="sqlite3"`.',
        )
    seen, target = observation_of(source), path_of(folder)
    if os.path.lexists(target) and not keep_old:
        raise BagError(
            f"{target} already exists.",
            "A new recording does not overwrite an existing file or folder.",
            "Choose another name, or keep the old recording under a new name: `record(..., "
            "keep_old=True)`.",
        )
    types = topic_types(seen, topics)
    store = installed_types(types.values())
    try:
        # The storages take some characters of a path for commands, which the learner's may have.
        with TemporaryDirectory(prefix="rosbeat-") as scratch:
            made = Path(scratch, _DATA)
            with Writer(made, version=9, storage_plugin=_STORAGES[storage]) as writer:
                _fill(writer, store, seen, types)
            _put(made, target)
    except (OSError, WriterError, sqlite3.Error) as error:
        raise BagError(
            f"The recording could not be written to {target}: {reason(error)}.",
            "Existing files have not changed.",
            "Choose a folder with write permission, on a disk with enough space.",
        ) from error
    return Bag(target)


def _fill(writer: Writer, store: Typestore, seen: Observation, types: dict[str, str]) -> None:
    samples = [one for one in seen.samples if one.topic in types]
    publishers = {topic: seen.graph.on(topic, "publisher") for topic in types}
    nodes = {topic: dict.fromkeys(end.node for end in ends) for topic, ends in publishers.items()}
    for one in samples:
        nodes[one.topic][one.node] = None
    names = {topic: list(found) for topic, found in nodes.items()}
    for key, fact in ((SESSION_NS, seen.time_ns), (SEED, seen.seed), (PUBLISHERS, names)):
        writer.set_custom_data(key, json.dumps(fact))
    connections = {
        topic: writer.add_connection(
            topic,
            type_name,
            typestore=store,
            offered_qos_profiles=[_qos(end.qos) for end in publishers[topic]],
        )
        for topic, type_name in types.items()
    }
    for one, data in zip(samples, serialized(store, samples), strict=True):
        writer.write(connections[one.topic], one.time_ns, data)


def _qos(qos: QoS) -> Qos:
    """QoS as a bag stores it; other policies have the ROS default."""
    return Qos(
        QosHistory[qos.history],
        qos.depth,
        QosReliability[qos.reliability],
        QosDurability[qos.durability],
        _limit(qos.deadline_ns),
        _limit(qos.lifespan_ns),
        QosLiveliness.AUTOMATIC,
        _NO_LIMIT,
        avoid_ros_namespace_conventions=False,
    )


def _limit(limit_ns: int) -> QosTime:
    return QosTime(*divmod(limit_ns, NANOSECONDS)) if limit_ns else _NO_LIMIT


def _put(made: Path, target: Path) -> None:
    """Bring a finished bag to its place in one step, with what was there kept beside it."""
    target.parent.mkdir(parents=True, exist_ok=True)
    part = target.parent / f".{target.name}-{uuid4().hex}"
    try:
        shutil.copytree(made, part)
        if os.path.lexists(target):
            target.rename(_free(target))
        part.rename(target)
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _free(target: Path) -> Path:
    number = 1
    while os.path.lexists(target.with_name(f"{target.name}-{number}")):
        number += 1
    return target.with_name(f"{target.name}-{number}")

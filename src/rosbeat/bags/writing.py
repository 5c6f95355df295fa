"""Write what a session published as a rosbag2 bag."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
import struct
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from uuid import uuid4

from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.errors import WriterError
from rosbags.typesys.store import Typestore

from rosbeat.bags import qualities, refusals
from rosbeat.bags.bag import Bag
from rosbeat.bags.notes import notes_of
from rosbeat.bags.plain import to_wire
from rosbeat.bags.sources import Run, chosen, observed, place, types_of
from rosbeat.bags.types import installed_types
from rosbeat.errors import called_as
from rosbeat.records import Observation, Sample

_STORAGES = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}
# The name does not follow the folder's: so one observation gives the same bytes wherever it goes.
_DATA = "messages"
#: What goes wrong when a value does not fit into its field.
MISFITS = (ValueError, TypeError, ArithmeticError, struct.error)


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
        raise refusals.unknown_storage(storage)
    seen, target = observed(source), place(folder)
    if os.path.lexists(target) and not keep_old:
        raise refusals.exists_already(target)
    types = types_of(seen, topics)
    store = installed_types(types.values())
    try:
        # The storages take some characters of a path for commands, which the learner's may have.
        with TemporaryDirectory(prefix="rosbeat-") as scratch:
            made = Path(scratch, _DATA)
            with Writer(made, version=9, storage_plugin=_STORAGES[storage]) as writer:
                _fill(writer, store, seen, types)
            _put(made, target)
    except (OSError, WriterError, sqlite3.Error) as error:
        raise refusals.not_written(target, error) from error
    return Bag(target)


def _fill(writer: Writer, store: Typestore, seen: Observation, types: dict[str, str]) -> None:
    for name, note in notes_of(seen, types).items():
        writer.set_custom_data(name, json.dumps(note))
    connections = {
        topic: writer.add_connection(
            topic,
            type_name,
            typestore=store,
            offered_qos_profiles=[
                qualities.stored(end.qos) for end in seen.graph.on(topic, "publisher")
            ],
        )
        for topic, type_name in types.items()
    }
    samples = chosen(seen, types)
    for one, wire in zip(samples, wires(store, samples), strict=True):
        writer.write(connections[one.topic], one.time_ns, wire)


def wires(store: Typestore, samples: Iterable[Sample]) -> list[bytes]:
    """Return messages in serialized form.

    Raises:
        BagError: If a message does not fit its type; the error says which one.
    """
    counts: dict[str, int] = {}
    made = []
    for one in samples:
        counts[one.topic] = counts.get(one.topic, 0) + 1
        try:
            made.append(to_wire(store, one.type_name, one.data))
        except MISFITS as error:
            raise refusals.does_not_fit(
                one.topic, one.type_name, counts[one.topic], error
            ) from error
    return made


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

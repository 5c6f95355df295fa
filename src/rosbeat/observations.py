"""Observations as text: written as JSON, read back, and told apart by a digest.

The text is an object with `format`, `version` and the fields of `records.Observation`, nested as
they are there; see `record_json`.
"""

from __future__ import annotations

from hashlib import sha256

from rosbeat.record_json import parse, record, write
from rosbeat.records import Observation

FORMAT = "rosbeat observation"
#: Raised by one whenever a field is added, taken away or given another meaning; not for a field
#: that is omitted while it is empty (`records.OMIT_EMPTY`).
VERSION = 3


def to_json(observation: Observation) -> str:
    """Write an observation; the same observation gives the same text."""
    return write(observation, {"format": FORMAT, "version": VERSION})


def digest(observation: Observation) -> str:
    """The SHA-256 of an observation, in hexadecimal: equal observations have equal digests."""
    head = {"format": FORMAT, "version": VERSION}
    return sha256(write(observation, head, sort_keys=True).encode("ascii")).hexdigest()


def from_json(text: str) -> Observation:
    """Read what `to_json` wrote.

    Raises:
        RecordError: If it is not JSON, of another format or version, or if any field is missing,
            unknown or of another type.
    """
    body = parse(text, "observation", FORMAT, VERSION)
    observation: Observation = record(Observation, body, "observation")
    return observation

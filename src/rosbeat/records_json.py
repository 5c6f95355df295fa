"""Write records as JSON, and read them back, checked field by field by msgspec.

A record is any dataclass of plain data; see `rosbeat.records`. A file of records may begin with a
head: `format`, `version`, and the kind of the record. Fields with a default may be missing, and
fields that are not known are passed over, so a field can be added without a new version.

msgspec's JSON has neither NaN and infinity, as messages may hold them, nor half of a surrogate
pair, as a learner's text may. Python's own `json` has all three: what holds one of them is written
and read by that module, at a third of the speed, and msgspec only checks the fields.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path, PurePath
from typing import Any, TypeVar

import msgspec

from rosbeat.errors import RecordError

#: Not looked up when a record is written: an answer that is observed may change these modules.
_encode, _dumps = msgspec.json.encode, json.dumps
_Record = TypeVar("_Record")


# Writing.


def to_json(
    value: object, head: Mapping[str, object] | None = None, indent: int | None = None
) -> str:
    """Write a record; equal records give equal texts.

    Args:
        value: The record; without a head also a list or dict of records.
        head: What stands before its fields, such as the format and its version.
        indent: Spaces for each level, in ASCII; None is one line without blanks.
    """
    document = {**head, **_fields_of(value)} if head else value
    if indent is not None:
        return _dumps(as_data(document), indent=indent)
    try:
        text = _encode(document, enc_hook=_plain).decode()
    except UnicodeEncodeError:  # half of a surrogate pair
        text = "null"
    # msgspec writes null for NaN and infinity, too.
    return text if "null" not in text else _dumps(as_data(document), separators=(",", ":"))


def as_data(value: object) -> Any:  # noqa: ANN401 - dicts, lists and texts
    """Return records as the dicts, lists, numbers and texts that JSON has."""
    return msgspec.to_builtins(value, enc_hook=_plain)


def _fields_of(record: Any) -> dict[str, object]:  # noqa: ANN401 - a dataclass
    return {one.name: getattr(record, one.name) for one in fields(record)}


def _plain(value: object) -> object:
    """Return what JSON has for a path, and for a number or text of a class of its own."""
    if isinstance(value, PurePath):
        return value.as_posix()
    for kind in (str, int, float):
        if isinstance(value, kind):
            return kind(value)
    raise TypeError(f"A record holds no {type(value).__name__}.")


# Reading.


@dataclass(frozen=True)
class Head:
    """Hold what stands before the fields of a record.

    Attributes:
        format: The name of the format.
        version: Its version.
        kind: The name of the record's class, if there are several.
    """

    format: str
    version: int
    kind: str = ""


def read_head(text: str, what: str, format_name: str, version: int) -> Head:
    """Read what stands before the fields of a record.

    Args:
        text: What `to_json` wrote.
        what: What it should be, for errors.
        format_name: The format that it should name.
        version: The version that it should name.

    Raises:
        RecordError: If it is not JSON, or of another format or version.
    """
    head = from_json(Head, text, what)
    if head.format != format_name:
        means = f'The field "format" should be "{format_name}".'
        raise refusal(f"It is no {what}.", means)
    if head.version != version:
        means = f"This rosbeat reads version {version}."
        raise refusal(f"It is of version {head.version!r}.", means)
    return head


def from_json(kind: type[_Record], text: str | bytes, what: str) -> _Record:
    """Read a record.

    Args:
        kind: Its class.
        text: What `to_json` wrote, with or without a head.
        what: What it should be, for errors.

    Raises:
        RecordError: If it is not JSON, or if any field is missing or of another type.
    """
    try:
        return _read(kind, text if isinstance(text, str) else text.decode())
    except msgspec.ValidationError as error:
        said, _, place = str(error).partition(" - at ")  # such as `$.samples[3].topic`
        where = what + place.strip("`").removeprefix("$")
        raise refusal(f"{said} at `{where}`.", "The course writes something else there.") from None
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        means = "It breaks off, or something else than the course has written it."
        raise refusal(f"It is not JSON: {error}.", means) from None


#: What has been read before. msgspec puts what it knows of a class in place before it knows all of
#: it, and crashes if another thread reads that class meanwhile.
_known: set[object] = set()
_one_at_a_time = threading.Lock()


def _read(kind: type[_Record], text: str) -> _Record:
    if kind not in _known:
        with _one_at_a_time:
            msgspec.json.Decoder(kind, dec_hook=_made)
            _known.add(kind)
    try:
        return msgspec.json.decode(text, type=kind, dec_hook=_made)
    except msgspec.ValidationError:
        raise
    except ValueError:  # NaN, infinity, or half of a surrogate pair; or no JSON at all
        return msgspec.convert(json.loads(text), kind, dec_hook=_made)


def _made(kind: type, value: object) -> object:
    if kind is Path and isinstance(value, str):
        return Path(value)
    raise TypeError(f"Expected `{kind.__name__}`, got `{type(value).__name__}`")


def refusal(what: str, means: str) -> RecordError:
    """Return the error for a text that cannot be read: what is wrong, and how it should be."""
    return RecordError(
        f"The saved record cannot be read. {what}",
        means,
        "Make the file again with this version of rosbeat, and do not edit it.",
    )

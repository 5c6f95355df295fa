"""Observations as text: written as JSON, read back, and told apart by a digest.

The text is an object with `format`, `version` and the fields of `records.Observation`, nested as
they are there. JSON (RFC 8259) has no infinity and no NaN, so such a number is written as
`{"$float": "nan"}`; no ROS field can be called `$float`. `write`, `parse` and `record` do the same
for any dataclass of plain data.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import partial
from hashlib import sha256
from math import isfinite
from pathlib import Path, PurePath
from types import NoneType, UnionType
from typing import Any, Union, get_args, get_origin, get_type_hints

from rosbeat.errors import RecordError
from rosbeat.records import Observation

FORMAT = "rosbeat observation"
#: Raised by one whenever a field is added, taken away or given another meaning.
VERSION = 2
_FLOAT = "$float"
_ODD_FLOATS = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}


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


# Writing.


def write(value: Any, head: dict[str, Any], sort_keys: bool = False) -> str:  # noqa: ANN401
    """Write a record as an object of JSON, in ASCII.

    Args:
        value: A dataclass of plain data.
        head: What stands before its fields: the format and its version.
        sort_keys: Write names in alphabetical order.
    """
    document = {**head, **_plain(value)}
    return json.dumps(document, sort_keys=sort_keys, allow_nan=False, separators=(",", ":"))


def _plain(value: Any) -> Any:  # noqa: ANN401 - a record, or anything that a message may hold
    if is_dataclass(value):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not isfinite(value):
        return {_FLOAT: str(float(value))}
    return value.as_posix() if isinstance(value, PurePath) else value


# Reading.


def parse(text: Any, what: str, format_name: str, version: int) -> dict[str, Any]:  # noqa: ANN401
    """Read the text of a record, without its head.

    Args:
        text: What `write` wrote.
        what: What it should be, in one word.
        format_name: The format that its head should name.
        version: The version that its head should name.

    Raises:
        RecordError: If it is not JSON, or of another format or version.
    """
    document = _parse(text)
    if not isinstance(document, dict) or document.get("format") != format_name:
        means = f'The field "format" should be "{format_name}".'
        raise refusal(f"It is no {what}.", means)
    if type(document.get("version")) is not int or document["version"] != version:
        found = document.get("version")
        raise refusal(f"It is of version {found!r}.", f"This rosbeat reads version {version}.")
    return {name: value for name, value in document.items() if name not in ("format", "version")}


def _parse(text: Any) -> Any:  # noqa: ANN401 - unchecked
    try:
        return json.loads(text, object_pairs_hook=_object, parse_constant=_no_constant)
    except (ValueError, TypeError, RecursionError) as error:
        raise refusal("It is not JSON.", f"{type(error).__name__}: {error}.") from error


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    made = dict(pairs)
    if len(made) != len(pairs):
        raise ValueError("a name stands twice in one object")
    return made


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is not a number in JSON")


def record(kind: Any, value: Any, path: str) -> Any:  # noqa: ANN401 - a dataclass of plain data
    """Make a dataclass from an object of JSON.

    Args:
        kind: The class. Its fields are numbers, texts, paths, tuples, dicts, optional values, and
            such dataclasses.
        value: The object.
        path: What it is called in an error.

    Raises:
        RecordError: If any field is missing, unknown or of another type.
    """
    hints = get_type_hints(kind)
    names = [field.name for field in fields(kind)]
    if not isinstance(value, dict) or set(value) != set(names):
        found = ", ".join(value) if isinstance(value, dict) else type(value).__name__
        raise refusal(f"{path} is not as it should be.", f"Wanted {', '.join(names)}: {found}.")
    return kind(**{name: _field(hints[name], value[name], f"{path}.{name}") for name in names})


def _field(kind: Any, value: Any, path: str) -> Any:  # noqa: ANN401
    if get_origin(kind) is tuple:
        return _tuple(get_args(kind), value, path)
    if get_origin(kind) in (UnionType, Union):
        (inner,) = (one for one in get_args(kind) if one is not NoneType)
        return None if value is None else _field(inner, value, path)
    if is_dataclass(kind):
        return record(kind, value, path)
    if get_origin(kind) is dict:
        return _dict(get_args(kind)[1], value, path)
    if kind is Path:
        _check(str, value, path)
        return Path(value)
    return _number_or_text(kind, value, path)


def _number_or_text(kind: Any, value: Any, path: str) -> Any:  # noqa: ANN401
    if kind is float and isinstance(value, dict):
        return _odd_float(value, path)
    _check(kind, value, path)
    if path.endswith("_ns") and value < 0:
        raise refusal(f"{path} is {value}.", "No time is before the beginning of the session.")
    return value


def _tuple(kinds: tuple[Any, ...], value: Any, path: str) -> tuple[Any, ...]:  # noqa: ANN401
    _check(list, value, path)
    if kinds[-1] is Ellipsis:
        kinds = kinds[:1] * len(value)
    if len(kinds) != len(value):
        raise refusal(f"{path} has {len(value)} parts.", f"It should have {len(kinds)}.")
    parts = enumerate(zip(kinds, value, strict=True))
    return tuple(_field(kind, one, f"{path}[{at}]") for at, (kind, one) in parts)


def _dict(kind: Any, value: Any, path: str) -> dict[str, Any]:  # noqa: ANN401
    _check(dict, value, path)
    read = _data if kind is Any else partial(_field, kind)
    return {name: read(one, f"{path}.{name}") for name, one in value.items()}


def _data(value: Any, path: str) -> Any:  # noqa: ANN401 - what a message may hold
    if isinstance(value, dict):
        return _odd_float(value, path) if _FLOAT in value else _map(value, path)
    if isinstance(value, list):
        return [_data(one, f"{path}[{at}]") for at, one in enumerate(value)]
    if value is None:
        raise refusal(f"{path} is null.", "A message always holds something.")
    if isinstance(value, float) and not isfinite(value):
        raise refusal(f"{path} is too large.", f'Infinity is written as {{"{_FLOAT}": "inf"}}.')
    return value


def _map(value: dict[str, Any], path: str) -> dict[str, Any]:
    return {name: _data(one, f"{path}.{name}") for name, one in value.items()}


def _odd_float(value: dict[str, Any], path: str) -> float:
    name = value[_FLOAT]
    if len(value) == 1 and isinstance(name, str) and name in _ODD_FLOATS:
        return _ODD_FLOATS[name]
    raise refusal(f"{path} is {value!r}.", f"{_FLOAT} is one of {', '.join(_ODD_FLOATS)}.")


def _check(kind: Callable[..., Any], value: Any, path: str) -> None:  # noqa: ANN401
    # `True` is an `int` for Python, but nobody wrote it where a number belongs.
    if type(value) is not kind:
        wanted, found = getattr(kind, "__name__", kind), type(value).__name__
        raise refusal(f"{path} is of type {found}.", f"It should be of type {wanted}.")


def refusal(what: str, means: str) -> RecordError:
    """The error for a text that cannot be read: what is wrong with it, and how it should be."""
    return RecordError(
        f"The saved record cannot be read. {what}",
        means,
        "Make the file again with this version of rosbeat, and do not edit it.",
    )

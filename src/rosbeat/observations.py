"""Observations as text: written as JSON, read back, and told apart by a digest.

The text is an object with `format`, `version` and the fields of `records.Observation`, nested as
they are there. JSON (RFC 8259) has no infinity and no NaN, so such a number is written as
`{"$float": "nan"}`; no ROS field can be called `$float`.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from hashlib import sha256
from math import isfinite
from typing import Any, get_args, get_origin, get_type_hints

from rosbeat.errors import RecordError
from rosbeat.records import Observation

FORMAT = "rosbeat observation"
#: Raised by one whenever a field is added, taken away or given another meaning.
VERSION = 2
_FLOAT = "$float"
_ODD_FLOATS = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}


def to_json(observation: Observation) -> str:
    """Write an observation; the same observation gives the same text."""
    return _dump(observation, sort_keys=False)


def digest(observation: Observation) -> str:
    """The SHA-256 of an observation, in hexadecimal: equal observations have equal digests."""
    return sha256(_dump(observation, sort_keys=True).encode("ascii")).hexdigest()


def from_json(text: str) -> Observation:
    """Read what `to_json` wrote.

    Raises:
        RecordError: If it is not JSON, of another format or version, or if any field is missing,
            unknown or of another type.
    """
    document = _parse(text)
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise _refusal("It is not an observation.", f'The field "format" should be "{FORMAT}".')
    if document.get("version") != VERSION or isinstance(document["version"], bool):
        found = document.get("version")
        raise _refusal(f"It is of version {found!r}.", f"This rosbeat reads version {VERSION}.")
    body = {name: value for name, value in document.items() if name not in ("format", "version")}
    observation: Observation = _record(Observation, body, "observation")
    return observation


# Writing.


def _dump(observation: Observation, sort_keys: bool) -> str:
    document = {"format": FORMAT, "version": VERSION, **_plain(observation)}
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
    return value


# Reading.


def _parse(text: Any) -> Any:  # noqa: ANN401 - unchecked
    try:
        return json.loads(text, object_pairs_hook=_object, parse_constant=_no_constant)
    except (ValueError, TypeError, RecursionError) as error:
        raise _refusal("It is not JSON.", f"{type(error).__name__}: {error}.") from error


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    made = dict(pairs)
    if len(made) != len(pairs):
        raise ValueError("a name stands twice in one object")
    return made


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is not a number in JSON")


def _record(kind: Any, value: Any, path: str) -> Any:  # noqa: ANN401 - a dataclass of records
    hints = get_type_hints(kind)
    names = [field.name for field in fields(kind)]
    if not isinstance(value, dict) or set(value) != set(names):
        found = ", ".join(value) if isinstance(value, dict) else type(value).__name__
        raise _refusal(f"{path} is not as it should be.", f"Wanted {', '.join(names)}: {found}.")
    return kind(**{name: _field(hints[name], value[name], f"{path}.{name}") for name in names})


def _field(kind: Any, value: Any, path: str) -> Any:  # noqa: ANN401
    if get_origin(kind) is tuple:
        (item, _) = get_args(kind)
        _check(list, value, path)
        return tuple(_field(item, one, f"{path}[{at}]") for at, one in enumerate(value))
    if is_dataclass(kind):
        return _record(kind, value, path)
    if get_origin(kind) is dict:
        _check(dict, value, path)
        return {name: _data(one, f"{path}.{name}") for name, one in value.items()}
    _check(kind, value, path)
    if path.endswith("_ns") and value < 0:
        raise _refusal(f"{path} is {value}.", "No time is before the beginning of the session.")
    return value


def _data(value: Any, path: str) -> Any:  # noqa: ANN401 - what a message may hold
    if isinstance(value, dict):
        return _odd_float(value, path) if _FLOAT in value else _map(value, path)
    if isinstance(value, list):
        return [_data(one, f"{path}[{at}]") for at, one in enumerate(value)]
    if value is None:
        raise _refusal(f"{path} is null.", "A message always holds something.")
    if isinstance(value, float) and not isfinite(value):
        raise _refusal(f"{path} is too large.", f'Infinity is written as {{"{_FLOAT}": "inf"}}.')
    return value


def _map(value: dict[str, Any], path: str) -> dict[str, Any]:
    return {name: _data(one, f"{path}.{name}") for name, one in value.items()}


def _odd_float(value: dict[str, Any], path: str) -> float:
    name = value[_FLOAT]
    if len(value) == 1 and isinstance(name, str) and name in _ODD_FLOATS:
        return _ODD_FLOATS[name]
    raise _refusal(f"{path} is {value!r}.", f"{_FLOAT} is one of {', '.join(_ODD_FLOATS)}.")


def _check(kind: Callable[..., Any], value: Any, path: str) -> None:  # noqa: ANN401
    # `True` is an `int` for Python, but nobody wrote it where a number belongs.
    if type(value) is not kind:
        wanted, found = getattr(kind, "__name__", kind), type(value).__name__
        raise _refusal(f"{path} is of type {found}.", f"It should be of type {wanted}.")


def _refusal(what: str, means: str) -> RecordError:
    return RecordError(
        f"The saved observation cannot be read. {what}",
        means,
        "Make the file again with this version of rosbeat, and do not edit it.",
    )

"""Records as JSON: any dataclass of plain data, nested as it is, and back, checked field by field.

JSON (RFC 8259) has no infinity and no NaN, so such a number is written as `{"$float": "nan"}`; no
ROS field can be called `$float`. Long tuples of records may be written by columns,
`{"$columns": {...}}`, which is a tenth of the work.

A field with the metadata `records.OMIT_EMPTY` is omitted while it is empty, and may be missing when
a record is read.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, is_dataclass
from functools import cache, partial
from itertools import repeat
from math import isfinite
from operator import attrgetter, itemgetter
from pathlib import Path, PurePath
from types import NoneType, UnionType
from typing import Any, Union, cast, get_args, get_origin, get_type_hints

from rosbeat.errors import RecordError
from rosbeat.record_columns import records_of

#: Not looked up in `json` when a record is written: an answer that is observed may change that.
_dumps = json.dumps
_FLOAT, _COLUMNS = "$float", "$columns"
#: From how many records on a tuple is written by columns.
_MANY = 32
_SIMPLE = {int, str, bool, NoneType}
#: The key in a field's metadata that says so; see `records.OMIT_EMPTY`.
_OMIT_EMPTY = "omit_empty"
_ODD_FLOATS = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}


# Writing.


def write(
    value: Any,  # noqa: ANN401
    head: dict[str, Any],
    sort_keys: bool = False,
    columns: bool = False,
) -> str:
    """Write a record as an object of JSON, in ASCII.

    Args:
        value: A dataclass of plain data.
        head: What stands before its fields: the format and its version.
        sort_keys: Write names in alphabetical order.
        columns: Write long tuples of records by columns.
    """
    document = {**head, **_plain(value, columns)}
    return _dumps(document, sort_keys=sort_keys, allow_nan=False, separators=(",", ":"))


@cache
def _field_names(kind: Any) -> tuple[tuple[str, ...], frozenset[str]]:  # noqa: ANN401
    """The names of all fields of a record, and of those that are omitted while empty."""
    optional = (one.name for one in fields(kind) if one.metadata.get(_OMIT_EMPTY))
    return tuple(one.name for one in fields(kind)), frozenset(optional)


# A record, or anything that a message may hold.
def _plain(value: Any, columns: bool = False) -> Any:  # noqa: ANN401
    if is_dataclass(value):
        kind: Any = type(value)
        every, optional = _field_names(kind)
        return {
            name: _plain(item, columns)
            for name in every
            if (item := getattr(value, name)) or name not in optional
        }
    if isinstance(value, dict):
        return {name: _plain(item, columns) for name, item in value.items()}
    if isinstance(value, tuple | list):
        if columns and len(value) >= _MANY and is_dataclass(value[0]):
            return _by_columns(value) or [_plain(item, columns) for item in value]
        return [_plain(item, columns) for item in value]
    if isinstance(value, float) and not isfinite(value):
        return {_FLOAT: str(float(value))}
    return value.as_posix() if isinstance(value, PurePath) else value


def _by_columns(values: Sequence[Any]) -> dict[str, Any] | None:
    """Records of one class by their fields; None if they are of several classes."""
    kinds: set[Any] = set(map(type, values))
    if len(kinds) != 1:
        return None
    every, optional = _field_names(*kinds)
    columns = {name: list(map(attrgetter(name), values)) for name in every}
    kept = {name: column for name, column in columns.items() if name not in optional or any(column)}
    return {_COLUMNS: {name: _column(column) for name, column in kept.items()}}


def _column(values: list[Any], nests: bool = True) -> Any:  # noqa: ANN401 - columns again, or not
    kinds = set(map(type, values))
    if kinds <= _SIMPLE or (kinds == {float} and all(map(isfinite, values))):
        return values
    if nests and kinds == {dict} and len({tuple(one) for one in values}) == 1 and values[0]:
        names = values[0]
        columns = {name: list(map(itemgetter(name), values)) for name in names}
        return {_COLUMNS: {name: _column(column, False) for name, column in columns.items()}}
    return [_plain(value, True) for value in values]


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
        RecordError: If any field is missing, unknown or of another type; one that is left out while
            it is empty may be missing.
    """
    try:
        return _reader(kind)(value)
    except _WrongError as wrong:
        place = "".join([path, *reversed(wrong.path)])
        raise refusal(f"{place} {wrong.what}", wrong.means) from None


Read = Callable[[Any], Any]


class _WrongError(Exception):
    """A value is not what it should be; on its way out it collects where that is."""

    def __init__(self, what: str, means: str) -> None:
        super().__init__(what)
        self.what, self.means = what, means
        self.path: list[str] = []


@cache
def _reader(kind: Any) -> Read:  # noqa: ANN401
    """What reads values of a type; made once, for a long observation has 50,000 of them."""
    if get_origin(kind) is tuple:
        return _tuple_reader(get_args(kind))
    if get_origin(kind) in (UnionType, Union):
        (inner,) = (one for one in get_args(kind) if one is not NoneType)
        return _optional_reader(_reader(inner))
    if is_dataclass(kind):
        return _record_reader(kind)
    if get_origin(kind) is dict:
        inner = get_args(kind)[1]
        return _dict_reader(_data if inner is Any else _reader(inner))
    return _path if kind is Path else _plain_reader(kind)


def _record_reader(kind: Any) -> Read:  # noqa: ANN401
    hints = get_type_hints(kind)
    names, optional = _field_names(kind)
    wanted, known = ", ".join(names), set(names)
    required = known - optional
    readers = [(name, _field_reader(name, hints[name])) for name in names if name in required]
    others = [(name, _field_reader(name, hints[name])) for name in names if name in optional]

    def read(value: Any) -> Any:  # noqa: ANN401
        if type(value) is not dict or not (
            value.keys() == known or required <= value.keys() <= known
        ):
            found = ", ".join(value) if isinstance(value, dict) else type(value).__name__
            raise _WrongError("is not as it should be.", f"Wanted {wanted}: {found}.")
        made = {}
        try:
            for name, reader in readers:
                made[name] = reader(value[name])
            for name, reader in others:
                if name in value:
                    made[name] = reader(value[name])
        except _WrongError as wrong:
            wrong.path.append(f".{name}")
            raise
        return kind(**made)

    return read


def _field_reader(name: str, kind: Any) -> Read:  # noqa: ANN401
    return _time if name.endswith("_ns") and kind is int else _reader(kind)


def _time(value: Any) -> Any:  # noqa: ANN401
    _check(int, value)
    if value < 0:
        said = "No time is before the beginning of the session."
        raise _WrongError(f"is {value}.", said)
    return value


def _plain_reader(kind: Any) -> Read:  # noqa: ANN401
    def read(value: Any) -> Any:  # noqa: ANN401
        if kind is float and type(value) is dict:
            return _odd_float(value)
        _check(kind, value)
        return value

    return read


def _optional_reader(inner: Read) -> Read:
    return lambda value: None if value is None else inner(value)


def _path(value: Any) -> Path:  # noqa: ANN401
    _check(str, value)
    return Path(value)


def _tuple_reader(kinds: tuple[Any, ...]) -> Read:
    many = kinds[-1] is Ellipsis
    readers = [_reader(kind) for kind in (kinds[:1] if many else kinds)]
    by_columns = _columns_reader(kinds[0]) if many and is_dataclass(kinds[0]) else None

    def read(value: Any) -> Any:  # noqa: ANN401
        if by_columns and type(value) is dict:
            return by_columns(value)
        _check(list, value)
        all_of_them = repeat(readers[0], len(value)) if many else readers
        if not many and len(readers) != len(value):
            said = f"It should have {len(readers)}."
            raise _WrongError(f"has {len(value)} parts.", said)
        return tuple(_all(all_of_them, value))

    return read


def _columns_reader(kind: Any) -> Read:  # noqa: ANN401
    hints = get_type_hints(kind)
    names, optional = _field_names(kind)
    readers = {name: _column_reader(name, hints[name]) for name in names}
    empty = {one.name: [one.default] for one in fields(kind) if one.name in optional}

    def read(value: dict[str, Any]) -> Any:  # noqa: ANN401
        columns = _columns(value, names, optional)
        found = (name for name in names if name in columns)
        made = {name: _in(f".{name}", readers[name], columns[name]) for name in found}
        lengths = set(map(len, made.values()))
        if len(lengths) != 1:
            raise _WrongError("has columns of several lengths.", "They should be equally long.")
        (count,) = lengths
        made |= {name: one * count for name, one in empty.items() if name not in made}
        return tuple(records_of(kind, *map(made.__getitem__, names)))

    return read


def _columns(
    value: dict[str, Any], names: Sequence[str], optional: frozenset[str] = frozenset()
) -> dict[str, Any]:
    found = value.get(_COLUMNS)
    is_complete = not names or (type(found) is dict and found.keys() | optional == set(names))
    if len(value) == 1 and type(found) is dict and is_complete:
        return found
    said = f"Wanted {', '.join(names)}." if names else "Wanted columns."
    raise _WrongError("is not as it should be.", said)


def _column_reader(name: str, kind: Any) -> Callable[[Any], list[Any]]:  # noqa: ANN401
    one = _field_reader(name, kind)

    def read(values: Any) -> list[Any]:  # noqa: ANN401
        if get_origin(kind) is dict and type(values) is dict:
            return _dicts(values, _data if get_args(kind)[1] is Any else _reader(get_args(kind)[1]))
        _check(list, values)
        # One look at a whole column, where nothing else has to be looked at.
        simple = kind in _SIMPLE and set(map(type, values)) == {kind}
        if simple and (one is not _time or min(values) >= 0):
            return cast("list[Any]", values)
        return _all(repeat(one, len(values)), values)

    return read


def _dicts(value: dict[str, Any], inner: Read) -> list[Any]:
    columns = _columns(value, ())
    for name, column in columns.items():
        _in(f".{name}", partial(_check, list), column)
    if not columns or len(set(map(len, columns.values()))) != 1:
        raise _WrongError("has columns of several lengths.", "They should be equally long.")
    if inner is not _data or not all(map(_is_simple, columns.values())):
        columns = {name: _all(repeat(inner, len(one)), one) for name, one in columns.items()}
    names = tuple(columns)
    if len(names) == 1:  # nearly every message of the course
        return [{names[0]: one} for one in columns[names[0]]]
    return [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _is_simple(values: list[Any]) -> bool:
    """Whether nothing in a column has to be looked at one by one."""
    kinds = set(map(type, values))
    return kinds <= {int, str, bool} or (kinds == {float} and all(map(isfinite, values)))


def _in(place: str, read: Callable[[Any], Any], value: Any) -> Any:  # noqa: ANN401
    try:
        return read(value)
    except _WrongError as wrong:
        wrong.path.append(place)
        raise


def _all(readers: Iterable[Read], values: list[Any]) -> list[Any]:
    made: list[Any] = []
    try:
        for reader, value in zip(readers, values, strict=True):
            made.append(reader(value))
    except _WrongError as wrong:
        wrong.path.append(f"[{len(made)}]")
        raise
    return made


def _dict_reader(inner: Read) -> Read:
    def read(value: Any) -> Any:  # noqa: ANN401
        _check(dict, value)
        return _map(value, inner)

    return read


def _map(value: dict[str, Any], inner: Read) -> dict[str, Any]:
    made = {}
    try:
        for name, one in value.items():
            made[name] = inner(one)
    except _WrongError as wrong:
        wrong.path.append(f".{name}")
        raise
    return made


def _data(value: Any) -> Any:  # noqa: ANN401 - what a message may hold
    if isinstance(value, dict):
        return _odd_float(value) if _FLOAT in value else _map(value, _data)
    if isinstance(value, list):
        return _all(repeat(_data, len(value)), value)
    if value is None:
        raise _WrongError("is null.", "A message always holds something.")
    if isinstance(value, float) and not isfinite(value):
        raise _WrongError("is too large.", f'Infinity is written as {{"{_FLOAT}": "inf"}}.')
    return value


def _odd_float(value: dict[str, Any]) -> float:
    name = value.get(_FLOAT)
    if len(value) == 1 and isinstance(name, str) and name in _ODD_FLOATS:
        return _ODD_FLOATS[name]
    raise _WrongError(f"is {value!r}.", f"{_FLOAT} is one of {', '.join(_ODD_FLOATS)}.")


def _check(kind: Callable[..., Any], value: Any) -> None:  # noqa: ANN401
    # `True` is an `int` for Python, but nobody wrote it where a number belongs.
    if type(value) is not kind:
        wanted, found = getattr(kind, "__name__", kind), type(value).__name__
        raise _WrongError(f"is of type {found}.", f"It should be of type {wanted}.")


def refusal(what: str, means: str) -> RecordError:
    """The error for a text that cannot be read: what is wrong with it, and how it should be."""
    return RecordError(
        f"The saved record cannot be read. {what}",
        means,
        "Make the file again with this version of rosbeat, and do not edit it.",
    )

import json
from dataclasses import dataclass, field, replace
from math import inf, nan
from typing import Any

import pytest

from rosbeat.errors import RecordError
from rosbeat.record_json import parse, record, write
from rosbeat.records import OMIT_EMPTY

HEAD = {"format": "a test", "version": 1}


@dataclass(frozen=True)
class Small:
    time_ns: int
    name: str
    value: float
    there: bool
    inner: tuple[int, ...] = ()
    note: str | None = None


@dataclass(frozen=True)
class Many:
    rows: tuple[Small, ...]
    messages: tuple["Message", ...] = ()


@dataclass(frozen=True)
class Message:
    data: dict[str, Any]


ROWS = tuple(Small(n, f"n{n % 3}", n / 3, n % 2 == 0, (n, n)) for n in range(100))


def there_and_back(value, columns):
    text = write(value, HEAD, columns=columns)
    return record(type(value), parse(text, "test", "a test", 1), "test"), text


@pytest.mark.parametrize("columns", [True, False])
@pytest.mark.parametrize(
    "rows",
    [
        ROWS,
        ROWS[:5],
        tuple(replace(one, note="x" if one.time_ns % 2 else None) for one in ROWS),
        tuple(replace(one, value=inf) for one in ROWS),
    ],
    ids=["many", "few", "notes", "endless"],
)
def test_rows_come_back(rows, columns):
    assert there_and_back(Many(rows), columns)[0] == Many(rows)


@pytest.mark.parametrize("columns", [True, False])
@pytest.mark.parametrize(
    "data",
    [
        lambda n: {"data": n / 2},
        lambda n: {"data": n, "name": "x"},
        lambda n: {"data": [n, n]},
        lambda n: {"x": {"y": n}},
        lambda n: {f"x{n}": n},
        lambda n: {"data": inf if n else 1.5},
        lambda n: {},
    ],
)
def test_messages_come_back(data, columns):
    value = Many((), tuple(Message(data(n)) for n in range(50)))
    assert there_and_back(value, columns)[0] == value


def test_columns_are_shorter_and_hold_the_same():
    by_columns, by_rows = (there_and_back(Many(ROWS), columns) for columns in (True, False))
    assert by_columns[0] == by_rows[0]
    assert len(by_columns[1]) < len(by_rows[1]) / 2


def test_no_number_is_kept_as_it_was():
    value = Many(tuple(replace(one, value=nan) for one in ROWS))
    found = there_and_back(value, True)[0]
    assert all(row.value != row.value for row in found.rows)


def changed(change):
    document = json.loads(write(Many(ROWS), HEAD, columns=True))
    change(document["rows"]["$columns"])
    return json.dumps(document)


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (lambda columns: columns["name"].pop(), "test.rows "),
        (lambda columns: columns.pop("name"), "test.rows "),
        (lambda columns: columns.update(other=[]), "test.rows "),
        (lambda columns: columns["time_ns"].__setitem__(3, -1), "test.rows.time_ns[3] "),
        (lambda columns: columns["time_ns"].__setitem__(3, True), "test.rows.time_ns[3] "),
        (lambda columns: columns["value"].__setitem__(7, 1), "test.rows.value[7] "),
        (lambda columns: columns["name"].__setitem__(9, None), "test.rows.name[9] "),
        (lambda columns: columns.update(name="x"), "test.rows.name "),
        (lambda columns: columns.update(inner={"$columns": {}}), "test.rows.inner "),
    ],
)
def test_columns_are_checked_field_by_field(change, place):
    with pytest.raises(RecordError) as caught:
        record(Many, parse(changed(change), "test", "a test", 1), "test")
    assert place in str(caught.value)


@pytest.mark.parametrize(
    "data", [{"$columns": {}}, {"$columns": {"a": [1], "b": []}}, {"$columns": 5}]
)
def test_columns_of_messages_are_checked(data):
    value = Many((), tuple(Message({"data": n}) for n in range(50)))
    document = json.loads(write(value, HEAD, columns=True))
    document["messages"]["$columns"]["data"] = data
    with pytest.raises(RecordError):
        record(Many, parse(json.dumps(document), "test", "a test", 1), "test")


@dataclass(frozen=True)
class Grown:
    """A record to which a field has been added."""

    time_ns: int
    added: tuple[str, ...] = field(default=(), metadata=OMIT_EMPTY)


@dataclass(frozen=True)
class AllGrown:
    rows: tuple[Grown, ...]


@pytest.mark.parametrize("columns", [True, False])
@pytest.mark.parametrize("with_added", [0, 1, 50])
def test_an_added_field_is_omitted_while_it_is_empty(columns, with_added):
    rows = tuple(Grown(n, ("new",) if n < with_added else ()) for n in range(50))
    again, text = there_and_back(AllGrown(rows), columns)
    assert again == AllGrown(rows)
    assert text.count("added") == (min(with_added, 1) if columns else with_added)


@pytest.mark.parametrize(
    "rows",
    [
        [{}],
        [{"time_ns": 1, "added": [], "other": 1}],
        [{"time_ns": 1, "added": None}],
        {"$columns": {}},
        {"$columns": {"added": [[]]}},
        {"$columns": {"time_ns": 5}},
        {"$columns": {"time_ns": [1], "other": [1]}},
        {"$columns": {"time_ns": [1, 2], "added": [[]]}},
    ],
)
def test_a_record_with_an_added_field_is_checked_as_before(rows):
    with pytest.raises(RecordError):
        record(AllGrown, {"rows": rows}, "test")

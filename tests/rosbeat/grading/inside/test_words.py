"""Memory is read without being touched, and tells of every change."""

import json
import subprocess
import sys

import pytest

from rosbeat.grading.inside.words import PARTS, Words, words_of_bodies, words_of_changes

#: What CPython keeps, and until when; the course works without it, only more slowly.
COUNTS = sys.version_info < (3, 14)


class Kind:
    """Something that can be written into."""

    value = 1


def plain():
    """Have no default values."""


def full(first=1, *, second=2):
    """Have all of them."""


def other(first=3, *, second=4):
    """Be another function."""


@pytest.fixture
def bodies():
    found = words_of_bodies([plain, full])
    assert found is not None
    yield found
    full.__code__, full.__defaults__, full.__kwdefaults__ = CODE, (1,), {"second": 2}


CODE = full.__code__


@pytest.mark.parametrize(
    ("name", "value", "place"),
    [("__code__", other.__code__, 0), ("__defaults__", (3,), 1), ("__kwdefaults__", {"b": 2}, 2),
     ("__defaults__", None, 1), ("__kwdefaults__", None, 2)],
)  # fmt: skip
def test_another_body_is_told(bodies, name, value, place):
    assert bodies.changed() == []
    setattr(full, name, value)
    assert bodies.changed() == [len(PARTS) + place]


def test_a_body_that_is_called_or_looked_at_is_the_same(bodies):
    full(5, second=6)
    assert [part(full) for part in PARTS][1:] == [(1,), {"second": 2}]
    full.note = "attributes are no part of the body"
    assert bodies.changed() == []


@pytest.mark.parametrize("functions", [[plain, len], [plain, Kind], [plain, 5]])
def test_what_is_no_function_of_python_cannot_be_told(functions):
    with pytest.raises(AttributeError):
        words_of_bodies(functions)


CHANGES = [
    lambda: setattr(Kind, "value", 2),
    lambda: setattr(Kind, "value", 1),
    lambda: setattr(Kind, "another", 1),
    lambda: delattr(Kind, "another"),
]


@pytest.mark.skipif(not COUNTS, reason="this Python's dictionaries do not count their changes")
def test_every_change_is_told():
    names = {"a": 1}
    for change in (*CHANGES, lambda: names.update(a=2), lambda: names.pop("a"), names.clear):
        words = words_of_changes([names, vars(Kind)])
        assert words.changed() == []
        change()
        assert words.changed() in ([0], [1]) or change == names.clear  # it was empty already


@pytest.mark.skipif(not COUNTS, reason="this Python's dictionaries do not count their changes")
def test_looking_at_something_is_no_change():
    names = {"a": 1, "b": [2]}
    words = words_of_changes([names, vars(Kind)])
    assert [names["a"], *names.items(), Kind.value, Kind().value, vars(Kind)["value"]]
    names["b"].append(3)  # what stands there is another matter
    assert words.changed() == []


@pytest.mark.skipif(COUNTS, reason="this Python's dictionaries count their changes")
def test_where_nothing_counts_that_is_told():
    assert words_of_changes([{"a": 1}]) is None


def test_words_are_those_of_the_moment_and_cannot_be_written():
    words = Words([id(CODE) + 8])  # which class it is of
    assert words.before.tolist() == [id(type(CODE))]
    with pytest.raises(ValueError, match="read-only"):
        words.before[0] = 1


#: A process of its own, for it is forked, and one that runs tests has threads.
PROGRAM = """
import inspect, json, os, resource, sys, argparse, email, http.client, unittest.mock
from rosbeat.grading.inside.words import PARTS, words_of_bodies

functions = [value for module in list(sys.modules.values())
             for value in list(vars(module).values()) if inspect.isfunction(value)]
words = words_of_bodies(functions)

def look():
    for one in functions:
        for part in PARTS:
            part(one)

def copied(deed):
    child = os.fork()
    if child == 0:
        deed()
        os._exit(0)
    return os.wait4(child, 0)[2].ru_minflt

nothing = copied(bool)
print(json.dumps([copied(look) - nothing, copied(words.changed) - nothing]))
"""


def test_to_read_them_copies_next_to_nothing():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    by_looking, by_reading = json.loads(done.stdout)
    assert by_reading < by_looking / 3, done.stderr

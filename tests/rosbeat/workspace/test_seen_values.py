import ast

import pytest

from rosbeat.workspace.seen_values import Seen, entries_of, items_of, text_of


def seen(text, **names):
    known = {name: Seen(ast.parse(value, mode="eval").body, {}) for name, value in names.items()}
    return Seen(ast.parse(text, mode="eval").body, known)


@pytest.mark.parametrize(
    "text",
    ["'a b'", "x", "'a' + ' b'", "f'a {y}'", "f'{\"a\"} b'", "'%s b' % 'a'", "'%s %s' % ('a', y)",
     "'{} {}'.format('a', y)", "'{1} {0}'.format(y, 'a')", "'{k} b'.format(k='a')",
     "' '.join(['a', y])", "' '.join(n for n in ('a', 'b'))"],
)  # fmt: skip
def test_a_text(text):
    assert text_of(seen(text, x="'a b'", y="'b'")) == "a b"


@pytest.mark.parametrize(
    "text",
    ["3", "None", "unknown", "f'{x!r}'", "f'{x:>9}'", "'%d' % 'a'", "'%s %s' % 'a'", "'%s' % ()",
     "'{:>999999999}'.format('a')", "'{} {}'.format('a')", "'{0.x}'.format('a')", "'{'.format()",
     "x.upper()", "open('f').read()", "'a' * 3", "' '.join(unknown)", "b'a'"],
)  # fmt: skip
def test_what_is_no_text_or_cannot_be_seen(text):
    assert text_of(seen(text, x="'a b'")) is None


@pytest.mark.parametrize(
    "text",
    ["['a', 'b']", "('a', 'b')", "x", "['a'] + ['b']", "[*x]", "['a', *['b']]", "list(x)",
     "[n for n in x]", "list(n for n in x)", "tuple(x)"],
)  # fmt: skip
def test_a_list(text):
    assert [text_of(one) for one in items_of(seen(text, x="['a', 'b']"))] == ["a", "b"]


@pytest.mark.parametrize(
    "text", ["'ab'", "unknown", "[*unknown]", "[n for n in x if n]", "{'a': 1}", "range(3)"]
)
def test_what_is_no_list_or_cannot_be_seen(text):
    assert items_of(seen(text, x="['a', 'b']")) is None


@pytest.mark.parametrize(
    "text", ["{'k': 'v'}", "dict(k='v')", "{**x}", "x | {}", "dict(x)", "dict(x, **{})", "x"]
)
def test_a_dictionary(text):
    found = entries_of(seen(text, x="{'k': 'v'}"))
    assert {key: text_of(value) for key, value in found.items()} == {"k": "v"}


@pytest.mark.parametrize("text", ["{unknown: 'v'}", "{**unknown}", "dict(unknown)", "[]", "{'a'}"])
def test_what_is_no_dictionary_or_cannot_be_seen(text):
    assert entries_of(seen(text)) is None

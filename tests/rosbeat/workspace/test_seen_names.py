import ast

import pytest

from rosbeat.workspace.seen_names import reached
from rosbeat.workspace.seen_values import items_of, text_of


def given(text):
    """What the first call of `setup` that is reached gets, as texts; None if none is."""
    call = reached(ast.parse(text), "setup")
    if call is None:
        return None
    items = items_of(call.of(call.node.args[0]))
    return items and [text_of(one) for one in items]


@pytest.mark.parametrize(
    "text",
    ["setup(['a', 'b'])", "x = ['a', 'b']\nsetup(x)", "x = ['a']\nx.append('b')\nsetup(x)",
     "x = ['a']\nx += ['b']\nsetup(x)", "x = []\nx.extend(['a', 'b'])\nsetup(x)",
     "x: list = ['a', 'b']\nsetup(x)", "import s\ns.setup(['a', 'b'])",
     "if __name__ == '__main__':\n    setup(['a', 'b'])", "if True:\n    setup(['a', 'b'])",
     "if False:\n    setup(['c'])\nelse:\n    setup(['a', 'b'])",
     "def run():\n    setup(['a', 'b'])\nrun()", "try:\n    setup(['a', 'b'])\nfinally:\n    pass",
     "done = setup(['a', 'b'])", "x = ['a']\nx = x + ['b']\nsetup(x)",
     "n = 'b'\nif n:\n    print(n)\nsetup(['a', n])"],
)  # fmt: skip
def test_a_call_that_is_reached(text):
    assert given(text) == ["a", "b"]


@pytest.mark.parametrize(
    "text",
    ["", "x = 1", "if False:\n    setup([])", "if 0:\n    setup([])", "def run():\n    setup([])",
     "class A:\n    def run(self):\n        setup([])"],
)  # fmt: skip
def test_a_call_that_is_not_reached(text):
    assert given(text) is None


@pytest.mark.parametrize(
    "text",
    ["x = ['a']\nx.remove('a')\nsetup(x)", "x = ['a']\nfor i in y:\n    x = i\nsetup(x)",
     "x = ['a']\nfor i in y:\n    x.append(i)\nsetup(x)", "x = ['a']\nx[0] = 'b'\nsetup(x)",
     "x, y = ['a'], ['b']\nsetup(x)", "x = ['a']\nx *= 2\nsetup(x)"],
)  # fmt: skip
def test_a_list_that_is_changed_in_another_way_is_not_seen(text):
    assert given(text) is None

"""Names that other cells of a page define, for an answer that builds on them."""

import pytest

from rosbeat.grading.inside.definitions import define_missing, definitions, names_of, needed


def space_after(text, *cells, **known):
    space = dict(known)
    define_missing([text], cells, space)
    return {name: value for name, value in space.items() if name != "__builtins__"}


def test_only_what_is_needed_is_defined():
    found = space_after("print(A + 1)", "A = 1\nB = 2\nboom()", "C = 3")
    assert found == {"A": 1}


def test_what_is_needed_may_need_more():
    cells = ("def twice(x):\n    return x * FACTOR", "import math\nFACTOR = math.floor(2.5)")
    found = space_after("y = twice(3)", *cells)
    assert found["twice"](3) == 6


def test_cells_that_come_first_count_more_and_the_last_line_of_a_cell():
    assert space_after("A", "A = 1\nA = 2", "A = 3") == {"A": 2}


@pytest.mark.parametrize("text", ["A = 5\nprint(A)", "def A(): pass\nA()", "import x as A\nA.b"])
def test_what_a_cell_defines_itself_is_its_own(text):
    assert space_after(text, "A = 1") == {}


def test_what_is_there_already_stays():
    assert space_after("print(A)", "A = 1", A=7) == {"A": 7}
    assert space_after("print(len([]))", "len = 1") == {}


def test_a_definition_that_fails_is_left_out():
    assert space_after("A, B", "A = 1 / 0\nB = 2") == {"B": 2}


@pytest.mark.parametrize("text", ["no python (", "\0", ""])
def test_texts_that_are_no_programs_need_nothing(text):
    assert space_after(text, "A = 1") == {}
    assert space_after("A", text, "A = 1") == {"A": 1}


def test_two_that_need_each_other_are_both_there():
    cells = ("def even(n):\n    return n == 0 or odd(n - 1)\ndef odd(n):\n    return even(n - 1)",)
    assert set(space_after("even(2)", *cells)) == {"even", "odd"}


def test_what_runs_is_told_in_the_order_in_which_it_runs():
    found = needed(["b"], ["a = 1\nb = a"], ())
    assert [names_of(one) for one in found] == [{"a"}, {"b"}]


def test_only_definitions_are_offered():
    cell = "import a\nfrom b import c as d\nx: int = 1\ny, z = 1, 2\nprint(x)\nclass E: pass"
    assert [sorted(names_of(one)) for one in definitions(cell)] == [
        ["a"], ["d"], ["x"], ["y", "z"], ["E"],
    ]  # fmt: skip

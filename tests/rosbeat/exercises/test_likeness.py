from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat.exercises.predict import agree, compared, form_of, is_blank, told

nan = float("nan")


class Broken:
    """Everything about it raises."""

    def __eq__(self, other):
        raise ZeroDivisionError

    __hash__ = None

    def __repr__(self):
        raise ZeroDivisionError

    @property
    def tolist(self):
        raise ZeroDivisionError


@pytest.mark.parametrize("guess", ["____", " ____ ", "'____'", "_", "", "  ", None, ...])
def test_nothing_filled_in_is_a_blank(guess):
    assert is_blank(guess)


@pytest.mark.parametrize("guess", [0, False, [], "no", "a_b", 0.0])
def test_a_guess_is_no_blank(guess):
    assert not is_blank(guess)


@pytest.mark.parametrize(
    ("guess", "happened"),
    [
        (63, 63), ("63", 63), (" 63.0 ", 63), (63.0, 63), (63, "63"), (np.int64(63), 63),
        (63, np.float32(63)), (22.3, 22.299999237060547), (0.3, 0.1 + 0.2), ("nan", nan),
        (float("inf"), "inf"), ("High", "High"), ("high", "High"), (" HIGH  one ", "high one"),
        ("'Normal'", "Normal"), ("Normal.", "Normal"), ("yes", True), ("No", False),
        (True, "yes"), ("True", True), (True, True), (False, np.bool_(False)),
        ([1, 2], (1, 2.0)), ("1, 2", [1, 2]), ("[1, 2]", [1, 2]), ("'a', 'b'", ["A", "b"]),
        ([], []), ("[]", []), ([["1"], [2]], [[1], ["2"]]), (np.array([1, 2]), [1, 2]),
        ([1, 2], np.array([1, 2])), (5, [5]), ({"a": 1}, {"a": 1}), ({1, 2}, {2, 1}),
        (10**400, 10**400),
    ],
)  # fmt: skip
def test_they_agree(guess, happened):
    assert agree(guess, happened)


@pytest.mark.parametrize(
    ("guess", "happened"),
    [
        (60, 63), ("60", 63), ("many", 63), (1_000_000, 1_000_001), (22.31, 22.3), (nan, 3),
        ("High", "Normal"), ("", "High"), ("yes", False), ("perhaps", True), (1, True),
        (True, 1), (True, 0), ([1, 2], [1]), ([1, 2], [2, 1]), ("1, 2, 3", [1, 2]), (1, []),
        ({"a": 1}, {"a": 2}), (object(), 3), (3, object()), (len, "len"), (10**400, 1),
    ],
)  # fmt: skip
def test_they_do_not_agree(guess, happened):
    assert not agree(guess, happened)


@pytest.mark.parametrize("tolerance", [3, 3.0, "3", 100, np.float64(4)])
def test_a_number_may_be_a_little_away(tolerance):
    assert agree(60, 63, tolerance)
    assert agree([60], [63], tolerance)
    assert not agree("High", "Normal", tolerance)


@pytest.mark.parametrize("tolerance", [0, 2.9, -3, nan, "wide", None, object(), True])
def test_not_every_tolerance_lets_it_pass(tolerance):
    assert not agree(60, 63, tolerance)


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary()
    | st.builds(Broken) | st.sampled_from([len, object, Broken]),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner) | st.tuples(inner),
    max_leaves=5,
)  # fmt: skip


@given(anything, anything, anything)
def test_nothing_raises_and_everything_is_one_short_line(guess, happened, tolerance):
    assert agree(guess, happened, tolerance) in (True, False)
    assert is_blank(guess) in (True, False)
    for exact in (True, False):
        assert len(told(guess, exact)) <= 200
        assert "\n" not in told(guess, exact)


@given(st.integers() | st.floats() | st.booleans() | st.lists(st.integers()))
def test_a_value_agrees_with_itself_and_with_how_it_is_told_exactly(value):
    assert agree(value, value)
    assert agree(told(value, exact=True), value) or len(told(value, exact=True)) > 190


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (63, "63"), (63.0, "63"), (22.299999237060547, "22.3"), (True, "yes"), (False, "no"),
        (None, "nothing"), (" High ", "High"), ("", "''"), ([1, True, "a"], "[1, yes, a]"),
        ((), "[]"), ({"a": 1.0}, "{a: 1}"), ("a\nb", "a b"), (np.float32(22.3), "22.3"),
        (Broken(), "a Broken"), ("x" * 500, "x" * 196 + " ..."),
    ],
)  # fmt: skip
def test_a_value_is_told_as_people_write_it(value, words):
    assert told(value) == words


def test_no_address_of_the_memory_is_told():
    assert " at 0x" not in told(object())
    assert " at 0x" not in told([object()])


@pytest.mark.parametrize(
    ("guess", "happened", "other"),
    [
        ("63 messages", 63, 64), ("63!", 63, 64), ("sixty-three", 63, 64), ([63], 63, 64),
        ("[63]", 63, 64), ("1 s", 1, 2), ("one", 1, 2), ("~26", 26, 27), ("about 26", 26, 27),
        ("20-30", 26, 31), ("no!", False, True), ("No, it does not", False, True),
        ("yes.", True, False), ("1 s, 2 s", [1, 2], [1, 3]), ("High!", "High", "Low"),
    ],
)  # fmt: skip
def test_an_answer_may_be_said_in_other_words(guess, happened, other):
    assert compared(guess, happened) is True
    assert compared(guess, other) is False


def test_a_range_is_as_wide_as_the_tolerance_allows():
    assert compared("20-30", 33) is False
    assert compared("20-30", 33, 3) is True
    assert compared("about 26", 27, 1) is True


@pytest.mark.parametrize(
    ("guess", "happened", "form"),
    [
        ("?", 63, "a number"), ("yes", 63, "a number"), (True, 1, "a number"),
        ("26 and 40", 26, "a number"), ([1, 2], 1, "a number"), ([], 1, "a number"),
        ("perhaps", True, "yes or no"), (1, np.bool_(True), "yes or no"),
        ("?", [1, 2], "a list, such as 1, 2, 3"),
    ],
)  # fmt: skip
def test_what_cannot_be_compared_is_not_wrong(guess, happened, form):
    assert compared(guess, happened) is None
    assert not agree(guess, happened)
    assert form_of(happened) == form


def test_what_holds_itself_and_what_is_very_long_are_told_all_the_same():
    endless: list = []
    endless.append(endless)
    assert told(endless) == "a list"
    assert not agree(endless, [[1]])
    assert told(list(range(1_000_000))).endswith(" ...")

"""Predictions: guesses as they are read, compared, and shown."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat import predict
from rosbeat.exercises.predict import (
    agree,
    compared,
    form_of,
    in_words,
    is_blank,
    range_in,
    truth_in,
)

BECAUSE = "The first one comes after a full period."


def test_odd_guesses_never_end_the_page():
    for guess in (object(), [], {}, len, predict, b"x"):
        assert str(predict(guess, 63, tolerance="wide", because=3)).startswith("○ ")
        assert str(predict(guess, "High", tolerance="wide", because=3)).startswith("✗ ")
    assert str(predict(float("nan"), 63)).startswith("✗ ")


def test_what_cannot_be_compared_is_no_wrong_prediction():
    prediction = predict("?", 63, because=BECAUSE)
    assert str(prediction) == "○ That cannot be compared with 63: write a number."
    assert str(predict("?", False)) == "○ That cannot be compared with no: write yes or no."
    assert not prediction.was_right


def test_a_guess_in_words_is_told_as_it_was_written():
    assert str(predict("20-30", 26)) == "✓ You predicted 20-30, and it was 26."
    near = predict("about 60", 63, tolerance=5)
    assert str(near) == "✓ You predicted about 60, and it was 63. That is close enough."


def test_text_and_html_say_the_same_and_are_the_same_every_time():
    bundle = predict("<b>", object())._repr_mimebundle_()
    assert bundle == predict("<b>", object())._repr_mimebundle_()
    assert "&lt;b&gt;" in bundle["text/html"]
    assert bundle["text/plain"] == repr(predict("<b>", object()))


# Numbers and truths in a text.


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("63", 63), ("63 messages", 63), ("63!", 63), ("(63)", 63), ("1s", 1), ("22.3 °C", 22.3),
        ("~26", 26), ("about 26.", 26), ("-5", -5), ("\u22125", -5), (".5 s", 0.5), ("1e3", 1000),
        ("1,000 messages", 1000), ("63, yes, 63", 63), ("a Float32 of 5", 5),
        ("one", 1), ("Sixty-three", 63), ("sixty three messages", 63), ("nineteen", 19),
        ("a hundred", 100), ("one hundred", 100), ("hundred", 100), ("None", 0), ("twenty", 20),
    ],
)  # fmt: skip
def test_the_one_number(text, number):
    assert range_in(text) == (number, number)


@pytest.mark.parametrize(
    "text",
    [
        *("20-30", "20 - 30", "20 to 30", "20\u201330", "20..30", "20 s to 30 s", "30-20"),
        *("between 20 and 30", "twenty to thirty", "about 20-30 messages", "twenty-thirty"),
    ],
)
def test_a_range(text):
    assert range_in(text) == (20, 30)


@pytest.mark.parametrize(
    "text",
    [
        *("", "?", "many", "20 and 30", "20 or 30", "1, 2, 3", "1-2-3", "1.2.3", "Float32", "0x10"),
        *("more than 20", "> 20", "20+", "at least 20", "not 63", "isn't 63", "10 %", "5 * 13"),
        *("1/2", "x" * 300 + " 5", "someone"),
    ],
)
def test_no_number_or_several(text):
    assert range_in(text) is None


@pytest.mark.parametrize(
    "text", ["yes", "YES!", "yes.", "Yes, it does", "true", "y", "I think yes"]
)
def test_yes(text):
    assert truth_in(text) is True


@pytest.mark.parametrize("text", ["no", "no!", "No, it does not", "False", "n", "probably no"])
def test_no(text):
    assert truth_in(text) is False


@pytest.mark.parametrize(
    "text",
    ["", "?", "perhaps", "yes or no", "no idea", "not yes", "I do not know", "63", "nobody"],
)
def test_neither(text):
    assert truth_in(text) is None


@given(st.text() | st.text(alphabet="0123456789.,-+e one-twy%"))
def test_no_text_raises(text):
    ends = range_in(text)
    assert ends is None or ends[0] <= ends[1]
    assert truth_in(text) in (True, False, None)


# What agrees, and how values are put in words.


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
        assert len(in_words(guess, exact)) <= 200
        assert "\n" not in in_words(guess, exact)


@given(st.integers() | st.floats() | st.booleans() | st.lists(st.integers()))
def test_a_value_agrees_with_itself_and_with_how_it_is_told_exactly(value):
    assert agree(value, value)
    assert agree(in_words(value, exact=True), value) or len(in_words(value, exact=True)) > 190


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
    assert in_words(value) == words


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
    assert in_words(endless) == "a list"
    assert not agree(endless, [[1]])
    assert in_words(list(range(1_000_000))).endswith(" ...")

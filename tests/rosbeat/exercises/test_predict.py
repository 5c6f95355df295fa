"""Predictions: guesses as they are read, compared, and shown."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat import predict
from rosbeat.exercises.predict import agree, compared, in_words, is_blank, range_in, truth_in

BECAUSE = "The first one comes after a full period."
SHOWN = [
    (("____", 63), "○ No prediction yet. It was 63."),
    (("63", 63), f"✓ You predicted 63, and it was 63.\n  {BECAUSE}"),
    ((60, 63), f"✗ You predicted 60, and it was 63. Look at why.\n  {BECAUSE}"),
    (("20-30", 26), f"✓ You predicted 20-30, and it was 26.\n  {BECAUSE}"),
    (("?", 63), "○ That cannot be compared with 63: write a number."),
    (("?", False), "○ That cannot be compared with no: write yes or no."),
    (("?", [1, 2]), "○ That cannot be compared with [1, 2]: write a list, such as 1, 2, 3."),
    ((22.3, 22.30003), "✗ You predicted 22.3, and it was 22.30003. Look at why.\n  " + BECAUSE),
]


@pytest.mark.parametrize(("given_and_happened", "said"), SHOWN)
def test_a_prediction_is_told_beside_what_happened(given_and_happened, said):
    prediction = predict(*given_and_happened, because=BECAUSE)
    assert str(prediction) == said
    assert prediction.was_right == said.startswith("✓")
    assert (BECAUSE in prediction.html()) == (BECAUSE in said)


def test_a_near_one_is_said_to_be_near():
    near = predict("about 60", 63, tolerance=5)
    assert str(near) == "✓ You predicted about 60, and it was 63. That is close enough."


def test_odd_guesses_never_end_the_page():
    for guess in (object(), [], {}, len, predict, b"x"):
        assert str(predict(guess, 63, tolerance="wide", because=3)).startswith("○ ")
        assert str(predict(guess, "High", tolerance="wide", because=3)).startswith("✗ ")
    assert str(predict(float("nan"), 63)).startswith("✗ ")


def test_text_and_html_say_the_same_and_are_the_same_every_time():
    bundle = predict("<b>", object())._repr_mimebundle_()
    assert bundle == predict("<b>", object())._repr_mimebundle_()
    assert "&lt;b&gt;" in bundle["text/html"]
    assert bundle["text/plain"] == repr(predict("<b>", object()))


# Numbers and truths in a text.

NUMBERS = {
    "63 messages": 63, "63!": 63, "(63)": 63, "63, yes, 63": 63, "1s": 1,
    "a Float32 of 1": 1, "one": 1, "~26": 26, "about 26.": 26, "22.3 °C": 22.3, "-5": -5,
    "\u22125": -5, ".5 s": 0.5, "1e3": 1000, "1,000 messages": 1000, "None": 0,
    "twenty": 20, "nineteen": 19,
}  # fmt: skip
RANGES = (
    *("20-30", "20 to 30", "20\u201330", "20..30", "20 s to 30 s", "30-20"),
    *("between 20 and 30", "about 20-30 messages"),
)
NEITHER = (
    *("", "?", "many", "20 and 30", "20 or 30", "1, 2, 3", "1-2-3", "1.2.3", "Float32", "0x10"),
    *("more than 20", "> 20", "20+", "at least 20", "not 63", "isn't 63", "10 %", "5 * 13"),
    *("1/2", "x" * 300 + " 5", "someone"),
)


@pytest.mark.parametrize(
    ("text", "ends"),
    [
        *((text, (number, number)) for text, number in NUMBERS.items()),
        *((text, (20, 30)) for text in RANGES),
        *((text, None) for text in NEITHER),
    ],
)
def test_the_one_number_or_range_of_a_text(text, ends):
    assert range_in(text) == ends


@pytest.mark.parametrize(
    ("truth", "texts"),
    [
        (True, ("yes", "YES!", "Yes, it does", "true", "y", "I think yes")),
        (False, ("no", "no!", "No, it does not", "False", "n", "probably no")),
        (None, ("", "?", "perhaps", "yes or no", "no idea", "not yes", "I do not know", "nobody")),
    ],
)
def test_yes_and_no(truth, texts):
    assert [truth_in(text) for text in texts] == [truth] * len(texts)


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


def test_nothing_filled_in_is_a_blank():
    assert all(map(is_blank, ["____", " ____ ", "'____'", "_", "", "  ", None, ...]))
    assert not any(map(is_blank, [0, False, [], "no", "a_b", 0.0]))


@pytest.mark.parametrize(
    ("guess", "happened", "verdict"),
    [
        *((guess, 63, True) for guess in (63, " 63.0 ", 63.0, np.int64(63), "63 messages", [63])),
        *((guess, 63, False) for guess in (60, "60", "three", "20-30")),
        *((guess, 63, None) for guess in ("many", "26 and 40", True, [1, 2], [])),
        (63, np.float32(63), True), (22.3, 22.299999237060547, True), (0.3, 0.1 + 0.2, True),
        ("nan", nan, True), (float("inf"), "inf", True), (22.31, 22.3, False), (nan, 3, False),
        (1_000_000, 1_000_001, False), ("20-30", 26, True), ("about 26", 27, False),
        ("High", "High", True), ("high.", "High", True), (" HIGH  one ", "high one", True),
        ("High", "Normal", False), ("", "High", False),
        ("yes", True, True), ("No, it does not", np.bool_(False), True), ("yes", False, False),
        (True, "yes", True), ("perhaps", True, None), (1, True, None),
        ([1, 2], (1, 2.0), True), ("1, 2", [1, 2], True), ("'a', 'b'", ["A", "b"], True),
        ("1 s, 2 s", [1, 2], True), ([], [], True), ([["1"], [2]], [[1], ["2"]], True),
        (np.array([1, 2]), [1, 2], True), (5, [5], True), ("?", [1, 2], None),
        ([1, 2], [2, 1], False), ("1, 2, 3", [1, 2], False),
        ({"a": 1}, {"a": 1}, True), ({"a": 1}, {"a": 2}, False), (3, object(), False),
    ],
)  # fmt: skip
def test_what_agrees_what_does_not_and_what_cannot_be_compared(guess, happened, verdict):
    assert compared(guess, happened) is verdict
    assert agree(guess, happened) is (verdict is True)


@pytest.mark.parametrize("tolerance", [3, 3.0, "3", 100, np.float64(4)])
def test_a_number_may_be_a_little_away(tolerance):
    assert agree(60, 63, tolerance)
    assert agree([60], [63], tolerance)
    assert agree("20-30", 33, tolerance)
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
        assert len(in_words(guess, exact)) <= 200
        assert "\n" not in in_words(guess, exact)


@given(st.integers() | st.floats() | st.booleans() | st.lists(st.integers()))
def test_a_value_agrees_with_itself_and_with_how_it_is_told_exactly(value):
    assert agree(value, value)
    assert agree(in_words(value, exact=True), value) or len(in_words(value, exact=True)) > 190


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (63.0, "63"), (22.299999237060547, "22.3"), (np.float32(22.3), "22.3"), (True, "yes"),
        (None, "nothing"), (" High ", "High"), ("", "''"), ([1, True, "a"], "[1, yes, a]"),
        ((), "[]"), ({"a": 1.0}, "{a: 1}"), ("a\nb", "a b"), (Broken(), "a Broken"),
        ("x" * 500, "x" * 196 + " ..."),
    ],
)  # fmt: skip
def test_a_value_is_told_as_people_write_it(value, words):
    assert in_words(value) == words


def test_what_holds_itself_is_told_all_the_same_and_no_address_of_the_memory():
    endless: list = []
    endless.append(endless)
    assert in_words(endless) == "a list"
    assert not agree(endless, [[1]])
    assert " at 0x" not in in_words([object()])

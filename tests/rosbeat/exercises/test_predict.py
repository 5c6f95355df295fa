"""Predictions: guesses as they are read, compared, and shown."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat import predict

BECAUSE = "The first one comes after a full period."
NAN = float("nan")
SHOWN = [
    (("____", 63), "○ No prediction yet. It was 63."),
    (("63", 63), f"✓ You predicted 63, and it was 63.\n  {BECAUSE}"),
    ((60, 63), f"✗ You predicted 60, and it was 63. Look at why.\n  {BECAUSE}"),
    (("20-30", 26), f"✓ You predicted 20-30, and it was 26.\n  {BECAUSE}"),
    (("?", 63), "○ That cannot be compared with what happened: write a number."),
    (("?", False), "○ That cannot be compared with what happened: write yes or no."),
    (("?", [1, 2]), "○ That cannot be compared with what happened: write a list, such as 1, 2, 3."),
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


def test_text_and_html_say_the_same_and_are_the_same_every_time():
    bundle = predict("<b>", object())._repr_mimebundle_()
    assert bundle == predict("<b>", object())._repr_mimebundle_()
    assert "&lt;b&gt;" in bundle["text/html"]
    assert bundle["text/plain"] == repr(predict("<b>", object()))


# What agrees, what does not, and what cannot be compared.

RIGHT, WRONG, OPEN = "✓", "✗", "○"
COMPARED = {
    RIGHT: [
        *((guess, 63) for guess in (63, 63.0, np.int64(63), " 63.0 ", "63 messages", "about 63.")),
        *((guess, 26) for guess in ("20-30", "20 to 30", "20–30", "20..30", "30-20", "~26",
                                    "20 s to 30 s", "between 20 and 30", "about 20-30 messages")),
        *(("1,000 messages", 1000), ("1e3", 1000), (".5 s", 0.5), ("-5", -5), ("\u22125", -5)),
        *((63, np.float32(63)), (22.3, 22.299999237060547), ("22.3 °C", 22.3), (0.3, 0.1 + 0.2)),
        *(("High", "High"), ("high.", "High"), (" HIGH  one ", "high one")),
        *((guess, True) for guess in ("yes", "YES!", "Yes, it does", "Yes it does", "true", True)),
        *((guess, np.bool_(False)) for guess in ("no", "No, it does not", "False", False)),
        *(([1, 2], (1, 2.0)), ("1, 2", [1, 2]), ("[1 s, 2 s]", [1, 2]), ("'a', 'b'", ["A", "b"])),
        *((np.array([1, 2]), [1, 2]), ([], []), ([["1"], [2]], [[1], ["2"]])),
    ],
    WRONG: [
        *((guess, 63) for guess in (60, "60", "20-30", NAN)),
        *((22.31, 22.3), (1_000_000, 1_000_001), ("about 26", 27), ("High", "Normal")),
        *(("yes", False), ([2, 1], [1, 2]), ("1, 2, 3", [1, 2]), (3, object())),
    ],
    OPEN: [
        *((guess, 63) for guess in (
            *("many", "26 or 40", "1-2-3", "1.2.3", "Float32", "0x10", "more than 60", "> 60"),
            *("60+", "not 63", "63 %", "7 * 9", "63/1", "x" * 300 + " 63", True, [1, 2], b"x"),
            *(object(), {}, len),
        )),
        *((guess, True) for guess in ("perhaps", "no idea", "nobody", "yes or no", 1)),
        *((guess, 63) for guess in ("____", " ____ ", "'____'", "_", "  ", None, ...)),
        ("?", [1, 2]),
    ],
}  # fmt: skip


@pytest.mark.parametrize(
    ("sign", "guess", "happened"),
    [(sign, *case) for sign, cases in COMPARED.items() for case in cases],
)
def test_what_agrees_what_does_not_and_what_cannot_be_compared(sign, guess, happened):
    assert predict(guess, happened).sign == sign


@pytest.mark.parametrize(("tolerance", "sign"), [(3, RIGHT), (100, RIGHT), (2.9, WRONG)])
def test_a_number_may_be_a_little_away(tolerance, sign):
    for guess, happened in ((60, 63), ([60], [63]), ("50-60", 63)):
        assert predict(guess, happened, tolerance=tolerance).sign == sign


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


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary()
    | st.text(alphabet="0123456789.,-+e one-twy%") | st.builds(Broken) | st.sampled_from([len]),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner) | st.tuples(inner),
    max_leaves=4,
)  # fmt: skip


@given(anything, anything)
def test_nothing_raises_and_every_sentence_is_short(guess, happened):
    said = predict(guess, happened).sentence
    assert len(said) <= 500
    assert "\n" not in said


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (63.0, "63"), (22.299999237060547, "22.3"), (True, "yes"), (None, "nothing"),
        (" High ", "High"), ("", "''"), ([1, True, "a"], "[1, yes, a]"), ("a\nb", "a b"),
        (Broken(), "a Broken"), ("x" * 500, "x" * 196 + " ..."),
    ],
)  # fmt: skip
def test_a_value_is_told_as_people_write_it(value, words):
    assert str(predict("____", value)) == f"○ No prediction yet. It was {words}."


def test_no_address_of_the_memory_is_told():
    assert " at 0x" not in str(predict("____", [object()]))

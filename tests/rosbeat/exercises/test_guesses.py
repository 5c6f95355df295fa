import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat.exercises.predict import range_in, truth_in


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
def test_nothing_raises(text):
    ends = range_in(text)
    assert ends is None or ends[0] <= ends[1]
    assert truth_in(text) in (True, False, None)

"""Tables that are harmless in a spreadsheet."""

import csv
import io

import pytest

from graded_classes import HOSTILE
from rosbeat.grading.csv_table import MOST_OF_A_CELL, cell, csv_text, number


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("Ana Müller", "Ana Müller"),
        ("日本語 👩🏽", "日本語 👩🏽"),
        ('=HYPERLINK("http://a.b","x")', '\'=HYPERLINK("http://a.b","x")'),
        ("+1+1", "'+1+1"),
        ("-2+3+cmd|' /C calc'!A0", "'-2+3+cmd|' /C calc'!A0"),
        ("@SUM(A1)", "'@SUM(A1)"),
        ("  =1+1", "'  =1+1"),
        ("\t=1+1", "' =1+1"),
        ("\r=1+1", "' =1+1"),
        ('"=1+1', "'\"=1+1"),
        ("＝1+1", "'＝1+1"),
        ("'=1+1", "'=1+1"),
        ("a;=1+1", "a;'=1+1"),
        ('a;"=1+1', "a;\"'=1+1"),
        ("; ;@a", "; ;'@a"),
        ("a=b, c-d; e", "a=b, c-d; e"),
        ("-", "-"),
        ("= ", "= "),
        ("\0=1+1", "\\u0000=1+1"),
        ("\u202e=1+1", "\\u202e=1+1"),
        ("one\r\ntwo\u2028three\tfour", "one two three four"),
        ("\x1b[31mred", "\\u001b[31mred"),
        ("\ud800", "\\ud800"),
        ("", ""),
    ],
)
def test_a_text_stays_a_text(text, shown):
    assert cell(text) == shown
    assert cell(shown) == shown


def test_a_cell_fits_into_a_spreadsheet():
    assert len(cell("x" * 100_000)) == MOST_OF_A_CELL
    assert len(cell("=" * 100_000)) <= 32_767


@pytest.mark.parametrize(
    ("value", "shown"),
    [(2, "2"), (2.0, "2"), (0.5, "0.5"), (1 / 3, "0.33333"), (10.0, "10"), (100, "100"),
     (0.0, "0"), (-0.0, "0"), (-1e-9, "0"), (1e-5, "0.00001"), (0.1 + 0.2, "0.3")],
)  # fmt: skip
def test_a_number_is_short(value, shown):
    assert number(value) == shown


def opened(text, separator=","):
    """The cells as a spreadsheet of a country shows them."""
    return list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))


@pytest.mark.parametrize(
    "text", [*HOSTILE, "=1", "a;=1", 'a;"=1";=2', ';"";=cmd|', "x;;=1", "; =1"]
)
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_nothing_is_a_formula_wherever_the_file_is_opened(text, separator):
    shown = opened(csv_text([("name", "points"), (text, 1.5), ("b", text)]), separator)
    for row in shown:
        for one in row:
            assert one.lstrip(' "')[:1] not in set("=+-@＝＋－＠")


def test_a_table_is_read_back_by_python():
    rows = [("a", "b"), ('say "hi", you', 2.0), ("semi;colon", "")]
    assert opened(csv_text(rows)) == [["a", "b"], ['say "hi", you', "2"], ["semi;colon", ""]]
    assert csv_text(rows).count("\r\n") == 3

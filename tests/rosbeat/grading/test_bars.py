"""Bars: lengths, labels, and words for those who do not see them."""

import re
from xml.etree import ElementTree

import pytest

from graded_classes import HOSTILE
from rosbeat.grading.bars import Segment, bar, in_words, labels

PARTS = (
    Segment("passed", 6, "✓ passed"),
    Segment("failed", 0, "✗ no"),
    Segment("open", 2, "○ a b"),
)


def rectangles(drawn):
    tree = ElementTree.fromstring(drawn)
    return [(one.get("class"), one.get("x"), one.get("width")) for one in tree.iter("rect")]


def test_lengths_are_shares_of_the_width():
    assert rectangles(bar(PARTS, 8, "03a")) == [
        ("passed", "0.000%", "75.000%"),
        ("open", "75.000%", "25.000%"),
    ]


def test_a_number_stands_where_it_fits():
    drawn = bar([Segment("passed", 99, "x"), Segment("failed", 1, "y")], 100, "03a")
    assert [one.text for one in ElementTree.fromstring(drawn).iter("text")] == ["99"]


def test_it_is_said_what_is_drawn():
    assert in_words(PARTS) == "6 passed, 2 a b"
    tree = ElementTree.fromstring(bar(PARTS, 8, "03a"))
    assert tree.get("role") == "img"
    assert tree.get("aria-label") == "03a: 6 passed, 2 a b"


def test_labels_have_sign_word_and_number():
    text = re.sub("<[^>]+>", "", labels(PARTS))
    assert text == "✓ passed 6 ○ a b 2"


def test_nothing_is_drawn_of_nothing():
    assert rectangles(bar([], 0, "03a")) == []
    assert 'aria-label="03a: none"' in bar(PARTS[1:2], 0, "03a")
    assert labels(PARTS[1:2]) == ""


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_a_strange_text_changes_nothing(text):
    drawn = bar([Segment("passed", 1, text)], 1, text)
    assert rectangles(drawn) == [("passed", "0.000%", "100.000%")]
    drawn.encode("utf-8")

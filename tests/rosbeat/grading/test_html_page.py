"""Pages that work from one file, whatever is in them."""

import re

import pytest

from graded_classes import HOSTILE
from parsed_html import Parsed
from rosbeat.grading.html_page import (
    MOST_ROWS,
    document,
    folded,
    listed,
    name,
    paragraph,
    prose,
    section,
    shown,
    table,
    visible,
)


def test_a_page_has_what_browsers_and_readers_need():
    parsed = Parsed(document("Feedback", "<p>x</p>", ""))
    tags = [tag for tag, _ in parsed.elements]
    metas = [attrs for tag, attrs in parsed.elements if tag == "meta"]
    assert ("html", {"lang": "en"}) in parsed.elements
    assert {"charset": "utf-8"} in metas
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in metas
    (policy,) = [one["content"] for one in metas if "http-equiv" in one]
    assert policy == "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    assert not {"script", "link", "iframe", "object"} & set(tags)


def test_a_page_asks_the_network_for_nothing():
    page = document("Feedback", "<p>x</p>")
    assert not re.search(r"https?:|url\(|@import|src=", page)


def test_both_themes_have_all_the_colours_that_are_used():
    page = document("Feedback")
    light, dark = re.findall(r":root \{([^}]*--ink[^}]*)\}", page)
    used = set(re.findall(r"var\((--[\w-]+)\)", page))
    assert used
    assert used <= set(re.findall(r"(--[\w-]+):", light))
    assert used <= set(re.findall(r"(--[\w-]+):", dark))


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
@pytest.mark.parametrize("make", [shown, name, paragraph, prose, visible])
def test_nothing_of_a_text_gets_through(make, text):
    made = make(text)
    made.encode("utf-8")
    assert "\0" not in made
    assert "\x1b" not in made
    assert "\u202e" not in made


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
@pytest.mark.parametrize("make", [shown, name, paragraph, prose])
def test_a_text_makes_no_elements(make, text):
    elements = Parsed(f'<i title="{shown(text)}">{make(text)}</i>').elements
    assert {tag for tag, _ in elements} <= {"i", "p", "pre", "bdi"}
    assert all(set(attrs) <= {"title", "dir", "class"} for _, attrs in elements)


def test_a_title_cannot_end_the_title():
    elements = Parsed(document("</title><script>x</script>")).elements
    assert "script" not in [tag for tag, _ in elements]


def test_what_is_hidden_is_shown_and_line_breaks_stay():
    assert visible("a\u202eb\0c\n\td") == "a\\u202eb\\u0000c\n\td"
    assert shown("é \N{SNAKE} <&") == "é \N{SNAKE} &lt;&amp;"


def test_a_long_text_is_cut_and_says_so():
    assert len(shown("W" * 100_000)) < 5_000
    assert "100,000 characters in all" in shown("W" * 100_000)
    assert shown("abcdef", 4) == "abc…"


def test_a_long_text_that_fits_is_not_cut():
    assert shown("W" * 3_000) == "W" * 3_000


def test_several_lines_keep_their_shape():
    assert paragraph("a\n  b") == "<pre>a\n  b</pre>"
    assert paragraph("a") == '<p dir="auto">a</p>'
    assert prose("a\nb") == '<p class="said" dir="auto">a\nb</p>'
    assert paragraph(" ") == prose(" ") == ""


def test_nothing_is_made_of_nothing():
    assert section("x", "", "") == table("x", ["y"], []) == folded("x", "") == ""


def test_a_table_has_headings_of_both_kinds():
    parsed = Parsed(table("What", ("A", "B"), [("1", "2")]))
    assert [attrs["scope"] for tag, attrs in parsed.elements if tag == "th"] == [
        "col",
        "col",
        "row",
    ]
    assert "caption" in [tag for tag, _ in parsed.elements]


def test_a_table_that_nobody_reads_says_how_much_is_left():
    made = table("What", ("A",), [(str(number),) for number in range(MOST_ROWS + 3)])
    assert "And 3 more" in made
    assert made.count("<tr>") == MOST_ROWS + 2


def test_a_long_table_is_folded_up():
    assert listed("What", ("A",), [("1",)] * 11).startswith("<table>")
    assert "<summary>What (12)</summary>" in listed("What", ("A",), [("1",)] * 12)

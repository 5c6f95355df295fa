"""Code in a card: in colours that can be read, and with nothing added to its text."""

import re

import pytest

from parsed_html import Parsed
from rosbeat.exercises import highlighting
from rosbeat.exercises.cards import EDGES, words
from rosbeat.exercises.highlighting import highlighted

PYTHON = 'def tick(self):\n    return f"{self.count} <b>"  # 3 of `5`\n'
CELLS = {
    "a program": PYTHON,
    "a file of Python": f"%%save src/a.py\n{PYTHON}",
    "a terminal": '%%terminal build\ncd "$HOME"  # there\n',
}
PLAIN = {
    "words": "This is no program & has no colours.",
    "a file that is no Python": "%%save src/a.xml\n<a>1</a>\n",
    "a blank": "",
    "what no parser takes": "\0" + "(" * 500,
}
COLOURS = {
    name: getattr(highlighting, name) for name in ("KEYWORD", "STRING", "NUMBER", "NAME", "COMMENT")
}


def brightness(colour):
    """WCAG 2.2, "relative luminance"."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
    return sum(weight * one for weight, one in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one, other):
    """WCAG 2.2, "contrast ratio"."""
    low, high = sorted(map(brightness, (one, other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("name", COLOURS)
def test_code_can_be_read_on_light_and_dark_pages(name):
    light, dark = COLOURS[name]
    assert contrast(light, "#ffffff") >= 4.5
    assert contrast(dark, "#111111") >= 4.5


@pytest.mark.parametrize("page", ["#ffffff", "#111111", "#1e1e1e"])
def test_the_edge_of_a_card_is_seen_on_light_and_dark_pages(page):
    assert min(contrast(edge, page) for edge in EDGES.values()) >= 3


@pytest.mark.parametrize("name", CELLS)
def test_code_has_colours_and_its_text_stays(name):
    html = highlighted(CELLS[name])
    assert html.count("light-dark(") >= 3
    assert Parsed(f"<pre>{html}</pre>").text == CELLS[name]


@pytest.mark.parametrize("name", PLAIN)
def test_other_text_has_no_colours(name):
    html = highlighted(PLAIN[name])
    assert "color" not in html
    assert Parsed(f"<pre>{html}</pre>").text == PLAIN[name]


def test_no_backquote_is_left_in_a_sentence():
    html = words("Write `self.count += 1`, or run `ros2 topic list`.")
    assert "`" not in html
    assert Parsed(html).text == "Write self.count += 1, or run ros2 topic list."
    assert len(re.findall("<code>", html)) == 2
    assert words("a `b", "strong") == "<strong>a `b</strong>"

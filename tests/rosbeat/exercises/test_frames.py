import pytest

from rosbeat.exercises.cards import EDGES, clipped, code, framed, indented, words


def luminance(colour):
    """WCAG 2.2, "relative luminance"."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize("page", ["#ffffff", "#111111", "#1e1e1e"])
@pytest.mark.parametrize("sign", EDGES)
def test_an_edge_is_seen_on_a_white_and_on_a_dark_page(sign, page):
    low, high = sorted(luminance(colour) for colour in (EDGES[sign], page))
    assert (high + 0.05) / (low + 0.05) >= 3


def test_a_frame_has_no_colours_of_its_own_but_the_edge():
    html = framed("✓", "one", "", "two")
    assert html.count("#") == 1
    assert "background" not in html
    assert html.endswith("<div>one</div><div>two</div></div>")


def test_everything_is_escaped():
    for html in (words("<i>&"), words("<i>&", "strong"), words("<i>&\nb"), code("<i>&")):
        assert "&lt;i&gt;&amp;" in html


def test_lines_below_the_first_are_set_in():
    assert indented("a\nb\nc") == "a\n  b\n  c"


@pytest.mark.parametrize("text", ["", "short", "\nlines\n  of a program\n"])
def test_what_is_short_stays_as_it_is(text):
    assert clipped(text) == text.strip("\n")

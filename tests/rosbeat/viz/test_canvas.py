import matplotlib as mpl
import pytest

from rosbeat.viz import theme
from rosbeat.viz.canvas import blank, line_height, text_width, wrap


def test_a_canvas_counts_pixels():
    with blank(200) as canvas:
        assert tuple(canvas.figure.get_size_inches() * theme.DPI) == (theme.WIDTH, 200)
        assert canvas.axes.get_xlim() == (0, theme.WIDTH)
        assert canvas.axes.get_ylim() == (0, 200)


def test_the_theme_holds_inside_and_the_page_gets_its_settings_back():
    with mpl.rc_context({"font.size": 33, "axes.facecolor": "red"}):
        with blank(50):
            assert mpl.rcParams["font.size"] == theme.TEXT
        assert mpl.rcParams["font.size"] == 33


@pytest.mark.parametrize("weight", ["normal", "bold"])
@pytest.mark.parametrize("size", [theme.TEXT, theme.TINY])
def test_text_is_as_wide_as_it_was_said_to_be(size, weight):
    words = "/temperature_sensor"
    with blank(50) as canvas:
        drawn = canvas.text(10, 25, words, size, weight=weight).get_window_extent()
    assert text_width(words, size, weight) == pytest.approx(drawn.width, abs=3)
    assert line_height(size) > 0


def test_no_text_has_no_width():
    assert text_width("  ") == 0


def test_dollars_are_not_mathematics():
    with blank(50) as canvas:
        canvas.text(10, 25, "$x_1$ costs $")
        canvas.figure.canvas.draw()
    assert text_width("$x$") > text_width("x")


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("/short", ("/short",)),
        ("/temperature_sensor", ("/temperature_", "sensor")),
        ("/building_site/floor", ("/building_site/", "floor")),
    ],
)
def test_names_break_after_their_joints(name, rows):
    assert wrap(name, 110) == rows


def test_a_name_without_joints_breaks_anywhere():
    rows = wrap("x" * 60, 100)
    assert "".join(rows) == "x" * 60
    assert all(text_width(row) <= 100 for row in rows)

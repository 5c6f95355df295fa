import matplotlib as mpl
import pytest
from matplotlib.path import Path

from rosbeat.viz import theme
from rosbeat.viz.canvas import (
    BROKEN,
    Entry,
    TimeScale,
    blank,
    cornered,
    line_height,
    smooth,
    text_width,
    wrap,
)


def test_a_canvas_counts_pixels():
    with blank(200) as canvas:
        assert tuple(canvas.figure.get_size_inches() * theme.DPI) == (canvas.width, canvas.height)
        assert canvas.axes.get_xlim() == (0, theme.WIDTH)
        assert canvas.axes.get_ylim() == (0, canvas.height)
        assert canvas.top - canvas.bottom == 200


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


def test_a_key_takes_as_many_rows_as_it_needs_and_has_the_marks_of_the_picture():
    entries = [Entry(f"a long meaning of mark {k}", theme.style(k), theme.CARD) for k in range(5)]
    with blank(50) as plain, blank(50, entries=entries) as canvas:
        pass
    assert (canvas.height - plain.height) / (line_height(theme.SMALL) + 4) == pytest.approx(2)
    assert [
        text.get_text() for text in canvas.axes.texts if text.get_position()[1] < canvas.top
    ] == []
    assert {text.get_text() for text in canvas.axes.texts} == {one.words for one in entries}
    lines, marks = canvas.axes.lines[::2], canvas.axes.lines[1::2]
    assert {line.get_linestyle() for line in lines} <= {"-", "--", "-.", ":"}
    assert {mark.get_marker() for mark in marks} == {look.marker for look in theme.STYLES}
    assert {mark.get_markerfacecolor() for mark in marks} == {theme.CARD}


def test_an_entry_wider_than_the_picture_still_gets_a_row():
    with blank(50, entries=[Entry("words " * 40, theme.style(0))]) as canvas:
        assert len(canvas.axes.texts) == 1


def test_seconds_become_pixels():
    scale = TimeScale(10, 100, 600)
    assert [scale(at) for at in (0, 5, 10)] == [100, 350, 600]


def test_one_instant_stands_in_the_middle():
    scale = TimeScale(0, 100, 600)
    assert scale(0) == 350
    assert scale.ticks() == [0]


@pytest.mark.parametrize("last", [0.001, 1, 7, 60, 12345])
def test_ticks_are_inside_and_few(last):
    ticks = TimeScale(last, 150, 700).ticks()
    assert 2 <= len(ticks) <= 11
    assert ticks[0] == 0
    assert ticks[-1] <= last * 1.0001


def test_a_smooth_arrow_runs_along_the_flow_at_both_ends():
    right, down = smooth([(0, 0), (100, 40)]), smooth([(0, 0), (100, -40)], downward=True)
    assert (right.vertices[1][1], right.vertices[2][1]) == (0, 40)
    assert (down.vertices[1][0], down.vertices[2][0]) == (0, 100)


def test_a_cornered_arrow_reaches_its_ends_and_rounds_the_rest():
    path = cornered([(0, 0), (50, 0), (50, 50)])
    assert tuple(path.vertices[0]) == (0, 0)
    assert tuple(path.vertices[-1]) == (50, 50)
    assert list(path.codes).count(Path.CURVE3) == 2


@pytest.mark.parametrize("end", [(100, 20), (20, 100), (20, 20)])
def test_the_tip_of_an_arrow_is_at_its_end(end):
    with blank(200) as canvas:
        canvas.arrow(Path([(20, 20), end]), BROKEN)
    line, head = canvas.axes.patches
    assert tuple(head.get_path().vertices[0]) == end
    assert line.get_linestyle() == "--"

from rosbeat.viz import key, theme
from rosbeat.viz.canvas import blank

ENTRIES = [key.Entry(f"meaning {k}", theme.style(k)) for k in range(5)]


def test_no_entries_need_no_room():
    assert key.height([], 700) == 0


def test_entries_that_do_not_fit_go_to_the_next_row():
    rows = key.rows(ENTRIES, 300)
    assert [entry for row in rows for entry in row] == ENTRIES
    assert len(rows) > 1
    assert key.height(ENTRIES, 300) == len(rows) * key.ROW


def test_an_entry_wider_than_the_row_still_gets_one():
    assert key.rows(ENTRIES[:1], 10) == [ENTRIES[:1]]


def test_marks_are_drawn_as_in_the_picture():
    with blank(80) as canvas:
        key.draw(canvas, [key.Entry("waits", theme.style(1), fill=theme.CARD)], 10, 70, 700)
    line, mark = canvas.axes.lines
    assert line.get_linestyle() == theme.style(1).dash
    assert mark.get_marker() == theme.style(1).marker
    assert mark.get_markerfacecolor() == theme.CARD
    assert [text.get_text() for text in canvas.axes.texts] == ["waits"]


def test_a_stretch_of_time_is_drawn_as_a_bar():
    with blank(80) as canvas:
        entry = key.Entry("callback waits", theme.Style("", "", ""), bar=theme.WAIT)
        key.draw(canvas, [entry], 10, 70, 700)
    (bar,) = canvas.axes.patches
    assert bar.get_hatch() == theme.WAIT.hatch

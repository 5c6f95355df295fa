from rosbeat.viz.canvas import blank, text_width
from rosbeat.viz.notes import Note


def test_it_is_as_large_as_its_words():
    one, two = Note(("asks for RELIABLE",)), Note(("offers BEST_EFFORT", "asks for RELIABLE"))
    assert one.size[0] > text_width("asks for RELIABLE", one.points)
    assert two.size[0] > one.size[0]
    assert two.size[1] > one.size[1]


def test_the_lines_are_in_order_around_the_middle():
    with blank(100) as canvas:
        Note(("first", "second")).draw(canvas, 200, 50)
    first, second = canvas.axes.texts
    assert (first.get_text(), second.get_text()) == ("first", "second")
    assert first.get_position()[1] + second.get_position()[1] == 100
    assert first.get_position()[1] > 50

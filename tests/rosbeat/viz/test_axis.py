import pytest

from rosbeat.viz import axis
from rosbeat.viz.canvas import blank


def test_seconds_become_pixels():
    scale = axis.Scale(0, 10, 100, 600)
    assert [scale(at) for at in (0, 5, 10)] == [100, 350, 600]


def test_one_instant_stands_in_the_middle():
    scale = axis.Scale(3, 3, 100, 600)
    assert scale(3) == 350
    assert scale.ticks() == [3]


@pytest.mark.parametrize("last", [0.001, 1, 7, 60, 12345])
def test_ticks_are_inside_and_few(last):
    ticks = axis.Scale(0, last, 150, 700).ticks()
    assert 2 <= len(ticks) <= 11
    assert ticks[0] == 0
    assert ticks[-1] <= last * 1.0001


def test_times_are_written_below():
    with blank(100) as canvas:
        axis.draw(canvas, axis.Scale(0, 2, 100, 600), 30, 90)
    assert canvas.axes.texts[0].get_text() == "0 s"
    assert canvas.axes.texts[-1].get_text() == "2 s"

import pytest
from matplotlib.path import Path

from rosbeat.viz import arrows
from rosbeat.viz.canvas import blank


def test_a_curve_runs_along_the_flow_at_both_ends():
    right = arrows.curve([(0, 0), (100, 40)])
    assert right.vertices[1][1] == 0
    assert right.vertices[2][1] == 40
    down = arrows.curve([(0, 0), (100, -40)], downward=True)
    assert down.vertices[1][0] == 0
    assert down.vertices[2][0] == 100


def test_a_cornered_line_reaches_its_ends_and_rounds_the_rest():
    path = arrows.cornered([(0, 0), (50, 0), (50, 50)])
    assert tuple(path.vertices[0]) == (0, 0)
    assert tuple(path.vertices[-1]) == (50, 50)
    assert list(path.codes).count(Path.CURVE3) == 2


@pytest.mark.parametrize("end", [(100, 20), (20, 100), (20, 20)])
def test_the_tip_is_at_the_end(end):
    with blank(200) as canvas:
        arrows.draw(canvas, Path([(20, 20), end]), arrows.BROKEN)
    line, head = canvas.axes.patches
    assert tuple(head.get_path().vertices[0]) == end
    assert line.get_linestyle() == "--"

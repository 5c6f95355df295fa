import pytest
from matplotlib.patches import Ellipse, FancyBboxPatch

from rosbeat.viz import theme
from rosbeat.viz.canvas import blank
from rosbeat.viz.labels import node_label, topic_label

NODE = node_label("/temperature_sensor", 110, 10, strong=False)
STRONG = node_label("/temperature_sensor", 200, 10, strong=True)
TOPIC = topic_label("/t", ("std_msgs/msg/Float32",), ("nobody subscribes",), 200, 10, strong=True)


@pytest.mark.parametrize(
    ("label", "shape"), [(NODE, Ellipse), (STRONG, Ellipse), (TOPIC, FancyBboxPatch)]
)
def test_the_text_is_inside_its_shape(label, shape):
    with blank(200) as canvas:
        label.draw(canvas, 300, 100)
        canvas.figure.canvas.draw()
    patch = canvas.axes.patches[0]
    assert isinstance(patch, shape)
    outline = patch.get_transform().transform_path(patch.get_path())
    for text in canvas.axes.texts:
        box = text.get_window_extent()
        corners = [(x, y) for x in (box.x0, box.x1) for y in (box.y0 + 2, box.y1 - 2)]
        assert outline.contains_points(corners).all(), text.get_text()


def test_a_topic_says_its_type_and_what_is_wrong():
    assert [line.words for line in TOPIC.lines] == ["/t", "Float32", "nobody subscribes"]
    assert TOPIC.lines[-1].colour == theme.ALERT_TEXT
    assert TOPIC.broken


def test_a_highlighted_name_is_bold():
    with blank(200) as canvas:
        TOPIC.draw(canvas, 300, 100)
    assert [text.get_weight() for text in canvas.axes.texts] == ["bold", "normal", "normal"]


def test_a_broken_name_makes_a_higher_box():
    assert NODE.size[1] > node_label("/a", 110, 10, strong=False).size[1]

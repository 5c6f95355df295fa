"""The places of nodes and topics."""

import re

import pytest

from rosbeat.panel.layout import layout
from rosbeat.records import Endpoint, GraphSnapshot
from rosbeat.viz.graphs import Marked, arrange
from rosbeat.viz.wiring import wiring

FLOAT = "std_msgs/msg/Float32"


def ring(count, kind=FLOAT):
    """Every node hears the one before."""
    ends = []
    for k in range(count):
        ends.append(Endpoint(f"/node{k}", f"/ring{k}", kind, "publisher", None, 1))
        last = f"/ring{(k - 1) % count}"
        ends.append(Endpoint(f"/node{k}", last, kind, "subscription", None, 1))
    return wiring(GraphSnapshot(tuple(f"/node{k}" for k in range(count)), tuple(ends)))


def numbers(path):
    return [float(text) for text in re.findall(r"-?\d+\.\d", path)]


def test_no_two_boxes_overlap_and_all_lie_inside():
    for count in (1, 2, 7):
        placed = layout(ring(count))
        boxes = placed["boxes"]
        assert len(boxes) == 2 * count
        for box in boxes:
            assert box["x"] - box["w"] / 2 > 0
            assert box["x"] + box["w"] / 2 < placed["width"]
            assert box["y"] - box["h"] / 2 > 0
            assert box["y"] + box["h"] / 2 < placed["height"]
        for k, one in enumerate(boxes):
            for other in boxes[k + 1 :]:
                aside = abs(one["x"] - other["x"]) >= (one["w"] + other["w"]) / 2
                above = abs(one["y"] - other["y"]) >= (one["h"] + other["h"]) / 2
                assert aside or above


@pytest.mark.parametrize(("count", "flow"), [(1, "x"), (6, "y")])
def test_arrows_begin_and_end_at_their_boxes(count, flow):
    """A graph that is too wide for a page runs down, in the panel as in a picture."""
    shown = ring(count)
    assert arrange(Marked(shown, shown)).down == (flow == "y")
    placed = layout(shown)
    boxes = {box["key"]: box for box in placed["boxes"]}
    assert len(placed["edges"]) == 2 * count
    length, first = ("w", 0) if flow == "x" else ("h", 1)
    for edge in placed["edges"]:
        start, end = boxes[edge["from"]], boxes[edge["to"]]
        found = numbers(edge["path"])
        assert abs(found[first] - start[flow] - start[length] / 2) < 0.2
        assert abs(found[first - 2] - end[flow] + end[length] / 2) < 0.2
        other = "y" if flow == "x" else "x"
        assert abs(found[-1 - first] - end[other]) < 0.2


def test_what_is_wrong_is_marked_and_said():
    lonely = Endpoint("/sensor", "/temprature", FLOAT, "publisher", None, 0)
    placed = layout(wiring(GraphSnapshot(("/sensor",), (lonely,))))
    assert placed["edges"][0]["fault"] == "nobody subscribes"
    topic = next(box for box in placed["boxes"] if box["kind"] == "topic")
    assert topic["broken"]
    assert "nobody subscribes" in topic["lines"]
    assert "nobody subscribes" in placed["words"]


def test_a_name_in_several_lines_is_still_the_name_and_what_is_below_is_not():
    name, kind = "/window_state_of_the_greenhouse_in_the_north", "std_msgs/msg/Bool"
    lonely = Endpoint("/window", name, kind, "publisher", None, 0)
    placed = layout(wiring(GraphSnapshot(("/window",), (lonely,))))
    node, topic = sorted(placed["boxes"], key=lambda box: box["kind"])
    assert topic["rows"] > 1
    assert "".join(topic["lines"][: topic["rows"]]) == name
    assert topic["lines"][topic["rows"] :] == ["Bool", "nobody subscribes"]
    assert (node["lines"], node["rows"]) == (["/window"], 1)


def test_only_numbers_are_offered_to_the_slider():
    assert layout(ring(2))["numeric"] == ["/ring0", "/ring1"]
    assert layout(ring(2, "std_msgs/msg/String"))["numeric"] == []


def test_nothing_at_all_has_a_layout_too():
    placed = layout(wiring(GraphSnapshot()))
    assert placed["boxes"] == placed["edges"] == []
    assert placed["width"] > 0

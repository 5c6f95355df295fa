"""From a session to frames: what is drawn of each topic, what is new, and when one is sent."""

import json
import math
import re
from itertools import combinations, pairwise

import pytest

from record_builders import FLOAT, STRING, graph_of, pub, sub
from rosbeat.panel.panel import RARE_RETRY, RETRY, RETRY_FOR, WINDOW, FlowControl
from rosbeat.panel.sampling import KEPT_LINES, LINES_PER_FRAME, POINTS, Sampler, layout
from rosbeat.records import Fault, GraphSnapshot, LogRecord
from rosbeat.viz.graphs import wiring


def said(text, level="INFO", time_ns=0):
    return LogRecord(time_ns, level, "sensor", text, "f", 1)


@pytest.fixture
def sampler(made_up):
    made = Sampler(made_up)
    made.look()
    return made


@pytest.fixture
def topic(made_up, sampler):
    """Look at the session after each message, and return what a frame says of the topic."""

    def hear(*values, whole=True, period=1 / 20, **about):
        for value in values:
            made_up.hear(value, **about)
            sampler.look()
            made_up.seconds += period
        made_up.seconds -= period
        return sampler.frame(whole)["topics"].get("/temperature")

    return hear


def test_a_whole_frame_has_everything(made_up, sampler):
    made_up.hear(22.5)
    made_up.said.append(said("hello"))
    sampler.look()
    frame = sampler.frame(whole=True)
    assert frame["live"] is True
    assert frame["nodes"] == {"/monitor": "running", "/sensor": "running"}
    assert [box["name"] for box in frame["graph"]["boxes"]] == [
        "/sensor",
        "/temperature",
        "/monitor",
    ]
    assert frame["topics"]["/temperature"]["text"] == "22.5"
    assert frame["log"] == [(0, "INFO", "sensor", "hello")]
    assert json.loads(json.dumps(frame, allow_nan=False))


def test_a_later_frame_has_only_what_is_new(made_up, sampler):
    sampler.frame(whole=True)
    sampler.look()
    assert set(sampler.frame(whole=False)) == {"whole", "time", "topics"}
    made_up.states["/sensor"] = "paused"
    sampler.look()
    frame = sampler.frame(whole=False)
    assert frame["nodes"]["/sensor"] == "paused"
    assert "graph" not in frame
    made_up.snapshot = GraphSnapshot(("/monitor",))
    sampler.look()
    assert len(sampler.frame(whole=False)["graph"]["boxes"]) == 1


def test_the_frame_after_many_that_were_skipped_is_complete(made_up, sampler):
    sampler.frame(whole=True)
    for k in range(400):
        made_up.seconds = k / 20
        made_up.hear(float(k), count=5)
        made_up.said.append(said(str(k), time_ns=k))
        sampler.look()
    frame = sampler.frame(whole=False)
    topic = frame["topics"]["/temperature"]
    assert topic["total"] == topic["from"]["/sensor"] == 2000
    assert [value for _, value in topic["points"]] == list(range(400))
    assert len(frame["log"]) == LINES_PER_FRAME
    assert frame["left_out"] == 400 - LINES_PER_FRAME
    assert frame["log"][-1][3] == "399"


def test_a_frame_stays_small_whatever_comes(made_up, sampler):
    for k in range(5000):
        made_up.hear(k * 1.234567, count=100, topic=f"/topic{k % 10}")
        made_up.said += [said("x" * 60)] * 3
        sampler.look()
    sampler.frame(whole=True)
    for k in range(10):
        made_up.hear(k * 1.234567, count=100, topic=f"/topic{k}")
    sampler.look()
    assert len(json.dumps(sampler.frame(whole=False))) < 5000
    assert len(json.dumps(sampler.frame(whole=True))) < 300_000
    assert len(sampler.frame(whole=True)["log"]) == KEPT_LINES


def test_points_are_sent_once_and_all_of_them_when_asked_for(topic, made_up, sampler):
    assert topic(0.0, 1.0, 2.0, whole=False, period=1)["points"] == [(0, 0), (1, 1), (2, 2)]
    made_up.seconds = 3
    assert topic(3.0, whole=False)["points"] == [(3, 3)]
    assert len(sampler.frame(True)["topics"]["/temperature"]["points"]) == 4


def test_counts_are_those_of_the_session_and_not_of_the_points(topic, made_up, sampler):
    made_up.hear(1.0, count=7)
    made_up.hear(1.0, count=2, node="/other")
    sampler.look()
    news = sampler.frame(False)["topics"]["/temperature"]
    assert (news["total"], news["from"]) == (9, {"/sensor": 7, "/other": 2})
    news = topic(1.0, whole=False)
    assert (news["total"], news["from"]) == (10, {"/sensor": 1})


def test_only_half_a_minute_is_drawn(topic):
    at = [point[0] for point in topic(*[0.0] * 2 * POINTS)["points"]]
    assert 29 < at[-1] - at[0] <= 30.001
    assert at[-1] == pytest.approx(63.95)


def test_a_rate_is_counted_over_two_seconds_and_a_silent_topic_is_told_once_more(made_up, sampler):
    rates = []
    for k in range(160):
        made_up.seconds = k / 20
        if k < 60:
            made_up.hear(0.0, count=5)
        sampler.look()
        rates += [topic["rate"] for topic in sampler.frame(whole=False)["topics"].values()]
    assert rates[55] == 100
    assert rates[-1] == 0
    assert rates[1:].count(0) == 1


@pytest.mark.parametrize(
    ("data", "text", "field", "points"),
    [
        (22.123456789, "22.12", "", [22.123456789]),
        ("Normal", "Normal", "", []),
        (True, "True", "", [1.0]),
        ({}, "{}", "", []),
        ({"header": {"stamp": {"sec": 3}}, "temperature": 4.5}, "4.5", "temperature", [4.5]),
        ({"position": {"x": 1.5}, "y": 2}, "1.5", "position.x", [1.5]),
        ("x" * 500, "x" * 119 + "…", "", []),
        # What has no place on an axis is a gap.
        (math.nan, "nan", "", [None]),
        (math.inf, "inf", "", [None]),
        (-math.inf, "−inf", "", [None]),
    ],
)
def test_any_message_has_words_and_numbers_have_points(topic, data, text, field, points):
    news = topic(data)
    assert (news["text"], news["field"]) == (text, field)
    found = [value for _, value in news["points"]]
    assert found == (points if None in points else pytest.approx(points, rel=1e-4))


def test_an_exception_is_in_the_log(made_up, sampler):
    fault = Fault(2_000_000_000, "/room/sensor", "talk", "ZeroDivisionError", "by zero", 3, "1 / 0")
    made_up.failed.append(fault)
    sampler.look()
    (line,) = sampler.frame(whole=False)["log"]
    assert line[:3] == (2.0, "FATAL", "room.sensor")
    assert line[3] == "stopped in talk: ZeroDivisionError: by zero, line 3: 1 / 0"


# The graph.


def ring(count, kind=FLOAT):
    """Every node hears the one before."""
    ends = []
    for k in range(count):
        ends += [pub(f"/node{k}", f"/ring{k}", 1, kind)]
        ends += [sub(f"/node{k}", f"/ring{(k - 1) % count}", 1, kind)]
    return wiring(graph_of(*ends))


@pytest.mark.parametrize(("count", "flow", "side"), [(1, "x", "w"), (6, "y", "h")])
def test_boxes_lie_inside_and_apart_and_arrows_begin_and_end_at_them(count, flow, side):
    """A graph that is too wide for a page runs down, in the panel as in a picture."""
    placed = layout(ring(count))
    boxes = {box["key"]: box for box in placed["boxes"]}
    assert len(boxes) == len(placed["edges"]) == 2 * count
    for at, size, whole in (("x", "w", "width"), ("y", "h", "height")):
        assert all(
            box[size] / 2 < box[at] < placed[whole] - box[size] / 2 for box in boxes.values()
        )
    for one, other in combinations(boxes.values(), 2):
        aside = abs(one["x"] - other["x"]) >= (one["w"] + other["w"]) / 2
        assert aside or abs(one["y"] - other["y"]) >= (one["h"] + other["h"]) / 2
    first, across = (0, "y") if flow == "x" else (1, "x")
    for edge in placed["edges"]:
        start, end = boxes[edge["from"]], boxes[edge["to"]]
        found = [float(text) for text in re.findall(r"-?\d+\.\d", edge["path"])]
        assert found[first] == pytest.approx(start[flow] + start[side] / 2, abs=0.2)
        assert found[first - 2] == pytest.approx(end[flow] - end[side] / 2, abs=0.2)
        assert found[-1 - first] == pytest.approx(end[across], abs=0.2)


def test_what_is_wrong_is_marked_below_a_name_that_may_have_several_lines():
    name = "/window_state_of_the_greenhouse_in_the_north"
    placed = layout(wiring(graph_of(pub("/window", name, 0))))
    node, topic = sorted(placed["boxes"], key=lambda box: box["kind"])
    assert (node["lines"], node["rows"], topic["broken"]) == (["/window"], 1, True)
    assert "".join(topic["lines"][: topic["rows"]]) == name
    assert topic["lines"][topic["rows"] :] == ["Float32", "nobody subscribes"]
    assert placed["edges"][0]["fault"] == "nobody subscribes"
    assert "nobody subscribes" in placed["words"]


def test_only_numbers_are_offered_to_the_slider_and_nothing_at_all_has_a_layout_too():
    assert layout(ring(2))["numeric"] == ["/ring0", "/ring1"]
    assert layout(ring(2, STRING))["numeric"] == []
    placed = layout(wiring(GraphSnapshot()))
    assert placed["boxes"] == placed["edges"] == []
    assert placed["width"] > 0


# When a frame may be sent.


def sent_within(flow, begin, seconds):
    """Frames that go out when somebody wants to send twenty a second."""
    times = [begin + k / 20 for k in range(round(20 * seconds))]
    return [flow.sent(now) for now in times if flow.may_send(now)]


@pytest.fixture
def flow():
    made = FlowControl()
    assert sent_within(made, 0, 10) == []  # nothing before a browser asks
    made.ask(10)
    return made


def test_a_browser_that_answers_gets_every_frame(flow):
    for k in range(200):
        assert flow.may_send(k / 20)
        number = flow.sent(k / 20)
        assert number == k + 1
        if number % 3 == 0:
            flow.heard(number, k / 20)
    assert not flow.asked


def test_one_that_sleeps_gets_a_frame_a_second_and_after_a_while_hardly_any(flow):
    times = [10 + k / 20 for k in range(round(20 * (RETRY_FOR + 3000)))]
    came = [now for now in times if flow.may_send(now) and flow.sent(now)]
    gaps = [b - a for a, b in pairwise(came)]
    assert max(gaps[: WINDOW + 500]) <= RETRY + 0.1
    assert gaps[-1] == pytest.approx(RARE_RETRY, abs=0.1)
    assert WINDOW + RETRY_FOR < len(came) < WINDOW + RETRY_FOR / RETRY + 3000 / RARE_RETRY + 20


def test_when_it_wakes_up_all_is_as_before(flow):
    last = sent_within(flow, 0, 600)[-1]
    flow.heard(last, 600)
    assert len(sent_within(flow, 600, 0.3)) == WINDOW
    assert not flow.may_send(600.4)
    assert flow.may_send(600.3 + RETRY)


def test_a_new_view_begins_anew_although_the_old_one_never_answered(flow):
    sent_within(flow, 0, 100)
    flow.ask(100)
    assert flow.asked
    assert len(sent_within(flow, 100, 0.3)) == WINDOW


def test_answers_from_elsewhere_change_nothing(flow):
    sent_within(flow, 0, 0.4)
    for number in (-3, 99):
        flow.heard(number, 0.4)
    assert not flow.may_send(0.5)

"""The panel: messages from the browser, frames on time, a picture, and an end without remains."""

import math
import threading
import time
from queue import Empty
from types import SimpleNamespace

import comm
import pytest
from ipywidgets.widgets.widget import _instances

from notebooks.kernel import WatchedKernel
from rosbeat.errors import SessionError
from rosbeat.panel import panel as panels
from rosbeat.panel.panel import WINDOW, Panel, is_for_a_browser, still
from rosbeat.records import GraphSnapshot


@pytest.fixture
def in_a_browser(monkeypatch):
    """As in a kernel that has a browser."""
    monkeypatch.setattr(panels, "is_for_a_browser", lambda: True)
    shown = []
    monkeypatch.setattr(panels, "display", lambda data, **about: shown.append(data))
    return shown


@pytest.fixture
def panel(in_a_browser, made_up):
    made = Panel(made_up)
    yield made
    made.close()


@pytest.fixture
def frames(panel):
    """What is sent; the browser answers nothing by itself."""
    sent = []
    panel._widget.send = sent.append
    return sent


def threads():
    return [one for one in threading.enumerate() if one.name == "rosbeat panel"]


VIEW = "application/vnd.jupyter.widget-view+json"

# What comes from the browser.


@pytest.mark.parametrize(
    ("order", "asked"),
    [
        ({"do": "pause", "node": "/a"}, ("pause", "/a")),
        ({"do": "start", "node": "/a"}, ("start", "/a")),
        ({"do": "publish", "topic": "/t", "value": 3}, ("publish", "/t", 3.0)),
        ({"do": "repeat", "topic": "/t", "value": 3, "on": True}, ("repeat", "/t", 3.0)),
        ({"do": "repeat", "topic": "/t", "on": False}, ("repeat", "/t", None)),
        ({"do": "disturb", "topic": "/t", "kind": "offset", "amount": 2},
         ("disturb", "/t", "offset", 2.0)),
        ({"do": "load", "milliseconds": 200}, ("load", 200.0)),
        ({"do": "load", "milliseconds": 1e9}, ("load", 900.0)),
        # What makes no sense changes nothing.
        *((order, None) for order in (
            {}, {"do": "release"}, {"do": "__class__"}, {"do": "nonsense"}, {"do": "pause"},
            {"do": "pause", "node": 3}, {"do": "publish", "topic": "/t", "value": "hot"},
            {"do": "publish", "topic": "/t", "value": True},
            {"do": "publish", "topic": "/t", "value": math.nan},
            {"do": "disturb", "topic": "/t", "kind": "fire", "amount": 2})),
    ],
    ids=str,
)  # fmt: skip
def test_a_click_reaches_the_session_or_is_refused(
    panel, frames, made_up, eventually, order, asked
):
    panel._heard({"do": "open"})
    panel._heard(order)
    assert made_up.asked == ([asked] if asked else [])
    if asked is None and order:
        eventually(lambda: any("does not understand" in one.get("note", "") for one in frames))


def test_what_a_session_refuses_is_said_in_words(panel, frames, made_up, eventually):
    def refuse(node):
        raise SessionError(f"There is no {node}.", "It means this.", "Try that.")

    made_up.pause = refuse
    panel._heard({"do": "open"})
    panel._heard({"do": "pause", "node": "/a"})
    eventually(lambda: any(one.get("note") == "There is no /a. Try that." for one in frames))


# Frames.


def test_nothing_is_sent_until_a_browser_opens_it(panel, frames, made_up, eventually):
    looks = []
    made_up.conditions = lambda: looks.append(1) or {}
    eventually(lambda: len(looks) > 3)
    assert frames == []
    panel._heard({"do": "open"})
    eventually(lambda: frames)
    assert frames[0]["whole"]
    assert frames[0]["number"] == 1


def test_frames_are_numbered_and_stop_when_nobody_answers(panel, frames, eventually):
    panel._heard({"do": "open"})
    eventually(lambda: len(frames) >= 6)
    panel._heard({"got": 6})
    eventually(lambda: len(frames) >= 8)
    found = [(frame["number"], frame["whole"]) for frame in list(frames)]
    assert found == [(k, k == 1) for k in range(1, len(found) + 1)]


def test_a_browser_that_answers_nothing_still_hears_of_the_kernel(panel, frames, eventually):
    panel._heard({"do": "open"})
    eventually(lambda: len(frames) > WINDOW)


def test_a_second_view_gets_everything(panel, frames, eventually):
    panel._heard({"do": "open"})
    eventually(lambda: len(frames) >= 2)
    before = len(frames)
    panel._heard({"do": "open"})
    eventually(lambda: any(frame.get("whole") for frame in frames[before:]))


# The picture, and the end.


def test_at_the_end_of_a_cell_it_shows_a_picture_and_a_view_below(panel, in_a_browser):
    panel._ipython_display_()
    picture, view = in_a_browser
    assert set(view) == {VIEW}
    assert view[VIEW]["model_id"] == panel._widget.model_id
    assert picture["text/plain"].startswith(
        "The instrument panel of this session. 2 nodes and 1 topic."
    )
    assert "<figure" in picture["text/html"]
    assert "For the live one, run this cell again" in picture["text/html"]
    assert "no nodes yet" in still(GraphSnapshot())["text/plain"]


def test_without_nodes_there_is_a_sentence_behind_the_view(panel, made_up, in_a_browser):
    made_up.snapshot = GraphSnapshot()
    panel._ipython_display_()
    assert "no nodes yet" in in_a_browser[0]["text/html"]
    assert "rosbeat-still" in in_a_browser[0]["text/html"]


def test_without_a_browser_it_is_a_picture_and_no_thread(made_up, monkeypatch):
    shown = []
    monkeypatch.setattr(panels, "display", lambda data, **about: shown.append(data))
    for _ in range(2):
        made = Panel(made_up)
        made._ipython_display_()
        made.close()
    assert threads() == []
    assert shown[0] == shown[1]
    assert set(shown[0]) == {"text/html", "text/plain"}


def test_closing_leaves_nothing_behind(in_a_browser, made_up):
    before = len(comm.get_comm_manager().comms), len(_instances)
    made = [Panel(made_up) for _ in range(3)]
    assert len(threads()) == 3
    for one in made:
        one.close()
        one.close()
        assert repr(one) == "Panel(closed)"
    assert threads() == []
    assert (len(comm.get_comm_manager().comms), len(_instances)) == before
    assert made_up.asked == [("release",)] * 3


def test_a_browser_is_expected_only_behind_a_kernel(monkeypatch):
    monkeypatch.delenv("ROSBEAT_STEADY_HOME", raising=False)
    assert not is_for_a_browser()
    shell = SimpleNamespace()
    monkeypatch.setattr(panels, "get_ipython", lambda: shell)
    assert not is_for_a_browser()
    shell.kernel = object()
    assert is_for_a_browser()
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", "/somewhere")
    assert not is_for_a_browser()


# In a real kernel, with a make-believe browser; page 07 shows the picture.


NODES = """
from rclpy.node import Node
from std_msgs.msg import Float32
from rosbeat import Session

class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(0.02, lambda: self.publisher.publish(Float32(data=22.0)))

ros = Session()
ros.add(Sensor)
ros.start()
"""

WITH_A_BROWSER = "import os; del os.environ['ROSBEAT_STEADY_HOME']"


@pytest.fixture
def kernel(tmp_path):
    made = WatchedKernel(str(tmp_path), 60)
    yield made
    made.stop()


def run(kernel, source):
    """Run a cell; return what it sent."""
    asked = kernel.execute_cell_input(source)
    kernel.await_reply(asked, 60)
    assert kernel.reply["status"] == "ok", kernel.reply
    return until(kernel, lambda one: is_idle(one) and one["parent_header"]["msg_id"] == asked)


def is_idle(message):
    return message["content"].get("execution_state") == "idle"


def until(kernel, wanted):
    """Every message up to the first that is wanted."""
    found, deadline = [], time.monotonic() + 60
    while not found or not wanted(found[-1]):
        assert time.monotonic() < deadline, "the deadline came first"
        try:
            found.append(kernel.get_message("iopub", timeout=1))
        except Empty:
            continue
    return found


def shown(messages):
    every = (m["content"]["data"] for m in messages if m["msg_type"] == "display_data")
    return {mime: data for one in every for mime, data in one.items()}


def is_fourth_frame(message):
    data = message["content"].get("data", {})
    return message["msg_type"] == "comm_msg" and data.get("content", {}).get("number") == 4


@pytest.mark.ros
def test_a_browser_gets_frames_while_a_cell_runs_and_the_kernel_ends_in_peace(kernel):
    run(kernel, WITH_A_BROWSER)
    run(kernel, NODES)
    model = shown(run(kernel, "ros.panel()"))[VIEW]["model_id"]
    content = {"comm_id": model, "data": {"method": "custom", "content": {"do": "open"}}}
    kernel.kc.shell_channel.send(kernel.kc.session.msg("comm_msg", content))
    asked = kernel.execute_cell_input("ros.wait(1)")
    sent = [m["content"]["data"]["content"] for m in until(kernel, is_fourth_frame)
            if m["msg_type"] == "comm_msg"]  # fmt: skip
    frames = [one for one in sent if "number" in one]
    assert [frame["number"] for frame in frames] == [1, 2, 3, 4]
    assert frames[0]["whole"]
    kernel.await_reply(asked, 60)
    assert kernel.leave() == 0
    assert kernel.last_words() == ""

"""The panel in a real kernel, with no browser or with a make-believe one."""

import time
from queue import Empty

import pytest

from notebooks.kernel import WatchedKernel

pytestmark = pytest.mark.ros

VIEW = "application/vnd.jupyter.widget-view+json"
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
    (one,) = (m["content"]["data"] for m in messages if m["msg_type"] == "display_data")
    return one


def test_while_pages_are_built_it_is_the_same_picture_each_time(kernel):
    run(kernel, NODES)
    first, second = (run(kernel, "ros.panel()") for _ in range(2))
    assert shown(first) == shown(second)
    assert set(shown(first)) == {"text/html", "text/plain"}
    assert "/sensor" in shown(first)["text/plain"]
    assert {m["msg_type"] for m in first} == {"status", "execute_input", "display_data"}


def test_a_browser_gets_frames_while_a_cell_runs_and_the_kernel_ends_in_peace(kernel):
    run(kernel, WITH_A_BROWSER)
    run(kernel, NODES)
    model = shown(run(kernel, "ros.panel()"))[VIEW]["model_id"]
    content = {"comm_id": model, "data": {"method": "custom", "content": {"do": "open"}}}
    kernel.kc.shell_channel.send(kernel.kc.session.msg("comm_msg", content))
    asked = kernel.execute_cell_input("ros.wait(1)")
    frames = [m["content"]["data"]["content"] for m in until(kernel, is_fourth_frame)
              if m["msg_type"] == "comm_msg"]  # fmt: skip
    assert [frame["number"] for frame in frames] == [1, 2, 3, 4]
    assert frames[0]["whole"]
    kernel.await_reply(asked, 60)
    assert kernel.leave() == 0
    assert kernel.last_words() == ""


def is_fourth_frame(message):
    data = message["content"].get("data", {})
    return message["msg_type"] == "comm_msg" and data.get("content", {}).get("number") == 4

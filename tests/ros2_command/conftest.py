"""The command with and without nodes to talk to."""

import sys
import time
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
# The command need not be installed to be tested.
sys.path[:0] = [str(HERE.parents[1] / "src" / "ros2_command"), str(HERE)]

from as_typed import Ros2, demo_node, own_graph  # noqa: E402
from forking import Forks  # noqa: E402
from launch_package import Demo, running_in  # noqa: E402


@pytest.fixture(scope="session")
def forks():
    with Forks(Ros2().environment) as forks:
        yield forks


@pytest.fixture(scope="session")
def ros2(forks):
    return Ros2(forks)


@pytest.fixture
def another_node():
    """Starts one more node: `with another_node(graph, name, topic, period):`."""
    return demo_node


# Nodes that nobody asks any more would cost the other tests their time.


@pytest.fixture(scope="module")
def graph(forks):
    """In a domain where `/one` publishes on `/temperature`, and `/ns_two` on `/slow`."""
    nodes = (("one", "temperature", 0.05), ("ns_two", "slow", 1.0))
    with own_graph(*nodes, forks=forks) as graph:
        yield graph


@pytest.fixture(scope="module")
def rich(forks):
    """In a domain with `rich_node.py` alone."""
    with own_graph((), file="rich_node.py", forks=forks) as graph:
        yield graph


@pytest.fixture
def demo(ros2, tmp_path, monkeypatch):
    """The package `demo`; at the end none of its programs runs."""
    made = Demo(tmp_path / "prefix")
    monkeypatch.setitem(ros2.environment, "AMENT_PREFIX_PATH", str(made.prefix))
    monkeypatch.setitem(ros2.environment, "ROS_LOG_DIR", str(tmp_path / "log"))
    yield made
    deadline = time.monotonic() + 10
    while (left := running_in(made.prefix)) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not left


@pytest.fixture(scope="module")
def latched(forks):
    """In a domain where a node has published one reliable message that it stores, and no more."""
    node = ("strong", "/latched", "reliable")
    with own_graph(node, file="latched_node.py", forks=forks) as graph:
        yield graph

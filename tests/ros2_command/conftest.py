"""The command with and without nodes to talk to."""

import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
# The command need not be installed to be tested.
sys.path[:0] = [str(HERE.parents[1] / "src" / "ros2_command"), str(HERE)]

from as_typed import Ros2, demo_node, own_graph  # noqa: E402


@pytest.fixture(scope="session")
def ros2():
    return Ros2()


@pytest.fixture
def another_node():
    """Starts one more node: `with another_node(graph, name, topic, period):`."""
    return demo_node


@pytest.fixture(scope="session")
def graph():
    """In a domain where `/one` publishes on `/temperature`, and `/ns_two` on `/slow`."""
    with own_graph(("one", "temperature", 0.05), ("ns_two", "slow", 1.0)) as graph:
        yield graph


@pytest.fixture(scope="session")
def rich():
    """In a domain with `rich_node.py` alone."""
    with own_graph((), file="rich_node.py") as graph:
        yield graph

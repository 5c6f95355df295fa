"""The pytest plugin: the examples of docs/testing.md run as they stand, and what can go wrong."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from std_msgs.msg import Float32, Int32

from nodes import Listener
from rosbeat.errors import DurationError, SessionError
from rosbeat.testing import TestSession

pytestmark = pytest.mark.ros

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = re.findall(
    r"(?ms)^```python\n(.*?)^```", (ROOT / "docs" / "testing.md").read_text("utf-8")
)
FINISHED = ROOT / "solutions" / "sensor_simulator" / "sensor_simulator"


@pytest.fixture
def ros():
    with TestSession() as session:
        yield session


def test_the_examples_pass_in_a_folder_that_has_nothing_else(tmp_path):
    """The plugin is found by its entry point, not by a conftest of ours."""
    for number, example in enumerate(EXAMPLES):
        (tmp_path / f"test_example_{number}.py").write_text(example, "utf-8")
    node = (FINISHED / "temperature_subscriber.py").read_text("utf-8")
    (tmp_path / "monitor.py").write_text(node, "utf-8")
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}
    options = ["-q", "-p", "no:cacheprovider", "-W", "error", "-W", "ignore::DeprecationWarning"]
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", *options, tmp_path],
        capture_output=True, text=True, env=environment, cwd=tmp_path, timeout=100,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "7 passed" in ran.stdout


def test_a_message_comes_at_its_time(ros):
    listener = ros.add(Listener)
    ros.publish("count", 30, at=1.5)
    ros.publish("/count", Int32(data=20), at=0.5)
    ros.run(1)
    assert listener.heard == [20]
    ros.run(1)
    assert listener.heard == [20, 30]
    assert listener.times == [500_000_000, 1_500_000_000]


def test_a_message_of_any_type_needs_no_subscription(ros):
    ros.publish("warmth", Float32(data=3.0))
    ros.run(0)
    assert [sample.value for sample in ros.messages("warmth")] == [3.0]


@pytest.mark.parametrize(
    ("arguments", "options", "error", "words"),
    [
        (("nowhere", 1), {}, SessionError, "No node subscribes to /nowhere"),
        (("count", "warm"), {}, SessionError, "does not fit into std_msgs/msg/Int32"),
        (("count", {"value": 1}), {}, SessionError, "does not fit"),
        (("count", 1), {"at": 0.5}, SessionError, "has passed: it is 1 s"),
        (("count", 1), {"at": -1}, DurationError, "negative"),
        ((7, 1.0), {}, SessionError, "a name is a string"),
    ],
)
def test_what_cannot_be_published_is_explained(ros, says, arguments, options, error, words):
    ros.add(Listener)
    ros.run(1)
    with pytest.raises(error) as raised:
        ros.publish(*arguments, **options)
    says(raised.value, words)

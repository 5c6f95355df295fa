"""The C part of message types, loaded ahead."""

import subprocess
import sys

import pytest

from rosbeat.errors import RosbeatError
from rosbeat.ros.recording import load_type_support

pytestmark = pytest.mark.ros


def test_a_type_is_ready_after_it_and_not_before():
    program = (
        "from std_msgs.msg import Float32, String\n"
        "from rosbeat.ros.recording import load_type_support\n"
        "ready = lambda one: type(one)._TYPE_SUPPORT is not None\n"
        "before = ready(Float32)\nload_type_support(['std_msgs/msg/Float32'])\n"
        "print(before, ready(Float32), ready(String))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout == "False True False\n"


def test_twice_is_as_good_as_once():
    load_type_support(["std_msgs/msg/String", "std_msgs/msg/String"])
    load_type_support([])


def test_a_type_that_is_not_there_is_an_error():
    with pytest.raises((RosbeatError, ImportError, AttributeError, ValueError)):
        load_type_support(["std_msgs/msg/Nothing"])

import subprocess
import sys

import pytest

import rosbeat.bags


def test_every_public_name_is_there():
    assert sorted(dir(rosbeat.bags)) == sorted(rosbeat.bags.__all__)
    for name in rosbeat.bags.__all__:
        assert getattr(rosbeat.bags, name).__doc__


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'rewind'"):
        _ = rosbeat.bags.rewind


def test_only_replay_needs_ros():
    code = (
        "import sys; from rosbeat.bags import Bag, compare, inject, record, stuck; "
        "assert 'rclpy' not in sys.modules; from rosbeat.bags import replay; "
        "assert 'rclpy' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=100)

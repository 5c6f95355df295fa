"""Each test has a ROS of its own, which nobody else hears."""

import pytest
import rclpy


@pytest.fixture
def ros():
    """Start ROS, and shut it down whatever the test does."""
    rclpy.init()
    yield
    rclpy.try_shutdown()

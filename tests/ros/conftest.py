"""Each test owns its sessions."""

import pytest
import rclpy

from session_fixtures import empty_domain, eventually, ros, says, slept

__all__ = ["empty_domain", "eventually", "ros", "says", "slept"]


@pytest.fixture(autouse=True)
def _nothing_left_open():
    """A session or context that a test leaves open would be the next test's."""
    yield
    assert not rclpy.ok()

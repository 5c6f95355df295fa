"""rclpy's own wait set, asked for what cannot be taken directly; see also `test_virtual_time`."""

from rosbeat.ros.wait_set import WaitSetExecutor


def test_an_executor_whose_making_was_interrupted_goes_quietly():
    WaitSetExecutor.__new__(WaitSetExecutor).__del__()

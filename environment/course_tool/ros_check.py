"""Run by the Python of `.venv`: one node hears another, and what ROS it was, as a line of JSON."""

# rclpy carries only part of its types.
# mypy: disable-error-code="import-untyped,attr-defined,no-untyped-call"

from __future__ import annotations

import json
import os
import sys
import time
from importlib.metadata import version

DEADLINE = 20.0


def facts() -> dict[str, object]:
    """Return what a node of this environment sees."""
    import rclpy
    from rclpy.utilities import get_rmw_implementation_identifier

    return {
        "python": sys.version.split()[0],
        "rclpy": version("ros-rclpy"),
        "rclpy_file": rclpy.__file__,
        "rmw": get_rmw_implementation_identifier(),
        "environ": {
            name: value
            for name, value in os.environ.items()
            if name.startswith(("ROS_", "RMW_", "AMENT_", "FASTRTPS_", "FASTDDS_"))
        },
        "milliseconds": hear(),
    }


def hear() -> float | None:
    """Return how long it took until a subscriber had a message, or None if it never came."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from std_msgs.msg import String

    started = time.monotonic()
    heard: list[str] = []
    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node("rosbeat_first_sound", context=context)
    publisher = node.create_publisher(String, "rosbeat_first_sound", 10)
    node.create_subscription(String, "rosbeat_first_sound", lambda m: heard.append(m.data), 10)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    while not heard and time.monotonic() < started + DEADLINE:
        publisher.publish(String(data="thump"))
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)
    return round(1000 * (time.monotonic() - started), 1) if heard else None


if __name__ == "__main__":
    print(json.dumps(facts()))

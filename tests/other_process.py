"""Nodes in a process of their own, as a terminal runs them."""

import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

from rosbeat import environment

# It announces itself often, so that it is found at once and not after up to three seconds.
PROFILE = (
    Path(__file__).parents[1] / "src" / "ros2_command" / "ros2_command" / "data" / "fastdds.xml"
)

PROGRAM = """
import rosbeat, rclpy, sys
from functools import partial
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from nodes import *

rclpy.init()
executor = SingleThreadedExecutor()
for node in ({nodes}):
    executor.add_node(node)
print("ready", flush=True)
try:
    executor.spin()
except ExternalShutdownException:
    pass
"""


@contextmanager
def other_process(domain_id, nodes):
    """Run nodes, given as Python expressions with a comma after each, until the block ends."""
    environ = {**os.environ, "ROS_DOMAIN_ID": str(domain_id)}
    environ[environment.profile_variable()] = str(PROFILE)
    environ["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM.format(nodes=nodes)], env=environ, stdout=subprocess.PIPE,
        text=True,
    )  # fmt: skip
    with process:
        try:
            assert process.stdout.readline() == "ready\n"
            yield process
        finally:
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()

"""Report what a robot in this domain does, as lines of JSON: the program behind the live view.

`python -m rosbeat.ros.robot_reporter rosie` runs in a process of its own, so that no code and no
session of the kernel holds it up, and it ends when its input does. It prints a frame ten times a
second:

| field | value |
|---|---|
| `pose` | x and y in meters, theta in radians; null while nothing is heard |
| `scan` | angle in radians and range in meters of each ray that met something |
| `map` | columns, a cell's side and the lower left corner in meters, data; only when new |
| `temperature`, `lamp` | the last value; null as long as there is none |

Each line of its input is a command, a list of JSON: how fast the robot is to drive ahead, in meters
a second, and to turn to the left, in radians a second.
"""

from __future__ import annotations

import json
import sys
import time
from math import isfinite
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any

import rclpy
from geometry_msgs.msg import Pose2D, Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool, Float32

from rosbeat.ros.graph import HiddenNode

#: Seconds from one frame to the next; and after which a robot that says nothing is gone.
_PERIOD, _SILENCE = 0.1, 2.0
_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class RobotReporter(HiddenNode):
    """Remember what a robot said last, and pass commands on.

    Args:
        context: The context whose domain the robot is in.
        name: Below which the robot's topics are, such as `rosie`.
    """

    def __init__(self, context: Context, name: str) -> None:
        super().__init__(context)
        self._pose: list[float] | None = None
        self._scan: list[tuple[float, float]] = []
        self._map: dict[str, Any] | None = None
        self._temperature: float | None = None
        self._lamp: bool | None = None
        self._heard_at = 0.0
        base = f"/{name.strip('/')}"
        self.create_subscription(Pose2D, f"{base}/pose", self._hear_pose, 10)
        self.create_subscription(LaserScan, f"{base}/scan", self._hear_scan, 10)
        self.create_subscription(OccupancyGrid, f"{base}/map", self._hear_map, _LATCHED)
        self.create_subscription(Float32, f"{base}/temperature", self._hear_temperature, 10)
        self.create_subscription(Bool, f"{base}/lamp", self._hear_lamp, _LATCHED)
        self._commands = self.create_publisher(Twist, f"{base}/cmd_vel", 10)

    def frame(self) -> dict[str, Any]:
        """Return what is known now; the map only once."""
        if time.monotonic() - self._heard_at > _SILENCE:
            self._pose, self._scan = None, []
        known: dict[str, Any] = {
            "pose": self._pose,
            "scan": self._scan,
            "temperature": self._temperature,
            "lamp": self._lamp,
        }
        if self._map is not None:
            known["map"], self._map = self._map, None
        return known

    def command(self, ahead: float, turn: float) -> None:
        """Tell the robot how fast to drive and to turn."""
        told = Twist()
        told.linear.x, told.angular.z = float(ahead), float(turn)
        self._commands.publish(told)

    def _hear_pose(self, told: Pose2D) -> None:
        self._pose, self._heard_at = [told.x, told.y, told.theta], time.monotonic()

    def _hear_scan(self, told: LaserScan) -> None:
        self._scan = [
            (told.angle_min + rank * told.angle_increment, length)
            for rank, length in enumerate(told.ranges)
            if isfinite(length) and told.range_min <= length < told.range_max
        ]

    def _hear_map(self, told: OccupancyGrid) -> None:
        info, corner = told.info, told.info.origin.position
        self._map = {
            "width": info.width,
            "side": info.resolution,
            "corner": [corner.x, corner.y],
            "data": list(told.data),
        }

    def _hear_temperature(self, told: Float32) -> None:
        self._temperature = told.data if isfinite(told.data) else None

    def _hear_lamp(self, told: Bool) -> None:
        self._lamp = told.data


def _read(commands: SimpleQueue[str | None]) -> None:
    for line in sys.stdin:
        commands.put(line)
    commands.put(None)


def _is_told(commands: SimpleQueue[str | None], reporter: RobotReporter) -> bool:
    """Pass on the commands that have come; return whether more can."""
    while True:
        try:
            line = commands.get_nowait()
        except Empty:
            return True
        if line is None:
            return False
        ahead, turn = json.loads(line)
        reporter.command(ahead, turn)


def main() -> None:
    """Report until the input ends."""
    commands: SimpleQueue[str | None] = SimpleQueue()
    Thread(target=_read, args=(commands,), daemon=True).start()
    context = Context()
    rclpy.init(args=[], context=context)
    reporter = RobotReporter(context, sys.argv[1])
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(reporter)
    due = time.monotonic()
    try:
        while _is_told(commands, reporter):
            due += _PERIOD
            while (left := due - time.monotonic()) > 0:
                executor.spin_once(timeout_sec=left)
            print(json.dumps(reporter.frame()), flush=True)
    except (KeyboardInterrupt, BrokenPipeError):
        pass  # the kernel is interrupted or gone
    finally:
        executor.shutdown()
        rclpy.try_shutdown(context=context)


if __name__ == "__main__":
    main()

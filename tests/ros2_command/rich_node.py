"""A node for the tests of `ros2` that offers what `demo_node.py` does not.

It has a service that tells of its calls, an action, parameters with limits, a stamped topic, a
hidden one, and a `/clock` that is ten times as fast as the wall's. Says `ready` when it is there,
and ends when its standard input does.
"""

import sys
import threading
import time

import rclpy
from geometry_msgs.msg import PointStamped
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Int32, String
from std_srvs.srv import SetBool
from test_msgs.action import Fibonacci
from test_msgs.msg import BoundedSequences


class Rich(Node):
    def __init__(self) -> None:
        super().__init__("rich", namespace="house")
        limits = FloatingPointRange(from_value=0.0, to_value=100.0, step=0.5)
        self.declare_parameter("count", 3)
        self.declare_parameter("names", ["a", "b"])
        self.declare_parameter(
            "limit", 30.0,
            ParameterDescriptor(
                description="upper limit", floating_point_range=[limits],
                additional_constraints="above low",
            ),
        )  # fmt: skip
        self.declare_parameter("fixed", "x", ParameterDescriptor(read_only=True))
        self.declare_parameter(
            "spare", value=7, descriptor=ParameterDescriptor(dynamic_typing=True)
        )
        self.declare_parameter("maybe", Parameter.Type.INTEGER)
        self.server = self.create_service(SetBool, "enable", self.enable)
        self.server.configure_introspection(
            self.get_clock(), qos_profile_system_default, ServiceIntrospectionState.CONTENTS
        )
        self.points = self.create_publisher(PointStamped, "point", 10)
        self.numbers = self.create_publisher(Int32, "number", 10)
        self.bounded = self.create_publisher(BoundedSequences, "bounded", 10)
        self.hidden = self.create_publisher(String, "_hidden", 10)
        self.clock_publisher = self.create_publisher(Clock, "/clock", 10)
        self.number, self.began = 0, time.monotonic()
        self.timer = self.create_timer(0.05, self.publish)
        self.action = ActionServer(
            self, Fibonacci, "fibonacci", self.execute,
            goal_callback=self.judge, cancel_callback=lambda handle: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )  # fmt: skip

    def publish(self) -> None:
        point = PointStamped()
        point.header.stamp = self.get_clock().now().to_msg()
        self.points.publish(point)
        self.number += 1
        self.numbers.publish(Int32(data=self.number))
        self.bounded.publish(BoundedSequences())
        now = Clock()
        nanoseconds = int((time.monotonic() - self.began) * 1e10)
        now.clock.sec, now.clock.nanosec = divmod(nanoseconds, 1_000_000_000)
        self.clock_publisher.publish(now)

    def enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success, response.message = request.data, "on"
        return response

    def judge(self, goal: Fibonacci.Goal) -> GoalResponse:
        return GoalResponse.ACCEPT if goal.order >= 0 else GoalResponse.REJECT

    def execute(self, handle) -> Fibonacci.Result:
        sequence = [0, 1]
        while len(sequence) <= handle.request.order:
            if handle.is_cancel_requested:
                handle.canceled()
                return Fibonacci.Result(sequence=sequence)
            sequence.append(sequence[-1] + sequence[-2])
            handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(0.1)
        handle.succeed()
        return Fibonacci.Result(sequence=sequence)


def main() -> None:
    rclpy.init()
    node = Rich()
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)
    ended = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), ended.set()), daemon=True).start()
    print("ready", flush=True)
    while not ended.is_set():
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()

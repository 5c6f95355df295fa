"""A node for the tests of `ros2`: name, topic, and seconds between messages as arguments.

With 0 seconds it is in the graph and does nothing, not even answer. Says `ready` when it is there,
and ends when its standard input does.
"""

import sys
import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32
from std_srvs.srv import SetBool


class Demo(Node):
    def __init__(self, name: str, topic: str, period: float) -> None:
        super().__init__(name)
        self.declare_parameter("rate", 3)
        self.declare_parameter("limits.max", 30.0)
        self.publisher = self.create_publisher(Float32, topic, 10)
        self.subscription = self.create_subscription(Float32, f"{name}/in", self.hear, 10)
        self.service = self.create_service(SetBool, "~/enable", self.enable)
        self.timer = self.create_timer(period or 1.0, self.publish)

    def publish(self) -> None:
        self.publisher.publish(Float32(data=25.5))

    def hear(self, msg: Float32) -> None:  # `print` itself has no signature in Python 3.10
        print(msg)

    def enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success, response.message = request.data, "on"
        return response


def main() -> None:
    name, topic, period = sys.argv[1:4]
    rclpy.init()
    node = Demo(name, topic, float(period))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    ended = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), ended.set()), daemon=True).start()
    print("ready", flush=True)
    if not float(period):
        ended.wait()
    while not ended.is_set():
        executor.spin_once(timeout_sec=0.1)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()

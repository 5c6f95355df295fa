"""Two nodes in a multi-threaded executor."""

import time

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Talker(Node):
    def __init__(self, name, seconds):
        super().__init__(name)
        self.seconds = seconds
        self.create_timer(1.0, self.tell)
        self.get_logger().info("Started")

    def tell(self):
        self.get_logger().info("begins")
        time.sleep(self.seconds)
        self.get_logger().info("ends")


def main(args=None):
    rclpy.init(args=args)
    node_a, node_b = Talker("a", 0.3), Talker("b", 0.45)
    executor = MultiThreadedExecutor()
    executor.add_node(node_a)
    executor.add_node(node_b)
    try:
        executor.spin()
    finally:
        print("finally", flush=True)
        executor.shutdown()
        node_a.destroy_node()
        node_b.destroy_node()


if __name__ == "__main__":
    main()

"""A program whose callback calls sys.exit in a thread of a multi-threaded executor."""

import sys

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Exiting(Node):
    def __init__(self):
        super().__init__("exiting")
        self.create_timer(0.4, self.leave)
        self.get_logger().info("Started")

    def leave(self):
        self.get_logger().info("leaves")
        sys.exit(3)


def main(args=None):
    rclpy.init(args=args)
    node = Exiting()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    try:
        executor.spin()
    finally:
        print("finally", flush=True)


if __name__ == "__main__":
    main()

"""A program whose callback calls sys.exit."""

import sys

import rclpy
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
    try:
        rclpy.spin(node)
    finally:
        print("finally", flush=True)
        node.destroy_node()
        rclpy.shutdown()


if __name__ == "__main__":
    main()

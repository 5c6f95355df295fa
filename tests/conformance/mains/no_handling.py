"""A program that handles nothing."""

import rclpy
from rclpy.node import Node


class Beat(Node):
    def __init__(self):
        super().__init__("beat")
        self.create_timer(0.4, lambda: self.get_logger().info("beat"))
        self.get_logger().info("Started")


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Beat())


if __name__ == "__main__":
    main()

"""A program that has a class, and all the rest behind `if __name__ == "__main__"`."""

import sys

import rclpy
from rclpy.node import Node


class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.count = 0
        self.create_timer(0.4, self.tell)
        self.get_logger().info("Started")

    def tell(self):
        self.count += 1
        self.get_logger().info(f"line {self.count}")
        if self.count == 4:
            raise RuntimeError("four is too many")


if __name__ == "__main__":
    rclpy.init(args=sys.argv)
    rclpy.spin(Counter())

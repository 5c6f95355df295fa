"""Lets `with` shut ROS down, as Kilted's tutorials do; in Jazzy that is a TypeError."""

import sys

import rclpy
from rclpy.node import Node


class Beat(Node):
    def __init__(self):
        super().__init__("beat")
        self.create_timer(0.4, self.beat)
        self.get_logger().info("Started")

    def beat(self):
        self.get_logger().info("beat")
        if "--shut-down" in sys.argv:
            rclpy.shutdown()


def main(args=None):
    try:
        with rclpy.init(args=args):
            rclpy.spin(Beat())
            print("spin has returned", flush=True)
    finally:
        print(rclpy.ok(), flush=True)


if __name__ == "__main__":
    main()

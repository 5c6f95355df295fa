"""A program that is asleep in a callback when the signal comes."""

import time

import rclpy
from rclpy.node import Node


class Sleeper(Node):
    def __init__(self):
        super().__init__("sleeper")
        self.create_timer(0.3, self.sleep)
        self.get_logger().info("Started")

    def sleep(self):
        self.get_logger().info("begins")
        time.sleep(2.0)
        self.get_logger().info("ends")


def main(args=None):
    rclpy.init(args=args)
    node = Sleeper()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""A program that tells rclpy which signals to handle."""

import sys
import time

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions


class Beat(Node):
    def __init__(self):
        super().__init__("beat")
        self.create_timer(0.4, lambda: self.get_logger().info("beat"))
        self.get_logger().info("Started")


def main():
    rclpy.init(signal_handler_options=getattr(SignalHandlerOptions, sys.argv[1]))
    try:
        rclpy.spin(Beat())
    except KeyboardInterrupt:
        time.sleep(0.2)  # a thread of rclpy's may still be shutting the context down
        print("interrupted", rclpy.ok(), flush=True)
        raise


if __name__ == "__main__":
    main()

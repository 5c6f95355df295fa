"""A program whose own signal handler sleeps, and then shuts ROS down."""

import signal
import time

import rclpy
from rclpy.node import Node


class Beat(Node):
    def __init__(self):
        super().__init__("beat")
        self.create_timer(0.4, lambda: self.get_logger().info("beat"))
        signal.signal(signal.SIGTERM, self.leave)
        self.get_logger().info("Started")

    def leave(self, number, frame):
        self.get_logger().info(f"signal {number}")
        time.sleep(0.6)
        self.get_logger().info("leaves")
        rclpy.shutdown()


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Beat())
    print("spun", flush=True)
    return 4


if __name__ == "__main__":
    main()

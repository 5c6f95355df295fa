"""The tutorial's publisher with `try_shutdown`."""

import rclpy
from rclpy.node import Node


class Beat(Node):
    def __init__(self):
        super().__init__("beat")
        self.create_timer(0.4, lambda: self.get_logger().info("beat"))
        self.get_logger().info("Started")


def main(args=None):
    rclpy.init(args=args)
    node = Beat()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
        print("finally", flush=True)


if __name__ == "__main__":
    main()

"""Catches both exceptions with which a spin ends, and says which it was."""

import rclpy
from rclpy.executors import ExternalShutdownException
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
        print("spin has returned", flush=True)
    except (KeyboardInterrupt, ExternalShutdownException) as error:
        print(type(error).__name__, flush=True)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""A node and a module that log at each level."""

import rclpy
import rclpy.logging
from rclpy.node import Node


class Talkative(Node):
    def __init__(self):
        super().__init__("talkative")
        self.create_timer(0.4, self.tell)
        self.get_logger().info("Started")

    def tell(self):
        for logger in (self.get_logger(), rclpy.logging.get_logger("module")):
            logger.debug("debug")
            logger.info("info")
            logger.warning("warning")


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Talkative())


if __name__ == "__main__":
    main()

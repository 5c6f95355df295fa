"""A program whose callback raises."""

import rclpy
from rclpy.node import Node


class Raising(Node):
    def __init__(self):
        super().__init__("raising")
        self.create_timer(0.4, self.tell)
        self.count = 0
        self.get_logger().info("Started")

    def tell(self):
        self.count += 1
        self.get_logger().info(f"count {self.count}")
        if self.count == 2:
            raise ValueError("two is too many")


def main(args=None):
    rclpy.init(args=args)
    node = Raising()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()

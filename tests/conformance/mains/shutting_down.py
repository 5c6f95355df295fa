"""A callback that ends the program by shutting ROS down."""

import rclpy
from rclpy.node import Node


class Ending(Node):
    def __init__(self):
        super().__init__("ending")
        self.create_timer(0.7, self.end)
        self.get_logger().info("Started")

    def end(self):
        self.get_logger().info("shuts down")
        rclpy.shutdown()


def main(args=None):
    rclpy.init(args=args)
    node = Ending()
    rclpy.spin(node)
    print("spin has returned", flush=True)
    node.destroy_node()


if __name__ == "__main__":
    main()

"""A loop around spin_once, as long as ROS is up."""

import rclpy
from rclpy.node import Node


def main(args=None):
    rclpy.init(args=args)
    node = Node("looped")
    node.get_logger().info("Started")
    node.create_timer(0.4, lambda: node.get_logger().info("beat"))
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)
    print("the loop has ended", flush=True)
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

"""A node that offers no parameters: its name as argument. Ends when its standard input does."""

import sys

import rclpy
from rclpy.node import Node


def main() -> None:
    rclpy.init()
    node = Node(sys.argv[1], start_parameter_services=False)
    print("ready", flush=True)
    sys.stdin.read()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()

"""A program that ends with the exit code that it is told."""

import sys

import rclpy


def main():
    rclpy.init()
    rclpy.create_node("exiting").get_logger().info("Started")
    sys.exit(int(sys.argv[1]))


if __name__ == "__main__":
    main()

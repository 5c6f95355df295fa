"""A loop that publishes and sleeps, and never spins."""

import time

import rclpy
from std_msgs.msg import Int32


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("sleepy")
    publisher = node.create_publisher(Int32, "number", 10)
    node.get_logger().info("Started")
    number = 0
    while rclpy.ok():
        publisher.publish(Int32(data=number))
        node.get_logger().info(f"published {number}")
        number += 1
        time.sleep(0.5)
    print("the loop has ended", flush=True)


if __name__ == "__main__":
    main()

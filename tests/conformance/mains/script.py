"""A program without a function `main`, as many are: it runs from top to bottom."""

import rclpy
from rclpy.node import Node

rclpy.init()
node = Node("script")
logger = node.get_logger()
count = 0


def tell():
    global count
    count += 1
    logger.info(f"line {count}")


logger.info("Started")
timer = node.create_timer(0.4, tell)
while rclpy.ok() and count < 3:
    rclpy.spin_once(node)
print("counted to", count, flush=True)
node.destroy_node()
rclpy.shutdown()

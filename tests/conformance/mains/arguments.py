"""A node that shows what its arguments have made of it."""

import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32


class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.declare_parameter("limit", 1.5)
        self.declare_parameter("unit", "C")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(0.4, self.tell)
        self.get_logger().info("Started")

    def tell(self):
        limit, unit = (self.get_parameter(name).value for name in ("limit", "unit"))
        self.get_logger().info(f"{self.get_name()} {self.publisher.topic_name} {limit!r} {unit!r}")


def main(args=None):
    rclpy.init(args=args)
    node = Sensor()
    node.get_logger().info(f"left {rclpy.utilities.remove_ros_args(sys.argv)[1:]}")
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()

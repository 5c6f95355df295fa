"""Publishes once more after `rclpy.shutdown()`, which no publisher survives."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32


class Beat(Node):
    def __init__(self):
        super().__init__("beat")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(0.4, self.beat)
        self.get_logger().info("Started")

    def beat(self):
        self.publisher.publish(Float32())
        rclpy.shutdown()


def main(args=None):
    rclpy.init(args=args)
    node = Beat()
    rclpy.spin(node)
    print("spin has returned", flush=True)
    node.publisher.publish(Float32())


if __name__ == "__main__":
    main()

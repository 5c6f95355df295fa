"""A node that wants to stop its robot at the end, when its context has been shut down."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Stopping(Node):
    def __init__(self):
        super().__init__("stopping")
        self.publisher = self.create_publisher(Int32, "speed", 10)
        self.create_timer(0.4, self.drive)
        self.get_logger().info("Started")

    def drive(self):
        self.publisher.publish(Int32(data=5))
        self.get_logger().info("drives")


def main(args=None):
    rclpy.init(args=args)
    node = Stopping()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("stops", flush=True)
        node.publisher.publish(Int32(data=0))
        print("has stopped", flush=True)


if __name__ == "__main__":
    main()

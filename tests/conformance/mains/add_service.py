"""The service of the official tutorial."""

import rclpy
from rclpy.node import Node
from test_msgs.srv import BasicTypes


class MinimalService(Node):
    def __init__(self):
        super().__init__("minimal_service")
        self.srv = self.create_service(BasicTypes, "add_two_ints", self.add_two_ints_callback)
        self.get_logger().info("Ready")

    def add_two_ints_callback(self, request, response):
        response.int64_value = request.int32_value + request.int64_value
        self.get_logger().info(
            "Incoming request\na: %d b: %d" % (request.int32_value, request.int64_value)
        )
        return response


def main():
    rclpy.init()

    minimal_service = MinimalService()

    rclpy.spin(minimal_service)

    rclpy.shutdown()


if __name__ == "__main__":
    main()

"""A client that shuts ROS down when it has its answer, as that of the official action tutorial."""

import rclpy
from rclpy.node import Node
from test_msgs.srv import BasicTypes


class ClosingClient(Node):
    def __init__(self):
        super().__init__("closing_client")
        self.client = self.create_client(BasicTypes, "add_two_ints")
        self.get_logger().info("Started")

    def ask(self):
        self.client.wait_for_service()
        future = self.client.call_async(BasicTypes.Request(int32_value=2, int64_value=3))
        future.add_done_callback(self.answered)

    def answered(self, future):
        self.get_logger().info(f"sum {future.result().int64_value}")
        rclpy.shutdown()


def main(args=None):
    rclpy.init(args=args)
    client = ClosingClient()
    client.ask()
    rclpy.spin(client)
    print("finally", flush=True)


if __name__ == "__main__":
    main()

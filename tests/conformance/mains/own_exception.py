"""A program whose callback raises what `except Exception` does not catch."""

import rclpy
from rclpy.node import Node


class Stop(BaseException):
    pass


class Raising(Node):
    def __init__(self):
        super().__init__("raising")
        self.create_timer(0.4, self.stop)
        self.get_logger().info("Started")

    def stop(self):
        raise Stop("enough")


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(Raising())
    finally:
        print("finally", flush=True)


if __name__ == "__main__":
    main()

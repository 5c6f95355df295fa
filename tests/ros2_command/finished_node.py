"""A node that SIGTERM ends as Ctrl+C does, for tests of signals.

Publishes on `temperature` each tenth of a second, and says so.
"""

import signal

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float32


class TemperatureSensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(0.1, self.publish_temperature)

    def publish_temperature(self):
        self.publisher.publish(Float32(data=22.0))
        print("published", flush=True)


def main(args=None):
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    rclpy.init(args=args)
    node = TemperatureSensor()
    try:  # noqa: SIM105 - as a learner writes it
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()

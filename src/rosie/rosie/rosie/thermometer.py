"""Measure how warm it is where Rosie stands."""

import random

from geometry_msgs.msg import Pose2D
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float32

from rosie import greenhouse


class Thermometer(Node):
    """Publish the temperature at the place that Rosie's wheels report."""

    def __init__(self):
        super().__init__('thermometer', namespace='rosie')
        self.place = greenhouse.START[:2]
        self.publisher = self.create_publisher(Float32, 'temperature', 10)
        self.create_subscription(Pose2D, 'pose', self.remember, 10)
        self.declare_parameter('period', 1.0, ParameterDescriptor(
            description='Seconds from one reading to the next.',
            floating_point_range=[FloatingPointRange(from_value=0.1, to_value=60.0)]))
        self.timer = self.create_timer(self.get_parameter('period').value, self.measure)
        self.add_post_set_parameters_callback(self.adopt)
        self.get_logger().info('Thermometer started')

    def remember(self, pose):
        """Remember where Rosie is."""
        self.place = (pose.x, pose.y)

    def measure(self):
        """Publish a reading, which is a little off each time, as that of any thermometer."""
        reading = greenhouse.temperature(*self.place) + random.gauss(0.0, 0.1)
        self.publisher.publish(Float32(data=round(reading, 2)))
        self.get_logger().info(f'Publishing: {reading:.2f}')

    def adopt(self, parameters):
        """Measure at another period from now on."""
        for parameter in parameters:
            if parameter.name == 'period':
                self.timer.timer_period_ns = round(parameter.value * 1e9)
                self.timer.reset()


def main(args=None):
    """Run the thermometer until somebody stops it."""
    rclpy.init(args=args)
    try:
        rclpy.spin(Thermometer())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()

"""Feel how warm this computer is, with a sensor that nearly every computer has."""

import os
from pathlib import Path
import random

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float32

#: Linux has a folder for each sensor here: its `type`, and its `temp` in thousandths of a degree.
FOLDER = '/sys/class/thermal'


class ComputerThermometer(Node):
    """Publish the temperature of this computer; simulate it where there is no sensor."""

    def __init__(self):
        super().__init__('computer_thermometer', namespace='rosie')
        self.publisher = self.create_publisher(Float32, 'computer_temperature', 10)
        folder = self.declare_parameter('folder', FOLDER).value
        self.sensor = find_sensor(Path(folder))
        if self.sensor is None:
            self.get_logger().info(
                f'Simulating: there is no sensor in {folder}, so this follows how busy it is')
        else:
            self.get_logger().info(f'Reading a real sensor: {kind(self.sensor)}, {self.sensor}')
        self.timer = self.create_timer(1.0, self.measure)

    def measure(self):
        """Publish a reading in degrees Celsius."""
        try:
            reading = simulated() if self.sensor is None else read(self.sensor)
        except (OSError, ValueError) as error:
            self.get_logger().warning(f'No reading this time: {error}')
            return
        self.publisher.publish(Float32(data=reading))
        self.get_logger().info(f'Publishing: {reading:.1f}')


def find_sensor(folder):
    """Return the folder of a sensor that can be read, of the processor's if there is one."""
    sensors = [path for path in sorted(folder.glob('thermal_zone*')) if is_readable(path)]
    named = [path for path in sensors if 'cpu' in kind(path) or 'pkg' in kind(path)]
    return next(iter(named + sensors), None)


def is_readable(sensor):
    """Return whether a sensor gives a number."""
    try:
        read(sensor)
    except (OSError, ValueError):
        return False
    return True


def read(sensor):
    """Return the temperature of a sensor in degrees Celsius."""
    return int((sensor / 'temp').read_text()) / 1000


def kind(sensor):
    """Return what a sensor says that it is."""
    try:
        return (sensor / 'type').read_text().strip()
    except OSError:
        return 'of an unknown kind'


def simulated():
    """Return a temperature that rises with the work of the last minute, from 40 to 70 degrees."""
    busy = os.getloadavg()[0] / (os.cpu_count() or 1)
    return 40 + 30 * min(1.0, busy) + random.gauss(0.0, 0.2)


def main(args=None):
    """Run the thermometer until somebody stops it."""
    rclpy.init(args=args)
    try:
        rclpy.spin(ComputerThermometer())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()

"""The complete listings of the tutorial as they stand, but for blanks at the ends of lines."""

PUBLISHER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32
import random


class TemperaturSensor(Node):
    def __init__(self):
        super().__init__('temperature_sensor')

        #Create publisher on "temperature" topic
        self.publisher_ = self.create_publisher(Float32,'temperature',10)

        #Set up time to publish every 1 second
        self.timer = self.create_timer(1.0,self.publish_temperature)

        #initial temperature
        self.temperature = 22.0

        self .get_logger().info("Temperature Sensor Node Started")

    def publish_temperature(self):
        #simulate temperature fluctuation
        self.temperature += random.uniform(-0.5,0.5)

        #keep temperature inrealistic range
        self.temperature =max(10.2,min(28.0,self.temperature))

        #create and publish message
        msg = Float32()
        msg.data = self.temperature

        self.publisher_.publish(msg)
        self.get_logger().info(f'Publishing: {self.temperature:.2f}C')

def main(args=None):
    rclpy.init(args=args)
    node = TemperaturSensor()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass

    node.destroy_node()
    rclpy.shutdown()

if __name__ == '__main__':
    main()
"""

SUBSCRIBER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

class TemperatureMonitor(Node):
    def __init__(self):
        super().__init__('temperature_monitor')

        #Create subscriber to 'temperature' topic
        self .subscription = self.create_subscription(
            Float32,
            'temperature',
            self.temperature_callback,
            10
        )

        self.get_logger().info('Temperature Monitor Node Started')


    def temperature_callback(self,msg):
        temp = msg.data

        #Simple alert system
        if temp > 26.0:
            status = "High"
        elif temp < 20.0:
            status = "Low"
        else:
            status= "Normal"


        self.get_logger().info(f'Temperature: {temp:.2f}C - Status:{status}')

def main(args=None):
    rclpy.init(args=args)
    node = TemperatureMonitor()

    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass

if __name__ == "__main__":
    main()
"""

SETUP = """\
from setuptools import find_packages, setup

package_name = 'sensor_simulator'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='janak',
    maintainer_email='janak.klal@gmail.com',
    description='TODO: Package description',
    license='TODO: License declaration',
    extras_require={
        'test': [
            'pytest',
        ],
    },
    entry_points={
    'console_scripts': [
        'temperature_publisher = sensor_simulator.temperature_publisher:main',
        'temperature_subscriber = sensor_simulator.temperature_subscriber:main',
    ],
},
)
"""

"""A session beside another one may use the same topic name for another type: it has its own domain.

In a process of its own, for what this is about would end the tests: see `fastdds.xml`.
"""

import subprocess
import sys

import pytest

pytestmark = pytest.mark.ros

PROGRAM = """
from rclpy.node import Node
from rosbeat import Session
from rosbeat.ros.scenario import observe
from std_msgs.msg import Float32, Float64, String

class Sensor(Node):
    kind, value = Float32, 21.5

    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(self.kind, "temperature", 10)
        self.heard = self.create_subscription(self.kind, "temperature", self.hear, 10)
        self.create_timer(1.0, self.tick)
        self.sum = 0

    def tick(self):
        self.publisher_.publish(self.kind(data=self.value))

    def hear(self, message):
        self.sum += message.data == self.value

class Wide(Sensor):
    kind = Float64

class Words(Sensor):
    kind, value = String, "x" * 10_000

first = Session()
sensor = first.add(Sensor)
first.run(10, quiet=True)
for other in (Wide, Words, Sensor, Wide):
    print(len(observe(other, 5).samples), end=" ")
with Session() as second:
    words = second.add(Words)
    second.run(5, quiet=True)
    first.run(5, quiet=True)
    print(words.sum, sensor.sum, len(first.messages("temperature")), end=" ")
first.close()
print("closed")
"""


def test_each_session_hears_its_own():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "5 5 5 5 5 15 15 closed\n"), done.stderr
    assert not done.stderr

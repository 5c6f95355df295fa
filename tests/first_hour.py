"""What beginners type in their first hour and get wrong, as cells of a page."""

IMPORTS = """\
import os
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, Int32, String
from rosbeat import Session, check, hint, predict, progress, quiz, viz, workspace
%load_ext rosbeat
ros = Session()
"""
_SENSOR = """\
class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.timer = self.create_timer(1.0, self.measure)

    def measure(self):
        self.publisher.publish(Float32(data=22.5))

ros.close()
ros = Session()
ros.add(Sensor)
ros.run(seconds=2)
"""
_NAME, _PUBLISHER = 'super().__init__("sensor")', 'Float32, "temperature", 10'
_TIMER, _PUBLISH = "1.0, self.measure)", "self.publisher.publish(Float32(data=22.5))"


def _sensor(old: str, new: str) -> str:
    assert old in _SENSOR
    return _SENSOR.replace(old, new)


def _published(value: str) -> str:
    return _sensor("Float32(data=22.5)", value)


#: A cell for each mistake, by a name.
CELLS = {
    # Typing.
    "a class that does not exist": "from rclpy.node import Nod",
    "a package that does not exist": "import rclpi",
    "small letters": "from std_msgs.msg import float32",
    "no colon": "class Sensor(Node)\n    pass",
    "a bracket left open": "print('hello'",
    "a quote left open": "print('hello)",
    "not indented": "class Sensor(Node):\ndef __init__(self):\n    pass",
    "indented too far": "x = 1\n  y = 2",
    "a name misspelled": "Sesion()",
    "a class of a cell that has not run": "ros.add(Thermometer)",
    "a text and a number": "'Temperature: ' + 22.5",
    "a decimal comma": "float('22,5')",
    "a list that is too short": "[1, 2, 3][3]",
    "a key that is missing": "{'a': 1}['b']",
    # Sessions.
    "a class in quotes": "ros.add('Sensor')",
    "nothing to add": "ros.add()",
    "no seconds": "ros.run()",
    "seconds in quotes": "ros.run('three')",
    "seconds below zero": "ros.run(seconds=-1)",
    "an argument of another name": "ros.run(second=3)",
    "a topic misspelled": "ros.messages('temprature')",
    "a method misspelled": "ros.mesages('temperature')",
    "a session that is closed": "old = Session()\nold.close()\nold.run(1)",
    "a node of another session": "a = Session()\nn = Node('n')\na.close()\nros.add(n)",
    "init on a page": "rclpy.init()",
    # Checks.
    "an exercise without its answer": "check('00a')",
    "the answer without its exercise": "check(Node)",
    "an exercise that does not exist": "check('00z', Node)",
    "an object for a class": "print(check('00a', 5))",
    "a hint for nothing": "hint('zz')",
    "a prediction without what happens": "predict('3')",
    "a prediction in words": "print(predict('many', 3))",
    "a letter that is no choice": "quiz('03', 'z')",
    "a page for progress": "progress('00')",
    # Nodes.
    "no call of the parent": _sensor(_NAME, "pass"),
    "no name": _sensor(_NAME, "super().__init__()"),
    "a space in the name": _sensor(_NAME, 'super().__init__("my sensor")'),
    "type and topic swapped": _sensor(_PUBLISHER, '"temperature", Float32, 10'),
    "a topic without quotes": _sensor(_PUBLISHER, "Float32, temperature, 10"),
    "no depth": _sensor(_PUBLISHER, 'Float32, "temperature"'),
    "the depth in quotes": _sensor(_PUBLISHER, 'Float32, "temperature", "10"'),
    "a space in the topic": _sensor(_PUBLISHER, 'Float32, "my topic", 10'),
    "period and method swapped": _sensor(_TIMER, "self.measure, 1.0)"),
    "a method that is called": _sensor(_TIMER, "1.0, self.measure())"),
    "a method misspelled in a node": _sensor(_TIMER, "1.0, self.measur)"),
    "a period of zero": _sensor(_TIMER, "0.0, self.measure)"),
    "no self": _sensor("def measure(self)", "def measure()"),
    "no self before an attribute": _sensor(_PUBLISH, "publisher.publish(Float32(data=22.5))"),
    "a number for a message": _published("22.5"),
    "a value without its field": _published("Float32(22.5)"),
    "a whole number": _published("Float32(data=22)"),
    "a text for a number": _published("Float32(data='22.5')"),
    "a field misspelled": _published("Float32(dat=22.5)"),
    "another type than the publisher's": _published("String(data='a')"),
    "a class for a message": _published("Float32"),
    "a logger without brackets": _sensor(_PUBLISH, "self.get_logger.info('hello')"),
    "a level misspelled": _sensor(_PUBLISH, "self.get_logger().inf('hello')"),
    "division by zero": _published("Float32(data=1 / 0)"),
    "a callback without a message": (
        "class Reader(Node):\n"
        "    def __init__(self):\n"
        "        super().__init__('reader')\n"
        "        self.create_subscription(Float32, 'temperature', self.read, 10)\n\n"
        "    def read(self):\n"
        "        pass\n\n"
        f"{_SENSOR.replace('ros.run', 'ros.add(Reader)' + chr(10) + 'ros.run')}"
    ),
    # Terminals and files.
    "a terminal without a name": "%%terminal\nls",
    "a folder that does not exist": "%%terminal one\ncd nowhere",
    "a folder in a folder that does not exist": "%%terminal one\nmkdir a/b/c",
    "a command misspelled": "%%terminal one\npyton3 --version",
    "a word of ros2 misspelled": "%%terminal one\nros2 pgk list",
    "a word of colcon misspelled": "%%terminal one\ncolcon biuld",
    "a file without a name": "%%save\nx = 1",
    "a file outside of the workspace": "%%save ../../x.py\nx = 1",
}

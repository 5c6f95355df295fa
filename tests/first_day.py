"""What beginners type on their first day and get wrong, in a kernel in which nothing ran before.

Each row is a cell as it was typed, and words that its answer has to hold.
"""

_CLASS = "class Reader:\n    def check(self, temp):\n"


def _in_method(*lines: str) -> str:
    return _CLASS + "".join(f"        {line}\n" for line in lines)


#: Cells, each with the words that lead on.
CELLS: dict[str, tuple[str, ...]] = {
    # Words of other languages.
    _in_method("if temp > 26:", "    x = 1", "else if temp < 20:", "    x = 2"): ("`elif`",),
    _in_method("if temp > 26:", "    x = 1", "elseif temp < 20:", "    x = 2"): ("`elif`",),
    _in_method("if temp > 26:", "    x = 1", "elsif temp < 20:", "    x = 2"): ("`elif`",),
    "temp = 30\nif temp > 26 then:\n    print('High')": ("`then`", "colon"),
    "temp = 30\nif temp > 26 && temp < 40:\n    print('High')": ("`&&`", "`and`"),
    "count = 0\ncount++": ("`count += 1`",),
    "// my first node\nx = 1": ("`#`",),
    "if True {\n    print('yes')\n}": ("braces", "colon"),
    "import Node from rclpy.node": ("`from rclpy.node import Node`",),
    "float temp = 22.5": ("`temp = ...`",),
    "node = new Node('a')": ("`Node(...)`",),
    "ready = true": ("True",),
    "print 'hello'": ("print(",),
    # Comparisons.
    "temp = 30\nif temp > 26 or < 20:\n    print('odd')": ("`or`", "comparison of its own"),
    "temp = 30\nif temp = 26:\n    print('26')": ("`==`",),
    "temp = 30\nif temp => 26:\n    print('High')": ("`>=`",),
    "temp = 30\nif temp is greater than 26:\n    print('High')": ("`greater`", "`>`"),
    # Numbers and names.
    "period = 2s": ("`2s`", "unit", "`2`"),
    "period = 2 seconds": ("`2 seconds`", "unit", "Write only `2`"),
    "limit = 26.5°C": ("`26.5°C`", "unit"),
    "rate = 10Hz": ("`10Hz`", "unit"),
    "rest = 17 % (5": ("`(`", "never closed"),
    "share = 80 %": ("`80 %`", "unit"),
    "count = 3\nif count % 10 = 0:\n    print('ten')": ("condition", "`==`"),
    "5 = count": ("literal", "name on the left"),
    "2nd_sensor = 1": ("begins with a digit",),
    "room-temp = 20": ("`room-temp`", "`_`"),
    "class = 3": ("word of Python",),
    # Quotes, brackets, colons, spaces.
    "print(“hello”)": ("“", "straight"),
    "topic = ‘weather’": ("‘", "straight"),
    "x = 5 – 3": ("–", "Type -"),
    "print('hello)": ("quote", "ends before the text does"),
    "print('it's warm')": ("quote",),
    "print('hello'": ("`(`", "never closed"),
    "print('hello'))": ("`)`", "not opened"),
    "class Reader\n    pass": ("colon is missing", "`class`"),
    "def f(x)\n    return x": ("colon is missing", "`def`"),
    "class Reader:\ndef f(self):\n    pass": ("Line 1 begins a block", "four spaces"),
    "x = 1\n  y = 2": ("more spaces",),
    "if True:\n    x = 1\n  y = 2": ("no line above it has",),
    "x = [1, 2 3]": ("comma",),
    "else:\n    print('Low')": ("`else`", "`if`"),
    "return 5": ("`return`", "function"),
    # A terminal's commands.
    "ros2 topic list": ("`ros2 topic list`", "`%%terminal look`"),
    "ls": ("`ls`", "`%%terminal look`"),
    "ls -l": ("`ls -l`", "`%%terminal look`"),
    "cd ..": ("`cd ..`", "`%%terminal look`"),
    "$ pwd": ("`pwd`", "`%%terminal look`"),
    "mkdir -p src/docs": ("`mkdir -p src/docs`", "`%%terminal look`"),
    "source install/setup.bash": ("`source install/setup.bash`", "`%%terminal look`"),
    "colcon build": ("`colcon build`", "`%%terminal look`"),
    "python3 node.py": ("`python3 node.py`", "`%%terminal look`"),
    "pip install numpy": ("`pip install numpy`", "`%%terminal look`"),
    "%%terminl one\nls": ("%%terminal",),
    # Modules.
    "import rospy": ("ROS 1", "rclpy"),
    "from turtlesim.msg import Pose": ("turtlesim", "not installed here", "ros2 pkg list"),
    "import cv_bridge": ("cv_bridge", "not installed here"),
    "import rclpi": ("There is rclpy",),
    "from std_msgs.msg import float32": ("Float32",),
    "from .helper import limit": ("dot", "ros2 run"),
    # Values.
    "'Temperature: ' + 22.5": ("string and a number",),
    "float('22,5')": ("22.5",),
    "[1, 2, 3][3]": ("no such index",),
    "1 / 0": ("divides by zero",),
    "import random\nrandom.uniform(0.3)": ("uniform was called without b",),
    "import random\nrandom.unifrom(0, 1)": ("it has uniform",),
}

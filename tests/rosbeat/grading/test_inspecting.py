"""Which answers a person has to look at, and which not."""

import pytest

from rosbeat.grading.inspecting import reasons

IMPORTS = """from rosbeat import Session, check, clinic
import sys
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32
"""


def said(answer, imports=IMPORTS):
    return [(one.line, one.text) for one in reasons(answer, imports)]


@pytest.mark.parametrize(
    "answer",
    [
        "",
        "class A(Node):\n    def __init__(self):\n        super().__init__()\n        self._n = 1",
        "import math\nfrom collections import deque\nimport numpy as np\nx = np.clip(1, 0, 2)",
        "from std_msgs.msg import String as Word\nmsg = Float32\nmsg.data = 1.0",
        "print(type(3).__name__)\nclass A:\n    def f(self): return self.__class__.__name__",
        "class A:\n    def f(self): return getattr(self, 'on_' + self.kind)",
        "getattr(clock, 'now')\nhasattr(clock, f'take_{1}')",
        "import sys\ndef main():\n    rclpy.init(args=sys.argv)\n    sys.exit(0)",
        "from rosbeat import Session\nfrom rosbeat import check",
        "class B:\n    _a = 1\n    def f(self):\n        self.__n = self._a",
        "x = {}\nx['a'] = 1\nx.y = 2\ndel x['a']\nself.publisher.count = 3",
        "this is no python (",
        "x = '\0'",
    ],
    ids=range(13),
)
def test_what_exercises_ask_for_is_not_held(answer):
    assert said(answer) == []


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("import os", "imports os"),
        ("import math, subprocess", "imports subprocess"),
        ("import os.path as p", "imports os.path"),
        ("from os import _exit", "imports os"),
        ("from threading import sys", "imports sys"),
        ("from . import secrets", "imports ."),
        ("from rosbeat.exercises import page_03", "imports rosbeat.exercises"),
        ("import rosbeat", "imports rosbeat"),
        ("import requests", "imports requests"),
        ("def f():\n    import ctypes", "imports ctypes"),
        ("eval('1')", "uses eval"),
        ("run = exec", "uses exec"),
        ("open('/etc/passwd')", "uses open"),
        ("get_ipython()", "uses get_ipython"),
        ("().__class__.__bases__", "reaches for"),
        ("f.__globals__", "reaches for __globals__"),
        ("x.__subclasses__()", "reaches for __subclasses__"),
        ("g.gi_frame", "reaches for gi_frame"),
        ("rclpy.utilities.sys.modules", "reaches for"),
        ("rclpy.utilities.os.system('ls')", "reaches for"),
        ("from rclpy.utilities import os", "imports os"),
        ("import rclpy.executors as e\ne.inspect.stack()", "reaches for"),
        ("node._publishers", "reaches for _publishers"),
        ("getattr(x, '__globals__')", "__globals__"),
        ("getattr(x, name)", "a name that is made up"),
        ("setattr(Node, 'x', 1)", ""),
        ("rclpy.spin = print", "changes rclpy"),
        ("Node.publish = print", "changes Node"),
        ("other = Node\nother.publish = print", "changes other"),
        ("del rclpy.spin", "changes rclpy"),
        ("rclpy.x += 1", "changes rclpy"),
        ("rclpy.x: int = 1", "changes rclpy"),
        ("import math\nmath.pi = 3", "changes math"),
        ("import sys\nsys.stdout = None", ""),
        ("import sys\nsys.modules['json'] = 1", ""),
        ("from rosbeat import clinic", "uses the clinic"),
        ("def diagnoses():\n    return clinic.Ward(7)", "uses the clinic"),
        ("from rosbeat.clinic.ward import Ward", "imports rosbeat.clinic.ward"),
    ],
)
def test_what_reaches_further_is_held_with_its_line(answer, words):
    found = said(answer)
    assert found, answer
    assert any(words in text for _, text in found), found
    assert all(1 <= line <= len(answer.splitlines()) for line, _ in found)


def test_a_name_of_ones_own_is_nobody_elses():
    assert said("clinic = 3\nprint(clinic)", "import rclpy") == []


def test_reasons_come_by_line_and_one_for_each():
    lines = [line for line, _ in said("import os\nx = 1\neval(open('x'))\nimport sys, os")]
    assert lines == sorted(set(lines))
    assert {1, 3} <= set(lines)


def test_a_text_that_breaks_the_parser_is_not_our_business():
    for answer in ("(" * 5_000, "-" * 100_000 + "1", "x = " + "[" * 3_000):
        assert said(answer) == []

"""Right answers in styles of many kinds: what is written around a node, and how it is written.

Each style is put around right answers of the bank. Nothing of it changes what the node does, so
each has to pass, and none may be held.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from textwrap import dedent, indent


@dataclass(frozen=True)
class Style:
    """A way to write an answer.

    Attributes:
        name: What it is about.
        above: Stands above the answer's class.
        below: Stands below it.
        members: Stands at the top of the class's body.
        change: Changes the text in any other way.
        left_out: Whether the mark says that a line was left out, as a command of IPython.
    """

    name: str
    above: str = ""
    below: str = ""
    members: str = ""
    change: Callable[[str], str] = str
    left_out: bool = False

    def around(self, answer: str) -> str:
        """The answer in this style."""
        if self.members:
            inner = indent(dedent(self.members).strip("\n"), "    ")
            found = re.search(r"(?m)^class [^\n]*:\n", answer)
            assert found, answer
            answer = f"{answer[: found.end()]}{inner}\n\n{answer[found.end() :]}"
        parts = (
            dedent(self.above).strip("\n"),
            self.change(answer),
            dedent(self.below).strip("\n"),
        )
        return "\n\n".join(part for part in parts if part)


def _first_class(answer: str) -> str:
    return re.findall(r"(?m)^class (\w+)", answer)[-1]


def _named_below(text: str) -> Callable[[str], str]:
    """Add a text in which NAME is the class."""
    return lambda answer: f"{answer}\n\n{dedent(text).strip()}".replace(
        "NAME", _first_class(answer)
    )


def _each_class(pattern: str, other: str) -> Callable[[str], str]:
    return lambda answer: re.sub(pattern, other, answer, flags=re.MULTILINE)


_MAIN = """
def main(args=None):
    rclpy.init(args=args)
    node = NAME()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""
_SIGNALS = """
import signal
import rclpy
from rclpy.executors import ExternalShutdownException
"""

MAGICS = (
    Style("%%time", "%%time"),
    Style("%%capture", "%%capture"),
    Style("%%timeit once", "%%timeit -n1 -r1"),
    Style("%matplotlib inline", "%matplotlib inline\nimport matplotlib.pyplot as plt",
          left_out=True),
    Style("!ls", "!ls -la", left_out=True),
    Style("!ls over two lines", "!ls \\\n    -la", left_out=True),
    Style("files = !ls", "files = !ls\nprint(files)", left_out=True),
    Style("%pip", "%pip install --quiet numpy", left_out=True),
    Style("!ros2", below="!ros2 topic list", left_out=True),
    Style("help", below="Node?", left_out=True),
    Style("%timeit on a line", "%timeit -n 2 -r 1 sum(range(10))"),
    Style("%time on a line", "%time total = sum(range(10))\nprint(total)"),
    Style("a magic in a block", "if True:\n    %precision 3\n    !echo hello", left_out=True),
    Style("get_ipython", "get_ipython().run_line_magic('matplotlib', 'inline')"),
    Style("display", "from IPython.display import HTML, Markdown, clear_output, display",
          "display(Markdown('**done**'))\nclear_output(wait=True)"),
    Style("top-level await", "import asyncio\nawait asyncio.sleep(0)"),
    Style("top-level async with", """
        import asyncio
        from contextlib import asynccontextmanager

        @asynccontextmanager
        async def nothing():
            yield 1

        async with nothing() as one:
            print(one)
        """),
)  # fmt: skip

IMPORTS = (
    Style("signal", "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)"),
    Style("os and sys", "import os, sys\nprint(os.getcwd(), sys.version, os.getpid(), sys.argv)"),
    Style("the home", "import os\nfrom pathlib import Path\nprint(Path.home(), Path.cwd())\n"
          "print(os.path.expanduser('~/ros2_ws'), os.environ.get('ROS_DISTRO', 'none'))"),
    Style("threading", """
        import threading
        lock = threading.Lock()
        heard = threading.Event()
        worker = threading.Thread(target=heard.wait, args=(0.01,), daemon=True)
        worker.start()
        """),
    Style("a pool", "from concurrent.futures import ThreadPoolExecutor\n"
          "with ThreadPoolExecutor(2) as pool:\n    print(list(pool.map(abs, [-1, 2])))"),
    Style("asyncio", "import asyncio\n\nasync def nothing():\n    await asyncio.sleep(0)\n\n"
          "asyncio.run(nothing())"),
    Style("numpy", "import numpy as np\nrng = np.random.default_rng(3)\nprint(rng.normal(size=3))"),
    Style("matplotlib", "import matplotlib\nmatplotlib.use('Agg')\nimport matplotlib.pyplot as plt",
          "plt.plot([1, 2, 3])\nplt.close('all')"),
    Style("a program", "import subprocess\nprint(subprocess.run(['echo', 'hello'], check=True,\n"
          "                     capture_output=True, text=True).stdout)"),
    Style("doctest", """
        import doctest

        def double(x):
            \"\"\"
            >>> double(2)
            4
            \"\"\"
            return 2 * x

        doctest.testmod()
        """),
    Style("warnings", "import warnings\nwarnings.warn('nearly done')\nPATTERN = '\\d+'"),
    Style("from the future", "from __future__ import annotations"),
    Style("all of rclpy", "import rclpy\nimport rclpy.node as rn\nfrom rclpy.qos import *\n"
          "from std_msgs.msg import *"),
    Style("standard output", "import sys\nsys.stdout.write('hello\\n')\nsys.stdout.flush()\n"
          "print('error', file=sys.stderr)"),
    Style("redirected", "import contextlib, io\nwith contextlib.redirect_stdout(io.StringIO()):\n"
          "    print('hidden')"),
)  # fmt: skip

CLASSES = (
    Style("slots", members="__slots__ = ('extra',)"),
    Style("a cached property", "from functools import cached_property, lru_cache, partial, wraps",
          members="""
        @cached_property
        def limits(self):
            return (1.0, 2.0)

        @staticmethod
        @lru_cache(maxsize=None)
        def square(x):
            return x * x

        @classmethod
        def make(cls, *args, **options):
            return cls(*args, **options)
        """),
    Style("attributes of a class", "from typing import ClassVar",
          members="RATE: ClassVar[float] = 2.0\nknown: dict = {}\nsignal = watcher = recorder = 1"),
    Style("a dataclass beside", """
        from dataclasses import dataclass, field
        from enum import Enum, auto
        from typing import NamedTuple

        @dataclass(frozen=True)
        class Settings:
            rate: float = 2.0
            names: list = field(default_factory=list)

        class Mode(Enum):
            DAY = auto()
            NIGHT = auto()

        class Point(NamedTuple):
            x: float = 0.0
        """),
    Style("a decorator", """
        def registered(cls):
            registry.append(cls)
            return cls

        registry = []
        """, change=_each_class(r"^class ", "@registered\nclass ")),
    Style("a metaclass", """
        class Meta(type(Node)):
            def __new__(mcs, name, bases, space, **more):
                return super().__new__(mcs, name, bases, space)
        """, change=_each_class(r"\(Node\):", "(Node, metaclass=Meta):")),
    Style("a base of one's own", "class Base(Node):\n    pass",
          change=_each_class(r"\(Node\):", "(Base):")),
    Style("super with arguments", change=lambda text: re.sub(
        r"(?m)^class (\w+)\(Node\):(.*?)super\(\)", r"class \1(Node):\2super(\1, self)", text,
        flags=re.DOTALL) if text.count("class ") == 1 else text),
    Style("Node.__init__", change=_each_class(r"super\(\).__init__\((?=[\"'])",
                                              "Node.__init__(self, ")),
    Style("another name", change=_named_below("Another = NAME\nassert Another is NAME")),
    Style("in a block", change=lambda text: f"if True:\n{indent(text, '    ')}"),
    Style("written twice", change=lambda text: f"{text}\n\n{text}"),
    Style("a generator", "import itertools\n\ndef ticks():\n    n = 0\n    while True:\n"
          "        yield n\n        n += 1\n\nprint(list(itertools.islice(ticks(), 3)))"),
    Style("globals", "globals()['PERIOD'] = 0.5\nassert 'PERIOD' in globals()",
          "print(sorted(name for name in dir() if name.isupper()))"),
    Style("exec and eval", "exec('seven = 7')\nassert eval('seven + 1') == 8"),
)  # fmt: skip

TEXTS = (
    Style("comments in other scripts", "# ноль ошибок, 问题, אין בעיות, ¡olé!, 🎉\n"
          "größe = π = 3.14\n变量 = 'ü'\nprint('°C', 变量, '🌡')"),
    Style("a coding line", "# -*- coding: utf-8 -*-\n#!/usr/bin/env python3"),
    Style("windows line ends", change=lambda text: text.replace("\n", "\r\n")),
    Style("tabs", change=lambda text: re.sub(
        r"(?m)^( {4})+", lambda found: "\t" * (len(found[0]) // 4), text)),
    Style("blanks at line ends", change=lambda text: text.replace("\n", "   \n") + "\n\n\n"),
    Style("a last expression", below="42"),
    Style("a string of several lines", 'NOTES = """\n!ls\n%%time\n?\n%matplotlib inline\n"""'),
    Style("a remainder", "x = (7\n     % 4)\ny = 7 \\\n    % 4\nassert not (x\n    != y)"),
    Style("a progress bar", "import sys\nfor n in range(20):\n    sys.stdout.write(f'\\r{n} %')"),
    Style("half a pair", "HALF = '\\ud83d'\nprint(ascii(HALF))"),
    Style("a main", _SIGNALS, change=_named_below(_MAIN)),
    Style("a main with signals", _SIGNALS, change=_named_below("""
        def main(args=None):
            signal.signal(signal.SIGTERM, signal.default_int_handler)
            try:
                with rclpy.init(args=args):
                    rclpy.spin(NAME())
            except (KeyboardInterrupt, ExternalShutdownException):
                pass
        """)),
)  # fmt: skip

NAMES = (
    Style("names of C code", "import ctypes\nimport gc"),
    Style("a display of all names", below="display(vars())"),
)
STYLES = (*MAGICS, *IMPORTS, *CLASSES, *TEXTS, *NAMES)


# Answers that are built in an unusual way.

WRITTEN: dict[str, tuple[str, str]] = {}


def _written(name: str, exercise: str, text: str) -> None:
    WRITTEN[name] = (exercise, dedent(text).strip() + "\n")


_written(
    "a generator as a callback",
    "03a",
    """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.steps = self._run(self.create_publisher(Float32, "humidity", 5))
            self.create_timer(0.5, self.steps.__next__)

        def _run(self, out):
            while True:
                yield out.publish(Float32(data=45.0))
    """,
)
_written(
    "a node inside a function",
    "03a",
    """
    def make(period, topic):
        class Made(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.out = self.create_publisher(Float32, topic, 5)
                self.create_timer(period, self.say)

            def say(self):
                self.out.publish(Float32(data=45.0))

        return Made

    HumiditySensor = make(0.5, "humidity")
    """,
)
_written(
    "type",
    "03a",
    """
    def __init__(self):
        Node.__init__(self, "humidity_sensor")
        self.out = self.create_publisher(Float32, "humidity", 5)
        self.create_timer(1 / 2, self.say)

    HumiditySensor = type("HumiditySensor", (Node,), {
        "__init__": __init__,
        "say": lambda self: self.out.publish(Float32(data=45.0)),
    })
    """,
)
_written(
    "an enum and a match",
    "04a",
    """
    from enum import Enum

    class State(Enum):
        WARM = "Warm"
        FROST = "Frost"
        FINE = "Fine"

        @classmethod
        def of(cls, temp):
            match temp:
                case t if t > 8.0:
                    return cls.WARM
                case t if t < 2.0:
                    return cls.FROST
                case _:
                    return cls.FINE

    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            state = State.of(msg.data)
            self.get_logger().info(f"Fridge: {msg.data:.2f}C - Status:{state.value}")
    """,
)
_written(
    "a decorator that logs",
    "04a",
    """
    import functools

    def logged(method):
        @functools.wraps(method)
        def wrapper(self, *args, **options):
            self.get_logger().info(method(self, *args, **options))
        return wrapper

    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.hear, 10)

        @logged
        def hear(self, msg):
            word = {True: "Warm"}.get(msg.data > 8.0) or {True: "Frost"}.get(msg.data < 2.0)
            return f"Fridge: {msg.data:.2f}C - Status:{word or 'Fine'}"
    """,
)
_written(
    "an async callback",
    "04a",
    """
    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.hear, 10)

        async def hear(self, msg):
            status = "Warm" if msg.data > 8.0 else "Frost" if msg.data < 2.0 else "Fine"
            self.get_logger().info(f"Fridge: {msg.data:.2f}C - Status:{status}")
    """,
)
_written(
    "a deque and statistics",
    "04e",
    """
    import statistics
    from collections import deque

    class CalmMonitor(Node):
        def __init__(self):
            super().__init__("calm_monitor")
            self.last = deque(maxlen=5)
            self.status = "Normal"
            self.means = self.create_publisher(Float32, "mean", 10)
            self.words = self.create_publisher(String, "status", 10)
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            self.last.append(msg.data)
            self.means.publish(Float32(data=statistics.fmean(self.last)))
            before, self.status = self.status, self.after(msg.data)
            if before != self.status:
                self.words.publish(String(data=self.status))

        def after(self, x):
            if x > 26.0 or (self.status == "High" and x >= 25.0):
                return "High"
            if x < 20.0 or (self.status == "Low" and x <= 21.0):
                return "Low"
            return "Normal"
    """,
)
_written(
    "names in another alphabet",
    "00b",
    """
    class SportsReporter(Node):
        '''Спортивный репортёр ⚽'''

        def __init__(self):
            super().__init__("sports_reporter")
            self.издатель = self.create_publisher(String, "sports", 10)
            self.таймер = self.create_timer(2.0, self.писать)
            self.счёт = 0

        def писать(self):
            self.счёт += 1
            self.издатель.publish(String(data=f"Матч № {self.счёт}: ½ – 数 🎉"))
    """,
)
_written(
    "numpy's clip",
    "03b",
    """
    import numpy as np

    class RoomSensor(Node):
        def __init__(self):
            super().__init__("temperature_sensor")
            self.out = self.create_publisher(Float32, "temperature", 10)
            self.create_timer(1.0, self.step)
            self.dice = np.random.default_rng()
            self.temperature = np.float64(22.0)

        def step(self):
            drift = self.dice.uniform(-0.3, 0.3)
            self.temperature = np.clip(self.temperature + drift, 18.0, 28.0)
            self.out.publish(Float32(data=float(self.temperature)))
    """,
)
_written(
    "a node that is tried out first",
    "03a",
    """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.out = self.create_publisher(Float32, "humidity", 5)
            self.create_timer(0.5, self.say)

        def say(self):
            self.out.publish(Float32(data=45.0))

    with Session(seed=1) as robot:
        node = robot.add(HumiditySensor)
        robot.run(seconds=2)
    print("works!", robot)
    check("03a", HumiditySensor)
    """,
)

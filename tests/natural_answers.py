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
    """

    name: str
    above: str = ""
    below: str = ""
    members: str = ""
    change: Callable[[str], str] = str

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
    Style("%matplotlib inline", "%matplotlib inline\nimport matplotlib.pyplot as plt"),
    Style("!ls", "!ls -la"),
    Style("!ls over two lines", "!ls \\\n    -la"),
    Style("files = !ls", "files = !ls\nprint(files)"),
    Style("help", below="Node?"),
    Style("%timeit on a line", "%timeit -n 2 -r 1 sum(range(10))"),
    Style("%time on a line", "%time total = sum(range(10))\nprint(total)"),
    Style("a magic in a block", "if True:\n    %precision 3\n    !echo hello"),
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
    Style("a program", "import subprocess\nprint(subprocess.run(['echo', 'hello'], check=True,\n"
          "                     capture_output=True, text=True).stdout)"),
    Style("from the future", "from __future__ import annotations"),
)  # fmt: skip

CLASSES = (
    Style("a metaclass", """
        class Meta(type(Node)):
            def __new__(mcs, name, bases, space, **more):
                return super().__new__(mcs, name, bases, space)
        """, change=_each_class(r"\(Node\):", "(Node, metaclass=Meta):")),
    Style("another name", change=_named_below("Another = NAME\nassert Another is NAME")),
    Style("in a block", change=lambda text: f"if True:\n{indent(text, '    ')}"),
    Style("written twice", change=lambda text: f"{text}\n\n{text}"),
    Style("globals", "globals()['PERIOD'] = 0.5\nassert 'PERIOD' in globals()",
          "print(sorted(name for name in dir() if name.isupper()))"),
)  # fmt: skip

TEXTS = (
    Style("comments in other scripts", "# ноль ошибок, 问题, אין בעיות, ¡olé!, 🎉\n"
          "größe = π = 3.14\n变量 = 'ü'\nprint('°C', 变量, '🌡')"),
    Style("a coding line", "# -*- coding: utf-8 -*-\n#!/usr/bin/env python3"),
    Style("windows line ends", change=lambda text: text.replace("\n", "\r\n")),
    Style("tabs", change=lambda text: re.sub(
        r"(?m)^( {4})+", lambda found: "\t" * (len(found[0]) // 4), text)),
    Style("a string of several lines", 'NOTES = """\n!ls\n%%time\n?\n%matplotlib inline\n"""'),
    Style("a remainder", "x = (7\n     % 4)\ny = 7 \\\n    % 4\nassert not (x\n    != y)"),
    Style("half a pair", "HALF = '\\ud83d'\nprint(ascii(HALF))"),
    Style("a main", _SIGNALS, change=_named_below(_MAIN)),
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

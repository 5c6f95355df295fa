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
    Style("%%time and a comment", "%%time\n# how long does it take?"),
    Style("%%capture", "%%capture"),
    Style("%%capture with a name", "%%capture output --no-stderr"),
    Style("%%timeit once", "%%timeit -n1 -r1"),
    Style("%matplotlib inline", "%matplotlib inline\nimport matplotlib.pyplot as plt",
          left_out=True),
    Style("%autoreload", "%load_ext autoreload\n%autoreload 2", left_out=True),
    Style("!ls", "!ls -la", left_out=True),
    Style("!ls over two lines", "!ls \\\n    -la", left_out=True),
    Style("!!ls", "!!ls", left_out=True),
    Style("files = !ls", "files = !ls\nprint(files)", left_out=True),
    Style("%pip", "%pip install --quiet numpy", left_out=True),
    Style("!ros2", below="!ros2 topic list", left_out=True),
    Style("help", below="Node?", left_out=True),
    Style("help, in front", below="?Node", left_out=True),
    Style("%timeit on a line", "%timeit -n 2 -r 1 sum(range(10))"),
    Style("%time on a line", "%time total = sum(range(10))\nprint(total)"),
    Style("%who", below="%whos", left_out=True),
    Style("%env", "%env COURSE=rosbeat", left_out=True),
    Style("a magic in a block", "if True:\n    %precision 3\n    !echo hello", left_out=True),
    Style("get_ipython", "get_ipython().run_line_magic('matplotlib', 'inline')"),
    Style("get_ipython, asked", "shell = get_ipython()\nif shell is not None:\n"
          "    shell.system('echo hello')"),
    Style("%debug", below="# %debug\n%xmode Plain", left_out=True),
    Style("display", "from IPython.display import HTML, Markdown, clear_output, display",
          "display(Markdown('**done**'))\nclear_output(wait=True)"),
    Style("display without an import", below="display('done')"),
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
    Style("logging", """
        import logging
        logging.basicConfig(level=logging.DEBUG, format="%(asctime)s %(message)s")
        logger = logging.getLogger(__name__)
        logger.info("the cell runs")
        """),
    Style("time", "import time\nstart = time.perf_counter()\ntime.sleep(0.01)",
          "print(f'{time.perf_counter() - start:.3f} s', time.time(), time.strftime('%H:%M'))"),
    Style("signal", "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)"),
    Style("os and sys", "import os, sys\nprint(os.getcwd(), sys.version, os.getpid(), sys.argv)"),
    Style("the home", "import os\nfrom pathlib import Path\nprint(Path.home(), Path.cwd())\n"
          "print(os.path.expanduser('~/ros2_ws'), os.environ.get('ROS_DISTRO', 'none'))"),
    Style("who I am", "import getpass, platform, socket\n"
          "print(getpass.getuser(), platform.system(), socket.gethostname())"),
    Style("a file", "from pathlib import Path\nPath('log.txt').write_text('begun\\n')",
          "with open('log.txt', 'a') as log:\n    log.write('done\\n')"),
    Style("a folder", "import os\nos.makedirs('data/raw', exist_ok=True)\nprint(os.listdir('.'))"),
    Style("a temporary folder", "import tempfile\nwith tempfile.TemporaryDirectory() as folder:\n"
          "    print(folder)"),
    Style("csv and json", """
        import csv, io, json
        table = io.StringIO()
        csv.writer(table).writerow([1, 2.5, "three"])
        SETTINGS = json.loads('{"rate": 2}')
        """),
    Style("pickle", "import pickle\nassert pickle.loads(pickle.dumps([1, 2])) == [1, 2]"),
    Style("sqlite", "import sqlite3\ndb = sqlite3.connect(':memory:')\ndb.execute('select 1')"),
    Style("threading", """
        import threading
        lock = threading.Lock()
        heard = threading.Event()
        worker = threading.Thread(target=heard.wait, args=(0.01,), daemon=True)
        worker.start()
        """),
    Style("a pool", "from concurrent.futures import ThreadPoolExecutor\n"
          "with ThreadPoolExecutor(2) as pool:\n    print(list(pool.map(abs, [-1, 2])))"),
    Style("processes", "import multiprocessing\nprint(multiprocessing.cpu_count())"),
    Style("asyncio", "import asyncio\n\nasync def nothing():\n    await asyncio.sleep(0)\n\n"
          "asyncio.run(nothing())"),
    Style("numpy", "import numpy as np\nrng = np.random.default_rng(3)\nprint(rng.normal(size=3))"),
    Style("matplotlib", "import matplotlib\nmatplotlib.use('Agg')\nimport matplotlib.pyplot as plt",
          "plt.plot([1, 2, 3])\nplt.close('all')"),
    Style("random", "import random\nrandom.seed(7)\nprint(random.choice([1, 2, 3]))"),
    Style("dates", "from datetime import datetime, timedelta, timezone\n"
          "from zoneinfo import ZoneInfo\n"
          "print(datetime.now(timezone.utc) + timedelta(days=1), ZoneInfo('Europe/Berlin'))"),
    Style("locale", "import locale\nlocale.setlocale(locale.LC_ALL, '')"),
    Style("statistics", "import statistics\nfrom collections import Counter, deque\n"
          "print(statistics.mean(deque([1, 2], maxlen=5)), Counter('abba'))"),
    Style("argparse", "import argparse\nparser = argparse.ArgumentParser()\n"
          "parser.add_argument('--rate', type=float)\noptions = parser.parse_args([])"),
    Style("a program", "import subprocess\nprint(subprocess.run(['echo', 'hello'], check=True,\n"
          "                     capture_output=True, text=True).stdout)"),
    Style("which", "import shutil\nprint(shutil.which('python3'))"),
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
    Style("unittest", """
        import unittest

        class TestNothing(unittest.TestCase):
            def test_it(self):
                self.assertEqual(1, 1)

        unittest.main(argv=["x"], exit=False)
        """),
    Style("warnings", "import warnings\nwarnings.warn('nearly done')\nPATTERN = '\\d+'"),
    Style("atexit", "import atexit\natexit.register(print, 'goodbye')"),
    Style("garbage", "import gc\ngc.collect()"),
    Style("from the future", "from __future__ import annotations"),
    Style("all of rclpy", "import rclpy\nimport rclpy.node as rn\nfrom rclpy.qos import *\n"
          "from std_msgs.msg import *"),
    Style("messages by module", "import std_msgs.msg as m\nfrom std_msgs import msg as messages\n"
          "print(m.Float32(data=1.0), messages.String(data='x'))"),
    Style("importlib", "import importlib\nmath = importlib.import_module('math')\n"
          "importlib.reload(math)"),
    Style("ipywidgets", "import ipywidgets as widgets\nslider = widgets.FloatSlider(value=2.0)"),
    Style("a path", "import sys\nsys.path.append('.')\nsys.path.insert(0, '/home/me/ros2_ws')"),
    Style("standard output", "import sys\nsys.stdout.write('hello\\n')\nsys.stdout.flush()\n"
          "print('error', file=sys.stderr)"),
    Style("redirected", "import contextlib, io\nwith contextlib.redirect_stdout(io.StringIO()):\n"
          "    print('hidden')"),
    Style("try an import", "try:\n    import pandas as pd\nexcept ImportError:\n    pd = None"),
    Style("typing", "from typing import Any, Callable, ClassVar, Dict, Final, List, Optional, "
          "Protocol, TypeVar, Union\nRATE: Final[float] = 2.0\nT = TypeVar('T')"),
)  # fmt: skip

CLASSES = (
    Style("a docstring", members='"""Publish and listen.\n\nArgs: none.\n"""'),
    Style("slots", members="__slots__ = ('extra',)"),
    Style("a property", members="""
        @property
        def beats_per_minute(self) -> float:
            return 30.0
        """),
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
    Style("special methods", members="""
        def __repr__(self):
            return f"<{type(self).__name__}>"

        def __enter__(self):
            return self

        def __exit__(self, *error):
            return False

        def __bool__(self):
            return True
        """),
    Style("a destructor", members="def __del__(self):\n    pass"),
    Style("an initialised subclass", members="def __init_subclass__(cls, **more):\n"
          "    super().__init_subclass__(**more)"),
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
    Style("an abstract class", """
        from abc import ABC, abstractmethod

        class Says(ABC):
            @abstractmethod
            def say(self):
                ...
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
    Style("a mixin", """
        class Helper:
            def helps(self):
                return vars(self)
        """, change=_each_class(r"\(Node\):", "(Helper, Node):")),
    Style("a base of one's own", "class Base(Node):\n    pass",
          change=_each_class(r"\(Node\):", "(Base):")),
    Style("Node by its module", "import rclpy.node",
          change=_each_class(r"\(Node\):", "(rclpy.node.Node):")),
    Style("super with arguments", change=lambda text: re.sub(
        r"(?m)^class (\w+)\(Node\):(.*?)super\(\)", r"class \1(Node):\2super(\1, self)", text,
        flags=re.DOTALL) if text.count("class ") == 1 else text),
    Style("Node.__init__", change=_each_class(r"super\(\).__init__\((?=[\"'])",
                                              "Node.__init__(self, ")),
    Style("built anew", change=_named_below("NAME = type('NAME', (NAME,), {})")),
    Style("another name", change=_named_below("Another = NAME\nassert Another is NAME")),
    Style("in a block", change=lambda text: f"if True:\n{indent(text, '    ')}"),
    Style("in a try", change=lambda text: f"try:\n{indent(text, '    ')}\n"
          "except NameError as error:\n    print(error)\nelse:\n    pass"),
    Style("in a with", "from contextlib import suppress",
          change=lambda text: f"with suppress(KeyError):\n{indent(text, '    ')}"),
    Style("written twice", change=lambda text: f"{text}\n\n{text}"),
    Style("a helper beside", "def clamp(x, low, high):\n    return max(low, min(x, high))\n\n"
          "identity = lambda x: x\nNUMBERS = [n ** 2 for n in range(5)]"),
    Style("a generator", "import itertools\n\ndef ticks():\n    n = 0\n    while True:\n"
          "        yield n\n        n += 1\n\nprint(list(itertools.islice(ticks(), 3)))"),
    Style("a match", "match 3:\n    case 3:\n        three = True\n    case _:\n        three = 0"),
    Style("a walrus", "if (n := len('abc')) > 2:\n    print(f'{n=}')"),
    Style("globals", "globals()['PERIOD'] = 0.5\nassert 'PERIOD' in globals()",
          "print(sorted(name for name in dir() if name.isupper()))"),
    Style("names of builtins", "id = 3\ntype_ = list = [1]\ninput = None\ndel id, list, input"),
    Style("exec and eval", "exec('seven = 7')\nassert eval('seven + 1') == 8"),
    Style("raises and catches", "try:\n    1 / 0\nexcept ZeroDivisionError as error:\n"
          "    print(f'{error!r}')\nfinally:\n    print('on')"),
    Style("asserts", below="assert issubclass(Node, object)\nassert True, 'all is well'"),
)  # fmt: skip

TEXTS = (
    Style("comments in other scripts", "# ноль ошибок, 问题, אין בעיות, ¡olé!, 🎉\n"
          "größe = π = 3.14\n变量 = 'ü'\nprint('°C', 变量, '🌡')"),
    Style("a coding line", "# -*- coding: utf-8 -*-\n#!/usr/bin/env python3"),
    Style("windows line ends", change=lambda text: text.replace("\n", "\r\n")),
    Style("tabs", change=lambda text: re.sub(
        r"(?m)^( {4})+", lambda found: "\t" * (len(found[0]) // 4), text)),
    Style("blanks at line ends", change=lambda text: text.replace("\n", "   \n") + "\n\n\n"),
    Style("empty lines", "\n\n\n", change=lambda text: text.replace("\n", "\n\n")),
    Style("a form feed", "x = 1\n\x0c\ny = 2"),
    Style("semicolons", "a = 1; b = 2; print(a, b);"),
    Style("a last expression", below="42"),
    Style("a last tuple", below="Node, 'done'"),
    Style("an ellipsis", below="..."),
    Style("a long comment", "# " + "x" * 5_000),
    Style("a string of several lines", 'NOTES = """\n!ls\n%%time\n?\n%matplotlib inline\n"""'),
    Style("a remainder", "x = (7\n     % 4)\ny = 7 \\\n    % 4\nassert not (x\n    != y)"),
    Style("prints", "for n in range(200):\n    print(n, end=' ', flush=True)"),
    Style("a progress bar", "import sys\nfor n in range(20):\n    sys.stdout.write(f'\\r{n} %')"),
    Style("colours", "print('\\033[1;32mgreen\\033[0m \\a')"),
    Style("bytes", "print(b'\\xff'.decode('latin-1'), bytes(3), bytearray(b'x'))"),
    Style("half a pair", "HALF = '\\ud83d'\nprint(ascii(HALF))"),
    Style("annotations", "rate: float = 2.0\nnames: 'list[str]' = []\ncount: int"),
    Style("a main", _SIGNALS, change=_named_below(_MAIN)),
    Style("a main, guarded", _SIGNALS, change=_named_below(
        f"{_MAIN}\nif __name__ == '__main__' and '__file__' in globals():\n    main()")),
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
    "getattr and setattr",
    "03a",
    """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            for name, value in {"topic": "humidity", "period": 0.5, "depth": 5}.items():
                setattr(self, name, value)
            create = getattr(self, "create_" + "publisher")
            self.__dict__["out"] = create(Float32, self.topic, self.depth)
            vars(self).update(value=45.0)
            self.create_timer(getattr(self, "period"), self.say)

        def say(self):
            self.out.publish(Float32(data=self.value))
    """,
)
_written(
    "a lambda",
    "03a",
    """
    class HumiditySensor(Node):
        def __init__(self, *args, **options):
            super().__init__("humidity_sensor", *args, **options)
            out = self.create_publisher(Float32, "humidity", 5)
            self.create_timer(0.5, lambda: out.publish(Float32(data=45.0)))
    """,
)
_written(
    "partial",
    "03a",
    """
    from functools import partial

    class HumiditySensor(Node):
        def __init__(self):
            Node.__init__(self, node_name="humidity_sensor")
            out = self.create_publisher(msg_type=Float32, topic="humidity", qos_profile=5)
            self.create_timer(timer_period_sec=0.5,
                              callback=partial(out.publish, Float32(data=45.0)))
    """,
)
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
    "a callable object",
    "03a",
    """
    class Says:
        def __init__(self, out):
            self.out = out
            self.count = 0

        def __call__(self):
            self.count += 1
            self.out.publish(Float32(data=45.0))

    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.create_timer(0.5, Says(self.create_publisher(Float32, "humidity", 5)))
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
    "a dataclass of settings",
    "03a",
    """
    from dataclasses import dataclass, field

    @dataclass
    class Settings:
        topic: str = "humidity"
        period: "float" = 0.5
        depth: int = field(default=5)

    class HumiditySensor(Node):
        settings = Settings()

        def __init__(self):
            super().__init__("humidity_sensor")
            self.out = self.create_publisher(Float32, self.settings.topic, self.settings.depth)
            self.create_timer(self.settings.period, self.say)

        def say(self):
            self.out.publish(Float32(data=45.0))
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
    "bisect",
    "04a",
    """
    import bisect
    import math

    class FridgeMonitor(Node):
        EDGES = (2.0, math.nextafter(8.0, 9.0))

        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            status = ("Frost", "Fine", "Warm")[bisect.bisect_right(self.EDGES, msg.data)]
            self.get_logger().info("Fridge: %.2fC - Status:%s" % (msg.data, status))
    """,
)
_written(
    "a table of rules",
    "04a",
    """
    from operator import gt, lt

    RULES = [(gt, 8.0, "Warm"), (lt, 2.0, "Frost")]

    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            status = next((word for test, limit, word in RULES if test(msg.data, limit)), "Fine")
            self.get_logger().info("Fridge: {:.2f}C - Status:{}".format(msg.data, status))
    """,
)
_written(
    "a property and its setter",
    "04a",
    """
    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self._temp = 0.0
            self.subscription = self.create_subscription(Float32, "temperature", self.hear, 10)

        @property
        def temp(self):
            return self._temp

        @temp.setter
        def temp(self, value):
            self._temp = value

        @property
        def status(self):
            return "Warm" if self.temp > 8 else "Frost" if self.temp < 2 else "Fine"

        def hear(self, msg):
            self.temp = msg.data
            self.get_logger().info(f"Fridge: {self.temp:.2f}C - Status:{self.status}")
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
    "numpy.select",
    "04a",
    """
    import numpy as np

    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            status = np.select([msg.data > 8.0, msg.data < 2.0], ["Warm", "Frost"], "Fine")
            self.get_logger().info(f"Fridge: {msg.data:.2f}C - Status:{status}")
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
    "words by format",
    "04b",
    """
    from string import Template

    TEXT = Template("$degrees degrees")

    class Alarm(Node):
        def __init__(self, /, name="alarm"):
            super().__init__(name)
            self.alerts = self.create_publisher(String, "alert", 10)
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg: Float32) -> None:
            if msg.data < 20.0 or msg.data > 26.0:
                self.alerts.publish(String(data=TEXT.substitute(degrees=format(msg.data, ".1f"))))
    """,
)
_written(
    "try, except, else, finally",
    "04b",
    """
    class Comfortable(Exception):
        pass

    class Alarm(Node):
        def __init__(self):
            super().__init__("alarm")
            self.alerts, self.heard = self.create_publisher(String, "alert", 10), 0
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            try:
                if 20.0 <= msg.data <= 26.0:
                    raise Comfortable
            except Comfortable:
                pass
            else:
                self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))
            finally:
                self.heard += 1
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
    "a class of its own for each task",
    "04e",
    """
    from collections import deque

    class Mean:
        '''Keep the last values.'''

        __slots__ = ("_values",)

        def __init__(self, size: int = 5) -> None:
            self._values: deque[float] = deque(maxlen=size)

        def __lshift__(self, value: float) -> float:
            self._values.append(value)
            return sum(self._values) / len(self._values)

    class Calm:
        def __init__(self):
            self.word = "Normal"

        def send(self, x):
            low, high = (20.0, 26.0)
            low += 1.0 * (self.word == "Low")
            high -= 1.0 * (self.word == "High")
            above = x > high or (self.word == "High" and x == high)
            below = x < low or (self.word == "Low" and x == low)
            new = "High" if above else "Low" if below else "Normal"
            changed, self.word = new != self.word, new
            return changed

    class CalmMonitor(Node):
        def __init__(self):
            super().__init__("calm_monitor")
            self.mean, self.calm = Mean(), Calm()
            self.means = self.create_publisher(Float32, "mean", 10)
            self.words = self.create_publisher(String, "status", 10)
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            self.means.publish(Float32(data=self.mean << msg.data))
            if self.calm.send(msg.data):
                self.words.publish(String(data=self.calm.word))
    """,
)
_written(
    "an event and a lock",
    "00a",
    """
    import threading

    class WeatherReader(Node):
        def __init__(self):
            super().__init__("weather_reader")
            self.lock = threading.RLock()
            self.heard = threading.Event()
            self.signal = self.heard.set
            self.create_subscription(String, "weather", self.read, 10)

        def read(self, msg):
            with self.lock:
                self.signal()
                self.get_logger().info("I read: " + msg.data)
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
    "itertools",
    "00b",
    """
    import itertools

    class SportsReporter(Node):
        def __init__(self):
            super().__init__("sports_reporter")
            self.news = map("Goal {}".format, itertools.count(1))
            out = self.create_publisher(String, "sports", 10)
            self.create_timer(2.0, lambda: out.publish(String(data=next(self.news))))
    """,
)
_written(
    "random without its module's name",
    "03b",
    """
    from random import Random

    class RoomSensor(Node):
        __dice = Random()

        def __init__(self):
            super().__init__("temperature_sensor")
            self.out = self.create_publisher(Float32, "temperature", 10)
            self.create_timer(1.0, self.step)
            self.__value = 22.0

        def step(self):
            self.__value = sorted((18.0, self.__value + self.__dice.uniform(-0.3, 0.3), 28.0))[1]
            msg = Float32()
            msg.data = self.__value
            self.out.publish(msg)
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

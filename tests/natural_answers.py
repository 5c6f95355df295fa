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
        parts = (dedent(self.above).strip("\n"), self.change(answer), dedent(self.below).strip("\n"))
        return "\n\n".join(part for part in parts if part)


def _first_class(answer: str) -> str:
    return re.findall(r"(?m)^class (\w+)", answer)[-1]


def _named_below(text: str) -> Callable[[str], str]:
    """Add a text in which NAME is the class."""
    return lambda answer: f"{answer}\n\n{dedent(text).strip()}".replace("NAME", _first_class(answer))


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
          "parser.add_argument('--rate', type=float, default=2.0)\noptions = parser.parse_args([])"),
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

STYLES = (*MAGICS, *IMPORTS, *CLASSES, *TEXTS)

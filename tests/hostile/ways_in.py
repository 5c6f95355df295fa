"""Ways from a plain value to what runs it, each of which has once been open."""

from hostile.deed import WRONG, Deed, before

_TELL = "raise RuntimeError(str(found)[:40])"


def _way(name, code, words, alone="RuntimeError"):
    return Deed(name, before(f"{code.strip()}\n{_TELL}", WRONG), words=words, alone=alone)


DEEDS = (
    _way("attrgetter", "from operator import attrgetter\nfound = attrgetter('f_back')",
         "attrgetter"),
    _way("reduce with getattr",
         "from functools import reduce\nfound = reduce(getattr, ['mro'], Node)", "hands on getattr",
         alone="type"),
    _way("a pattern of a class", """
match Node.create_timer:
    case object(__globals__=space):
        found = space
""", "reaches for __globals__"),
    _way("a module under another name", "import enum\nfound = enum.bltns.exec", "bltns",
         alone=""),
    _way("a private import", "from random import _os as found", "imports _os"),
    _way("inner names imported", "from random import __builtins__ as found",
         "imports __builtins__"),
    _way("something else as self", "def f(self):\n    return self._os\n\nfound = f(random)", "_os"),
    Deed("getattr of self with a name that is made up", before(
        "def f(self, name):\n    return getattr(self, name)\n\n"
        "found = f(Node.create_timer, '__glo' + 'bals__')", WRONG), "failed", "__globals__",
        alone="__globals__"),
    _way("string.Formatter", "import string\nfound = string.Formatter()", "Formatter"),
    _way("a subclass of redirect_stdout", "import contextlib\n\n"
         "class R(contextlib.redirect_stdout):\n    _stream = 'modules'\n\nfound = R({})",
         "redirect_stdout"),
    _way("update_wrapper", "from functools import update_wrapper as found", "update_wrapper"),
    _way("wraps with names", "from functools import wraps\n"
         "found = wraps(Node, ('mro',), ())", "wraps"),
    _way("hints that are evaluated", "import typing\n\n"
         "def f(x: '1 + 1'):\n    pass\n\nfound = typing.get_type_hints(f)", "get_type_hints"),
    _way("singledispatch", "from functools import singledispatch as found", "singledispatch"),
    _way("a shell of asyncio", "import asyncio\nfound = asyncio.create_subprocess_shell",
         "create_subprocess_shell"),
    _way("settings of logging", "import logging.config\nfound = logging.config.dictConfig",
         "imports logging.config"),
    _way("memory through NumPy", "import numpy as np\n\nclass Here:\n"
         "    __array_interface__ = {'data': (id(Node), True), 'shape': (8,), 'typestr': '|u1',"
         " 'version': 3}\n\nfound = np.asarray(Here())", "__array_interface__"),
    _way("a format that reads attributes",
         "found = '{0.__init__.__globals__}'.format(Node)", "in a text"),
    _way("what a module of the course imports", "found = workspace.import_module('os').getcwd()",
         "import_module"),
    Deed("getattr from the node to the recorder", before(
        "def get(self, *names):\n    for name in names:\n        self = getattr(self, name)\n"
        "    return self\n",
        WRONG + "        get(self, 'cont' + 'ext', 'watch' + 'er', 'record' + 'er')\n"), "failed",
        "context", alone="context"),
    _way("yaml", "from rclpy.parameter import yaml as found", "imports yaml"),
    _way("a base that builds on os", "Base = __import__('os') and Node\nfound = Base",
         "uses __import__"),
)  # fmt: skip

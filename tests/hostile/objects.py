"""Objects that are not what they say: names, numbers, messages and nodes of one's own kind."""

from hostile.deed import RIGHT, WRONG, Deed, before, within


def _node(members, answer=WRONG):
    head, _, rest = answer.partition("\n")
    return f"{head}\n{members}\n{rest}"


DEEDS = (
    Deed(
        "a name that is another one each time",
        before(
            "class Name(str):\n    __eq__ = lambda self, other: True\n"
            "    __hash__ = lambda self: hash('humidity')\n"
            "    encode = lambda self, *a: b'humidity'\n    __str__ = lambda self: 'humidity'\n",
            WRONG.replace('"humidity"', "Name('wet')"),
        ),
        words="",
    ),
    Deed(
        "a depth that never ends",
        before(
            "class Depth(int):\n    def __index__(self):\n        while True:\n            pass\n"
            "    __eq__ = __lt__ = __gt__ = lambda self, other: self.__index__()\n"
            "    __hash__ = int.__hash__\n",
            RIGHT.replace(", 5)", ", Depth(5))"),
        ),
        words="still running",
    ),
    Deed(
        "a message that says something else each time",
        before(
            "class Wet(Float32):\n    @property\n    def data(self):\n        return 45.0\n"
            "    @data.setter\n    def data(self, value):\n        pass\n",
            WRONG.replace("Float32(data", "Wet(data"),
        ),
        words="",
    ),
    Deed(
        "a node that says it is another class",
        _node("    __class__ = property(lambda self: type('HumiditySensor', (Node,), {}))"),
        words="readings",
    ),
    Deed(
        "a node that cannot be destroyed",
        _node("    def destroy_node(self):\n        while True:\n            pass\n", RIGHT),
        words="",
        passes=True,
    ),
    Deed(
        "a node that is never freed",
        _node("    def __del__(self):\n        while True:\n            pass\n", RIGHT),
        words="",
        passes=True,
    ),
    Deed(
        "a node that answers to every name",
        _node("    def __getattr__(self, name):\n        return lambda *a, **k: self\n"),
        words="",
    ),
    Deed(
        "a node that is equal to everything, and false",
        _node(
            "    __eq__ = lambda self, other: True\n    __hash__ = lambda self: 0\n"
            "    __bool__ = lambda self: False\n    __len__ = lambda self: 0\n"
        ),
        words="readings",
    ),
    Deed(
        "a node with another clock",
        _node(
            "    def get_clock(self):\n        from rclpy.clock import Clock, ClockType\n"
            "        return Clock(clock_type=ClockType.STEADY_TIME)\n"
        ),
        words="",
    ),
    Deed(
        "a class that makes something else",
        _node("    def __new__(cls, *args):\n        import types\n"
              "        return types.SimpleNamespace(passed=True)\n"),
        words="",
    ),
    Deed(
        "a metaclass that answers for its class",
        before(
            "class Meta(type(Node)):\n    def __call__(cls, *args, **options):\n"
            "        return 'passed'\n    def __instancecheck__(cls, one):\n        return True\n",
            WRONG.replace("(Node)", "(Node, metaclass=Meta)"),
        ),
        words="",
    ),
    Deed(
        "a callback that is itself, over and over",
        within("self.publish_humidity()", RIGHT),
        words="Recursion",
    ),
    Deed(
        "a timer of a nanosecond",
        RIGHT.replace("0.5", "1e-9"),
        words="",
    ),
    Deed(
        "publishers without end",
        within("for n in range(10**9):\n    self.create_publisher(Float32, f'a{n}', 5)"),
        words="",
    ),
    Deed(
        "parameters without end",
        within("for n in range(10**9):\n    self.declare_parameter(f'a{n}', 'x' * 10_000)"),
        words="",
    ),
    Deed(
        "an exception whose cause has no end",
        before(
            "error = ValueError('a')\nfor n in range(100_000):\n    other = ValueError(str(n))\n"
            "    other.__context__ = other.__cause__ = error\n    error = other\nraise error"
        ),
        words="ValueError: 99999",
    ),
    Deed(
        "an exception group of many",
        before(
            "try:\n    some = [ValueError(n) for n in range(10_000)]\n"
            "    error = ExceptionGroup('x' * 10_000, some)\n"
            "except NameError:\n    error = ValueError('Group')\nraise error"
        ),
        words="Group",
    ),
)  # fmt: skip

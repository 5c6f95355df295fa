"""Further answers to page 03, from the page alone: right ones, and what they are near to."""

from bank.answer import edited, either, right, wrong
from bank.nodes.beat_wrong import BASE as BEAT
from bank.nodes.greenhouse_right import BASE as GREENHOUSE
from bank.nodes.room_right import BASE as ROOM

_MAKE = 'self.publisher_ = self.create_publisher(Float32, "humidity", 5)'
_TIMER = "self.timer = self.create_timer(0.5, self.publish_humidity)"
_SEND = "self.publisher_.publish(Float32(data=45.0))"
_SUP = 'super().__init__("humidity_sensor")'
_RS = "self.temperature += random.uniform(-0.3, 0.3)"
_RSEND = "self.publisher_.publish(Float32(data=self.temperature))"
_RC = "self.temperature = max(18.0, min(28.0, self.temperature))"
_GS = "self.temperature += random.uniform(-0.5, 0.5)"
_GC = "self.temperature = max(10.2, min(28.0, self.temperature))"


def _h(name, mistake, *e):
    return wrong("03a", name, mistake, edited(BEAT, *e))


_BEATS = (
    _h(
        "a sleep before it publishes",
        "callback-blocks",
        (_SEND, "import time\n        time.sleep(0.1)\n        " + _SEND),
    ),
    _h(
        "a long sleep after it has published",
        "callback-blocks",
        (_SEND, _SEND + "\n        import time\n        time.sleep(0.7)"),
    ),
    _h(
        "a loop with a sleep for the beat",
        "callback-blocks",
        (
            _SEND,
            "import time\n        for _ in range(2):\n            "
            + _SEND
            + "\n            time.sleep(0.5)",
        ),
        ("0.5, self", "1.0, self"),
    ),
    _h("it destroys itself", "node-ended", (_SEND, _SEND + "\n        self.destroy_node()")),
    _h(
        "it shuts ROS down",
        "gone-quiet",
        ("class H", "import rclpy\n\nclass H"),
        (_SEND, _SEND + "\n        rclpy.shutdown()"),
    ),
    _h("it stops its timer", "gone-quiet", (_SEND, _SEND + "\n        self.timer.cancel()")),
    _h(
        "rclpy.init in the constructor",
        "initialised-twice",
        (_SUP, "rclpy.init()\n        " + _SUP),
    ),
    _h(
        "rclpy.init after super",
        "initialised-twice",
        (_SUP, _SUP + "\n        rclpy.init(args=None)"),
    ),
    _h(
        "rclpy.init in the callback", "initialised-twice", (_SEND, "rclpy.init()\n        " + _SEND)
    ),
    either(
        "03a",
        "ROS is shut down in the constructor",
        ("never-published", "node-ended", "gone-quiet"),
        edited(BEAT, (_TIMER, _TIMER + "\n        rclpy.shutdown()")),
    ),
    _h(
        "a subscription for a publisher",
        "no-publisher",
        (
            _MAKE,
            _MAKE.replace("create_publisher", "create_subscription").replace(
                ", 5", ", self.publish_humidity, 5"
            ),
        ),
    ),
    _h(
        "a subscription without a callback",
        "no-publisher",
        (_MAKE, _MAKE.replace("create_publisher", "create_subscription")),
    ),
    _h(
        "a subscription that works",
        "no-publisher",
        (
            _MAKE,
            _MAKE.replace("create_publisher", "create_subscription").replace(
                ", 5", ", self.hear, 5"
            ),
        ),
        (_SEND, "pass\n\n    def hear(self, msg):\n        pass"),
    ),
    right(
        "03a",
        "main, which starts ROS and gives the node back",
        edited(BEAT)
        + """
def main(args=None):
    rclpy.init(args=args)
    return HumiditySensor()
""",
    ),
    right(
        "03a",
        "ROS started only if it does not run",
        edited(BEAT, (_SUP, "if not rclpy.ok():\n            rclpy.init()\n        " + _SUP)),
    ),
    right(
        "03a",
        "a period from a Duration, and a dict of settings",
        """
    from rclpy.duration import Duration

    SETTINGS = {"topic": "humidity", "depth": 5, "period": Duration(nanoseconds=500_000_000)}

    class HumiditySensor(Node):
        def __init__(self, *, topic=SETTINGS["topic"], depth=SETTINGS["depth"]):
            super().__init__("humidity_sensor")
            self.publisher_ = self.create_publisher(Float32, topic, depth)
            period = SETTINGS["period"].nanoseconds * 1e-9
            self.timer = self.create_timer(period, self.publish_humidity)

        def publish_humidity(self):
            self.publisher_.publish(Float32(data=random.gauss(45.0, 2.0)))
 """,
    ),
    right(
        "03a",
        "a mixin",
        """
    class Ticking:
        def start(self, period):
            self.timer = self.create_timer(period, self.tick)

    class HumiditySensor(Ticking, Node):
        def __init__(self):
            Node.__init__(self, "humidity_sensor")
            self.out = self.create_publisher(Float32, "humidity", 5)
            self.start(0.5)

        def tick(self):
            self.out.publish(Float32(data=45.0))
 """,
    ),
    right(
        "03a",
        "a sleep that costs no beat",
        edited(BEAT, (_SEND, _SEND + "\n        import time\n        time.sleep(0.01)")),
    ),
    _h("a generator that is never advanced", "never-published", (_SEND, "yield " + _SEND)),
    _h("the depth and the period swapped", "wrong-depth", ('"humidity", 5', '"humidity", 2')),
)


def _r(name, *e):
    return right("03b", name, edited(ROOM, *e))


def _w(name, m, *e):
    return wrong("03b", name, m, edited(ROOM, *e))


_ROOMS = (
    _w(
        "back to the middle when it leaves",
        "set-back",
        (_RC, "if not 18.0 <= self.temperature <= 28.0:\n            self.temperature = 23.0"),
    ),
    _w(
        "back to the start when it leaves",
        "set-back",
        (
            _RC,
            "if self.temperature > 28.0 or self.temperature < 18.0:\n"
            "            self.temperature = 22.0",
        ),
    ),
    _w(
        "a degree back from each limit",
        "set-back",
        (
            _RC,
            "if self.temperature > 28.0:\n"
            "            self.temperature = 26.5\n"
            "        if self.temperature < 18.0:\n"
            "            self.temperature = 19.5",
        ),
    ),
    _w(
        "it wraps round",
        "wraps-round",
        (
            _RC,
            "if self.temperature > 28.0:\n"
            "            self.temperature = 18.0\n"
            "        elif self.temperature < 18.0:\n"
            "            self.temperature = 28.0",
        ),
    ),
    _w(
        "it wraps round with a remainder",
        "wraps-round",
        (_RC, "self.temperature = 18.0 + (self.temperature - 18.0) % 10.0"),
    ),
    _w(
        "a window is opened now and then",
        "jumps",
        ("self.temperature = 22.0", "self.temperature = 22.0\n        self.count = 0"),
        (
            _RC,
            "self.count += 1\n"
            "        if self.count % 250 == 0:\n"
            "            self.temperature -= 4.0\n"
            "        " + _RC,
        ),
    ),
    _w(
        "a draught, as chance has it",
        "jumps",
        (
            _RC,
            "if random.random() < 0.01:\n"
            "            self.temperature = random.uniform(18.0, 28.0)\n"
            "        " + _RC,
        ),
    ),
    _w("smaller steps up", "uneven-steps", ("(-0.3, 0.3)", "(-0.3, 0.2)")),
    _w("smaller steps down", "uneven-steps", ("(-0.3, 0.3)", "(-0.1, 0.3)")),
    _w(
        "a slow sine",
        "not-random",
        ("class R", "import math\n\nclass R"),
        ("self.temperature = 22.0", "self.n = 0"),
        (
            f"{_RS}\n        {_RC}",
            "self.n += 1\n        self.temperature = 23.0 + 5.0 * math.sin(0.01 * self.n)",
        ),
    ),
    _w(
        "a sine of a day",
        "not-random",
        ("class R", "import math\n\nclass R"),
        ("self.temperature = 22.0", "self.n = 0"),
        (
            f"{_RS}\n        {_RC}",
            "self.n += 1\n"
            "        self.temperature = 23.0 - 5.0 * math.cos(2 * math.pi * self.n / 600)",
        ),
    ),
    _w(
        "a hundred steps drawn in advance",
        "not-random",
        (
            "self.temperature = 22.0",
            "self.temperature = 22.0\n"
            "        self.steps = [random.uniform(-0.3, 0.3) for _ in range(100)]\n"
            "        self.n = 0",
        ),
        (_RS, "self.temperature += self.steps[self.n % 100]\n        self.n += 1"),
    ),
    _w(
        "a thousand steps drawn in advance",
        "not-random",
        ("class R", "from itertools import cycle\n\nclass R"),
        (
            "self.temperature = 22.0",
            "self.temperature = 22.0\n"
            "        self.steps = cycle([random.uniform(-0.3, 0.3) for _ in range(1000)])",
        ),
        (_RS, "self.temperature += next(self.steps)"),
    ),
    either(
        "03b",
        "a day of readings drawn in advance",
        ("index-error",),
        edited(
            ROOM,
            (
                "self.temperature = 22.0",
                "self.walk = [22.0]\n"
                "        for _ in range(3000):\n"
                "            moved = self.walk[-1] + random.uniform(-0.3, 0.3)\n"
                "            self.walk.append(max(18.0, min(28.0, moved)))",
            ),
            (f"{_RS}\n        {_RC}", "self.temperature = self.walk.pop()"),
        ),
    ),
    _w(
        "around 22, further away",
        "forgets-itself",
        (_RS, "self.temperature = 22.0 + random.uniform(-1.0, 1.0)"),
    ),
    _r(
        "a normal step, cut off at the widest",
        (_RS, "self.temperature += max(-0.3, min(0.3, random.gauss(0.0, 0.2)))"),
    ),
    _r("a beta step", (_RS, "self.temperature += 0.6 * random.betavariate(0.8, 0.8) - 0.3")),
    _r("one of three", (_RS, "self.temperature += random.choice((-0.3, 0.0, 0.3))")),
    _r("tenths", (_RS, "self.temperature += random.randint(-3, 3) / 10")),
    _r(
        "a generator written by hand",
        ("self.temperature = 22.0", "self.temperature, self.state = 22.0, 42"),
        (
            _RS,
            "self.state = (self.state * 1103515245 + 12345) % 2**31\n"
            "        self.temperature += 0.6 * self.state / 2**31 - 0.3",
        ),
    ),
    _r(
        "SystemRandom",
        ("class R", "CHANCE = random.SystemRandom()\n\nclass R"),
        ("random.uniform", "CHANCE.uniform"),
    ),
    _r(
        "a match and a guard",
        (
            _RC,
            "match self.temperature:\n"
            "            case t if t > 28.0:\n"
            "                self.temperature = 28.0\n"
            "            case t if t < 18.0:\n"
            "                self.temperature = 18.0",
        ),
    ),
    _r(
        "numpy's normal, clipped",
        ("class R", "import numpy as np\n\nclass R"),
        (_RS, "self.temperature += float(np.clip(np.random.normal(0.0, 0.2), -0.3, 0.3))"),
    ),
    _r(
        "minus half the range, a sum of two",
        (_RS, "self.temperature += random.uniform(-0.15, 0.15) + random.uniform(-0.15, 0.15)"),
    ),
    _r(
        "steps shuffled anew each time",
        (
            _RS,
            "steps = [-0.3, -0.2, -0.1, 0.1, 0.2, 0.3]\n"
            "        random.shuffle(steps)\n"
            "        self.temperature += steps[0]",
        ),
    ),
    right(
        "03b",
        "a walk in a list, and limits in a tuple",
        """
    class RoomSensor(Node):
        LIMITS = 18.0, 28.0

        def __init__(self):
            super().__init__("temperature_sensor")
            self.history = [22.0]
            self.publisher_ = self.create_publisher(Float32, "temperature", 10)
            self.create_timer(1.0, self.publish_temperature)

        def publish_temperature(self):
            low, high = self.LIMITS
            step = random.uniform(-0.3, 0.3)
            self.history.append(min(max(self.history[-1] + step, low), high))
            msg = Float32()
            msg.data = self.history[-1]
            self.publisher_.publish(msg)
 """,
    ),
    either(
        "03b",
        "the step's limits for the room's",
        ("other-limits", "step-too-small", "forgets-itself", "clamp-swapped"),
        edited(ROOM, (_RC, "self.temperature = max(-0.3, min(0.3, self.temperature))")),
    ),
    _w(
        "rounded to half degrees",
        "step-too-wide",
        ("data=self.temperature", "data=round(self.temperature * 2) / 2"),
    ),
    either(
        "03b",
        "a step for each second that has passed",
        ("step-too-wide",),
        edited(ROOM, (_RS, "self.temperature += random.uniform(-0.3, 0.3) * 2")),
    ),
    either(
        "03b",
        "a new generator with the same seed each time",
        ("one-way", "not-random"),
        edited(ROOM, (_RS, "self.temperature += random.Random(4).uniform(-0.3, 0.3)")),
    ),
)


def _gr(name, *e):
    return right("03c", name, edited(GREENHOUSE, *e))


def _gw(name, m, *e):
    return wrong("03c", name, m, edited(GREENHOUSE, *e))


_GREENHOUSES = (
    _gw(
        "back to the start",
        "set-back",
        (_GC, "if not 10.2 <= self.temperature <= 28.0:\n            self.temperature = 22.0"),
    ),
    _gw(
        "it wraps round",
        "wraps-round",
        (
            _GC,
            "if self.temperature > 28.0:\n"
            "            self.temperature = 10.2\n"
            "        if self.temperature < 10.2:\n"
            "            self.temperature = 28.0",
        ),
    ),
    _gw("smaller steps up", "uneven-steps", ("(-0.5, 0.5)", "(-0.5, 0.3)")),
    _gw(
        "steps drawn in advance",
        "not-random",
        (
            "self.temperature = 22.0",
            "self.temperature = 22.0\n"
            "        self.steps = [random.uniform(-0.5, 0.5) for _ in range(500)]\n"
            "        self.n = 0",
        ),
        (_GS, "self.temperature += self.steps[self.n % 500]\n        self.n += 1"),
    ),
    _gw(
        "a tide",
        "not-random",
        ("class G", "import math\n\nclass G"),
        ("self.temperature = 22.0", "self.n = 0"),
        (
            f"{_GS}\n        {_GC}",
            "self.n += 1\n        self.temperature = 19.1 + 8.9 * math.sin(0.02 * self.n + 0.33)",
        ),
    ),
    _gw(
        "rclpy.init in the constructor",
        "initialised-twice",
        ("super().__init__", "rclpy.init()\n        super().__init__"),
    ),
    _gw(
        "it sleeps for its beat",
        "callback-blocks",
        (
            "self.publisher_.publish(",
            "import time\n        time.sleep(0.25)\n        self.publisher_.publish(",
        ),
        ("0.25, self", "0.1, self"),
    ),
    _gw(
        "a subscription for a publisher",
        "no-publisher",
        ("create_publisher", "create_subscription"),
        (", 10)", ", self.publish_temperature, 10)"),
    ),
    _gr(
        "a NamedTuple of limits",
        (
            "class G",
            "from typing import NamedTuple\n"
            "\n"
            "class Limits(NamedTuple):\n"
            "    low: float = 10.2\n"
            "    high: float = 28.0\n"
            "\n"
            "class G",
        ),
        (_GC, "self.temperature = max(Limits().low, min(Limits().high, self.temperature))"),
    ),
    _gr(
        "numpy's interp for the formula",
        ("class G", "import numpy as np\n\nclass G"),
        (
            "self.temperature * 9 / 5 + 32",
            "float(np.interp(self.temperature, [0.0, 100.0], [32.0, 212.0]))",
        ),
    ),
    _gr(
        "Fahrenheit through Kelvin",
        ("self.temperature * 9 / 5 + 32", "(self.temperature + 273.15) * 1.8 - 459.67"),
    ),
    _gr(
        "a generator of its own",
        ("self.temperature = 22.0", "self.temperature, self.chance = 22.0, random.Random()"),
        ("random.uniform", "self.chance.uniform"),
    ),
    _gr(
        "a generator of numpy's",
        ("class G", "import numpy as np\n\nclass G"),
        (
            "self.temperature = 22.0",
            "self.temperature, self.chance = 22.0, np.random.default_rng()",
        ),
        ("random.uniform(-0.5, 0.5)", "float(self.chance.uniform(-0.5, 0.5))"),
    ),
    right(
        "03c",
        "a queue of two timers, and enum units",
        """
    from enum import Enum

    class Unit(Enum):
        CELSIUS = "C"
        FAHRENHEIT = "F"

        def of(self, celsius):
            return celsius if self is Unit.CELSIUS else celsius * 9 / 5 + 32

    class GreenhouseSensor(Node):
        def __init__(self):
            super().__init__("greenhouse_sensor")
            self.out = self.create_publisher(Float32, "greenhouse/temperature", 10)
            self.celsius, self.even = 22.0, True
            self.create_timer(0.125, self.half)

        def half(self):
            self.even = not self.even
            if self.even:
                self.celsius = min(28.0, max(10.2, self.celsius + random.uniform(-0.5, 0.5)))
                self.out.publish(Float32(data=Unit.FAHRENHEIT.of(self.celsius)))
 """,
    ),
    _gw(
        "the formula's 32 in brackets",
        "wrong-unit",
        ("self.temperature * 9 / 5 + 32", "self.temperature * 9 / (5 + 32)"),
    ),
    _gw(
        "the clamp in Celsius on a copy",
        "clamp-not-kept",
        (_GC, "pass"),
        ("fahrenheit = self.temperature", "fahrenheit = max(10.2, min(28.0, self.temperature))"),
    ),
    _gw("a whole degree", "step-too-wide", ("(-0.5, 0.5)", "(-1, 1)")),
)


def _re(name, mistakes, *e):
    names = (mistakes,) if isinstance(mistakes, str) else mistakes
    return either("03b", name, names, edited(ROOM, *e))


def _ge(name, mistakes, *e):
    names = (mistakes,) if isinstance(mistakes, str) else mistakes
    return either("03c", name, names, edited(GREENHOUSE, *e))


_MORE = (
    right("03a", "a rate object by hand", edited(BEAT, ("0.5", "1.0 / 2"))),
    right(
        "03a",
        "keyword clock and autostart",
        edited(BEAT, ("self.publish_humidity)", "self.publish_humidity, autostart=True)")),
    ),
    right(
        "03a",
        "a one-shot that re-arms by reset",
        """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.pub = self.create_publisher(Float32, "humidity", 5)
            self.t = self.create_timer(0.5, self.go)

        def go(self):
            self.t.cancel()
            self.pub.publish(Float32(data=45.0))
            self.t.reset()
 """,
    ),
    right(
        "03a",
        "a class decorator",
        """
    def named(cls):
        cls.topic = "humidity"
        return cls

    @named
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.publisher_ = self.create_publisher(Float32, self.topic, 5)
            self.timer = self.create_timer(0.5, self.publish_humidity)

        def publish_humidity(self):
            self.publisher_.publish(Float32(data=45.0))
 """,
    ),
    either(
        "03a",
        "three timers in a row",
        ("wrong-rate",),
        edited(
            BEAT,
            (
                "self.timer = self.create_timer(0.5, self.publish_humidity)",
                "for p in (0.5, 1.0, 1.5):\n"
                "            self.create_timer(p, self.publish_humidity)",
            ),
        ),
    ),
    either(
        "03a",
        "it misses every fifth",
        ("wrong-rate",),
        edited(
            BEAT,
            ("self.timer =", "self.n = 0\n        self.timer ="),
            (
                "self.publisher_.publish",
                "self.n += 1\n        if self.n % 5:\n            self.publisher_.publish",
            ),
        ),
    ),
    either(
        "03a",
        "it begins late",
        ("wrong-rate",),
        edited(
            BEAT,
            ("self.timer =", "self.n = 0\n        self.timer ="),
            (
                "self.publisher_.publish",
                "self.n += 1\n        if self.n > 2:\n            self.publisher_.publish",
            ),
        ),
    ),
    either(
        "03a",
        "a subscription besides, broken",
        ("callback-parameters", "callback-missing"),
        edited(
            BEAT,
            (
                "self.timer =",
                'self.create_subscription(Float32, "temperature", self.publish_humidity, 5)\n'
                "        self.timer =",
            ),
        ),
    ),
    either(
        "03a",
        "the publisher is destroyed",
        ("new-to-me", "gone-quiet"),
        edited(
            BEAT,
            (
                "self.publisher_.publish(Float32(data=45.0))",
                "self.publisher_.publish(Float32(data=45.0))\n"
                "        self.destroy_publisher(self.publisher_)",
            ),
        ),
    ),
    either(
        "03a",
        "spin in the callback",
        ("callback-blocks",),
        edited(
            BEAT,
            ("self.publisher_.publish", "rclpy.spin_once(self)\n        self.publisher_.publish"),
        ),
    ),
    _r("momentum-free: mirrored step", (_RS, "self.temperature -= random.uniform(-0.3, 0.3)")),
    _r(
        "two draws, sign and width",
        (_RS, "self.temperature += random.choice([1, -1]) * random.uniform(0.0, 0.3)"),
    ),
    _r(
        "sqrt step",
        (_RS, "self.temperature += random.choice([1, -1]) * 0.3 * random.random() ** 0.5"),
    ),
    _r(
        "clamped by while",
        (
            _RC,
            "while self.temperature > 28.0:\n"
            "            self.temperature = 28.0\n"
            "        while self.temperature < 18.0:\n"
            "            self.temperature = 18.0",
        ),
    ),
    _r(
        "draws again until it fits",
        (
            f"{_RS}\n        {_RC}",
            "while True:\n"
            "            new = self.temperature + random.uniform(-0.3, 0.3)\n"
            "            if 18.0 <= new <= 28.0:\n"
            "                break\n"
            "        self.temperature = new",
        ),
    ),
    _r(
        "a step that shrinks near a limit",
        (
            f"{_RS}\n        {_RC}",
            "low = max(18.0, self.temperature - 0.3)\n"
            "        high = min(28.0, self.temperature + 0.3)\n"
            "        self.temperature = random.uniform(low, high)",
        ),
    ),
    _r(
        "rounded to hundredths, kept",
        (_RC, "self.temperature = round(max(18.0, min(28.0, self.temperature)), 2)"),
    ),
    _r(
        "rounded to hundredths, shown only",
        ("data=self.temperature", "data=round(self.temperature, 2)"),
    ),
    _r(
        "rounded to tenths, kept and of tenths",
        (_RS, "self.temperature += random.randint(-3, 3) / 10"),
        ("data=self.temperature", "data=round(self.temperature, 1)"),
    ),
    _r(
        "starts at a random place",
        ("self.temperature = 22.0", "self.temperature = random.uniform(18.0, 28.0)"),
    ),
    _re(
        "rounded to whole degrees, and kept",
        "never-changes",
        (_RC, "self.temperature = round(max(18.0, min(28.0, self.temperature)), 0)"),
    ),
    _re(
        "goes back to the limit only after a step too many",
        "clamped-too-early",
        (
            f"{_RS}\n        {_RC}",
            "if self.temperature > 28.0:\n"
            "            self.temperature = 28.0\n"
            "        if self.temperature < 18.0:\n"
            f"            self.temperature = 18.0\n        {_RS}",
        ),
    ),
    _re("gauss", "step-too-wide", (_RS, "self.temperature += random.gauss(0.0, 0.3)")),
    _re(
        "momentum",
        ("not-random", "step-too-wide"),
        ("self.temperature = 22.0", "self.temperature = 22.0\n        self.speed = 0.0"),
        (
            _RS,
            "self.speed = max(-0.3, min(0.3, self.speed + random.uniform(-0.02, 0.02)))\n"
            "        self.temperature += self.speed",
        ),
    ),
    _re(
        "limits in the wrong order of size, by if",
        ("no-clamp", "clamp-swapped", "never-changes"),
        (
            _RC,
            "if self.temperature < 28.0:\n"
            "            self.temperature = 28.0\n"
            "        if self.temperature > 18.0:\n"
            "            self.temperature = 18.0",
        ),
    ),
    _re(
        "only the upper half is clamped low",
        ("set-back", "other-limits"),
        (_RC, "if self.temperature > 28.0:\n            self.temperature = 22.0\n        " + _RC),
    ),
    _re(
        "set back at the upper limit, no lower one",
        ("set-back", "no-clamp"),
        (_RC, "if self.temperature > 28.0:\n            self.temperature = 22.0"),
    ),
    _re(
        "a sign flips at the limit and stays",
        ("no-clamp", "not-random"),
        ("self.temperature = 22.0", "self.temperature, self.way = 22.0, 1"),
        (
            f"{_RS}\n        {_RC}",
            "self.temperature += self.way * random.uniform(0.0, 0.3)\n"
            "        if not 18.3 < self.temperature < 27.7:\n"
            "            self.way = -self.way",
        ),
    ),
    _re(
        "it stops after ten minutes",
        "gone-quiet",
        ("self.temperature = 22.0", "self.temperature, self.n = 22.0, 0"),
        (_RSEND, "self.n += 1\n        if self.n < 600:\n            " + _RSEND),
    ),
    _re("abs step", "one-way", (_RS, "self.temperature += abs(random.uniform(-0.3, 0.3))")),
    _r(
        "a step every other time only",
        ("self.temperature = 22.0", "self.temperature, self.n = 22.0, 0"),
        (_RS, "self.n += 1\n        if self.n % 2:\n            " + _RS),
    ),
    _re(
        "starts at the lower limit in Fahrenheit",
        ("no-clamp", "other-limits", "set-back", "jumps"),
        ("= 22.0", "= 72.0"),
        (_RC, "pass"),
    ),
    _re(
        "the clamp on the step",
        ("no-clamp",),
        (
            f"{_RS}\n        {_RC}",
            "step = max(-0.3, min(0.3, random.uniform(-1, 1)))\n        self.temperature += step",
        ),
    ),
    _re(
        "temperature of 22 plus all steps, forgetting the clamp",
        "clamp-not-kept",
        ("self.temperature = 22.0", "self.temperature, self.sum = 22.0, 0.0"),
        (
            f"{_RS}\n        {_RC}",
            "self.sum += random.uniform(-0.3, 0.3)\n"
            "        self.temperature = max(18.0, min(28.0, 22.0 + self.sum))",
        ),
    ),
    _re("uniform of ints", "step-too-wide", (_RS, "self.temperature += random.uniform(-3, 3) / 5")),
    _re("randint", "wrong-values", (_RS, "self.temperature += float(random.randint(-1, 1))")),
    _re(
        "uniform of one sided and minus the mean",
        ("step-too-small",),
        (_RS, "self.temperature += random.uniform(0.0, 0.3) - 0.15"),
    ),
    _gr(
        "step drawn in Fahrenheit units",
        (_GS, "self.temperature += random.uniform(-0.9, 0.9) / 1.8"),
    ),
    _gr("rounded to hundredths of Fahrenheit", ("data=fahrenheit", "data=round(fahrenheit, 2)")),
    _gr(
        "a Decimal",
        ("class G", "from decimal import Decimal\n\nclass G"),
        ("self.temperature * 9 / 5 + 32", "float(Decimal(self.temperature) * 9 / 5 + 32)"),
    ),
    _gr(
        "float32 of numpy",
        ("class G", "import numpy as np\n\nclass G"),
        ("data=fahrenheit", "data=float(np.float32(fahrenheit))"),
    ),
    _ge(
        "whole Fahrenheit kept",
        ("converted-back", "wrong-values", "step-too-wide"),
        (
            "fahrenheit = self.temperature * 9 / 5 + 32",
            "fahrenheit = float(int(self.temperature * 9 / 5 + 32))",
        ),
    ),
    _ge(
        "upper limit in Fahrenheit, lower in Celsius",
        ("other-limits", "no-clamp", "wrong-unit"),
        ("self.temperature = 22.0", "self.temperature = 71.6"),
        ("(-0.5, 0.5)", "(-0.9, 0.9)"),
        ("max(10.2, min(28.0, ", "max(10.2, min(82.4, "),
        (" * 9 / 5 + 32", ""),
    ),
    _ge(
        "steps in Celsius on a walk in Fahrenheit",
        "step-too-small",
        ("self.temperature = 22.0", "self.temperature = 71.6"),
        ("max(10.2, min(28.0, ", "max(50.36, min(82.4, "),
        (" * 9 / 5 + 32", ""),
    ),
    _ge("limits of the room", "other-limits", ("max(10.2", "max(18.0")),
    _ge(
        "32 added before it is multiplied",
        "wrong-unit",
        ("self.temperature * 9 / 5 + 32", "(32 + self.temperature) * 1.8"),
    ),
)

ANSWERS = (*_BEATS, *_ROOMS, *_GREENHOUSES, *_MORE)

"""Page 09: answers that were written from the page alone, and neighbours of those found wanting."""

from bank.answer import edited, right, wrong
from bank.beyond import anywhere_right, silence_right, worker_wrong


def _silence(name, mistake, *edits):
    return wrong("09a", name, mistake, edited(silence_right.BASE, *edits))


def _work(name, mistake, *edits):
    return wrong("09b", name, mistake, edited(worker_wrong.TIMED, *edits))


def _place(name, mistake, *edits):
    return wrong("09c", name, mistake, edited(anywhere_right.BASE, *edits))


_UNIT = 'self.declare_parameter("unit", "C")'

ANSWERS = (
    # 09a, right.
    right("09a", "the count of readings is compared by a timer", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.heard, self.before, self.quiet, self.lost = 0, 0, 0, False
                self.create_timer(0.25, self.look)

            def hear(self, msg):
                self.heard += 1

            def look(self):
                if self.heard != self.before:
                    self.before, self.quiet = self.heard, 0
                    if self.lost:
                        self.say("back")
                elif self.heard:
                    self.quiet += 1
                    if self.quiet >= 12 and not self.lost:
                        self.say("lost")

            def say(self, word):
                self.lost = word == "lost"
                self.statuses.publish(String(data=word))
    '''),
    right("09a", "a helper class with a property, and nanoseconds", '''
        class Silence:
            def __init__(self, clock, seconds):
                self.clock, self.limit, self.last = clock, int(seconds * 10**9), None

            def broken(self):
                self.last = self.clock.now().nanoseconds

            @property
            def lasts(self):
                return (self.last is not None
                        and self.clock.now().nanoseconds - self.last >= self.limit)

        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.silence, self.lost = Silence(self.get_clock(), 3), False
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_timer(0.1, self.look)

            def hear(self, msg):
                self.silence.broken()
                self.set_lost(False)

            def look(self):
                self.set_lost(self.silence.lasts)

            def set_lost(self, lost):
                if lost is not self.lost:
                    self.lost = lost
                    self.statuses.publish(String(data="lost" if lost else "back"))
    '''),
    # 09a, wrong.
    wrong("09a", "it sleeps for three seconds in the callback", "callback-blocks", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.count = 0

            def hear(self, msg):
                self.count += 1
                before = self.count
                time.sleep(3)
                if self.count == before:
                    self.statuses.publish(String(data="lost"))
    '''),
    _silence("it sleeps before it says back", "callback-blocks",
             ("self.last = self.get_clock().now()", "self.last = self.get_clock().now()\n"
              "        time.sleep(3)")),
    _silence("a letter of one word is a capital", "wrong-word", ('"back"', '"Back"')),
    _silence("every second silence", "silence-unnoticed",
             ("self.lost = True\n            self.statuses.publish",
              "self.lost = True\n            self.n = getattr(self, 'n', 0) + 1\n"
              "            if self.n % 2: self.statuses.publish")),
    # 09b, right.
    right("09b", "a dataclass, a property and a helper class", '''
        from collections import deque
        from dataclasses import dataclass, field

        @dataclass
        class Oven:
            node: Node
            done: object
            orders: deque = field(default_factory=deque)
            timer: object = None

            @property
            def busy(self):
                return self.timer is not None

            def order(self, number):
                self.orders.append(number)
                if not self.busy:
                    self.start()

            def start(self):
                self.timer = self.node.create_timer(3.0, self.ready)

            def ready(self):
                self.timer.destroy()
                self.timer = None
                self.done(self.orders.popleft())
                if self.orders:
                    self.start()

        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                beats = self.create_publisher(String, "beat", 10)
                dones = self.create_publisher(Int32, "done", 10)
                oven = Oven(self, lambda number: dones.publish(Int32(data=number)))
                self.create_timer(1.0, lambda: beats.publish(String(data="still here")))
                self.create_subscription(Int32, "order", lambda msg: oven.order(msg.data), 10)
    '''),
    right("09b", "the end of each order is calculated when it comes", '''
        class SteadyWorker(Node):
            def __init__(self):
                super().__init__("steady_worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, self.beat)
                self.create_timer(0.05, self.look)
                self.create_subscription(Int32, "order", self.take, 10)
                self.plan, self.free = {}, 0

            @property
            def now(self):
                return self.get_clock().now().nanoseconds

            def beat(self):
                self.beats.publish(String(data=f"{len(self.plan)} orders"))

            def take(self, msg):
                self.free = max(self.free, self.now) + 3 * 10**9
                self.plan[msg.data] = self.free

            def look(self):
                for number in [one for one, end in self.plan.items() if end <= self.now]:
                    del self.plan[number]
                    self.dones.publish(Int32(data=number))
    '''),
    right("09b", "inheritance: a heart, and a worker with a heart", '''
        class Heart(Node):
            def __init__(self, name):
                super().__init__(name)
                self.beats = self.create_publisher(String, "beat", 10)
                self.heart = self.create_timer(1.0, self.beat)

            def beat(self):
                self.beats.publish(String(data="alive"))

        class SteadyWorker(Heart):
            def __init__(self):
                super().__init__("steady_worker")
                self.queue = []
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_subscription(Int32, "order", self.take, 10)
                self.work = self.create_timer(3.0, self.finish, autostart=False)

            def take(self, msg):
                self.queue += [msg]
                if len(self.queue) == 1:
                    self.work.reset()

            def finish(self):
                self.work.cancel()
                self.dones.publish(self.queue.pop(0))
                if self.queue:
                    self.work.reset()
    '''),
    # 09b, wrong.
    _work("half a second too long", "work-too-long", ("create_timer(3.0", "create_timer(3.5")),
    _work("it stops after the first order", "order-lost",
          ("if self.oven.is_canceled():",
           "if not hasattr(self, 'begun'):\n            self.begun = True")),
    _work("one too many to begin with", "wrong-values",
          ("self.waiting = []", "self.waiting = [0]")),
    # 09c, right.
    right("09c", "round, join and a dict of parameters", '''
        class AnyMonitor(Node):
            DEFAULTS = {"low": 20.0, "high": 26.0, "unit": "C"}

            def __init__(self):
                super().__init__("any_monitor")
                for name, value in self.DEFAULTS.items():
                    self.declare_parameter(name, value)
                self.pub = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "reading", self.listen, 10)

            def __getitem__(self, name):
                return self.get_parameter(name).value

            def listen(self, msg):
                words = {msg.data > self["high"]: "High", msg.data < self["low"]: "Low"}
                parts = words.get(True, "Normal"), str(round(msg.data, 2)), self["unit"]
                self.pub.publish(String(data=" ".join(parts)))
    '''),
    right("09c", "numpy, and properties", '''
        import numpy as np

        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                declared = [("low", 20.0), ("high", 26.0), ("unit", "C")]
                self.declare_parameters("", declared)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "reading", self.hear, 10)

            @property
            def settings(self):
                return [one.value for one in self.get_parameters(["low", "high", "unit"])]

            def hear(self, msg):
                low, high, unit = self.settings
                side = int(np.sign(msg.data - np.clip(msg.data, low, high)))
                word = {-1: "Low", 0: "Normal", 1: "High"}[side]
                self.out.publish(String(data=f"{word} {np.round(msg.data, 1):.1f} {unit}"))
    '''),
    # 09c, wrong.
    _place("a colon behind the word", "wrong-form", ("{word} {", "{word}: {")),
    _place("a degree sign before the unit", "wrong-form",
           ("{self.value_of('unit')}", "°{self.value_of('unit')}")),
    _place("no unit is declared", "unit-fixed", (_UNIT, 'self.unit = "C"'),
           ("{self.value_of('unit')}", "{self.unit}")),
    _place("units for unit", "unit-fixed", ('"unit"', '"units"'), ("'unit'", "'units'")),
)  # fmt: skip

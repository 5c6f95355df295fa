"""09b, work, and go on beating: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.worker_right import BASE

_STEP = "self.create_timer(0.5, self.step)"
_BEAT = "self.create_timer(1.0, self.beat)"
_DONE = "self.dones.publish(Int32(data=self.waiting.pop(0)))"
_ALIVE = 'self.beats.publish(String(data="alive"))'
_APPEND = "self.waiting.append(msg.data)"

BUSY = """
    class Worker(Node):
        def __init__(self):
            super().__init__("worker")
            self.beats = self.create_publisher(String, "beat", 10)
            self.dones = self.create_publisher(Int32, "done", 10)
            self.create_timer(1.0, self.beat)
            self.create_subscription(Int32, "order", self.work, 10)

        def beat(self):
            self.beats.publish(String(data="alive"))

        def work(self, msg):
            time.sleep(3.0)
            self.dones.publish(Int32(data=msg.data))
"""
_SLEEP = "time.sleep(3.0)"

TIMED = """
    class Worker(Node):
        def __init__(self):
            super().__init__("worker")
            self.beats = self.create_publisher(String, "beat", 10)
            self.dones = self.create_publisher(Int32, "done", 10)
            self.create_timer(1.0, self.beat)
            self.create_subscription(Int32, "order", self.take, 10)
            self.waiting = []
            self.oven = self.create_timer(3.0, self.finish)
            self.oven.cancel()

        def beat(self):
            self.beats.publish(String(data="alive"))

        def take(self, msg):
            self.waiting.append(msg.data)
            if self.oven.is_canceled():
                self.oven.reset()

        def finish(self):
            self.dones.publish(Int32(data=self.waiting.pop(0)))
            if not self.waiting:
                self.oven.cancel()
"""


def _wrong(name, mistake, *edits, base=BASE):
    return wrong("09b", name, mistake, edited(base, *edits))


def _either(name, mistakes, *edits, base=BASE):
    return either("09b", name, mistakes, edited(base, *edits))


_THREAD = """
    class Worker(Node):
        def __init__(self):
            super().__init__("worker")
            self.beats = self.create_publisher(String, "beat", 10)
            self.dones = self.create_publisher(Int32, "done", 10)
            self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
            self.create_subscription(Int32, "order", self.take, 10)

        def take(self, msg):
            def work():
                time.sleep(0.2)
                self.dones.publish(msg)

            threading.Thread(target=work).start()
"""

ANSWERS = (
    wrong("09b", "a beat that is a little too fast", "wrong-rate",
          edited(BASE, (_BEAT, "self.create_timer(0.95, self.beat)"))),
    # The exercise's own mistakes.
    _wrong("as it was", "beat-starved", base=BUSY),
    _wrong("many short sleeps", "beat-starved",
           (_SLEEP, "for _ in range(30):\n            time.sleep(0.1)"), base=BUSY),
    _wrong("it beats itself while it works, and late", "beat-starved",
           (_SLEEP, "for _ in range(3):\n            time.sleep(1.0)\n            self.beat()"),
           base=BUSY),
    _wrong("the node's clock sleeps", "beat-starved",
           ("class W", "from rclpy.duration import Duration\n\nclass W"),
           (_SLEEP, "self.get_clock().sleep_for(Duration(seconds=3.0))"), base=BUSY),
    _wrong("another callback group alone changes nothing", "beat-starved",
           ("self.work, 10", "self.work, 10, callback_group=ReentrantCallbackGroup()"), base=BUSY),
    _wrong("it sleeps in a step", "beat-starved",
           ("self.left += 1\n        if self.left > 6:\n            self.left = 0\n            ",
            "time.sleep(3.0)\n        ")),
    _wrong("it counts real time", "callback-blocks",
           (_SLEEP, "until = time.monotonic() + 3.0\n        while time.monotonic() < until:\n"
                    "            pass"), base=BUSY),
    _wrong("a thread of its own", "never-published",
           # It lives longer than the check: what it does then is nobody's business.
           (_SLEEP, "threading.Thread(target=self.later, args=(msg,), daemon=True).start()\n\n"
                    "    def later(self, msg):\n        time.sleep(3.0)\n"
                    "        with suppress(Exception):\n            self.report(msg)\n\n"
                    "    def report(self, msg):"),
           ("class W", "from contextlib import suppress\n\nclass W"), base=BUSY),
    _wrong("3.9 seconds", "work-too-long", ("create_timer(3.0", "create_timer(3.9"), base=TIMED),
    _wrong("3.4 seconds", "work-too-long", ("create_timer(3.0", "create_timer(3.4"), base=TIMED),
    _wrong("2.9 seconds", "work-too-short", ("create_timer(3.0", "create_timer(2.9"), base=TIMED),
    _wrong("a second", "work-too-short", ("create_timer(3.0", "create_timer(1.0"), base=TIMED),
    _wrong("only two orders may wait", "order-lost",
           (_APPEND, f"if len(self.waiting) < 3:\n            {_APPEND}"), base=TIMED),
    _wrong("only one order may wait", "order-lost",
           (_APPEND, f"if len(self.waiting) < 2:\n            {_APPEND}"), base=TIMED),
    _wrong("the third order is dropped", "order-lost",
           (_APPEND, "self.count = getattr(self, 'count', 0) + 1\n        if self.count != 3:\n"
                     f"            {_APPEND}"), base=TIMED),
    _wrong("a list that is empty now and then", "index-error",
           ("        if not self.waiting:\n            self.oven.cancel()", "        pass"),
           base=TIMED),
    _wrong("threads that raise when all is over", "never-published", base=_THREAD),
    _wrong("it does not work at all", "work-too-short", (_SLEEP, "pass"), base=BUSY),
    _wrong("two seconds", "work-too-short", ("> 6", "> 3")),
    _wrong("a timer that runs on and is never begun anew", "work-too-short",
           ("        self.oven.cancel()\n\n    def beat", "\n    def beat"),
           ("self.dones.publish", "if not self.waiting:\n            return\n        "
                                  "self.dones.publish"),
           ("        if not self.waiting:\n            self.oven.cancel()", "        pass"),
           ("        if self.oven.is_canceled():\n            self.oven.reset()", "        pass"),
           base=TIMED),
    _wrong("six seconds", "work-too-long", ("> 6", "> 12")),
    _wrong("each order begins the three seconds anew", "work-too-long",
           ("        if self.oven.is_canceled():\n            self.oven.reset()",
            "        self.oven.reset()"), base=TIMED),
    _wrong("a timer for each order, all at once", "work-at-once",
           (_APPEND, "timer = self.create_timer(3.0, lambda: self.ready(timer, msg))"),
           ("def step", "def ready(self, timer, msg):\n        timer.cancel()\n"
                        "        self.dones.publish(msg)\n\n    def step")),
    _wrong("all that wait are done together", "work-at-once",
           (_DONE, "for number in self.waiting:\n"
                   "                self.dones.publish(Int32(data=number))\n"
                   "            self.waiting = []")),
    _wrong("the newest order only", "order-lost", (_APPEND, "self.waiting = [msg.data]")),
    _wrong("no orders while it works", "order-lost",
           (_APPEND, "if not self.waiting:\n            self.waiting.append(msg.data)")),
    _wrong("the list is emptied", "order-lost", (_DONE, _DONE + "\n            self.waiting = []")),
    _wrong("the newest first", "order-swapped", ("pop(0)", "pop()")),
    _wrong("the smallest first", "order-swapped",
           (_APPEND, _APPEND + "\n        self.waiting.sort()")),
    _wrong("it reports twice", "done-twice",
           (_DONE, "self.dones.publish(Int32(data=self.waiting[0]))\n            " + _DONE)),
    _wrong("a timer that is never stopped", "done-twice",
           (_APPEND, "self.create_timer(3.0, lambda: self.dones.publish(msg))")),
    _wrong("it counts the orders", "wrong-values",
           (_DONE, "self.waiting.pop(0)\n            self.number = getattr(self, 'number', 0) + 1\n"
                   "            self.dones.publish(Int32(data=self.number))")),
    _wrong("two beats a second", "wrong-rate", ("1.0, self.beat", "0.5, self.beat")),
    _wrong("a beat every two seconds", "wrong-rate", ("1.0, self.beat", "2.0, self.beat")),
    _wrong("a beat with each step", "wrong-rate",
           ("self.left += 1", "self.left += 1\n        self.beat()")),
    _wrong("it beats only while there is nothing to do", "beat-starved",
           (_ALIVE, f"if not self.waiting:\n            {_ALIVE}")),
    _wrong("nobody beats", "never-published", (_ALIVE, "pass")),
    _wrong("nobody finishes", "never-published", (_STEP, "pass")),
    # The thirty.
    _wrong("a letter wrong", "topic-misspelled", ('"done"', '"dones"')),
    _wrong("a letter wrong in the beat", "topic-misspelled", ('"beat"', '"beats"')),
    _wrong("a letter wrong where it listens", "topic-misspelled", ('"order"', '"orders"')),
    _wrong("another topic to beat on", "wrong-topic", ('"beat"', '"heart"')),
    _wrong("a text for a number", "type-mismatch",
           ('(Int32, "done"', '(String, "done"'),
           ("Int32(data=self.waiting.pop(0))", "String(data=str(self.waiting.pop(0)))")),
    _wrong("a number for a beat", "type-mismatch",
           ('(String, "beat"', '(Int32, "beat"'), ('String(data="alive")', "Int32(data=1)")),
    _wrong("it hears another type", "type-mismatch", ('(Int32, "order"', '(Float32, "order"')),
    _wrong("the number published", "number-published",
           ("Int32(data=self.waiting.pop(0))", "self.waiting.pop(0)")),
    _wrong("a text in the number", "not-a-float",
           ("Int32(data=self.waiting.pop(0))", "Int32(data=str(self.waiting.pop(0)))")),
    _wrong("the callback called", "callback-called", ("self.take, 10", "self.take(), 10")),
    _wrong("the timer's callback called", "callback-called",
           ("0.5, self.step", "0.5, self.step()")),
    _wrong("no depth", "depth-missing", ('"done", 10', '"done"')),
    _wrong("nothing to take from", "index-error",
           ("if not self.waiting:\n            return\n        ", "")),
    _wrong("nothing that listens", "no-subscription",
           ('self.create_subscription(Int32, "order", self.take, 10)', "pass")),
    # Pairs.
    _either("two seconds, newest first", ("work-too-short", "order-swapped"),
            ("> 6", "> 3"), ("pop(0)", "pop()")),
    _either("asleep, and the newest only", ("beat-starved", "order-lost"),
            ("self.left += 1\n        if self.left > 6:\n            self.left = 0\n            ",
             "time.sleep(3.0)\n        "),
            (_APPEND, "self.waiting = [msg.data]")),
    _either("two beats a second, and no work", ("wrong-rate", "work-too-short"),
            ("1.0, self.beat", "0.5, self.beat"), (_SLEEP, "pass"), base=BUSY),
    _either("nobody beats, nobody works", ("never-published", "no-timer", "wrong-rate"),
            (_BEAT, "pass"), (_STEP, "pass")),
)  # fmt: skip

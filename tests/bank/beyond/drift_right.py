"""11c, compare two sensors: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class DriftWatch(Node):
        def __init__(self):
            super().__init__("drift_watch")
            self.create_subscription(Float32, "reference", self.remember, 10)
            self.create_subscription(Float32, "temperature", self.compare, 10)
            self.alarms = self.create_publisher(String, "fault", 10)
            self.reference = math.nan
            self.last = []
            self.drifts = False

        def remember(self, msg):
            self.reference = msg.data

        def compare(self, msg):
            difference = msg.data - self.reference
            if math.isnan(difference):
                return
            self.last = [*self.last, difference][-10:]
            mean = sum(self.last) / len(self.last)
            drifts = len(self.last) == 10 and abs(mean) > 1.0
            if drifts and not self.drifts:
                self.alarms.publish(String(data="drift"))
            self.drifts = drifts
"""


def _right(name, *edits):
    return right("11c", name, edited(BASE, *edits))


ANSWERS = (
    _right("as on the page"),
    _right("the other way round", ("msg.data - self.reference", "self.reference - msg.data")),
    _right("absolute names", ('"reference"', '"/reference"'), ('"fault"', '"/fault"')),
    _right("None until there is a reference",
           ("self.reference = math.nan", "self.reference = None"),
           ("difference = msg.data", "if self.reference is None:\n            return\n"
                                     "        difference = msg.data")),
    _right("all differences are kept", ("[*self.last, difference][-10:]",
                                        "[*self.last, difference]"),
           ("sum(self.last) / len(self.last)", "sum(self.last[-10:]) / 10"),
           ("len(self.last) == 10", "len(self.last) >= 10")),
    _right("at least 1 degree", ("> 1.0", ">= 1.0")),
    _right("numbers are asked for", ("if math.isnan(difference):", "if difference != difference:")),
    right("11c", "a deque and a mean", '''
        from collections import deque
        from statistics import fmean

        class Watch(Node):
            def __init__(self):
                super().__init__("watch")
                self.pairs, self.newest, self.state = deque(maxlen=10), None, "well"
                self.out = self.create_publisher(String, "fault", 10)
                for topic, callback in (("reference", self.on_reference),
                                        ("temperature", self.on_temperature)):
                    self.create_subscription(Float32, topic, callback, 10)

            def on_reference(self, msg):
                self.newest = msg.data

            def on_temperature(self, msg):
                if self.newest is None or math.isnan(msg.data) or math.isnan(self.newest):
                    return
                self.pairs.append(msg.data - self.newest)
                if len(self.pairs) < 10:
                    return
                state = "drift" if not -1.0 <= fmean(self.pairs) <= 1.0 else "well"
                if state != self.state and state == "drift":
                    self.out.publish(String(data=state))
                self.state = state
    '''),
    right("11c", "one callback for both, a running sum", '''
        from functools import partial

        class Watch(Node):
            def __init__(self):
                super().__init__("watch")
                self.out = self.create_publisher(String, "fault", 10)
                self.seen, self.queue, self.total, self.spoke = {}, [], 0.0, False
                for name in ("temperature", "reference"):
                    self.create_subscription(Float32, name, partial(self.hear, name), 10)

            def hear(self, name, msg):
                self.seen[name] = msg.data
                if name != "temperature" or any(math.isnan(x) for x in self.seen.values()):
                    return
                if len(self.seen) < 2:
                    return
                self.queue.append(self.seen["temperature"] - self.seen["reference"])
                self.total += self.queue[-1]
                if len(self.queue) > 10:
                    self.total -= self.queue.pop(0)
                self.report(len(self.queue) == 10 and abs(self.total / 10) > 1)

            def report(self, bad):
                if bad > self.spoke:
                    self.out.publish(String(data="drift"))
                self.spoke = bad
    '''),
    right("11c", "numpy, async", '''
        import numpy as np

        class Watch(Node):
            def __init__(self):
                super().__init__("watch")
                self.out = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.temperature, 10)
                self.create_subscription(Float32, "reference", self.note, 10)
                self.ref, self.buffer, self.count, self.was = np.nan, np.zeros(10), 0, False

            async def note(self, msg):
                self.ref = msg.data

            async def temperature(self, msg):
                off = msg.data - self.ref
                if np.isnan(off):
                    return
                self.buffer[self.count % 10] = off
                self.count += 1
                now = bool(self.count >= 10 and abs(self.buffer.mean()) > 1.0)
                if now and not self.was:
                    self.out.publish(String(data="drift"))
                self.was = now
    '''),
    right("11c", "a class that judges", '''
        class Judge:
            def __init__(self, width, limit):
                self.width, self.limit = width, limit
                self.values, self.bad = [], False

            def __call__(self, value):
                self.values = (self.values + [value])[-self.width:]
                before, self.bad = self.bad, self.is_bad()
                return self.bad and not before

            def is_bad(self):
                full = len(self.values) == self.width
                return full and abs(sum(self.values)) > self.limit * self.width

        class Watch(Node):
            def __init__(self):
                super().__init__("watch")
                self.judge, self.reference = Judge(10, 1.0), None
                self.fault = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "reference", self.ref, 10)
                self.create_subscription(Float32, "temperature", self.temp, 10)

            def ref(self, msg):
                self.reference = msg.data

            def temp(self, msg):
                if self.reference is not None and not math.isnan(msg.data - self.reference):
                    if self.judge(msg.data - self.reference):
                        self.fault.publish(String(data="drift"))
    '''),
)  # fmt: skip

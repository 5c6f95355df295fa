"""11a, 11b and 11c: more answers, written from the page alone."""

from bank.answer import edited, right, wrong
from bank.beyond.drift_right import BASE as DRIFT
from bank.beyond.look_into import BASE as LOOK
from bank.beyond.watchdog_right import BASE as WATCHDOG


def _look(name, mistake, *edits):
    return wrong("11a", name, mistake, edited(LOOK, *edits))


def _watchdog(name, mistake, *edits):
    return wrong("11b", name, mistake, edited(WATCHDOG, *edits))


def _drift(name, mistake, *edits):
    return wrong("11c", name, mistake, edited(DRIFT, *edits))


FINDINGS = (
    right(
        "11a",
        "a dataclass",
        """
        from dataclasses import asdict, dataclass

        @dataclass
        class Findings:
            messages: int = 0
            gap: float = 0.0
            mean: float = 0.0

        def look_into(bag):
            seen = list(bag.messages("/temperature"))
            good = [one.value for one in seen if one.value == one.value]
            found = Findings(messages=len(seen), mean=sum(good) / len(good))
            for before, after in zip(seen[:-1], seen[1:]):
                found.gap = max(found.gap, after.time - before.time)
            return asdict(found)
    """,
    ),
    right(
        "11a",
        "nested functions and map",
        """
        def look_into(bag):
            def times():
                return [one.time for one in bag.messages("temperature")]

            def numbers():
                values = map(lambda one: one.value, bag.messages("temperature"))
                return list(filter(math.isfinite, values))

            longest = max(map(lambda pair: pair[1] - pair[0], zip(times(), times()[1:])))
            return {"gap": longest, "mean": math.fsum(numbers()) / len(numbers()),
                    "messages": len(times())}
    """,
    ),
    right(
        "11a",
        "a callable object",
        """
        class Look:
            def __call__(self, bag):
                rows = sorted((one.time, one.value) for one in bag.messages("temperature"))
                gaps = [rows[n + 1][0] - rows[n][0] for n in range(len(rows) - 1)]
                values = [value for _, value in rows if not math.isnan(value)]
                return {"messages": len(rows), "gap": max(gaps, default=0.0),
                        "mean": sum(values) / max(len(values), 1)}
    """,
        "Look()",
    ),
    right(
        "11a", "rounded to three decimals", edited(LOOK, ('"mean": mean', '"mean": round(mean, 3)'))
    ),
    _look("a name with a capital", "key-missing", ('"messages"', '"Messages"')),
    _look(
        "NaN becomes the reading before",
        "wrong-values",
        (
            "numbers = [one.value for one in readings if not math.isnan(one.value)]",
            "numbers = []\n    for one in readings:\n"
            "        last = numbers[-1] if numbers else 20.0\n"
            "        numbers.append(last if math.isnan(one.value) else one.value)",
        ),
    ),
    _look(
        "the second longest gap",
        "wrong-values",
        ('"gap": max(gaps)', '"gap": sorted(gaps)[-2] if len(gaps) > 1 else 0.0'),
    ),
    _look("gaps in whole seconds", "wrong-values", ('"gap": max(gaps)', '"gap": int(max(gaps))')),
    _look("the largest reading", "wrong-values", ('"mean": mean', '"mean": max(numbers)')),
)

ALARMS = (
    right(
        "11b",
        "a counter that is a property",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.numbers = []
                self.out = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", lambda m: self.take(m.data), 10)

            @property
            def equal(self):
                count = 0
                for value in reversed(self.numbers):
                    if value != self.numbers[-1]:
                        break
                    count += 1
                return count

            def take(self, value):
                for word in self.faults(value):
                    self.out.publish(String(data=word))

            def faults(self, value):
                if math.isnan(value):
                    return ["nan"]
                self.numbers.append(value)
                jumped = len(self.numbers) > 1 and not -5 <= value - self.numbers[-2] <= 5
                return ["jump"] * jumped + ["stuck"] * (self.equal == 5)
    """,
    ),
    right(
        "11b",
        "three detectors",
        """
        class NanDetector:
            word = "nan"

            def faulty(self, value):
                return value != value

        class JumpDetector:
            word, last = "jump", None

            def faulty(self, value):
                if math.isnan(value):
                    return False
                before, self.last = self.last, value
                return before is not None and abs(value - before) > 5

        class StuckDetector:
            word, last, left = "stuck", None, 4

            def faulty(self, value):
                if math.isnan(value):
                    return False
                self.left = self.left - 1 if value == self.last else 4
                self.last = value
                return self.left == 0

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.detectors = [NanDetector(), JumpDetector(), StuckDetector()]
                self.pub = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                for one in self.detectors:
                    if one.faulty(msg.data):
                        self.pub.publish(String(data=one.word))
    """,
    ),
    right(
        "11b",
        "groupby over all numbers",
        """
        from itertools import groupby

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                pub, numbers = self.create_publisher(String, "fault", 10), []

                def listen(msg):
                    if math.isnan(msg.data):
                        pub.publish(String(data="nan"))
                        return
                    numbers.append(msg.data)
                    if abs(numbers[-1] - (numbers[-2:] or [0])[0]) > 5:
                        pub.publish(String(data="jump"))
                    lengths = [len(list(group)) for _, group in groupby(numbers)]
                    if lengths[-1] == 5:
                        pub.publish(String(data="stuck"))

                self.create_subscription(Float32, "temperature", listen, 10)
    """,
    ),
    right(
        "11b",
        "reading by best effort",
        edited(
            WATCHDOG,
            ("self.listen, 10", "self.listen, qos_profile_sensor_data"),
            ("class W", "from rclpy.qos import qos_profile_sensor_data\n\nclass W"),
        ),
    ),
    _watchdog("NaN with capitals", "wrong-word", ('"nan"', '"NaN"')),
    _watchdog("more than six degrees", "other-limits", ("> 5.0", "> 6.0")),
    _watchdog("seven equal readings", "counted-wrong", ("self.equal == 5", "self.equal == 7")),
    _watchdog(
        "its memory begins with 25", "alarm-at-start", ("self.last = None", "self.last = 25.0")
    ),
    _watchdog("stuck instead of jump", "wrong-word", ('self.say("jump")', 'self.say("stuck")')),
)

DRIFTS = (
    right(
        "11c",
        "two deques and a generator",
        """
        from collections import deque

        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.pairs = deque(maxlen=10)
                self.newest = {}
                self.pub = self.create_publisher(String, "fault", 10)
                for topic in ("reference", "temperature"):
                    self.create_subscription(
                        Float32, topic, lambda msg, topic=topic: self.take(topic, msg.data), 10
                    )
                self.alarm = self.alarms()
                next(self.alarm)

            def take(self, topic, value):
                self.newest[topic] = value
                if topic == "temperature" and "reference" in self.newest:
                    difference = value - self.newest["reference"]
                    if difference == difference:
                        self.pairs.append(difference)
                        self.alarm.send(sum(self.pairs) / 10 if len(self.pairs) == 10 else 0)

            def alarms(self):
                before = False
                while True:
                    mean = yield
                    now = not -1 <= mean <= 1
                    if now and not before:
                        self.pub.publish(String(data="drift"))
                    before = now
    """,
    ),
    right(
        "11c",
        "a window of its own, and inheritance",
        """
        class Window:
            def __init__(self, size):
                self.size, self.values = size, []

            def add(self, value):
                self.values.append(value)
                del self.values[:-self.size]

            @property
            def mean(self):
                return sum(self.values) / self.size if len(self.values) == self.size else None

        class Pairs(Node):
            reference = None

            def __init__(self, name):
                super().__init__(name)
                self.create_subscription(Float32, "temperature", self.on_temperature, 10)
                self.create_subscription(Float32, "reference", self.on_reference, 10)

            def on_reference(self, msg):
                self.reference = msg.data

            def on_temperature(self, msg):
                if self.reference is None or math.isnan(self.reference) or math.isnan(msg.data):
                    return
                self.on_pair(msg.data - self.reference)

        class DriftWatch(Pairs):
            def __init__(self):
                self.window, self.armed = Window(10), True
                super().__init__("drift_watch")
                self.out = self.create_publisher(String, "fault", 10)

            def on_pair(self, difference):
                self.window.add(difference)
                mean = self.window.mean
                if mean is None:
                    return
                if abs(mean) <= 1.0:
                    self.armed = True
                elif self.armed:
                    self.armed = False
                    self.out.publish(String(data="drift"))
    """,
    ),
    right(
        "11c",
        "ten places in a ring",
        """
        import numpy as np

        class DriftWatch(Node):
            def __init__(self):
                super().__init__("drift_watch")
                self.ring, self.count = np.zeros(10), 0
                self.reference, self.state = float("nan"), "fine"
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.create_subscription(Float32, "temperature", self.compare, 10)
                self.out = self.create_publisher(String, "fault", 10)

            def remember(self, msg):
                self.reference = msg.data

            def compare(self, msg):
                if np.isnan([msg.data, self.reference]).any():
                    return
                self.ring[self.count % 10] = msg.data - self.reference
                self.count += 1
                before = self.state
                self.state = "drift" if self.count >= 10 and abs(self.ring.mean()) > 1 else "fine"
                if (before, self.state) == ("fine", "drift"):
                    self.out.publish(String(data=self.state))
    """,
    ),
    _drift("a capital", "wrong-word", ('data="drift"', 'data="Drift"')),
    _drift("a limit of one and a half", "other-limits", ("> 1.0", "> 1.5")),
    _drift("twenty pairs", "wrong-window", ("-10:", "-20:"), ("== 10", "== 20")),
    _drift("eight pairs", "wrong-window", ("-10:", "-8:"), ("== 10", "== 8")),
    _drift("a reference of 20", "wrong-start", ("math.nan", "20.0")),
    _drift(
        "each pair alone, not full",
        "wrong-window",
        ("[*self.last, difference][-10:]", "[difference]"),
        ("len(self.last) == 10 and ", ""),
    ),
)

ANSWERS = (*FINDINGS, *ALARMS, *DRIFTS)

"""08a, 08b and 08c: more answers, written from the page alone."""

from bank.answer import edited, right, wrong
from bank.beyond.archive_right import BASE as ARCHIVE
from bank.beyond.deadline_right import BASE as WATCHDOG
from bank.beyond.mode_keeper_right import BASE as KEEPER

_KEPT = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
_ASKS = "QoSProfile(depth=16, reliability=ReliabilityPolicy.BEST_EFFORT)"
_SILENCE = "Duration(seconds=2)"


def _keeper(name, mistake, *edits):
    return wrong("08a", name, mistake, edited(KEEPER, *edits))


def _archive(name, mistake, *edits):
    return wrong("08b", name, mistake, edited(ARCHIVE, *edits))


def _watchdog(name, mistake, *edits):
    return wrong("08c", name, mistake, edited(WATCHDOG, *edits))


MODES = (
    right(
        "08a",
        "a dataclass for the state",
        """
        from dataclasses import dataclass

        @dataclass
        class State:
            mode: str = "idle"

            def take(self, word):
                changed = word != self.mode
                self.mode = word
                return changed

        class Keeper(Node):
            def __init__(self):
                super().__init__("keeper")
                self.state = State()
                self.out = self.create_publisher(
                    String, "mode", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                )
                self.out.publish(String(data=self.state.mode))
                self.create_subscription(
                    String, "command",
                    lambda msg: self.state.take(msg.data) and self.out.publish(msg), 10,
                )
    """,
    ),
    right(
        "08a",
        "a base class that publishes what is new",
        """
        class Latched(Node):
            def __init__(self, name, topic, first):
                super().__init__(name)
                qos = QoSProfile(depth=1)
                qos.durability = DurabilityPolicy.TRANSIENT_LOCAL
                self._publisher, self._value = self.create_publisher(String, topic, qos), None
                self.update(first)

            def update(self, value):
                if value == self._value:
                    return
                self._value = value
                self._publisher.publish(String(data=f"{value}"))

        class ModeKeeper(Latched):
            def __init__(self):
                super().__init__("mode_keeper", "mode", "idle")
                self.create_subscription(String, "command", lambda m: self.update(m.data), 1)
    """,
    ),
    right(
        "08a",
        "a history in a deque",
        """
        from collections import deque

        class ModeKeeper(Node):
            def __init__(self):
                super().__init__("mode_keeper")
                self.create_subscription(String, "command", self.obey, 10)
                self.modes = self.create_publisher(
                    String, "mode", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                )
                self.history = deque(maxlen=100)
                self.obey(String(data="idle"))

            def obey(self, msg):
                if list(self.history)[-1:] == [msg.data]:
                    return
                self.history.append(msg.data)
                self.modes.publish(msg)
    """,
    ),
    right(
        "08a",
        "a long lifespan",
        edited(KEEPER, ("depth=1,", "depth=1, lifespan=Duration(seconds=3600),")),
    ),
    right(
        "08a",
        "a timer without a period that fires once",
        edited(
            KEEPER,
            (
                'self.change("idle")',
                'self.mode = ""\n        self.once = self.create_timer(0.0, self.begin)'
                "\n\n    def begin(self):\n        self.once.cancel()"
                '\n        self.change("idle")',
            ),
        ),
    ),
    _keeper(
        "kept for half a second",
        "lifespan-too-short",
        ("depth=1,", "depth=1, lifespan=Duration(nanoseconds=500_000_000),"),
    ),
    _keeper(
        "kept for ten seconds",
        "lifespan-too-short",
        ("depth=1,", "depth=1, lifespan=Duration(seconds=10),"),
    ),
    _keeper("kept by the commands, not by the modes", "not-kept", (_KEPT, "QoSProfile(depth=1)")),
    _keeper(
        "the first mode after a twentieth of a second",
        "wrong-start",
        (
            'self.change("idle")',
            "self.mode = None\n        self.once = self.create_timer(0.05, self.begin)\n\n"
            '    def begin(self):\n        self.once.cancel()\n        self.change("idle")',
        ),
    ),
    _keeper(
        "a first mode with a capital", "wrong-start", ('self.change("idle")', 'self.change("Idle")')
    ),
    _keeper(
        "modes with a capital",
        "wrong-values",
        ("String(data=mode)", 'String(data=mode if mode == "idle" else mode.title())'),
    ),
    _keeper(
        "modes without their last letter",
        "wrong-values",
        ("String(data=mode)", 'String(data=mode if mode == "idle" else mode[:-1])'),
    ),
    _keeper(
        "every command but idle",
        "change-missing",
        ("if msg.data != self.mode:", 'if msg.data not in (self.mode, "idle"):'),
    ),
    _keeper(
        "a timer publishes changes a little later",
        "change-missing",
        (
            "            self.change(msg.data)",
            "            self.mode = msg.data\n"
            "            self.late = self.create_timer(0.1, self.tell)\n\n"
            "    def tell(self):\n        self.late.cancel()\n        self.change(self.mode)",
        ),
    ),
    _keeper(
        "modes as numbers on the topic of displays",
        "type-mismatch",
        ('(String, "mode"', '(Int32, "mode"'),
        ("String(data=mode)", "Int32(data=len(mode))"),
    ),
)

READINGS = (
    right(
        "08b",
        "a publisher handed over",
        """
        from functools import partial

        def forward(publisher, msg):
            publisher.publish(msg)

        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                out = self.create_publisher(Float32, "archive", QoSProfile(depth=1))
                self.create_subscription(
                    Float32, "reading", partial(forward, out),
                    QoSProfile(reliability=ReliabilityPolicy.BEST_EFFORT, depth=17),
                )
    """,
    ),
    right(
        "08b",
        "a shelf that is numpy",
        """
        import numpy as np

        class Shelf:
            def __init__(self, publisher):
                self.publisher, self.values = publisher, np.array([], dtype=np.float32)

            def __call__(self, msg):
                self.values = np.append(self.values, np.float32(msg.data))
                self.publisher.publish(Float32(data=float(self.values[-1])))

        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                shelf = Shelf(self.create_publisher(Float32, "archive", 10))
                qos = QoSProfile(depth=64, reliability=ReliabilityPolicy.BEST_EFFORT)
                self.create_subscription(Float32, "reading", lambda msg: shelf(msg), qos)
    """,
    ),
    right(
        "08b",
        "batches of four",
        """
        class Archive(Node):
            def __init__(self):
                super().__init__("archive")
                self.batch = []
                self.copies = self.create_publisher(Float32, "archive", 100)
                profile = QoSProfile(depth=100)
                profile.reliability = ReliabilityPolicy.BEST_EFFORT
                self.create_subscription(Float32, "reading", self.copy, profile)

            def copy(self, msg):
                self.batch.append(msg.data)
                if len(self.batch) == 4:
                    for value in self.batch:
                        self.copies.publish(Float32(data=value))
                    self.batch.clear()
    """,
    ),
    right(
        "08b",
        "a lifespan longer than the pause",
        edited(ARCHIVE, ("depth=16,", "depth=16, lifespan=Duration(seconds=8),")),
    ),
    _archive(
        "a lifespan of three seconds",
        "lifespan-too-short",
        ("depth=16,", "depth=16, lifespan=Duration(seconds=3),"),
    ),
    _archive(
        "a lifespan of seven seconds",
        "lifespan-too-short",
        ("depth=16,", "depth=100, lifespan=Duration(seconds=7),"),
    ),
    _archive(
        "a lifespan of a nanosecond",
        "lifespan-too-short",
        ("depth=16,", "depth=16, lifespan=Duration(nanoseconds=1),"),
    ),
    _archive("a depth of two", "queue-too-short", ("depth=16", "depth=2")),
    _archive("twelve", "queue-too-short", ("depth=16", "depth=12")),
    _archive(
        "two subscriptions, no reading twice, too short",
        "queue-too-short",
        (
            'self.create_subscription(Float32, "reading", self.copy, qos)',
            "self.seen = set()\n"
            '        self.create_subscription(Float32, "reading", self.copy, qos)\n'
            '        self.create_subscription(Float32, "reading", self.copy, 4)',
        ),
        ("depth=16", "depth=4"),
        (
            "self.copies.publish(msg)",
            "if msg.data not in self.seen:\n            self.seen.add(msg.data)\n"
            "            self.copies.publish(msg)",
        ),
    ),
    _archive(
        "every second reading",
        "wrong-values",
        (
            "self.copies.publish(msg)",
            "self.odd = not getattr(self, 'odd', False)\n        if self.odd:\n"
            "            self.copies.publish(msg)",
        ),
    ),
    _archive(
        "words on the topic of sensors",
        "type-mismatch",
        ('(Float32, "reading"', '(String, "reading"'),
    ),
)

SILENCES = (
    right(
        "08c",
        "a state machine in a dict",
        """
        class Watchdog(Node):
            NEXT = {("back", "silence"): "lost", ("lost", "reading"): "back"}

            def __init__(self):
                super().__init__("watchdog")
                self.state = "back"
                self.out = self.create_publisher(String, "health", 10)
                self.create_subscription(
                    Float32, "temperature", lambda msg: self.on("reading"),
                    QoSProfile(depth=1, deadline=Duration(seconds=2)),
                    event_callbacks=SubscriptionEventCallbacks(
                        deadline=lambda event: self.on("silence")),
                )

            def on(self, signal):
                new = self.NEXT.get((self.state, signal))
                if new:
                    self.state = new
                    self.out.publish(String(data=new))
    """,
    ),
    right(
        "08c",
        "a new timer for each reading",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.out = self.create_publisher(String, "health", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)
                self.timer, self.lost = None, False

            def on_reading(self, msg):
                if self.timer is not None:
                    self.destroy_timer(self.timer)
                self.timer = self.create_timer(2.0, self.on_silence)
                if self.lost:
                    self.out.publish(String(data="back"))
                self.lost = False

            def on_silence(self):
                if not self.lost:
                    self.out.publish(String(data="lost"))
                self.lost = True
    """,
    ),
    right(
        "08c",
        "seconds counted by a timer",
        """
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.out = self.create_publisher(String, "health", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)
                self.create_timer(0.25, self.on_quarter)
                self.heard_at, self.lost = float("inf"), False

            def seconds(self):
                return self.get_clock().now().nanoseconds / 1e9

            def on_quarter(self):
                if not self.lost and self.seconds() - self.heard_at >= 2.0:
                    self.lost = True
                    self.out.publish(String(data="lost"))

            def on_reading(self, msg):
                self.heard_at = self.seconds()
                if self.lost:
                    self.lost = False
                    self.out.publish(String(data="back"))
    """,
    ),
    right(
        "08c",
        "an event that counts the silence",
        edited(
            WATCHDOG,
            ("if not self.lost:", "if event.total_count_change and not self.lost:"),
            (_SILENCE, "Duration(seconds=1, nanoseconds=1_000_000_000)"),
        ),
    ),
    _watchdog("lost with a capital", "wrong-word", ('data="lost"', 'data="Lost"')),
    _watchdog("back with a blank", "wrong-word", ('data="back"', 'data="back "')),
    _watchdog("lost with a full stop", "wrong-word", ('data="lost"', 'data="lost."')),
    _watchdog(
        "a lifespan and no deadline", "no-deadline", ("deadline=Duration", "lifespan=Duration")
    ),
    _watchdog("four seconds", "wrong-deadline", ("seconds=2", "seconds=4")),
    _watchdog("five seconds", "wrong-deadline", ("seconds=2", "seconds=5")),
    _watchdog(
        "it begins with lost",
        "wrong-start",
        (
            "self.lost = False\n\n",
            'self.health.publish(String(data="lost"))\n        self.lost = True\n\n',
        ),
    ),
    _watchdog(
        "it waits for the third miss",
        "wrong-deadline",
        ("if not self.lost:", "if event.total_count > 2 and not self.lost:"),
    ),
    _watchdog(
        "the first silence never ends",
        "change-missing",
        (
            "if self.lost:\n            self.lost = False",
            "if self.lost and msg.data < 0:\n            self.lost = False",
        ),
    ),
    _watchdog(
        "texts on the topic of the sensor",
        "type-mismatch",
        ('Float32, "temperature"', 'String, "temperature"'),
    ),
)

ANSWERS = (*MODES, *READINGS, *SILENCES)

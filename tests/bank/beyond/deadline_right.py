"""08c, silence is news: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class Watchdog(Node):
        def __init__(self):
            super().__init__("watchdog")
            qos = QoSProfile(depth=10, deadline=Duration(seconds=2))
            events = SubscriptionEventCallbacks(deadline=self.on_silence)
            self.create_subscription(
                Float32, "temperature", self.on_reading, qos, event_callbacks=events
            )
            self.health = self.create_publisher(String, "health", 10)
            self.lost = False

        def on_silence(self, event):
            if not self.lost:
                self.lost = True
                self.health.publish(String(data="lost"))

        def on_reading(self, msg):
            if self.lost:
                self.lost = False
                self.health.publish(String(data="back"))
"""


def _right(name, *edits):
    return right("08c", name, edited(BASE, *edits))


ANSWERS = (
    _right("two methods and a flag"),
    _right("nanoseconds", ("seconds=2", "nanoseconds=2_000_000_000")),
    _right("by best effort, and one reading",
           ("depth=10, ", "depth=1, reliability=ReliabilityPolicy.BEST_EFFORT, ")),
    _right("a look at the event's number",
           ("if not self.lost:", "missed = event.total_count_change\n"
                                 "        if missed and not self.lost:")),
    _right("events set afterwards",
           ("SubscriptionEventCallbacks(deadline=self.on_silence)",
            "SubscriptionEventCallbacks()\n        events.deadline = self.on_silence")),
    _right("events of other kinds as well",
           ("deadline=self.on_silence",
            "deadline=self.on_silence, incompatible_qos=print, use_default_callbacks=False")),
    _right("early returns",
           ('if not self.lost:\n            self.lost = True\n'
            '            self.health.publish(String(data="lost"))',
            'if self.lost:\n            return\n        self.lost = True\n'
            '        self.health.publish(String(data="lost"))')),
    _right("the publisher has a lifespan, too",
           ('"health", 10', '"health", QoSProfile(depth=1, lifespan=Duration(seconds=5))')),
    _right("health that waits for late joiners",
           ('"health", 10', '"health", QoSProfile(depth=1, '
                            "durability=DurabilityPolicy.TRANSIENT_LOCAL)")),
    _right("a lambda for the event",
           ("deadline=self.on_silence", "deadline=lambda event: self.on_silence(event)")),
    _right("the deadline set afterwards",
           ("qos = QoSProfile(depth=10, deadline=Duration(seconds=2))",
            "qos = QoSProfile(depth=10)\n        qos.deadline = Duration(seconds=2)")),
    right("08c", "a word that is remembered, as on the page", '''
        class Dog(Node):
            def __init__(self):
                super().__init__("dog")
                self.word = "back"
                self.out = self.create_publisher(String, "/health", 1)
                self.create_subscription(
                    msg_type=Float32,
                    topic="/temperature",
                    callback=lambda _: self.say("back"),
                    qos_profile=QoSProfile(depth=1, deadline=Duration(seconds=2.0)),
                    event_callbacks=SubscriptionEventCallbacks(
                        deadline=lambda _: self.say("lost")
                    ),
                )

            def say(self, word):
                if word != self.word:
                    self.word = word
                    self.out.publish(String(data=word))
    '''),
    right("08c", "a timer that each reading sets back", '''
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)
                self.timer = self.create_timer(2.0, self.on_silence)
                self.timer.cancel()
                self.lost = False

            def on_silence(self):
                self.timer.cancel()
                self.lost = True
                self.health.publish(String(data="lost"))

            def on_reading(self, msg):
                self.timer.reset()
                if self.lost:
                    self.lost = False
                    self.health.publish(String(data="back"))
    '''),
    right("08c", "a clock that is looked at", '''
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.health = self.create_publisher(String, "health", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)
                self.create_timer(0.1, self.look)
                self.last = None
                self.lost = False

            def look(self):
                if self.last is None or self.lost:
                    return
                if self.get_clock().now() - self.last >= Duration(seconds=2):
                    self.lost = True
                    self.health.publish(String(data="lost"))

            def on_reading(self, msg):
                self.last = self.get_clock().now()
                if self.lost:
                    self.lost = False
                    self.health.publish(String(data="back"))
    '''),
    right("08c", "a class of its own for the news, and async", '''
        class News:
            """Says each word once."""

            def __init__(self, publisher):
                self.publisher, self.last = publisher, "back"

            def say(self, word):
                changed, self.last = word != self.last, word
                if changed:
                    self.publisher.publish(String(data=word))

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                news = News(self.create_publisher(String, "health", 10))
                qos = QoSProfile(depth=5, deadline=Duration(seconds=2))

                async def silence(event):
                    news.say("lost")

                async def reading(msg):
                    news.say("back")

                self.create_subscription(
                    Float32, "temperature", reading, qos,
                    event_callbacks=SubscriptionEventCallbacks(deadline=silence),
                )
    '''),
)  # fmt: skip

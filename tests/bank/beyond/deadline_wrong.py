"""08c, silence is news: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.deadline_right import BASE

_QOS = "qos = QoSProfile(depth=10, deadline=Duration(seconds=2))"
_MAKE = 'self.health = self.create_publisher(String, "health", 10)'
_SAY_LOST = 'self.health.publish(String(data="lost"))'
_SAY_BACK = 'self.health.publish(String(data="back"))'
_LOST = f"if not self.lost:\n            self.lost = True\n            {_SAY_LOST}"
_BACK = f"if self.lost:\n            self.lost = False\n            {_SAY_BACK}"


def _wrong(name, mistake, *edits):
    return wrong("08c", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("08c", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # The deadline.
    _wrong("a deadline a little too long", "wrong-deadline", ("seconds=2)", "seconds=2.25)")),
    _wrong("no deadline", "no-deadline", (", deadline=Duration(seconds=2)", "")),
    _wrong("a depth alone", "no-deadline", (_QOS, "qos = 10")),
    _wrong("a lifespan for a deadline", "no-deadline", ("10, deadline=", "10, lifespan=")),
    _wrong("no events", "deadline-unheard", (", event_callbacks=events", "")),
    _wrong("events without a callback", "deadline-unheard",
           ("SubscriptionEventCallbacks(deadline=self.on_silence)",
            "SubscriptionEventCallbacks()")),
    _wrong("the callback of another event", "deadline-unheard",
           ("(deadline=self.on_silence)", "(message_lost=self.on_silence)")),
    _wrong("the deadline on the wrong side", "deadline-wrong-side",
           ("self.on_reading, qos", "self.on_reading, 10"), ('"health", 10', '"health", qos')),
    _wrong("more than is offered", "qos-mismatch", ("seconds=2", "seconds=1")),
    _wrong("a little more than is offered", "qos-mismatch", ("seconds=2", "seconds=1.9")),
    _wrong("milliseconds taken for nanoseconds", "qos-mismatch",
           ("seconds=2", "nanoseconds=2_000")),
    _wrong("three seconds", "wrong-deadline", ("seconds=2", "seconds=3")),
    _wrong("two and a half", "wrong-deadline", ("seconds=2", "seconds=2.5")),
    _wrong("a minute", "wrong-deadline", ("seconds=2", "seconds=60")),
    _wrong("kept readings wanted", "qos-mismatch",
           ("depth=10, ", "depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL, ")),
    # What it says.
    _wrong("lost in each period", "status-repeated",
           (_LOST, f"self.lost = True\n        {_SAY_LOST}")),
    _wrong("back at each reading", "status-repeated",
           (_BACK, f"if self.lost is not None:\n            {_SAY_BACK}"),
           ("self.lost = False", "self.lost = None")),
    _wrong("back before anything was lost", "wrong-start",
           ("self.lost = False\n\n", "self.lost = True\n\n")),
    _wrong("never back", "status-repeated", (_SAY_BACK, "pass")),
    _wrong("lost once and for ever", "change-missing", (_BACK, "pass")),
    _wrong("it waits for the second miss", "wrong-deadline",
           ("if not self.lost:", "if event.total_count > 1 and not self.lost:")),
    _wrong("only the first silence", "change-missing",
           ("if not self.lost:", "if event.total_count == 1:")),
    _wrong("in capitals", "wrong-word", ('data="lost"', 'data="LOST"')),
    _wrong("another word", "wrong-word", ('data="back"', 'data="found"')),
    _wrong("the two words swapped", "wrong-start",
           ('data="lost"', 'data="x"'), ('data="back"', 'data="lost"'),
           ('data="x"', 'data="back"')),
    _wrong("it only logs", "never-published",
           (_SAY_LOST, 'self.get_logger().info("lost")'),
           (_SAY_BACK, 'self.get_logger().info("back")')),
    _wrong("a timer that runs on", "status-repeated",
           ("events = SubscriptionEventCallbacks(deadline=self.on_silence)",
            "events = None\n        self.create_timer(2.0, lambda: self.on_silence(None))"),
           (_LOST, f"self.lost = True\n        {_SAY_LOST}")),
    # The callbacks.
    _wrong("an event callback without event", "callback-parameters",
           ("on_silence(self, event)", "on_silence(self)")),
    _wrong("the event callback called", "callback-called",
           ("deadline=self.on_silence", "deadline=self.on_silence()")),
    _wrong("the callback called", "callback-called",
           ("self.on_reading, qos", "self.on_reading(), qos")),
    _wrong("a callback without msg", "callback-parameters",
           ("on_reading(self, msg)", "on_reading(self)")),
    _wrong("a number for a duration", "wrong-argument",
           ("Duration(seconds=2)", "2.0")),
    _wrong("a duration without a unit", "wrong-argument",
           ("Duration(seconds=2)", "Duration(2)")),
    _wrong("the events of a publisher", "wrong-argument",
           ("class W", "from rclpy.event_handler import PublisherEventCallbacks\n\nclass W"),
           ("SubscriptionEventCallbacks(d", "PublisherEventCallbacks(d")),
    _wrong("a duration in another unit", "wrong-argument",
           ("Duration(seconds=2)", "Duration(milliseconds=2000)")),
    _wrong("a profile without a depth", "depth-missing", ("depth=10, ", "")),
    _wrong("an event that there is not", "wrong-argument",
           ("Callbacks(deadline=", "Callbacks(silence=")),
    # The thirty.
    _wrong("the plural", "topic-misspelled", ('"temperature"', '"temperatures"')),
    _wrong("health misspelt", "topic-misspelled", ('"health", 10', '"healt", 10')),
    _wrong("another topic", "wrong-topic", ('"health", 10', '"news", 10')),
    _wrong("readings of another type", "type-mismatch", ('Float32, "temp', 'Int32, "temp')),
    _wrong("words as numbers", "type-mismatch",
           ('String, "health"', 'Int32, "health"'), ('String(data="lost")', "Int32(data=0)"),
           ('String(data="back")', "Int32(data=1)")),
    _wrong("a text published", "number-published", ('String(data="lost")', '"lost"')),
    _wrong("no publisher", "wrong-attribute", (_MAKE, "pass")),
    _wrong("no node name", "node-name-missing", ('"watchdog"', "")),
    _wrong("a method for the events", "wrong-argument",
           ("events = SubscriptionEventCallbacks(deadline=self.on_silence)",
            "events = self.on_silence")),
    _wrong("a timer that nobody sets back", "wrong-deadline",
           (", event_callbacks=events", ""),
           (_MAKE, f"{_MAKE}\n        self.create_timer(2.0, lambda: self.on_silence(None))")),
    # Pairs.
    _either("three seconds, and repeated", ("wrong-deadline", "status-repeated"),
            ("seconds=2", "seconds=3"), (_LOST, f"self.lost = True\n        {_SAY_LOST}")),
    _either("one second, and another word", ("qos-mismatch", "wrong-word"),
            ("seconds=2", "seconds=1"), ('data="lost"', 'data="gone"')),
    _either("no events, and misspelt", ("deadline-unheard", "topic-misspelled"),
            (", event_callbacks=events", ""), ('"health", 10', '"healt", 10')),
    _either("no events, and a minute", ("deadline-unheard", "wrong-deadline"),
            (", event_callbacks=events", ""), ("seconds=2", "seconds=60")),
    _either("repeated, in capitals", ("status-repeated", "wrong-word"),
            (_LOST, "self.lost = True\n        " + _SAY_LOST.replace("lost", "LOST"))),
)  # fmt: skip

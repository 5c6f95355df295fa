"""09a, notice the silence: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.silence_right import BASE

_LOST = 'self.statuses.publish(String(data="lost"))'
_BACK = 'self.statuses.publish(String(data="back"))'
_LOOK = "self.create_timer(0.5, self.look)"
_GUARD = "if self.last is None or self.lost:"


def _wrong(name, mistake, *edits):
    return wrong("09a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("09a", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # The exercise's own mistakes.
    wrong("09a", "the callback of the subscription looks", "noticed-afterwards", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.last = None

            def hear(self, msg):
                now = self.get_clock().now().nanoseconds / 1e9
                if self.last is not None and now - self.last > 3.0:
                    self.statuses.publish(String(data="lost"))
                    self.statuses.publish(String(data="back"))
                self.last = now
    '''),
    _wrong("no timer looks", "silence-unnoticed", (_LOOK, "pass")),
    _wrong("the wall clock", "silence-unnoticed",
           ("self.last = self.get_clock().now()", "self.last = time.time()"),
           ("(self.get_clock().now() - self.last).nanoseconds / 1e9", "time.time() - self.last")),
    _wrong("nanoseconds taken for seconds", "noticed-early",
           (".nanoseconds / 1e9", ".nanoseconds")),
    _wrong("divided too often", "silence-unnoticed", ("/ 1e9", "/ 1e12")),
    _wrong("it does not remember that it is lost", "status-repeated",
           (_GUARD, "if self.last is None:")),
    _wrong("lost from the beginning", "lost-before-found",
           ("self.last = None", "self.last = self.get_clock().now()")),
    _wrong("only once in a lifetime", "silence-unnoticed",
           ("if self.lost:\n            self.lost = False\n            ",
            "if self.lost is True:\n            self.lost = None\n            "),
           ("or self.lost:", "or self.lost is not False:")),
    _wrong("two seconds", "noticed-early", (">= 3.0", ">= 2.0")),
    _wrong("two and a half", "noticed-early", (">= 3.0", ">= 2.5")),
    _wrong("five seconds", "noticed-late", (">= 3.0", ">= 5.0")),
    _wrong("it looks every five seconds", "noticed-late", ("0.5, self.look", "5.0, self.look")),
    _wrong("it never looks in time", "silence-unnoticed", ("0.5, self.look", "50.0, self.look")),
    _wrong("nobody says back", "back-missing", (_BACK, "pass")),
    _wrong("back with each reading", "back-too-often",
           (f"if self.lost:\n            self.lost = False\n            {_BACK}",
            f"self.lost = False\n        {_BACK}")),
    _wrong("back with the first reading", "back-too-often",
           ("self.lost = False\n        self.last", "self.lost = True\n        self.last")),
    wrong("09a", "a timer that nobody sets back", "noticed-early", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.here = False

            def hear(self, msg):
                if not self.here:
                    self.here = True
                    self.create_timer(3.0, self.miss)

            def miss(self):
                self.statuses.publish(String(data="lost"))
    '''),
    wrong("09a", "a timer that is not stopped", "status-repeated", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.silence = self.create_timer(3.0, self.miss)
                self.silence.cancel()
                self.lost = False

            def hear(self, msg):
                self.silence.reset()
                if self.lost:
                    self.lost = False
                    self.statuses.publish(String(data="back"))

            def miss(self):
                self.lost = True
                self.statuses.publish(String(data="lost"))
    '''),
    wrong("09a", "a flag that a timer of three seconds looks at", "noticed-late", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.heard, self.lost = True, False
                self.silence = self.create_timer(3.25, self.look)
                self.silence.cancel()

            def hear(self, msg):
                self.heard = True
                if self.silence.is_canceled():
                    self.silence.reset()
                if self.lost:
                    self.lost = False
                    self.statuses.publish(String(data="back"))

            def look(self):
                if not self.heard and not self.lost:
                    self.lost = True
                    self.statuses.publish(String(data="lost"))
                self.heard = False
    '''),
    _wrong("other words", "wrong-word", ('"lost"', '"gone"')),
    _wrong("capital letters", "wrong-word", ('"lost"', '"Lost"'), ('"back"', '"BACK"')),
    _wrong("a blank behind the word", "wrong-word", ('"lost"', '"lost "')),
    _wrong("a word more", "wrong-word", ('"back"', '"back again"')),
    # The thirty.
    _wrong("another topic to say it on", "wrong-topic", ('"status"', '"alarm"')),
    _wrong("a letter wrong", "topic-misspelled", ('"status"', '"staus"')),
    _wrong("a letter wrong where it listens", "topic-misspelled",
           ('"temperature"', '"temprature"')),
    _wrong("statuses of another type", "type-mismatch",
           ("(String, ", "(Float32, "), ("String(data=\"lost\")", "Float32(data=1.0)"),
           ("String(data=\"back\")", "Float32(data=0.0)")),
    _wrong("it hears another type", "type-mismatch", ("(Float32, ", "(String, ")),
    _wrong("the callback called", "callback-called", ("self.hear, 10", "self.hear(), 10")),
    _wrong("no depth", "depth-missing", ('"status", 10', '"status"')),
    _wrong("a text published", "number-published", ('String(data="lost")', '"lost"')),
    _wrong("nothing that listens", "no-subscription",
           ('self.create_subscription(Float32, "temperature", self.hear, 10)', "pass")),
    _wrong("a time minus nothing", "none-used", (_GUARD, "if self.lost:")),
    _wrong("it waits in the callback", "callback-blocks",
           (f"if silence >= 3.0:\n            self.lost = True\n            {_LOST}",
            f"while silence >= 3.0 and not self.lost:\n            pass\n        {_LOST}")),
    # Pairs.
    _either("two seconds, and again and again", ("noticed-early", "status-repeated"),
            (">= 3.0", ">= 2.0"), (_GUARD, "if self.last is None:")),
    _either("five seconds, and nobody says back", ("noticed-late", "back-missing"),
            (">= 3.0", ">= 5.0"), (_BACK, "pass")),
    _either("another word, on another topic", ("wrong-word", "wrong-topic"),
            ('"lost"', '"gone"'), ('"status"', '"alarm"')),
    _either("lost from the beginning, again and again", ("lost-before-found", "status-repeated"),
            ("self.last = None", "self.last = self.get_clock().now()"),
            (_GUARD, "if False:")),
    _either("late, and back with the first reading", ("noticed-late", "back-too-often"),
            (">= 3.0", ">= 4.75"),
            ("self.lost = False\n        self.last", "self.lost = True\n        self.last")),
)  # fmt: skip

"""09a, notice the silence: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class Watchman(Node):
        def __init__(self):
            super().__init__("watchman")
            self.create_subscription(Float32, "temperature", self.hear, 10)
            self.statuses = self.create_publisher(String, "status", 10)
            self.lost = False
            self.last = None
            self.create_timer(0.5, self.look)

        def hear(self, msg):
            self.last = self.get_clock().now()
            if self.lost:
                self.lost = False
                self.statuses.publish(String(data="back"))

        def look(self):
            if self.last is None or self.lost:
                return
            silence = (self.get_clock().now() - self.last).nanoseconds / 1e9
            if silence >= 3.0:
                self.lost = True
                self.statuses.publish(String(data="lost"))
"""


def _right(name, *edits):
    return right("09a", name, edited(BASE, *edits))


ANSWERS = (
    _right("it looks twice a second"),
    _right("once a second", ("0.5, self.look", "1.0, self.look")),
    _right("more than three", (">= 3.0", "> 3.0"), ("0.5, self.look", "1.0, self.look")),
    _right("twenty times a second", ("0.5, self.look", "0.05, self.look")),
    _right("three and a half, looked at often", (">= 3.0", ">= 3.5"), ("0.5, ", "0.1, ")),
    right("09a", "a timer that each reading sets back", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.out = self.create_publisher(String, "status", 10)
                self.away = False
                self.alarm = self.create_timer(3.0, self.miss)
                self.alarm.cancel()
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, _):
                self.alarm.reset()
                if self.away:
                    self.out.publish(String(data="back"))
                self.away = False

            def miss(self):
                self.alarm.cancel()
                self.away = True
                self.out.publish(String(data="lost"))
    '''),
    right("09a", "a timer made anew for each reading", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.out = self.create_publisher(String, "status", 10)
                self.timer, self.away = None, False
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, _):
                if self.timer is not None:
                    self.destroy_timer(self.timer)
                self.timer = self.create_timer(3.25, self.miss)
                if self.away:
                    self.out.publish(String(data="back"))
                    self.away = False

            def miss(self):
                self.destroy_timer(self.timer)
                self.timer, self.away = None, True
                self.out.publish(String(data="lost"))
    '''),
    right("09a", "ticks are counted", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                out = self.create_publisher(String, "status", 10)
                ticks = -1

                def hear(msg):
                    nonlocal ticks
                    if ticks >= 7:
                        out.publish(String(data="back"))
                    ticks = 0

                def tick():
                    nonlocal ticks
                    if 0 <= ticks < 7:
                        ticks += 1
                        if ticks == 7:
                            out.publish(String(data="lost"))

                self.create_subscription(Float32, "temperature", hear, 10)
                self.create_timer(0.5, tick)
    '''),
    right("09a", "the status is compared with the one before", '''
        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.pub = self.create_publisher(String, "status", 10)
                self.create_timer(0.25, self.look)
                self.heard, self.status = None, "back"

            def seconds(self):
                return self.get_clock().now().nanoseconds / 1e9

            def hear(self, msg):
                self.heard = self.seconds()

            def look(self):
                if self.heard is None:
                    return
                status = "lost" if self.seconds() - self.heard >= 3 else "back"
                if status != self.status:
                    self.status = status
                    self.pub.publish(String(data=status))
    '''),
    right("09a", "states as objects, and type hints", '''
        from enum import Enum

        class State(Enum):
            NEW = "new"
            HERE = "back"
            GONE = "lost"

        class Watchman(Node):
            limit: float = 3.0

            def __init__(self) -> None:
                super().__init__("watchman")
                self.state = State.NEW
                self.pub = self.create_publisher(String, "status", 1)
                self.create_subscription(Float32, "/temperature", self._hear, 1)
                self._timer = self.create_timer(self.limit, self._miss, autostart=False)

            def _enter(self, state: State) -> None:
                before, self.state = self.state, state
                if before is not State.NEW and before is not state:
                    self.pub.publish(String(data=state.value))

            def _hear(self, msg: Float32) -> None:
                self._timer.reset()
                self._enter(State.HERE)

            def _miss(self) -> None:
                self._timer.cancel()
                self._enter(State.GONE)
    '''),
    right("09a", "time objects and a duration", '''
        from rclpy.duration import Duration

        class Watchman(Node):
            def __init__(self):
                super().__init__("watchman")
                self.pub = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)
                self.create_timer(0.2, self.look)
                self.due = None

            def hear(self, msg):
                if self.due == "over":
                    self.pub.publish(String(data="back"))
                self.due = self.get_clock().now() + Duration(seconds=3.0)

            def look(self):
                if self.due not in (None, "over") and self.get_clock().now() >= self.due:
                    self.due = "over"
                    self.pub.publish(String(data="lost"))
    '''),
)  # fmt: skip

"""11b, notice a sick sensor: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class Watchdog(Node):
        def __init__(self):
            super().__init__("watchdog")
            self.create_subscription(Float32, "temperature", self.listen, 10)
            self.faults = self.create_publisher(String, "fault", 10)
            self.last = None
            self.equal = 1

        def say(self, word):
            self.faults.publish(String(data=word))

        def listen(self, msg):
            if math.isnan(msg.data):
                self.say("nan")
                return
            if self.last is not None and abs(msg.data - self.last) > 5.0:
                self.say("jump")
            self.equal = self.equal + 1 if msg.data == self.last else 1
            if self.equal == 5:
                self.say("stuck")
            self.last = msg.data
"""
_JUMP = "if self.last is not None and abs(msg.data - self.last) > 5.0:"


def _right(name, *edits):
    return right("11b", name, edited(BASE, *edits))


ANSWERS = (
    _right("as on the page"),
    _right("not equal to itself", ("math.isnan(msg.data)", "msg.data != msg.data")),
    _right("NaN to begin with", ("self.last = None", "self.last = math.nan"),
           ("self.last is not None and ", "")),
    _right("both signs", (_JUMP, "if self.last is not None and "
                                 "(msg.data - self.last > 5 or self.last - msg.data > 5):")),
    _right("it also logs", ("self.say(\"nan\")", 'self.get_logger().error("no number")\n'
                                                 '            self.say("nan")')),
    _right("counting from 0", ("self.equal = 1", "self.equal = 0"), ("else 1", "else 0"),
           ("self.equal == 5", "self.equal == 4")),
    _right("the exact equality of floats", ("msg.data == self.last",
           "self.last is not None and abs(msg.data - self.last) == 0.0")),
    right("11b", "a window of five", '''
        from collections import deque

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.window = deque(maxlen=5)
                self.hangs = False
                self.faults = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                for word in self.found(msg.data):
                    self.faults.publish(String(data=word))

            def found(self, value):
                if math.isnan(value):
                    yield "nan"
                    return
                if self.window and abs(self.window[-1] - value) > 5:
                    yield "jump"
                self.window.append(value)
                hangs = len(self.window) == 5 and len(set(self.window)) == 1
                if hangs and not self.hangs:
                    yield "stuck"
                self.hangs = hangs
    '''),
    right("11b", "all readings in a list", '''
        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.numbers = []
                self.out = self.create_publisher(String, "/fault", 10)
                self.create_subscription(Float32, "/temperature", self.listen, 10)

            def listen(self, msg):
                word = self.judge(msg.data)
                if word:
                    self.out.publish(String(data=word))

            def judge(self, value):
                if math.isnan(value):
                    return "nan"
                self.numbers.append(value)
                *rest, before, _ = [value, value, *self.numbers][-7:] + []
                before = self.numbers[-2] if len(self.numbers) > 1 else value
                if not -5 <= value - before <= 5:
                    return "jump"
                last = self.numbers[-5:]
                same = len(last) == 5 and max(last) == min(last)
                if same and (len(self.numbers) == 5 or self.numbers[-6] != value):
                    return "stuck"
                return ""
    '''),
    right("11b", "one part for each fault", '''
        class NotANumber:
            word = "nan"
            def hears(self, value):
                return math.isnan(value)

        class Jump:
            word, before = "jump", None
            def hears(self, value):
                if math.isnan(value):
                    return False
                before, self.before = self.before, value
                return before is not None and abs(value - before) > 5.0

        class Hang:
            word, value, row = "stuck", None, 0
            def hears(self, value):
                if math.isnan(value):
                    return False
                self.row = self.row + 1 if value == self.value else 1
                self.value = value
                return self.row == 5

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.faults = self.create_publisher(String, "fault", 10)
                self.parts = [NotANumber(), Jump(), Hang()]

            def listen(self, msg):
                for part in self.parts:
                    if part.hears(msg.data):
                        self.faults.publish(String(data=part.word))
    '''),
    right("11b", "a coroutine remembers", '''
        def watch():
            word, last, row = "", None, 0
            while True:
                value = yield word
                if value != value:
                    word = "nan"
                    continue
                word = "jump" if last is not None and abs(value - last) > 5 else ""
                row = row + 1 if value == last else 1
                word = "stuck" if row == 5 else word
                last = value

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                out = self.create_publisher(String, "fault", 10)
                dog = watch()
                next(dog)

                def listen(msg):
                    word = dog.send(msg.data)
                    if word:
                        out.publish(String(data=word))

                self.create_subscription(Float32, "temperature", listen, 10)
    '''),
    right("11b", "parameters and numpy", '''
        import numpy as np
        from rclpy.qos import QoSProfile

        class Watchdog(Node):
            def __init__(self):
                super().__init__("watchdog")
                self.declare_parameter("limit", 5.0)
                self.faults = self.create_publisher(String, "fault", QoSProfile(depth=5))
                self.create_subscription(Float32, "temperature", self.listen, QoSProfile(depth=5))
                self.values = np.array([])

            def listen(self, msg):
                if np.isnan(msg.data):
                    self.faults.publish(String(data="nan"))
                    return
                self.values = np.append(self.values, msg.data)[-6:]
                steps = np.abs(np.diff(self.values))
                if steps.size and steps[-1] > self.get_parameter("limit").value:
                    self.faults.publish(String(data="jump"))
                if steps.size >= 4 and not steps[-4:].any() and (steps.size == 4 or steps[-5]):
                    self.faults.publish(String(data="stuck"))
    '''),
)  # fmt: skip

"""09b, work, and go on beating: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class Worker(Node):
        def __init__(self):
            super().__init__("worker")
            self.beats = self.create_publisher(String, "beat", 10)
            self.dones = self.create_publisher(Int32, "done", 10)
            self.create_timer(1.0, self.beat)
            self.create_subscription(Int32, "order", self.take, 10)
            self.waiting = []
            self.left = 0
            self.create_timer(0.5, self.step)

        def beat(self):
            self.beats.publish(String(data="alive"))

        def take(self, msg):
            self.waiting.append(msg.data)

        def step(self):
            if not self.waiting:
                return
            self.left += 1
            if self.left > 6:
                self.left = 0
                self.dones.publish(Int32(data=self.waiting.pop(0)))
"""


def _right(name, *edits):
    return right("09b", name, edited(BASE, *edits))


ANSWERS = (
    _right("steps of half a second"),
    _right("steps of a second", ("0.5, self.step", "1.0, self.step"), ("> 6", "> 3")),
    _right("steps of a tenth", ("0.5, self.step", "0.1, self.step"), ("> 6", "> 31")),
    _right("an empty beat", ('String(data="alive")', "String()")),
    _right("a deque", ("class W", "from collections import deque\n\nclass W"),
           ("self.waiting = []", "self.waiting = deque()"), ("pop(0)", "popleft()")),
    right("09b", "a timer of three seconds, begun with the first order", '''
        class Worker(Node):
            def __init__(self):
                super().__init__("worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.create_subscription(Int32, "order", self.take, 10)
                self.oven = self.create_timer(3.0, self.finish)
                self.oven.cancel()
                self.waiting = []

            def take(self, msg):
                if not self.waiting:
                    self.oven.reset()
                self.waiting = [*self.waiting, msg.data]

            def finish(self):
                first, *self.waiting = self.waiting
                self.dones.publish(Int32(data=first))
                if not self.waiting:
                    self.oven.cancel()
    '''),
    right("09b", "a timer for each order, made when it begins", '''
        class Worker(Node):
            def __init__(self):
                super().__init__("worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, self.beat)
                self.create_subscription(Int32, "order", self.take, 10)
                self.waiting, self.oven = [], None

            def beat(self):
                self.beats.publish(String(data="."))

            def take(self, msg):
                self.waiting.append(msg)
                self.begin()

            def begin(self):
                if self.oven is None and self.waiting:
                    msg = self.waiting.pop(0)
                    self.oven = self.create_timer(3.0, lambda: self.finish(msg))

            def finish(self, msg):
                self.destroy_timer(self.oven)
                self.oven = None
                self.dones.publish(msg)
                self.begin()
    '''),
    right("09b", "the clock says when it is done", '''
        class Worker(Node):
            def __init__(self):
                super().__init__("worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, self.beat)
                self.create_timer(0.05, self.look)
                self.create_subscription(Int32, "order", self.take, 10)
                self.orders, self.until = [], None

            def now(self):
                return self.get_clock().now().nanoseconds / 1e9

            def beat(self):
                self.beats.publish(String(data=str(len(self.orders))))

            def take(self, msg):
                self.orders.append(msg.data)

            def look(self):
                if self.orders and self.until is None:
                    self.until = self.now() + 3.0
                elif self.until is not None and self.now() >= self.until:
                    self.dones.publish(Int32(data=self.orders.pop(0)))
                    self.until = None
    '''),
    right("09b", "one timer does both", '''
        class Worker(Node):
            def __init__(self):
                super().__init__("worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, self.tick)
                self.create_subscription(Int32, "order", self.take, 10)
                self.queue, self.ticks = [], 0

            def take(self, msg):
                self.queue.append(msg.data)

            def tick(self):
                self.beats.publish(String(data="alive"))
                if self.queue:
                    self.ticks += 1
                if self.ticks == 4:
                    self.ticks = 1
                    self.dones.publish(Int32(data=self.queue.pop(0)))
                    if not self.queue:
                        self.ticks = 0
    '''),
    right("09b", "a coroutine waits for a future, in a group of its own", '''
        from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
        from rclpy.task import Future

        class Worker(Node):
            def __init__(self):
                super().__init__("worker")
                group = MutuallyExclusiveCallbackGroup()
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, self.beat)
                self.create_subscription(
                    Int32, "order", self.work, 10, callback_group=group
                )

            def beat(self):
                self.beats.publish(String(data="alive"))

            async def work(self, msg):
                await self.pause(3.0)
                self.dones.publish(Int32(data=msg.data))

            async def pause(self, seconds):
                over = Future()
                timer = self.create_timer(seconds, lambda: over.set_result(None))
                await over
                self.destroy_timer(timer)
    '''),
    right("09b", "a generator that is asked again and again", '''
        class Worker(Node):
            def __init__(self):
                super().__init__("worker")
                self.beats = self.create_publisher(String, "beat", 10)
                self.dones = self.create_publisher(Int32, "done", 10)
                self.create_timer(1.0, lambda: self.beats.publish(String(data="alive")))
                self.orders = []
                self.create_subscription(
                    Int32, "order", lambda msg: self.orders.append(msg.data), 10
                )
                plan = self.plan()
                self.create_timer(0.25, lambda: next(plan))

            def plan(self):
                while True:
                    while not self.orders:
                        yield
                    for _ in range(12):
                        yield
                    self.dones.publish(Int32(data=self.orders.pop(0)))
    '''),
)  # fmt: skip

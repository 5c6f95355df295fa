"""12c, heat to a target: right answers, in many styles."""

from bank.answer import edited, right

HEAD = """
    class Thermostat(Node):
        def __init__(self):
            super().__init__("thermostat")
            self.heater = self.create_publisher(Bool, "heater", 10)
            self.create_subscription(Float32, "temperature", self.listen, 10)
            self.reading = Future()
            self.server = ActionServer(
                self, Fibonacci, "heat", self.heat,
                goal_callback=self.decide, cancel_callback=self.agree,
            )

        def listen(self, msg):
            self.reading.set_result(int(msg.data))
            self.reading = Future()

        def agree(self, goal_handle):
            return CancelResponse.ACCEPT

        def decide(self, goal):
            return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT

        async def heat(self, goal_handle):
"""
BODY = """\
            degrees, canceled = [], False
            self.heater.publish(Bool(data=True))
            while not canceled and (not degrees or degrees[-1] < goal_handle.request.order):
                degrees.append(await self.reading)
                goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
                canceled = goal_handle.is_cancel_requested
            self.heater.publish(Bool(data=False))
            goal_handle.canceled() if canceled else goal_handle.succeed()
            return Fibonacci.Result(sequence=degrees)
"""
BASE = HEAD + BODY


def _right(name, *edits):
    return right("12c", name, edited(BASE, *edits))


def _body(name, body, *edits):
    lines = "".join(f"            {line}\n" for line in body.splitlines())
    return right("12c", name, edited(HEAD + lines, *edits))


ANSWERS = (
    _right("as on the page"),
    _body(
        "break, and two returns",
        """self.heater.publish(Bool(data=True))
feedback = Fibonacci.Feedback()
while True:
    degrees = await self.reading
    feedback.sequence.append(degrees)
    goal_handle.publish_feedback(feedback)
    if goal_handle.is_cancel_requested:
        self.heater.publish(Bool(data=False))
        goal_handle.canceled()
        return Fibonacci.Result(sequence=feedback.sequence)
    if degrees >= goal_handle.request.order:
        break
self.heater.publish(Bool(data=False))
goal_handle.succeed()
result = Fibonacci.Result()
result.sequence = feedback.sequence
return result""",
    ),
    _body(
        "the cancel is seen before the report",
        """seen = []
self.heater.publish(Bool(data=True))
while not goal_handle.is_cancel_requested:
    seen.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seen))
    if seen[-1] >= goal_handle.request.order:
        self.heater.publish(Bool(data=False))
        goal_handle.succeed()
        return Fibonacci.Result(sequence=seen)
self.heater.publish(Bool(data=False))
goal_handle.canceled()
return Fibonacci.Result(sequence=seen)""",
    ),
    _body(
        "finally",
        """seen = []
try:
    self.heater.publish(Bool(data=True))
    while not seen or seen[-1] < goal_handle.request.order:
        seen.append(await self.reading)
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seen))
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
            return Fibonacci.Result(sequence=seen)
    goal_handle.succeed()
    return Fibonacci.Result(sequence=seen)
finally:
    self.heater.publish(Bool(data=False))""",
    ),
    _body(
        "reads first, heats if it has to",
        """seen = [await self.reading]
goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seen))
while seen[-1] < goal_handle.request.order and not goal_handle.is_cancel_requested:
    self.heater.publish(Bool(data=True))
    seen.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seen))
self.heater.publish(Bool(data=False))
if goal_handle.is_cancel_requested:
    goal_handle.canceled()
else:
    goal_handle.succeed()
return Fibonacci.Result(sequence=seen)""",
    ),
    _body(
        "the heater each second",
        """seen = []
while True:
    self.heater.publish(Bool(data=True))
    seen.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seen))
    reached = seen[-1] >= goal_handle.request.order
    if reached or goal_handle.is_cancel_requested:
        self.heater.publish(Bool(data=False))
        (goal_handle.succeed if reached else goal_handle.canceled)()
        return Fibonacci.Result(sequence=seen)""",
    ),
    _body(
        "a local helper",
        """seen = []

def switch(on):
    self.heater.publish(Bool(data=on))

switch(True)
while True:
    seen.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=list(seen)))
    if goal_handle.is_cancel_requested or seen[-1] >= goal_handle.request.order:
        break
switch(False)
goal_handle.canceled() if goal_handle.is_cancel_requested else goal_handle.succeed()
return Fibonacci.Result(sequence=seen)""",
    ),
    right(
        "12c",
        "driven by the readings",
        """
        class Thermostat(Node):
            def __init__(self):
                super().__init__("boiler")
                self.heater = self.create_publisher(Bool, "heater", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.goal, self.seen, self.over = None, [], None
                self.server = ActionServer(
                    self, Fibonacci, "heat", self.heat,
                    goal_callback=self.decide, cancel_callback=lambda _: CancelResponse.ACCEPT,
                )

            def decide(self, goal):
                if goal.order < 10 or goal.order > 26:
                    return GoalResponse.REJECT
                return GoalResponse.ACCEPT

            async def heat(self, goal_handle):
                self.goal, self.seen, self.over = goal_handle, [], Future()
                self.heater.publish(Bool(data=True))
                return await self.over

            def listen(self, msg):
                if self.goal is None:
                    return
                goal = self.goal
                self.seen.append(round(msg.data))
                goal.publish_feedback(Fibonacci.Feedback(sequence=self.seen))
                if not goal.is_cancel_requested and self.seen[-1] < goal.request.order:
                    return
                self.heater.publish(Bool(data=False))
                goal.canceled() if goal.is_cancel_requested else goal.succeed()
                self.goal = None
                self.over.set_result(Fibonacci.Result(sequence=self.seen))
    """,
    ),
    right(
        "12c",
        "a timer of its own",
        """
        class Thermostat(Node):
            def __init__(self):
                super().__init__("thermostat")
                self.heater = self.create_publisher(Bool, "heater", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.degrees = None
                self.tick = Future()
                self.create_timer(1.0, self.next_tick)
                self.server = ActionServer(
                    self, Fibonacci, "heat", self.heat,
                    goal_callback=self.decide, cancel_callback=self.agree,
                )

            def listen(self, msg):
                self.degrees = int(msg.data)

            def next_tick(self):
                self.tick.set_result(None)
                self.tick = Future()

            def agree(self, goal_handle):
                return CancelResponse.ACCEPT

            def decide(self, goal):
                good = goal.order in range(10, 27)
                return GoalResponse.ACCEPT if good else GoalResponse.REJECT

            async def heat(self, goal_handle):
                seen = []
                self.heater.publish(Bool(data=True))
                while not seen or seen[-1] < goal_handle.request.order:
                    await self.tick
                    seen.append(self.degrees)
                    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=seen))
                    if goal_handle.is_cancel_requested:
                        break
                self.heater.publish(Bool(data=False))
                if goal_handle.is_cancel_requested:
                    goal_handle.canceled()
                else:
                    goal_handle.succeed()
                return Fibonacci.Result(sequence=seen)
    """,
    ),
    _right(
        "decided with or",
        (
            "return GoalResponse.ACCEPT if 10 <= goal.order <= 26 else GoalResponse.REJECT",
            "if goal.order < 10 or 26 < goal.order:\n            return GoalResponse.REJECT\n"
            "        return GoalResponse.ACCEPT",
        ),
    ),
    _right(
        "accepted by hand",
        (
            "cancel_callback=self.agree,",
            "cancel_callback=self.agree,\n"
            "            handle_accepted_callback=lambda handle: handle.execute(),",
        ),
    ),
)

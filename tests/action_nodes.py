"""An action server and a client of it, for tests."""

from typing import Any

from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.node import Node
from rclpy.task import Future
from test_msgs.action import Fibonacci


class Heater(Node):
    """Counts the seconds of a goal, from 1 to 9, one at a time."""

    def __init__(self, name: str = "heater", action: str = "heat") -> None:
        super().__init__(name)
        self.done = 0
        self.tick = Future()
        self.create_timer(1.0, self.next_tick)
        self.server = ActionServer(
            self,
            Fibonacci,
            action,
            self.heat,
            goal_callback=self.decide,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def next_tick(self) -> None:
        self.tick.set_result(None)
        self.tick = Future()

    def decide(self, goal: Any) -> GoalResponse:
        return GoalResponse.ACCEPT if 0 < goal.order < 10 else GoalResponse.REJECT

    async def wait(self) -> None:
        await self.tick

    async def heat(self, goal: Any) -> Any:
        seconds: list[int] = []
        while len(seconds) < goal.request.order and not goal.is_cancel_requested:
            await self.wait()
            seconds.append(len(seconds) + 1)
            goal.publish_feedback(Fibonacci.Feedback(sequence=seconds))
        if goal.is_cancel_requested:
            goal.canceled()
        else:
            goal.succeed()
        self.done += 1
        return Fibonacci.Result(sequence=seconds)


class Sender(Node):
    """Sends goals and remembers what comes back, and in which second."""

    def __init__(self, name: str = "sender", action: str = "heat") -> None:
        super().__init__(name)
        self.client = ActionClient(self, Fibonacci, action)
        self.log: list[Any] = []
        self.goal: Any = None

    def note(self, what: Any) -> None:
        seconds = self.get_clock().now().nanoseconds / 1e9
        self.log.append((int(seconds) if seconds == int(seconds) else seconds, what))

    def send(self, order: int) -> None:
        sent = self.client.send_goal_async(
            Fibonacci.Goal(order=order), lambda heard: self.note(list(heard.feedback.sequence))
        )
        sent.add_done_callback(self.decided)

    def decided(self, future: Any) -> None:
        self.goal = future.result()
        self.note("accepted" if self.goal.accepted else "rejected")
        if self.goal.accepted:
            self.goal.get_result_async().add_done_callback(self.ended)

    def ended(self, future: Any) -> None:
        response = future.result()
        self.note((response.status, list(response.result.sequence)))

    def cancel(self) -> None:
        self.goal.cancel_goal_async().add_done_callback(
            lambda future: self.note(f"canceling {len(future.result().goals_canceling)}")
        )

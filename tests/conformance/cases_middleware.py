"""Cases of actions and of quality of service."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import (
    CallbackGroup,
    ReentrantCallbackGroup,
)
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future
from std_msgs.msg import Int32
from test_msgs.action import Fibonacci

from conformance.programs import (
    Burst,
    LoggedNode,
    Process,
    case,
    work_for_a_while,
)


class FibonacciServer(LoggedNode):
    """An action server that sleeps before each number."""

    step = 0.4

    def __init__(self, group: CallbackGroup | None = None) -> None:
        super().__init__("fibonacci_server")
        self.server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            self.execute,
            callback_group=group,
            cancel_callback=self.accept_cancel,
        )

    def accept_cancel(self, _: Any) -> CancelResponse:
        self.note("accepts cancel")
        return CancelResponse.ACCEPT

    def execute(self, goal: Any) -> Fibonacci.Result:
        self.note("goal begins")
        sequence = [0, 1]
        for _ in range(goal.request.order):
            time.sleep(self.step)
            if goal.is_cancel_requested:
                goal.canceled()
                self.note("goal canceled")
                return Fibonacci.Result(sequence=sequence)
            sequence.append(sequence[-1] + sequence[-2])
            self.note(f"feedback {sequence[-1]}")
            goal.publish_feedback(Fibonacci.Feedback(sequence=sequence))
        goal.succeed()
        self.note("goal ends")
        return Fibonacci.Result(sequence=sequence)


class FibonacciClient(LoggedNode):
    """An action client in the style of the official tutorial."""

    order = 3
    cancel_after = 0.0

    def __init__(self) -> None:
        super().__init__("fibonacci_client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.once(0.5, self.send)

    def send(self) -> None:
        self.note(f"server {self.client.wait_for_server(timeout_sec=1.0)}")
        goal = Fibonacci.Goal(order=self.order)
        sent = self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        sent.add_done_callback(self.on_response)

    def on_response(self, sent: Future) -> None:
        self.goal = sent.result()
        self.note(f"accepted {self.goal.accepted}")
        self.goal.get_result_async().add_done_callback(self.on_result)
        if self.cancel_after:
            self.once(self.cancel_after, self.cancel)

    def on_feedback(self, message: Any) -> None:
        self.note(f"hears {message.feedback.sequence[-1]}")

    def cancel(self) -> None:
        self.note("cancels")
        self.goal.cancel_goal_async().add_done_callback(self.on_canceled)

    def on_canceled(self, future: Future) -> None:
        self.note(f"goals canceling {len(future.result().goals_canceling)}")

    def on_result(self, future: Future) -> None:
        answer = future.result()
        self.note(f"result {list(answer.result.sequence)} status {answer.status}")


@case(2.9)
def action_with_feedback() -> list[Process]:
    """A goal with feedback and a result, from a server that sleeps."""
    return [Process((FibonacciClient,)), Process((FibonacciServer,))]


@case(3.4)
def action_canceled() -> list[Process]:
    """A server with threads and a reentrant group notices the cancel request between two steps."""

    class Canceling(FibonacciClient):
        order = 5
        cancel_after = 1.0

    class Reentrant(FibonacciServer):
        def __init__(self) -> None:
            super().__init__(ReentrantCallbackGroup())

    return [Process((Canceling,)), Process((Reentrant,), threads=4)]


@case(3.4)
def action_two_goals() -> list[Process]:
    """A second goal waits for the first in a single thread."""

    class Short(FibonacciServer):
        step = 0.35

    class Second(FibonacciClient):
        order = 2

        def __init__(self) -> None:
            LoggedNode.__init__(self, "second_client")
            self.client = ActionClient(self, Fibonacci, "fibonacci")
            self.once(0.9, self.send)

    return [Process((FibonacciClient,)), Process((Second,)), Process((Short,))]


@case(2.4)
def action_that_raises() -> list[Process]:
    """An exception in the work on a goal aborts it; the server goes on."""

    class Raising(FibonacciServer):
        def __init__(self) -> None:
            super().__init__()
            self.every(0.7)

        def execute(self, goal: Any) -> Fibonacci.Result:
            self.note("raises")
            raise ValueError("no numbers left")

    return [Process((FibonacciClient,)), Process((Raising,))]


class FeedbackAtOnce(LoggedNode):
    """An action server that sends feedback as soon as it has accepted the goal."""

    def __init__(self) -> None:
        super().__init__("fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "fibonacci", self.execute)

    def execute(self, goal: Any) -> Fibonacci.Result:
        self.note("executes")
        work_for_a_while()  # else the client sometimes finds both when it looks
        goal.publish_feedback(Fibonacci.Feedback(sequence=[0, 1]))
        self.sleep(0.4)
        goal.publish_feedback(Fibonacci.Feedback(sequence=[0, 1, 1]))
        goal.succeed()
        return Fibonacci.Result(sequence=[0, 1, 1])


class GoalSender(LoggedNode):
    """Sends a goal, and writes down what comes back."""

    def __init__(self) -> None:
        super().__init__("fibonacci_client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.once(0.5, self.send)

    def send(self) -> None:
        self.client.wait_for_server()
        self.note("sends")
        sent = self.client.send_goal_async(Fibonacci.Goal(order=2), feedback_callback=self.hear_of)
        sent.add_done_callback(self.on_response)

    def hear_of(self, message: Any) -> None:
        self.note(f"hears {list(message.feedback.sequence)}")

    def on_response(self, future: Future) -> None:
        self.note(f"accepted {future.result().accepted}")
        future.result().get_result_async().add_done_callback(self.on_result)

    def on_result(self, future: Future) -> None:
        self.note(f"result {list(future.result().result.sequence)}")


@case(2.4, tolerance=0.6)
def feedback_after_acceptance() -> list[Process]:
    """A client hears that its goal is accepted before the feedback that follows at once."""
    return [Process((GoalSender,)), Process((FeedbackAtOnce,))]


@case(2.9, tolerance=0.6, from_first=True)
def feedback_after_acceptance_in_a_program() -> list[Process]:
    """So does a program that ends with the result."""

    def main() -> None:
        class Last(GoalSender):
            def on_result(self, future: Future) -> None:
                super().on_result(future)
                rclpy.shutdown()

        rclpy.init()
        rclpy.spin(Last())

    return [Process(main=main), Process((FeedbackAtOnce,))]


#: Fast DDS sends stored messages to a late-joining subscription in another process when the two
#: have exchanged heartbeats, which takes up to some tenths of a second.
LATE_JOINER = 0.4


class Storing(LoggedNode):
    """Publishes three messages, stored for late-joining subscriptions, and one more later."""

    lifespan = 0.0

    def __init__(self) -> None:
        super().__init__("talker")
        limits = {"lifespan": Duration(seconds=self.lifespan)} if self.lifespan else {}
        qos = QoSProfile(depth=2, durability=DurabilityPolicy.TRANSIENT_LOCAL, **limits)
        self.publisher = self.create_publisher(Int32, "number", qos)
        for number, seconds in enumerate((0.5, 0.8, 1.1, 3.2), start=1):
            self.once(seconds, lambda number=number: self.publish(number))

    def publish(self, number: int) -> None:
        self.note(f"publishes {number}")
        self.publisher.publish(Int32(data=number))


class LateListener(LoggedNode):
    """Hears what was stored."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.hear("number", QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL))


@case(3.6, tolerance=LATE_JOINER)
def late_joiner() -> list[Process]:
    """A late-joining subscription gets the last messages that were stored for it."""
    return [Process((Storing,)), Process((LateListener,), start=1.5)]


@case(2.8)
def queue_overflow() -> list[Process]:
    """A subscription with depth 2 whose process sleeps keeps the last two messages."""

    class Slow(LoggedNode):
        def __init__(self) -> None:
            super().__init__("slow")
            self.hear("number", 2)
            self.once(0.5, lambda: self.sleep(1.0))

    return [Process((Burst,)), Process((Slow,))]


@case(2.8)
def lifespan_in_a_queue() -> list[Process]:
    """A subscription's lifespan drops what has waited too long while its process slept."""

    class Slow(LoggedNode):
        def __init__(self) -> None:
            super().__init__("slow")
            self.hear("number", QoSProfile(depth=10, lifespan=Duration(seconds=0.4)))
            self.once(0.5, lambda: self.sleep(1.0))

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publish_at(0.8, "number", 1)
            self.publish_at(1.35, "number", 2)
            self.publish_at(2.0, "number", 3)

    return [Process((Talker,)), Process((Slow,))]


@case(3.6)
def deadline_missed() -> list[Process]:
    """Both ends notice each period without a message."""
    qos = QoSProfile(depth=10, deadline=Duration(seconds=0.6))

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            events = PublisherEventCallbacks(
                deadline=lambda info: self.note(f"offered missed {info.total_count}")
            )
            self.publisher = self.create_publisher(Int32, "number", qos, event_callbacks=events)
            for number, seconds in enumerate((0.4, 0.8, 2.3, 2.7, 3.1), start=1):
                self.once(seconds, lambda number=number: self.publish(number))

        def publish(self, number: int) -> None:
            self.note(f"publishes {number}")
            self.publisher.publish(Int32(data=number))

    class Listener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            events = SubscriptionEventCallbacks(
                deadline=lambda info: self.note(f"requested missed {info.total_count}")
            )
            self.hear("number", qos, event_callbacks=events)

    return [Process((Talker,)), Process((Listener,))]


@case(3.2)
def deadline_missed_while_asleep() -> list[Process]:
    """Several missed deadlines during a sleep are one event, before timers and messages."""
    qos = QoSProfile(depth=10, deadline=Duration(seconds=0.5))

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publisher = self.create_publisher(Int32, "number", qos)
            for number, seconds in enumerate((0.4, 2.2, 2.55, 2.9), start=1):
                self.once(seconds, lambda number=number: self.publish(number))

        def publish(self, number: int) -> None:
            self.publisher.publish(Int32(data=number))

    class Listener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            events = SubscriptionEventCallbacks(
                deadline=lambda info: self.note(f"missed {info.total_count_change}")
            )
            self.hear("number", qos, event_callbacks=events)
            self.once(0.7, lambda: self.sleep(1.5))
            self.once(1.0, lambda: self.note("timer"))

    return [Process((Talker,)), Process((Listener,))]


@case(1.8, misfits=True)
def incompatible_reliability() -> list[Process]:
    """A reliable subscription gets nothing from a best-effort publisher."""
    best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publisher = self.create_publisher(Int32, "number", best_effort)
            self.create_timer(0.5, self.publish)

        def publish(self) -> None:
            self.note("publishes")
            self.publisher.publish(Int32(data=1))

    class Listener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            self.hear("number")

    class Lenient(LoggedNode):
        def __init__(self) -> None:
            super().__init__("lenient")
            self.hear("number", best_effort)

    return [Process((Talker,)), Process((Listener,)), Process((Lenient,))]

"""Cases of entities: those that no `Node.create_*` made, and those that are destroyed or clash."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from action_msgs.msg import GoalStatus
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.action import ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.task import Future
from rclpy.waitable import NumberOfEntities, Waitable
from std_msgs.msg import Float32, Int32
from test_msgs.action import Fibonacci

from conformance.programs import (
    Adder,
    AddingNode,
    Beat,
    LoggedNode,
    Process,
    case,
    sum_of,
    wait_until,
)

#: How long the first request of a client may take to a server that has just been found, in seconds.
FIRST_REQUEST = 0.3


class LifecycleTalker(LoggedNode, LifecycleNode):
    """Publishes twice a second, which has an effect while it is active."""

    def __init__(self) -> None:
        LifecycleNode.__init__(self, "talker")
        self.talker: Any = None
        self.number = 0

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        self.note(f"configures from {state.label}")
        self.talker = self.create_lifecycle_publisher(Int32, "number", 10)
        self.timer = self.create_timer(0.3, self.publish)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        self.note(f"activates from {state.label}")
        return super().on_activate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        self.note(f"cleans up from {state.label}")
        self.destroy_timer(self.timer)
        self.destroy_lifecycle_publisher(self.talker)
        return TransitionCallbackReturn.SUCCESS

    def publish(self) -> None:
        self.number += 1
        self.note(f"publishes {self.number}, activated: {self.talker.is_activated}")
        self.talker.publish(Int32(data=self.number))


class Manager(LoggedNode):
    """Leads the talker through its states."""

    #: When it asks for which transition: configure, activate, deactivate, clean up.
    plan = ((0.5, 1), (1.25, 3), (1.85, 4), (2.45, 2))

    def __init__(self) -> None:
        super().__init__("manager")
        self.changer = self.create_client(ChangeState, "talker/change_state")
        self.asker = self.create_client(GetState, "talker/get_state")
        for seconds, transition in self.plan:
            self.once(seconds, lambda transition=transition: self.change(transition))

    def change(self, transition: int) -> None:
        request = ChangeState.Request()
        request.transition.id = transition
        self.note(f"asks for transition {transition}")
        self.changer.call_async(request).add_done_callback(self.changed)

    def changed(self, future: Future) -> None:
        self.note(f"success {future.result().success}")
        self.asker.call_async(GetState.Request()).add_done_callback(self.told)

    def told(self, future: Future) -> None:
        self.note(f"state {future.result().current_state.label}")


class NumberListener(LoggedNode):
    """Writes down the numbers that it hears."""

    def __init__(self, name: str = "listener") -> None:
        super().__init__(name)
        self.hear("number")


@case(3.0, tolerance=FIRST_REQUEST, from_first=True)
def lifecycle_by_services() -> list[Process]:
    """A lifecycle node changes its state by its services, and publishes while it is active."""
    return [Process((LifecycleTalker,)), Process((Manager,)), Process((NumberListener,), start=0.1)]


@case(1.85)
def lifecycle_by_methods() -> list[Process]:
    """So it does by its own methods; nobody hears what an inactive publisher publishes."""

    class Itself(LifecycleTalker):
        def __init__(self) -> None:
            super().__init__()
            self.once(0.2, lambda: self.note(f"{self.trigger_configure()}"))
            self.once(1.0, lambda: self.note(f"{self.trigger_activate()}"))
            self.once(1.6, lambda: self.note(f"{self.trigger_deactivate()}"))
            self.hear("number")

    return [Process((Itself,))]


class HiddenServices(LoggedNode):
    """Talks to an action server by its services, as a client of no action client's."""

    def __init__(self) -> None:
        super().__init__("asker")
        kind = Fibonacci.Impl
        self.sender = self.create_client(kind.SendGoalService, "fibonacci/_action/send_goal")
        self.getter = self.create_client(kind.GetResultService, "fibonacci/_action/get_result")
        self.once(0.8, self.send)

    def send(self) -> None:
        request = Fibonacci.Impl.SendGoalService.Request()
        request.goal_id.uuid = list(range(16))
        request.goal.order = 3
        self.note("sends")
        self.sender.call_async(request).add_done_callback(self.accepted)

    def accepted(self, future: Future) -> None:
        self.note(f"accepted {future.result().accepted}")
        request = Fibonacci.Impl.GetResultService.Request()
        request.goal_id.uuid = list(range(16))
        self.getter.call_async(request).add_done_callback(self.done)

    def done(self, future: Future) -> None:
        self.note(f"result {list(future.result().result.sequence)} {future.result().status}")


class QuickServer(LoggedNode):
    """An action server that is done at once."""

    def __init__(self, **options: Any) -> None:
        super().__init__("fibonacci_server")
        self.server = ActionServer(self, Fibonacci, "fibonacci", self.execute, **options)

    def execute(self, goal: ServerGoalHandle) -> Fibonacci.Result:
        self.note("executes")
        goal.succeed()
        return Fibonacci.Result(sequence=[0, 1, goal.request.order])


@case(2.0, tolerance=FIRST_REQUEST)
def goal_by_an_ordinary_client() -> list[Process]:
    """An action's hidden services answer an ordinary client."""
    return [Process((HiddenServices,)), Process((QuickServer,))]


@case(2.9, tolerance=FIRST_REQUEST)
def goal_that_expires() -> list[Process]:
    """A server forgets a goal some time after it has ended."""

    class Late(HiddenServices):
        def accepted(self, future: Future) -> None:
            self.note(f"accepted {future.result().accepted}")
            self.once(0.3, lambda: self.ask("soon"))
            self.once(1.5, lambda: self.ask("late"))

        def ask(self, when: str) -> None:
            self.note(f"asks {when}")
            request = Fibonacci.Impl.GetResultService.Request()
            request.goal_id.uuid = list(range(16))
            self.getter.call_async(request).add_done_callback(self.done)

        def done(self, future: Future) -> None:
            known = future.result().status == GoalStatus.STATUS_SUCCEEDED
            self.note("the result is known" if known else "the goal is unknown")

    return [Process((Late,)), Process((lambda: QuickServer(result_timeout=1),))]


class Ticket(Waitable):
    """A waitable of the simplest kind: a guard condition."""

    def __init__(self, node: LoggedNode) -> None:
        super().__init__(ReentrantCallbackGroup())
        self.node = node
        self.guard = node.create_guard_condition(lambda: None)
        self.tickets = 0

    def hand_in(self) -> None:
        self.tickets += 1
        self.guard.trigger()

    def is_ready(self, _: Any) -> bool:
        return self.tickets > 0

    def take_data(self) -> int:
        self.tickets -= 1
        return self.tickets

    async def execute(self, taken: int) -> None:
        self.node.note(f"executes, {taken} left")

    def get_num_entities(self) -> NumberOfEntities:
        return NumberOfEntities()

    def add_to_wait_set(self, _: Any) -> None:
        pass

    def __enter__(self) -> None:
        pass

    def __exit__(self, *_: object) -> None:
        pass


@case(1.8)
def waitable_of_a_program() -> list[Process]:
    """`spin_once` runs a waitable of the program's own, once for each call."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("waiting")
        ticket = Ticket(node)
        node.add_waitable(ticket)
        node.once(0.6, lambda: (node.note("hands in two"), ticket.hand_in(), ticket.hand_in()))
        for _ in range(3):
            rclpy.spin_once(node)
            node.note("spun once")

    return [Process(main=main)]


class TokenGroup(CallbackGroup):
    """A callback group that lets two callbacks begin in each second."""

    def __init__(self, node: LoggedNode) -> None:
        super().__init__()
        self.node = node
        self.left = 2
        self.refill = node.create_timer(1.0, self.fill, ReentrantCallbackGroup())

    def fill(self) -> None:
        self.left = 2

    def can_execute(self, entity: Any) -> bool:
        return self.left > 0

    def beginning_execution(self, entity: Any) -> bool:
        if self.left:
            self.left -= 1
            return True
        return False

    def ending_execution(self, entity: Any) -> None:
        pass


@case(2.7)
def callback_group_of_a_program() -> list[Process]:
    """A callback group of the program's own is asked before each callback."""

    class Limited(LoggedNode):
        def __init__(self) -> None:
            super().__init__("limited")
            self.every(0.28, "beat", TokenGroup(self))

    return [Process((Limited,))]


class Destroyer(LoggedNode):
    """Destroys an entity by the entity's own method, in a callback."""

    def __init__(self, kind: str) -> None:
        super().__init__("destroyer")
        self.publisher = self.create_publisher(Int32, "answer", 10)
        self.subscription = self.create_subscription(Int32, "number", self.on_number, 10)
        self.once(1.5, lambda: self.destroy(kind))
        self.once(1.8, lambda: self.note("runs on"))

    def on_number(self, message: Int32) -> None:
        self.note(f"number {message.data}")

    def destroy(self, kind: str) -> None:
        self.note(f"destroys its {kind}")
        getattr(self, kind).destroy()


class NumberTalker(LoggedNode):
    """Publishes twice."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.publish_at(1.2, "number", 1)  # when the others have found it
        self.publish_at(2.1, "number", 2)


def _destroying(kind: str) -> list[Process]:
    def main() -> None:
        rclpy.init()
        rclpy.spin(Destroyer(kind))

    return [Process(main=main), Process((NumberTalker,)), Process((NumberListener,))]


@case(2.5)
def publisher_destroyed_by_itself() -> list[Process]:
    """`publisher.destroy()` ends its own process, and no other."""
    return _destroying("publisher")


@case(2.5)
def subscription_destroyed_by_itself() -> list[Process]:
    """So does `subscription.destroy()`."""
    return _destroying("subscription")


@case(2.5)
def subscription_made_after_one_was_destroyed() -> list[Process]:
    """After `subscription.destroy()` others can be made; the process ends when it spins."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("destroyer")
        node.hear("number").destroy()
        node.note("destroyed")
        node.hear("number")
        node.note("made another")
        rclpy.spin(node)

    return [Process(main=main), Process((NumberTalker,)), Process((NumberListener,), start=0.5)]


@case(1.9, misfits=True)
def context_destroyed() -> list[Process]:
    """A program that destroys its context ends alone."""

    def main() -> None:
        rclpy.init()
        node = Beat("first")
        rclpy.spin_once(node)
        rclpy.spin_once(node)
        node.note("leaves")
        node.destroy_node()
        context = rclpy.get_default_context()
        rclpy.shutdown(context=context)
        context.destroy()

    return [Process(main=main), Process((Beat,))]


@case(2.1)
def two_nodes_of_one_name() -> list[Process]:
    """Two processes whose nodes have the same name both run; only a person is confused."""

    class First(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            self.hear("number")

    class Second(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            self.once(1.0, lambda: self.note("the second runs"))

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publish_at(0.7, "number", 1)
            self.publish_at(1.4, "number", 2)

    return [Process((First, Beat)), Process((Second,)), Process((Talker,))]


@case(2.6)
def two_programs_of_one_name() -> list[Process]:
    """So do two programs, and each ends by itself."""

    def program(start: float, period: float, count: int) -> Process:
        def main() -> None:
            rclpy.init()
            node = LoggedNode("counter")
            node.every(period, f"of {count}")
            for _ in range(count):
                rclpy.spin_once(node)

        return Process(main=main, start=start)

    # The second runs between the two lines of the first.
    return [program(0.0, 1.0, 2), program(1.0, 0.5, 1)]


@case(1.8, misfits=True)
def two_types_on_one_topic() -> list[Process]:
    """A publisher and a subscription of different types do not find each other; all run."""

    class Fitting(LoggedNode):
        def __init__(self) -> None:
            super().__init__("fitting")
            self.hear("number")

    class Misfit(LoggedNode):
        def __init__(self) -> None:
            super().__init__("misfit")
            self.subscription = self.create_subscription(
                Float32, "number", lambda message: self.note(f"hears {message.data}"), 10
            )
            self.every(0.4)
            self.once(1.5, self.count)

        def count(self) -> None:
            self.note(f"publishers {self.subscription.get_publisher_count()}")

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publish_at(0.9, "number", 5)

    return [Process((Talker,)), Process((Fitting,)), Process((Misfit,))]


@case(1.8, from_first=True)
def publisher_after_shutdown() -> list[Process]:
    """After `rclpy.shutdown()` a publisher refuses a message, and a subscriber gets none."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("talker")
        publisher = node.create_publisher(Int32, "number", 10)
        wait_until(publisher.get_subscription_count)
        node.note("publishes 1")
        publisher.publish(Int32(data=1))
        time.sleep(0.3)
        rclpy.shutdown()
        node.note("publishes 2")
        publisher.publish(Int32(data=2))

    return [Process(main=main), Process((NumberListener,))]


@case(1.8, from_first=True)
def client_after_shutdown() -> list[Process]:
    """A client still sends its request; `spin` returned when the context was shut down."""

    def main() -> None:
        rclpy.init()
        node = AddingNode("asker")
        node.client.wait_for_service()
        node.once(0.3, rclpy.shutdown)
        rclpy.spin(node)
        node.note("asks")
        node.client.call_async(sum_of(1, 2))

    return [Process(main=main), Process((Adder,))]


@case(2.3, tolerance=FIRST_REQUEST)
def service_of_a_new_node() -> list[Process]:
    """A node that a callback makes, and adds to the executor, serves."""

    class Maker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("maker")
            self.once(0.5, self.make)

        def make(self) -> None:
            self.note("makes a server")
            self.server = Adder()
            self.executor.add_node(self.server)

    class Asker(AddingNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.once(1.6, self.ask)

        def ask(self) -> None:
            self.note(f"ready {self.client.service_is_ready()}")
            future = self.client.call_async(sum_of(3, 4))
            future.add_done_callback(lambda done: self.note_response(done.result()))

    return [Process((Maker,)), Process((Asker,))]

"""Cases of what waits: services, nested spins, loops in main, rates, clocks and messages."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from rclpy.callback_groups import (
    MutuallyExclusiveCallbackGroup,
    ReentrantCallbackGroup,
)
from rclpy.duration import Duration
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32
from test_msgs.srv import BasicTypes

from conformance.programs import (
    Adder,
    AdderOfASecond,
    AdderOfHalfASecond,
    AddingNode,
    Beat,
    LoggedNode,
    Process,
    case,
    sum_of,
)


@case(2.0)
def call_async_with_done_callback() -> list[Process]:
    """The done callback comes with the response; the node is free until then."""

    class Asker(AddingNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.once(0.5, self.ask)
            self.once(0.8, lambda: self.note("meanwhile"))

        def ask(self) -> None:
            self.note("asks")
            future = self.client.call_async(sum_of(2, 3))
            future.add_done_callback(lambda done: self.note_response(done.result()))

    return [Process((Asker,)), Process((AdderOfHalfASecond,))]


class AwaitingNode(AddingNode):
    """Awaits a response in a callback, and has a timer besides."""

    reentrant = False

    def __init__(self) -> None:
        group = ReentrantCallbackGroup() if self.reentrant else None
        super().__init__("asker", group)
        self.every(0.4)
        self.once(0.5, self.ask, group)

    async def ask(self) -> None:
        self.note("asks")
        self.note_response(await self.client.call_async(sum_of(2, 3)))


@case(2.2)
def await_in_the_default_group() -> list[Process]:
    """Awaiting a response in the client's group never ends, and holds up the whole group."""
    return [Process((AwaitingNode,)), Process((AdderOfHalfASecond,))]


@case(2.2)
def await_in_a_reentrant_group() -> list[Process]:
    """Awaiting a response in a reentrant group works, and holds up nothing."""

    class Reentrant(AwaitingNode):
        reentrant = True

    return [Process((Reentrant,)), Process((AdderOfHalfASecond,))]


class CallingNode(AddingNode):
    """Calls a service from a timer callback, and has a timer in another group besides."""

    timeout: float | None = None
    own_group = False

    def __init__(self, name: str = "asker") -> None:
        super().__init__(name, MutuallyExclusiveCallbackGroup() if self.own_group else None)
        self.every(0.4, group=MutuallyExclusiveCallbackGroup())
        self.once(0.5, self.ask)

    def ask(self) -> None:
        self.note("asks")
        self.note_response(self.client.call(sum_of(2, 3), timeout_sec=self.timeout))


class CallingInOwnGroup(CallingNode):
    """The client is in a group of its own."""

    own_group = True


@case(2.6)
def call_with_threads_and_own_group() -> list[Process]:
    """`call` in a callback works with threads, and with a group for the client."""
    return [Process((CallingInOwnGroup,), threads=4), Process((AdderOfASecond,))]


@case(2.6)
def call_with_threads_in_the_default_group() -> list[Process]:
    """`call` in a callback of the client's own group waits forever; other groups go on."""
    return [Process((CallingNode,), threads=4), Process((AdderOfHalfASecond,))]


@case(2.5)
def call_in_a_single_thread() -> list[Process]:
    """`call` in a callback of a single thread waits forever, and other processes go on."""
    return [Process((CallingNode,)), Process((Adder,)), Process((Beat,))]


@case(2.6)
def call_with_timeout_in_a_single_thread() -> list[Process]:
    """`call` with a timeout in a callback of a single thread ends when it is over.

    It returns None in Jazzy, and raises TimeoutError in Kilted.
    """

    class Patient(CallingNode):
        timeout = 0.7

    return [Process((Patient,)), Process((Adder,))]


@case(2.2)
def server_with_threads() -> list[Process]:
    """A reentrant service handles two requests at once."""

    class Parallel(LoggedNode):
        def __init__(self) -> None:
            super().__init__("adder")
            self.service = self.create_service(
                BasicTypes, "add", self.add, callback_group=ReentrantCallbackGroup()
            )

        def add(self, request: Any, response: Any) -> Any:
            self.sleep(0.7, f"request {request.int32_value}")
            response.int64_value = request.int32_value + request.int64_value
            return response

    class Asker(AddingNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.once(0.5, lambda: self.ask(1))
            self.once(0.9, lambda: self.ask(2))

        def ask(self, number: int) -> None:
            future = self.client.call_async(sum_of(number, 10))
            future.add_done_callback(lambda done: self.note_response(done.result()))

    return [Process((Asker,)), Process((Parallel,), threads=4)]


@case(2.6)
def server_that_awaits_another() -> list[Process]:
    """An async service callback awaits another service, in a reentrant group."""

    class Relay(AddingNode):
        def __init__(self) -> None:
            group = ReentrantCallbackGroup()
            super().__init__("relay", group)
            self.create_service(BasicTypes, "relay", self.relay, callback_group=group)

        async def relay(self, request: Any, response: Any) -> Any:
            self.note("asks on")
            answer = await self.client.call_async(request)
            self.note("answers")
            response.int64_value = -answer.int64_value
            return response

    class Asker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.client = self.create_client(BasicTypes, "relay")
            self.once(0.5, self.ask)

        def ask(self) -> None:
            future = self.client.call_async(sum_of(2, 3))
            future.add_done_callback(lambda f: self.note(f"answer {f.result().int64_value}"))

    return [Process((Asker,)), Process((Relay,)), Process((AdderOfHalfASecond,))]


#: `wait_for_service` looks every 0.25 s, and may look just before the service is found.
FOUND = 0.4


class WaitsInItsConstructor(AddingNode):
    """The client node of the official tutorial."""

    def __init__(self) -> None:
        super().__init__("asker")
        self.note("is made")
        while not self.client.wait_for_service(timeout_sec=1.0):
            self.note("service not available, waiting again")
        self.note("service available")
        future = self.client.call_async(sum_of(2, 3))
        future.add_done_callback(lambda done: self.note_response(done.result()))
        self.once(0.3, lambda: self.note("timer"))


@case(4.1, tolerance=2 * FOUND)
def wait_for_service_in_a_constructor() -> list[Process]:
    """A constructor waits for a server that starts later, as in the official tutorial."""

    def main() -> None:
        rclpy.init()
        rclpy.spin(WaitsInItsConstructor())

    return [Process((Beat,)), Process(main=main, start=0.3), Process((Adder,), start=2.87)]


@case(3.3)
def wait_for_service_in_vain() -> list[Process]:
    """`wait_for_service` with a timeout in a callback returns False, and the node goes on."""

    class Waiter(AddingNode):
        def __init__(self) -> None:
            super().__init__("waiter")
            self.every(0.4)
            self.once(0.5, self.wait)

        def wait(self) -> None:
            self.note("waits")
            self.note(f"service {self.client.wait_for_service(timeout_sec=1.0)}")

    return [Process((Waiter,)), Process((Beat,))]


class NestedSpin(AddingNode):
    """Spins inside a callback until a response has come."""

    reentrant = False
    timeout: float | None = 1.0

    def __init__(self) -> None:
        super().__init__("asker", ReentrantCallbackGroup() if self.reentrant else None)
        self.every(0.4, "own group", MutuallyExclusiveCallbackGroup())
        self.every(0.7, "default group")
        self.once(0.5, self.ask)

    def ask(self) -> None:
        self.note("asks")
        future = self.client.call_async(sum_of(2, 3))
        rclpy.spin_until_future_complete(self, future, timeout_sec=self.timeout)
        self.note(f"done {future.done()}")


class NestedSpinReentrant(NestedSpin):
    """The client is in a reentrant group."""

    reentrant = True


@case(3.4)
def nested_spin_in_the_default_group() -> list[Process]:
    """Inside a callback of the client's own group, no response comes before the timeout."""
    return [Process((NestedSpin,)), Process((Adder,))]


@case(3.4)
def nested_spin_in_a_reentrant_group() -> list[Process]:
    """With the client in a reentrant group the response comes, and the node goes on."""
    return [Process((NestedSpinReentrant,)), Process((AdderOfHalfASecond,))]


@case(3.3)
def nested_spin_with_an_executor_of_its_own() -> list[Process]:
    """The same where the process has an executor of its own: afterwards nobody spins the node."""
    return [Process((NestedSpinReentrant, Beat)), Process((AdderOfHalfASecond,))]


@case(3.4, tolerance=FOUND)
def nested_spin_of_a_new_node() -> list[Process]:
    """A callback makes a node for its question, and spins that one."""

    class Maker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("maker")
            self.every(0.9)
            self.once(0.5, self.ask)

        def ask(self) -> None:
            self.note("asks")
            helper = rclpy.create_node("helper")
            client = helper.create_client(BasicTypes, "add")
            client.wait_for_service()
            future = client.call_async(sum_of(2, 3))
            rclpy.spin_until_future_complete(helper, future)
            self.note(f"sum {future.result().int64_value}")
            helper.destroy_node()

    return [Process((Maker,)), Process((AdderOfHalfASecond,))]


@case(5.0, from_first=True)
def client_with_timeouts() -> list[Process]:
    """`main` gives up on a response after 0.3 s; it comes while `main` waits for the next."""

    class Asker(AddingNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.client.wait_for_service()

    def main() -> None:
        rclpy.init()
        node = Asker()
        futures = []
        for number in range(3):
            node.note(f"asks {number}")
            futures.append(node.client.call_async(sum_of(number, 10)))
            rclpy.spin_until_future_complete(node, futures[-1], timeout_sec=0.3)
            node.note(f"done {[future.done() for future in futures]}")
        rclpy.spin_until_future_complete(node, futures[-1])
        node.note(f"done {[future.done() for future in futures]}")

    return [Process((AdderOfHalfASecond,)), Process(main=main, start=0.3)]


@case(3.6, tolerance=0.25)
def spin_once_in_a_loop() -> list[Process]:
    """`spin_once` returns after a callback or its timeout; what `main` does holds up the node."""

    class Looped(LoggedNode):
        def __init__(self) -> None:
            super().__init__("looped")
            self.every(0.8)

    def main() -> None:
        rclpy.init()
        node = Looped()
        node.note("made")
        for _ in range(4):
            rclpy.spin_once(node, timeout_sec=0.5)
            node.note("spun once")
        time.sleep(1.0)
        node.note("slept")
        while rclpy.ok():
            rclpy.spin_once(node)
            node.note("spun once more")

    return [Process(main=main)]


@case(
    2.6, tolerance=0.25,
)  # fmt: skip
def spin_once_without_waiting() -> list[Process]:
    """`spin_once(timeout_sec=0)` takes what is ready, one callback at a time."""

    class Looped(LoggedNode):
        def __init__(self) -> None:
            super().__init__("looped")
            self.every(0.3, "a")
            self.every(0.3, "b")

    def main() -> None:
        rclpy.init()
        node = Looped()
        node.note("made")
        for _ in range(3):
            time.sleep(0.7)
            rclpy.spin_once(node, timeout_sec=0)
            node.note("spun once")

    return [Process(main=main)]


class RateNode(LoggedNode):
    """Sleeps with a Rate in a callback."""

    def __init__(self) -> None:
        super().__init__("rate")
        self.once(0.3, self.work)
        self.every(0.7, group=MutuallyExclusiveCallbackGroup())

    def work(self) -> None:
        rate = self.create_rate(2.0)
        self.note("begins")
        for number in range(3):
            rate.sleep()
            self.note(f"step {number + 1}")
        self.destroy_rate(rate)
        self.note("ends")


@case(2.6)
def rate_with_threads() -> list[Process]:
    """`Rate.sleep` in a callback works with threads: the rate has a group of its own."""
    return [Process((RateNode,), threads=4)]


@case(2.5)
def rate_in_a_single_thread() -> list[Process]:
    """`Rate.sleep` in a callback of a single thread waits forever."""
    return [Process((RateNode,)), Process((Beat,))]


@case(3.3)
def clock_sleeps() -> list[Process]:
    """`Clock.sleep_for` and `Clock.sleep_until` hold up the process as `time.sleep` does."""

    class Sleeper(LoggedNode):
        def __init__(self) -> None:
            super().__init__("sleeper")
            self.every(0.7)
            self.once(0.4, self.sleep_by_the_clock)

        def sleep_by_the_clock(self) -> None:
            clock = self.get_clock()
            began = clock.now()
            self.note("begins")
            self.note(f"sleep_for {clock.sleep_for(Duration(seconds=0.8))}")
            until = began + Duration(seconds=1.6)
            self.note(f"sleep_until {clock.sleep_until(until)}")
            self.note(f"in the past {clock.sleep_until(began)}")

    return [Process((Sleeper,)), Process((Beat,))]


@case(3.2)
def wait_for_message_in_a_callback() -> list[Process]:
    """`wait_for_message` in a callback returns the next message, or False after its timeout."""

    class Waiter(LoggedNode):
        def __init__(self) -> None:
            super().__init__("waiter")
            self.every(0.7)
            self.once(0.4, self.wait)

        def wait(self) -> None:
            self.note("waits")
            found, message = wait_for_message(Int32, self, "number", time_to_wait=1.5)
            self.note(f"{found} {message.data if message else None}")
            found, message = wait_for_message(Int32, self, "number", time_to_wait=0.6)
            self.note(f"{found} {message.data if message else None}")

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publish_at(1.2, "number", 5)

    return [Process((Waiter,)), Process((Talker,))]


class Rated(LoggedNode):
    """Works in a loop with a rate that was made in the constructor."""

    def __init__(self, work: float) -> None:
        super().__init__("rated")
        self.rate = self.create_rate(2.5)
        self.work = work
        self.once(1.0, self.run, MutuallyExclusiveCallbackGroup())

    def run(self) -> None:
        for number in range(3):
            self.rate.sleep()
            self.note(f"step {number + 1}")
            time.sleep(self.work)


@case(3.2)
def rate_that_has_ticked() -> list[Process]:
    """A tick that came while nobody slept makes the next `sleep` return at once."""
    # Ticks at 0.4, 0.8, 1.2, 1.6, ...; the callback begins at 1.0.
    return [Process((lambda: Rated(0.05),), threads=3)]


@case(3.2)
def rate_that_is_slower_than_the_work() -> list[Process]:
    """So it does where the work takes longer than the period."""
    return [Process((lambda: Rated(0.5),), threads=3)]


@case(2.5)
def rate_that_has_ticked_in_a_single_thread() -> list[Process]:
    """The first `sleep` of a single thread returns, for a tick has passed; the second never."""
    return [Process((lambda: Rated(0.05),)), Process((Beat,))]


@case(2.6)
def rate_in_a_loop_of_main() -> list[Process]:
    """A loop around `spin_once` and `rate.sleep` goes on as long as the ticks come in between."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("looped")
        rate = node.create_rate(2.5)
        for number in range(4):
            rclpy.spin_once(node)
            rate.sleep()
            node.note(f"step {number + 1}")

    return [Process(main=main)]

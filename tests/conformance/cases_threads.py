"""Cases of threads that a node starts, and of what blocks a thread."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from queue import Empty, Queue

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import Int32

from conformance.programs import (
    Adder,
    AddingNode,
    Beat,
    LoggedNode,
    Process,
    case,
    sum_of,
)


@case(2.2)
def event_that_another_callback_sets() -> list[Process]:
    """`Event.wait` in a callback ends when another thread of the executor sets the event."""

    class Waiting(LoggedNode):
        def __init__(self) -> None:
            super().__init__("waiting")
            group = ReentrantCallbackGroup()
            self.event = threading.Event()
            self.once(0.4, self.wait, group)
            self.once(1.0, lambda: (self.note("sets"), self.event.set()), group)

        def wait(self) -> None:
            self.note("waits")
            self.note(f"event {self.event.wait(5.0)}")
            self.event.clear()
            self.note(f"event {self.event.wait(0.5)}")

    return [Process((Waiting,), threads=4)]


class Worker(LoggedNode):
    """Publishes from a thread of its own."""

    def __init__(self) -> None:
        super().__init__("worker")
        self.publisher = self.create_publisher(Int32, "number", 10)
        self.thread = threading.Thread(target=self.work, daemon=True)
        self.once(0.3, self.thread.start)
        self.every(0.9)

    def work(self) -> None:
        for number in range(3):
            time.sleep(0.4)
            self.note(f"publishes {number}")
            self.publisher.publish(Int32(data=number))


class NumberListener(LoggedNode):
    """Writes down the numbers that it hears."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.hear("number")


@case(2.0)
def worker_thread() -> list[Process]:
    """A node whose thread publishes is heard."""
    return [Process((Worker,)), Process((NumberListener,))]


@case(1.9)
def timer_of_threading() -> list[Process]:
    """`threading.Timer` calls back, unless it is canceled."""

    class Timed(LoggedNode):
        def __init__(self) -> None:
            super().__init__("timed")
            self.alarms = [
                threading.Timer(seconds, self.note, (f"timer of {seconds} s",))
                for seconds in (0.45, 0.8, 1.1)
            ]
            self.every(0.35)
            self.once(0.1, self.begin)

        def begin(self) -> None:
            for alarm in self.alarms:
                alarm.daemon = True
                alarm.start()
            time.sleep(0.1)
            self.alarms[1].cancel()

    return [Process((Timed,))]


@case(2.2)
def queue_between_threads() -> list[Process]:
    """A thread that gets jobs from a queue works while the executor goes on."""

    class Queued(LoggedNode):
        def __init__(self) -> None:
            super().__init__("queued")
            self.jobs: Queue[int] = Queue()
            self.count = 0
            self.create_timer(0.3, self.put)
            self.thread = threading.Thread(target=self.work, daemon=True)
            self.once(0.1, self.thread.start)

        def put(self) -> None:
            self.count += 1
            if self.count <= 3:
                self.note(f"puts {self.count}")
                self.jobs.put(self.count)

        def work(self) -> None:
            while True:
                try:
                    job = self.jobs.get(timeout=0.75)
                except Empty:
                    self.note("nothing to do")
                    return
                time.sleep(0.1)
                self.note(f"has done {job}")

    return [Process((Queued,))]


@case(2.1)
def condition_between_threads() -> list[Process]:
    """A condition with its lock, and `join`."""

    class Conditioned(LoggedNode):
        def __init__(self) -> None:
            super().__init__("conditioned")
            self.condition = threading.Condition()
            self.ready = 0
            self.once(0.5, self.wait)

        def work(self) -> None:
            for _ in range(2):
                time.sleep(0.3)
                with self.condition:
                    self.ready += 1
                    self.note(f"ready {self.ready}")
                    self.condition.notify()
            time.sleep(0.15)

        def wait(self) -> None:
            thread = threading.Thread(target=self.work)
            thread.start()
            with self.condition:
                self.note(f"condition {self.condition.wait_for(lambda: self.ready == 2, 3.0)}")
            thread.join(0.05)
            self.note(f"alive {thread.is_alive()}")
            thread.join()
            self.note(f"alive {thread.is_alive()}")

    return [Process((Conditioned, Beat))]


@case(1.95)
def pool_of_threads() -> list[Process]:
    """A callback waits for two jobs of a ThreadPoolExecutor, which run side by side."""

    class Pooled(LoggedNode):
        def __init__(self) -> None:
            super().__init__("pooled")
            self.pool = ThreadPoolExecutor(2)
            self.every(0.55)
            self.once(0.3, self.work)

        def job(self, seconds: float) -> float:
            time.sleep(seconds)
            self.note(f"has worked {seconds} s")
            return seconds

        def work(self) -> None:
            jobs = [self.pool.submit(self.job, seconds) for seconds in (0.65, 0.4)]
            self.note(f"in all {sum(job.result() for job in jobs):.1f} s")

    return [Process((Pooled,))]


@case(2.2)
def lock_between_callbacks() -> list[Process]:
    """A lock that one thread of the executor holds while it sleeps holds up another."""

    class Locked(LoggedNode):
        def __init__(self) -> None:
            super().__init__("locked")
            group = ReentrantCallbackGroup()
            self.lock = threading.Lock()
            self.once(0.3, lambda: self.work("first"), group)
            self.once(0.6, lambda: self.work("second"), group)
            self.every(0.65, group=group)

        def work(self, name: str) -> None:
            with self.lock:
                self.sleep(0.7, name)

    return [Process((Locked,), threads=4)]


@case(2.6, from_first=True)
def spin_in_a_thread() -> list[Process]:
    """`main` calls a service, and waits for the answer, while a thread spins."""

    def main() -> None:
        rclpy.init()
        node = AddingNode("asker")
        node.client.wait_for_service()
        node.every(0.55)
        thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
        thread.start()
        time.sleep(0.8)
        node.note("calls")
        node.note_response(node.client.call(sum_of(2, 3)))
        time.sleep(0.7)
        rclpy.shutdown()
        thread.join()
        node.note("ends")

    return [Process((Adder,)), Process(main=main)]


@case(2.2)
def executor_that_spins_in_a_thread() -> list[Process]:
    """An executor in a thread, and a rate in `main`."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("rated")
        node.every(1.2)
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node)
        thread = threading.Thread(target=executor.spin, daemon=True)
        thread.start()
        rate = node.create_rate(2.0)
        for number in range(3):
            rate.sleep()
            node.note(f"step {number + 1}")
        executor.shutdown()
        thread.join()
        node.note("ends")

    return [Process(main=main)]


@case(2.3)
def event_that_a_thread_sets() -> list[Process]:
    """In a single thread, a callback waits for a thread of the node: that is no deadlock."""

    class Waiting(LoggedNode):
        def __init__(self) -> None:
            super().__init__("waiting")
            self.done = threading.Event()
            self.once(0.3, self.wait)

        def wait(self) -> None:
            threading.Thread(target=self.work, daemon=True).start()
            self.note("waits")
            self.done.wait()
            self.note("has waited")

        def work(self) -> None:
            time.sleep(0.9)
            self.note("is done")
            self.done.set()

    return [Process((Waiting,)), Process((Beat,))]

"""Messages per second through one publisher and one subscription."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from actors import Sink, Source
from measuring import Row, interleaved
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from rosbeat import Session

AGAINST_RCLPY, AGAINST_LIMIT = 8.0, 0.7


def measure(quick: bool) -> list[Row]:
    """In bursts of ten, and one message at a time."""
    repeats = 7 if quick else 25
    return [*_compare(10, 2000, repeats), *_compare(1, 1000, repeats)]


def _compare(burst: int, messages: int, repeats: int) -> list[Row]:
    with Session() as ros, _Plain(burst) as plain:
        ros.add(partial(Source, burst))
        sink = ros.add(Sink)
        seconds = messages / burst / 1000
        ways = {
            "session": lambda: ros.run(seconds, quiet=True),
            "rclpy": partial(plain.through_executor, messages),
            "bare": partial(plain.by_hand, messages),
        }
        spans = interleaved(ways, repeats)
        assert sink.count == messages * (repeats + 1)
    return _rows(burst, {name: messages / span for name, span in spans.items()})


def _rows(burst: int, rates: dict[str, float]) -> list[Row]:
    faster, near = rates["session"] / rates["rclpy"], rates["session"] / rates["bare"]
    title = "messages/s, bursts of 10" if burst > 1 else "messages/s, one a timer tick"
    judged = burst > 1
    return [
        Row(f"{title}: session", f"{rates['session']:,.0f}"),
        Row(
            "  rclpy's SingleThreadedExecutor", f"{rates['rclpy']:,.0f}", f"{faster:.1f} x",
            f">= {AGAINST_RCLPY:g} x" if judged else "", faster >= AGAINST_RCLPY,
        ),
        Row(
            "  publish and take by hand, the limit", f"{rates['bare']:,.0f}", f"{near:.2f} x",
            f">= {AGAINST_LIMIT:g} x" if judged else "", near >= AGAINST_LIMIT,
        ),
    ]  # fmt: skip


class _Plain:
    """The same pair without a session."""

    def __init__(self, burst: int) -> None:
        self._burst = burst

    def __enter__(self) -> _Plain:
        self._context = Context()
        self._context.init([], domain_id=50)
        self._source = Node("source", context=self._context)
        self._sink = Node("sink", context=self._context)
        make = partial(_borrow, self._source, self._sink)
        self._publisher, self._subscription, self._message = make(self._hear)
        self._count = 0
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._source)
        self._executor.add_node(self._sink)
        return self

    def __exit__(self, *_: object) -> None:
        self._executor.shutdown()
        self._source.destroy_node()
        self._sink.destroy_node()
        self._context.try_shutdown()

    def through_executor(self, messages: int) -> None:
        """Publish a burst, spin until it has arrived."""
        goal = self._count
        for _ in range(messages // self._burst):
            goal += self._burst
            self._send()
            while self._count < goal:
                self._executor.spin_once(timeout_sec=1.0)

    def by_hand(self, messages: int) -> None:
        """Publish a burst, take it, call the callback: nothing can be faster."""
        subscription = self._subscription
        for _ in range(messages // self._burst):
            self._send()
            for _ in range(self._burst):
                with subscription.handle:
                    taken = subscription.handle.take_message(subscription.msg_type, False)
                subscription.callback(taken[0])

    def _send(self) -> None:
        for _ in range(self._burst):
            self._publisher.publish(self._message)

    def _hear(self, _: object) -> None:
        self._count += 1


def _borrow(source: Node, sink: Node, hear: Callable[[object], None]) -> tuple:
    from std_msgs.msg import Float32

    publisher = source.create_publisher(Float32, "flow", 10)
    subscription = sink.create_subscription(Float32, "flow", hear, 10)
    return publisher, subscription, Float32(data=1.5)

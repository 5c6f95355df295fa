"""Programs with deadlines and lifespans, run by the wall clock and in virtual time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32

from rosbeat import Session
from rosbeat.domains import lease_domain

TOPIC = "pulse"


def quality(
    deadline: float = 0.0, lifespan: float = 0.0, stored: bool = False, depth: int = 10
) -> QoSProfile:
    """A QoS profile with these limits in seconds; 0 stands for none."""
    limits = {"deadline": deadline, "lifespan": lifespan}
    return QoSProfile(
        depth=depth,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if stored else DurabilityPolicy.VOLATILE,
        **{name: Duration(seconds=limit) for name, limit in limits.items() if limit},
    )


class Heart(Node):
    """Publishes when it is told to, and notes the deadlines it has missed."""

    def __init__(self, qos: QoSProfile, name: str = "heart", **options: Any) -> None:
        super().__init__(name, **options)
        self.missed: list[tuple[int, int]] = []
        callbacks = PublisherEventCallbacks(deadline=self.on_missed)
        self.publisher = self.create_publisher(Int32, TOPIC, qos, event_callbacks=callbacks)
        self.infos: list[Any] = []

    def beat(self, number: int) -> None:
        self.publisher.publish(Int32(data=number))

    def on_missed(self, info: Any) -> None:
        self.infos.append(info)
        self.missed.append((info.total_count, info.total_count_change))


class Nurse(Node):
    """Hears, and notes the deadlines that were missed."""

    def __init__(self, qos: QoSProfile, name: str = "nurse", **options: Any) -> None:
        super().__init__(name, **options)
        self.heard: list[int] = []
        self.missed: list[tuple[int, int]] = []
        self.misfits: list[Any] = []
        self.infos: list[Any] = []
        callbacks = SubscriptionEventCallbacks(
            deadline=self.on_missed, incompatible_qos=self.misfits.append
        )
        self.subscription = self.create_subscription(
            Int32, TOPIC, self.hear, qos_profile=qos, event_callbacks=callbacks
        )

    def hear(self, message: Int32) -> None:
        self.heard.append(message.data)

    def on_missed(self, info: Any) -> None:
        self.infos.append(info)
        self.missed.append((info.total_count, info.total_count_change))


class Virtual:
    """A program in a session."""

    def __init__(self, session: Session) -> None:
        self.session = session

    def make(self, kind: Callable[..., Any], *args: Any, **options: Any) -> Any:
        return self.session.add(lambda: kind(*args, **options))

    def pass_time(self, seconds: float) -> None:
        self.session.run(seconds, quiet=True)

    def wait_for(self, done: Callable[[], Any]) -> None:
        for _ in range(1000):
            if done():
                return
            self.session.run(0.01, quiet=True)
        raise AssertionError("it never happened")

    @contextmanager
    def busy(self, *nodes: Node) -> Iterator[None]:
        for node in nodes:
            self.session.pause(node)
        yield
        for node in nodes:
            self.session.resume(node)
        self.session.run(0)


class ByTheWall:
    """The same without a session: rclpy as it is, against the wall clock."""

    def __init__(self, context: rclpy.Context) -> None:
        self.context = context
        self.executor = SingleThreadedExecutor(context=context)
        self.nodes: list[Node] = []

    def make(self, kind: Callable[..., Any], *args: Any, **options: Any) -> Any:
        made = kind(*args, context=self.context, **options)
        self.nodes.append(made)
        self.executor.add_node(made)
        self.pass_time(0.05)  # endpoints of one process are matched at once
        return made

    def pass_time(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.executor.spin_once(timeout_sec=0.01)

    def wait_for(self, done: Callable[[], Any]) -> None:
        end = time.monotonic() + 20
        while not done():
            assert time.monotonic() < end, "it never happened"
            self.executor.spin_once(timeout_sec=0.01)

    @contextmanager
    def busy(self, *nodes: Node) -> Iterator[None]:
        for node in nodes:
            self.executor.remove_node(node)
        yield
        for node in nodes:
            self.executor.add_node(node)
        self.pass_time(0.2)


@contextmanager
def virtually() -> Iterator[Virtual]:
    with Session(seed=1) as session:
        yield Virtual(session)


@contextmanager
def by_the_wall() -> Iterator[ByTheWall]:
    lease = lease_domain()
    context = rclpy.Context()
    context.init(domain_id=lease.domain_id)
    world = ByTheWall(context)
    try:
        yield world
    finally:
        world.executor.shutdown()
        for node in world.nodes:
            node.destroy_node()
        context.shutdown()
        lease.release()

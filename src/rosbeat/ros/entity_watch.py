"""Replace, on each new entity, the methods that send or wait, and run its callback from then on."""

from __future__ import annotations

import threading
from _thread import get_ident
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.client import Client
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.task import Future

from rosbeat.errors import SessionError
from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS
from rosbeat.ros.clock import VirtualClock
from rosbeat.ros.differences import RAISES_WHEN_CALL_TIMES_OUT
from rosbeat.ros.errors import note
from rosbeat.ros.processes import Entry, NodeState, callback_name
from rosbeat.ros.qos_events import wait_for_stored
from rosbeat.ros.recording import Entity, Memory, Message, PublisherTap
from rosbeat.ros.taking import TAKERS

if TYPE_CHECKING:
    from rosbeat.ros.session_core import SessionCore


class EntityWatch:
    """Watch the publishers, subscriptions, services, clients, timers and rates that nodes make.

    Args:
        core: The session of the nodes.
    """

    def __init__(self, core: SessionCore) -> None:
        self._core = core

    def begin(self, state: NodeState, kind: str, entity: Entity) -> None:
        """Tap what sends; run the callbacks of whatever has some."""
        core = self._core
        if kind in ("publisher", "subscription"):
            entity.destroy = partial(self._destroyed_by_itself, state, entity, entity.destroy)
        if kind == "publisher":
            self._tap_publisher(state, entity)
        elif kind == "rate":
            # A rate has no public name for its timer.
            entry = core.nodes.entry_of(entity._timer)
            assert entry is not None  # `create_rate` has made it by `create_timer`
            entity.sleep = partial(self._sleep, entry, entity.sleep)
            with core.running(), core.starting(core.start, state.process):
                entity._event = threading.Event()  # one that waits in virtual time
            entity._timer.callback = entity._event.set
        else:
            self._watch(state, kind, entity)

    def adopt(self, state: NodeState) -> None:
        """Watch entities that no `create_*` of the node has made, as in a lifecycle node."""
        for kind in ("subscription", "service", "client", "timer"):
            # Not the node's own attribute, which its class may have replaced.
            for entity in getattr(Node, f"{kind}s").fget(state.node):
                if self._core.nodes.entry_of(entity) is None:
                    self._watch(state, kind, entity)

    def _watch(self, state: NodeState, kind: str, entity: Entity) -> None:
        core = self._core
        if kind == "timer":
            name, source = "", f"{entity.timer_period_ns / NANOSECONDS:g} s"
        else:
            name = source = entity.topic_name if kind == "subscription" else entity.service_name
        called = "answer" if kind == "client" else callback_name(entity.callback)
        label = core.recorder.label(state.name, kind, called, source)
        entry = Entry(core.next_number(), state, kind, entity, name, label, TAKERS.get(kind))
        core.nodes.add_entry(entry)
        if kind == "timer":
            self._watch_timer(entry)
        elif kind == "subscription":
            self._watch_subscription(entry)
        elif kind == "client":
            self._watch_client(entry)
        elif kind == "service":
            self._watch_service(entry)
        core.virtual.watch(entry)

    def _watch_client(self, entry: Entry) -> None:
        """Replace the methods of a client that send or wait."""
        core = self._core
        client = entry.entity
        send, wait_for_service = client.call_async, client.wait_for_service

        def call_async(request: Message) -> Future:
            future = send(request)
            core.sent("service", entry.name, entry.state)
            return future

        call_and_wait = client.call

        def call(request: Message, timeout_sec: float | None = None) -> Message:
            self._check_call(entry)
            if core.live is None and core.virtual.in_callback:
                with core.waiting_for(f"a response from {entry.name}", client):
                    return call_and_wait(request, timeout_sec)
            return self._wait_for_answer(client, call_async(request), timeout_sec)

        def wait(timeout_sec: float | None = None) -> bool:
            # In the code of a node rclpy's own way sleeps; in a cell the nodes have to run.
            if core.live is not None or core.virtual.in_callback:
                began = core.virtual.now
                is_ready = bool(wait_for_service(timeout_sec))
                if not is_ready and core.live is None and core.virtual.now == began:
                    # ROS was shut down, so that it does not wait any more.
                    core.virtual.polled()
                return is_ready
            return core.wait_until(client.service_is_ready, timeout_sec)

        client.call_async, client.call, client.wait_for_service = call_async, call, wait

    def _watch_service(self, entry: Entry) -> None:
        """Let clients hear of an answer, whoever sends it."""
        core = self._core
        service, send = entry.entity, entry.entity.send_response
        answered = core.virtual.sender("client", entry.name, entry.state)

        def send_response(response: Message, header: Any) -> None:  # noqa: ANN401 - filled in C
            send(response, header)
            if core.live is None:
                answered()

        service.send_response = send_response

    def _watch_timer(self, entry: Entry) -> None:
        timer = entry.entity
        if isinstance(timer.clock, VirtualClock):
            timer.reset = partial(self._reset_timer, entry, timer.reset)
            return
        entry.kind = "wall timer"
        note(
            f"a timer of {entry.state.name} has its own clock, which counts real time, so it "
            "fires only while the session is live."
        )

    def _reset_timer(self, entry: Entry, original: Callable[[], None]) -> None:
        entry.entity.clock.move()
        original()
        if self._core.live is None:
            self._core.virtual.timer_reset(entry)

    def _watch_subscription(self, entry: Entry) -> None:
        core = self._core
        entry.born = core.recorder.mark()
        if core.live is None:
            taps = (tap for state in core.nodes.states() for tap in state.taps)
            wait_for_stored([tap for tap in taps if tap.topic == entry.name], entry)
        if core.counts_limits:
            core.limits.subscription_made(entry)
        if core.external_messages is not None:
            core.external_messages.watch_subscription(entry.entity)

    def _tap_publisher(self, state: NodeState, publisher: Publisher) -> None:
        core = self._core
        topic, memory = publisher.topic_name, Memory(publisher.msg_type)
        if topic in INFRASTRUCTURE_TOPICS:
            quiet = partial(core.sent, "subscription", topic, state)
            state.taps.append(PublisherTap(publisher, memory, lambda _: quiet()))
            return
        number = core.recorder.channel(topic, state.name, memory).number
        recorder, virtual, thread = core.recorder, core.virtual, get_ident()
        happened = virtual.sender("subscription", topic, state)

        def record(copy: Any) -> None:  # noqa: ANN401 - what `Memory.take` makes
            recorder.add_sample(number, virtual.now, copy)
            happened()

        def published(copy: Any) -> None:  # noqa: ANN401 - the same
            if core.live is not None:
                with recorder.lock:
                    recorder.add_sample(number, core.now(), copy)
            elif get_ident() == thread:
                record(copy)
            else:  # a thread of the node's own
                virtual.elsewhere.append(partial(record, copy))

        tap = PublisherTap(publisher, memory, published)
        state.taps.append(tap)
        if core.counts_limits:
            core.limits.publisher_made(state, publisher, tap)
        if core.external_messages is not None:
            core.external_messages.watch_publisher(publisher)

    def _destroyed_by_itself(
        self, state: NodeState, entity: Entity, destroy: Callable[[], None]
    ) -> None:
        """Let rclpy say what comes of an entity that is destroyed and still its node's."""
        destroy()
        with suppress(InvalidHandle):  # the node itself was destroyed
            if any(one is entity for one in (*state.node.publishers, *state.node.subscriptions)):
                self._core.virtual.hand_over(state.process)

    # Calls that wait.

    def _check_call(self, entry: Entry) -> None:
        if self._core.live is not None:
            self._core.refuse_in_callback("client.call")
        if not entry.state.spinning and entry.state.process.program is None:
            raise SessionError(
                f"{entry.state.name} calls {entry.name} before the node itself runs.",
                "A node that is still being created, was not added, or is paused cannot receive "
                "a response. On a robot, the call would wait forever.",
                "Add the node first, with `ros.add(...)`, and call the service after that, or in "
                "a timer's callback with `call_async`.",
            )

    def _wait_for_answer(
        self, client: Client, future: Future, timeout_sec: float | None
    ) -> Message:
        """Do in a cell what `client.call` does after its request (rclpy, `client.py`)."""
        self._core.wait("client.call", future.done, timeout_sec)
        if not future.done():
            client.remove_pending_request(future)
            if timeout_sec is not None and RAISES_WHEN_CALL_TIMES_OUT:
                raise TimeoutError
            if timeout_sec is None:
                raise SessionError(
                    f"No node has responded to the call of {client.service_name}.",
                    "Either no node of this session offers that service, or its callback does "
                    "not return. On a robot, the call would wait forever.",
                    "Add the node that offers the service first, and compare the two service "
                    "names.",
                )
        return future.result()

    def _sleep(self, entry: Entry, original: Callable[[], None]) -> None:
        if self._core.live is not None:
            self._core.refuse_in_callback("rate.sleep")
            original()
        elif self._core.virtual.in_callback:
            with self._core.waiting_for("a rate", entry.entity):
                original()
        else:
            calls = entry.calls
            self._core.wait("rate.sleep", lambda: entry.calls > calls, None)

"""The part of a session that learns of nodes and of what they make."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from threading import get_ident
from typing import Any
from weakref import WeakKeyDictionary, WeakSet

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.errors import SessionError
from rosbeat.records import INFRASTRUCTURE_TOPICS, GraphSnapshot, LogRecord
from rosbeat.runtime.acting import Acting
from rosbeat.runtime.arrivals import Arrivals
from rosbeat.runtime.clock import SessionClock
from rosbeat.runtime.console import note
from rosbeat.runtime.direct import TAKERS
from rosbeat.runtime.entities import Entry, NodeState, callback_name, full_name, period_text
from rosbeat.runtime.introspection import snapshot
from rosbeat.runtime.late_joiners import wait_for_stored
from rosbeat.runtime.launch import Launch
from rosbeat.runtime.limits import Limits
from rosbeat.runtime.live import LiveExecutor
from rosbeat.runtime.logger import SessionLogger
from rosbeat.runtime.messages import Memory, type_name
from rosbeat.runtime.recorder import Recorder
from rosbeat.runtime.sim_time import show_sim_time
from rosbeat.runtime.taps import PublisherTap, tap_client, tap_rate, tap_timer
from rosbeat.runtime.virtual_time import VirtualTimeExecutor


class Watching(Acting):
    """What the hooks tell of new nodes and entities; see `hooks.Watcher`.

    Attributes:
        clock: The one clock of all nodes.
        recorder: What happened so far.
        arrivals: Records what comes from outside; None in a private domain.
        virtual: The executor of virtual time; it also keeps the time while nothing runs.
        live: The live executor while the session is live, else None.
        start: How the node that is being made is started.
        limits: The deadlines and lifespans that the session counts.
    """

    limits: Limits
    clock: SessionClock
    recorder: Recorder
    arrivals: Arrivals | None
    virtual: VirtualTimeExecutor
    live: LiveExecutor | None

    def __init__(self) -> None:
        self._states: dict[Node, NodeState] = {}
        self._entries: dict[Any, Entry] = {}
        self._names: WeakKeyDictionary[Node, str] = WeakKeyDictionary()
        self._made: WeakSet[Any] = WeakSet()
        self._count = 0
        self.start = Launch()
        self._rosout_heard: Callable[[], None] | None = None

    @abstractmethod
    def now(self) -> int:
        """Nanoseconds since the session began."""

    @abstractmethod
    def show_news(self) -> None:
        """Print what has not been printed yet."""

    @abstractmethod
    def wait_until(self, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run virtual time until `done` is true, at most so many seconds."""

    # Which nodes there are.

    def states(self) -> list[NodeState]:
        """All nodes that have not been destroyed, in order of creation."""
        return list(self._states.values())

    def spinning_nodes(self) -> list[NodeState]:
        """The nodes whose callbacks run, in order of creation."""
        return [state for state in self.states() if state.spinning]

    def named(self, name: str) -> NodeState | None:
        """The node of this full name."""
        return next((state for state in self.states() if state.name == name), None)

    def state_of(self, node: Node | None) -> NodeState | None:
        """What is known of a node."""
        return self._states.get(node)

    def name_of(self, node: Node) -> str | None:
        """The full name of a node that is or was in this session; a destroyed one cannot say it."""
        return self._names.get(node)

    def graph(self) -> GraphSnapshot:
        """The graph as it is now."""
        return snapshot(self.states())

    def destroy(self, state: NodeState) -> None:
        """Destroy a node, whole or half-made."""
        if state.node is None:
            return
        try:
            state.node.destroy_node()
        except Exception:
            # Its constructor stopped half-way, or its own destroy_node raises, or did half of it.
            with suppress(AttributeError, InvalidHandle):
                Node.destroy_node(state.node)
            self.node_ends(state.node)

    @contextmanager
    def starting(self, start: Launch) -> Iterator[None]:
        """Nodes that are made in this block are started so."""
        before, self.start = self.start, start
        try:
            yield
        finally:
            self.start = before

    # What the hooks tell.

    def node_begins(self, name: str, namespace: str) -> None:
        """A node is about to be made: one of the same name makes room for it.

        It has to go first: rcl keeps one log publisher for each name and removes it with the first
        node of that name that is destroyed.
        """
        old = self.named(full_name(name, namespace))
        if old is not None:
            self.destroy(old)

    def node_made(self, node: Node) -> None:
        """`Node.__init__` has returned."""
        self.entity_begins(node)
        show_sim_time(node, self.live is None)

    def entity_begins(self, node: Node) -> None:
        """Give a new node the session's clock, before anything of it reads the time."""
        if "_clock" in node.__dict__ and node._clock is not self.clock:
            node._clock = self.clock
        if node not in self._states:
            name = node.get_fully_qualified_name()
            self._states[node] = NodeState(len(self._states), name, node, born_ns=self.now())
            self._names[node] = name

    def entity_made(self, node: Node, kind: str, entity: Any) -> None:  # noqa: ANN401
        """Tap what sends; run the callbacks of whatever has some."""
        state = self._states[node]
        if kind == "publisher":
            self._tap_publisher(state, entity)
        elif kind == "rate":
            tap_rate(entity, partial(self._sleep, self._entries[entity._timer]))
        else:
            self._watch(state, kind, entity)

    def node_ends(self, node: Node) -> None:
        """A node is about to be destroyed."""
        state = self._states.pop(node, None)
        if state is None:
            return
        state.spinning, state.ended = False, True
        self.virtual.forget(state)
        for entry in state.entries:
            self._entries.pop(entry.entity, None)
        if node.executor is not None:
            node.executor.remove_node(node)

    def logger_of(self, node: Node, original: Any) -> Any:  # noqa: ANN401
        """The logger that the node's code gets."""
        state = self._states.get(node)
        if state is None:
            return original
        if state.logger is None:
            state.logger = SessionLogger(original.name, self._logged, self.clock)
        return state.logger

    def explain_init(self) -> None:
        """The learner called `rclpy.init()`."""
        note("rclpy.init() has nothing to do here: the session has started ROS already.")

    def explain_shutdown(self) -> None:
        """The learner called `rclpy.shutdown()`: in a callback it ends that node."""
        current = self.virtual.current
        if self.live is not None and self.live.is_this_thread():
            current = self.state_of(self.live.current)
        if current is None:
            note("rclpy.shutdown() leaves this session open; `ros.close()` ends it.")
            return
        current.spinning, current.ended = False, True
        note(f"{current.name} called rclpy.shutdown() and stops; the other nodes go on.")

    def refuse_in_callback(self, call: str) -> None:
        """Nothing that waits for nodes may be called by a node.

        Raises:
            SessionError: If one of this session's callbacks is running, in this thread.
        """
        if self.virtual.running or (self.live is not None and self.live.is_this_thread()):
            raise SessionError(
                f"`{call}` was called from inside a callback.",
                "It waits for other callbacks, and they can only run when this one has returned: "
                "a deadlock, on a real robot too.",
                "For a service use `call_async` and add a done callback, or make the callback "
                "`async def` and await the future, with the client in a callback group of its "
                "own. To do something again and again, create a timer.",
            )

    @property
    def counts_limits(self) -> bool:
        """Whether deadlines and lifespans of what is made now are counted here; see `limits`."""
        return self.live is None and self.arrivals is None

    def next_number(self) -> int:
        """The place of a new entity in the order of creation."""
        self._count += 1
        return self._count

    # How it works.

    def _watch(self, state: NodeState, kind: str, entity: Any) -> None:  # noqa: ANN401
        name = "" if kind == "timer" else _name_of(kind, entity)
        source = period_text(entity.timer_period_ns) if kind == "timer" else name
        called = "answer" if kind == "client" else callback_name(entity.callback)
        label = self.recorder.label(state.name, kind, called, source)
        entry = Entry(self.next_number(), state, kind, entity, name, label, TAKERS.get(kind))
        state.entries.append(entry)
        self._entries[entity] = entry
        prepare = {"timer": self._timer, "subscription": self._subscription, "client": self._client}
        prepare.get(kind, bool)(entry)
        self.virtual.watch(entry)

    def _timer(self, entry: Entry) -> None:
        if entry.entity.clock is not self.clock:
            entry.kind = "wall timer"
            note(
                f"a timer of {entry.state.name} has a clock of its own, which counts real time: it "
                "fires only while the session is live."
            )
            return
        tap_timer(entry.entity, partial(self._timer_reset, entry))

    def _timer_reset(self, entry: Entry) -> None:
        if self.live is None:
            self.virtual.timer_reset(entry)

    def _client(self, entry: Entry) -> None:
        check = partial(self._check_call, entry)
        asked = self._sender("service", entry.name)
        tap_client(entry.entity, check, asked, partial(self._wait_for_answer, entry.entity))

    def _check_call(self, entry: Entry) -> None:
        self.refuse_in_callback("client.call")
        if not entry.state.spinning:
            raise SessionError(
                f"{entry.state.name} asks {entry.name} before it runs itself.",
                "Nobody takes the answer of a node that is still being made, was not added, or is "
                "paused. Outside a page the call would wait for ever.",
                "Add the node first, with `ros.add(...)`, and ask then, or in a timer's callback "
                "with `call_async`.",
            )

    def _subscription(self, entry: Entry) -> None:
        entry.born = self.recorder.mark()
        taps = [tap for state in self.states() for tap in state.taps if tap.topic == entry.name]
        wait_for_stored(taps, entry.entity)
        if self.counts_limits:
            self.limits.subscription_made(entry)
        if self.arrivals is not None:
            self.arrivals.watch_subscription(entry.entity)

    def _tap_publisher(self, state: NodeState, publisher: Any) -> None:  # noqa: ANN401
        topic = publisher.topic_name
        memory = Memory(publisher.msg_type)
        happened = self.virtual.sender("subscription", topic)
        if topic in INFRASTRUCTURE_TOPICS:
            quiet = self._sender("subscription", topic)
            state.taps.append(PublisherTap(publisher, memory, lambda _: quiet()))
            return
        kind = type_name(publisher.msg_type)
        channel = self.recorder.channel(topic, kind, state.name, memory)
        heard = self._published(happened, self.recorder.sampler(channel))
        tap = PublisherTap(publisher, memory, heard)
        tap.channel = channel
        state.taps.append(tap)
        if self.counts_limits:
            self.limits.publisher_made(state, publisher, tap)
        if self.arrivals is not None:
            self.arrivals.watch_publisher(publisher)

    def _published(
        self, happened: Callable[[], None], add: Callable[[int, Any], None]
    ) -> Callable[[Any], None]:
        virtual, home = self.virtual, get_ident()

        def heard(copy: Any) -> None:  # noqa: ANN401
            if self.live is None:
                if get_ident() != home:  # a thread of the node's own
                    virtual.elsewhere.append(partial(heard_elsewhere, copy))
                    return
                add(virtual.now, copy)
                happened()
                return
            with self.recorder.lock:
                add(self.now(), copy)

        def heard_elsewhere(copy: Any) -> None:  # noqa: ANN401
            add(virtual.now, copy)
            happened()

        return heard

    def _sender(self, kind: str, name: str) -> Callable[[], None]:
        happened = self.virtual.sender(kind, name)

        def sent() -> None:
            if self.live is None:
                happened()

        return sent

    def _logged(self, level: str, name: str, text: str, function: str, line: int) -> None:
        record = LogRecord(self.now(), level, name, text, function, line)
        self.recorder.logs.append(record)
        if self._rosout_heard is None:
            self._rosout_heard = self._sender("subscription", "/rosout")
        self._rosout_heard()
        if self.live is None:
            self.show_news()

    def _wait_for_answer(self, client: Any, future: Any, timeout_sec: float | None) -> Any:  # noqa: ANN401
        if self.live is None:
            self.wait_until(future.done, timeout_sec)
        else:
            self.live.wait_for(future, timeout_sec)
        if not future.done():
            client.remove_pending_request(future)
            if timeout_sec is None:
                raise _unanswered(client.service_name)
        return future.result()

    def _sleep(self, entry: Entry, original: Callable[[], None]) -> None:
        self.refuse_in_callback("rate.sleep")
        calls = entry.calls
        if self.live is None:
            self.wait_until(lambda: entry.calls > calls, None)
        else:
            original()


def _unanswered(service: str) -> SessionError:
    return SessionError(
        f"Nobody has answered the call to {service}.",
        "Either no node of this session offers that service, or its callback does not end. "
        "Outside a page the call would wait for ever.",
        "Add the node that offers the service first, and compare the two names.",
    )


def _name_of(kind: str, entity: Any) -> str:  # noqa: ANN401
    name: str = entity.topic_name if kind == "subscription" else entity.service_name
    return name

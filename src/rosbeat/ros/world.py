"""What one session owns: a context, a clock, an executor, a recorder, processes and nodes."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from threading import get_ident
from typing import Any, Protocol
from weakref import WeakKeyDictionary, WeakSet

from greenlet import getcurrent
from rclpy.exceptions import InvalidHandle, InvalidTopicNameException
from rclpy.node import Node
from rclpy.validate_full_topic_name import validate_full_topic_name

from rosbeat.domains import DomainLease, lease_domain
from rosbeat.errors import SessionError
from rosbeat.records import (
    INFRASTRUCTURE_TOPICS,
    Fault,
    GraphSnapshot,
    LogRecord,
    Observation,
    Sample,
)
from rosbeat.ros.actions import ActionEnd, action_of, wait_by_the_wall
from rosbeat.ros.blocking import VirtualWaits
from rosbeat.ros.clock import SessionClock, make_clock
from rosbeat.ros.console import Console, note
from rosbeat.ros.context import SessionContext
from rosbeat.ros.entities import TAKERS, Entry, NodeState, callback_name, full_name, period_text
from rosbeat.ros.errors import (
    asks_before_it_runs,
    asleep_while_going_live,
    called_in_callback,
    check_name,
    deadlock,
    foreign_node,
    no_such_node,
    unanswered_call,
    unknown_topic,
)
from rosbeat.ros.faults import fault_of, line_of
from rosbeat.ros.graph import ExternalMessages, GraphObserver, snapshot, with_other_processes
from rosbeat.ros.launch import Launch, Maker, show_sim_time
from rosbeat.ros.live import LiveExecutor
from rosbeat.ros.processes import Call, Process, Wait
from rosbeat.ros.qos_events import Limits, event_source, topic_of, wait_for_stored
from rosbeat.ros.randomness import SeededRandom
from rosbeat.ros.recording import (
    Memory,
    PublisherTap,
    Recorder,
    SessionLogger,
    mend_message_classes,
    tap_client,
    tap_rate,
    tap_timer,
    type_name,
)
from rosbeat.ros.virtual_time import VirtualTimeExecutor
from rosbeat.ros.wait_set import waitable_kind, waitable_name


class Closable(Protocol):
    """What ends with the session."""

    def close(self) -> None:
        """End."""


class World:
    """Everything behind a `Session`.

    It is what the hooks tell of new nodes and entities (see `recording.Watcher`), and what the
    executors ask for nodes. It never refers to the `Session`, so that a session nobody holds any
    more is closed at once.

    Args:
        seed: Seed of the random numbers that the nodes draw.
        domain_id: The ROS domain to join, or None for a private one.

    Attributes:
        recorder: What happened so far.
        console: Where log lines are printed.
        context: The ROS context.
        virtual: The executor of virtual time; it also keeps the time while nothing runs.
        live: The live executor while the session is live, else None.
        limits: The deadlines and lifespans that the session counts.
        graph_observer: Sees the other processes; None in a private domain, where there are none.
        external_messages: Records what comes from outside; None in a private domain.
        start: How the node that is being made is started.
        closed: Whether `close` was called.
        panel: The instrument panel, or None.
        makers: What the session was handed to make each node, and how it was started.
    """

    def __init__(self, seed: int = 0, domain_id: int | None = None) -> None:
        self._states: dict[Node, NodeState] = {}
        self._entries: dict[Any, Entry] = {}
        self._names: WeakKeyDictionary[Node, str] = WeakKeyDictionary()
        self._action_ends: WeakSet[Any] = WeakSet()
        self._count = self._goals = 0
        self._rosout_heard: Callable[[], None] | None = None
        mend_message_classes()
        self._lease: DomainLease | None = lease_domain() if domain_id is None else None
        self.domain_id = self._lease.domain_id if self._lease else domain_id
        self.start = Launch()
        self.recorder = Recorder()
        self.console = Console()
        self.context = SessionContext(self, self.domain_id or 0)
        self.virtual = VirtualTimeExecutor(self.context, self.recorder, self)
        self.live: LiveExecutor | None = None
        self.limits = Limits(self)
        self.closed = False
        self.panel: Closable | None = None
        self.makers: WeakKeyDictionary[Node, Maker] = WeakKeyDictionary()
        self._waits = VirtualWaits(self.virtual, self._entries.get)
        self._random = SeededRandom(seed)
        self._live_since = 0
        self._shown_logs = self._shown_faults = 0
        self._last_graph: GraphSnapshot | None = None
        self.graph_observer = None if domain_id is None else GraphObserver(self.context)
        self.external_messages = self.graph_observer and ExternalMessages(
            self.graph_observer, self.recorder, self.now
        )
        self.context.install()

    # Time.

    def now(self) -> int:
        """Return nanoseconds since the session began."""
        if self.live is None:
            return self.virtual.now
        return self.virtual.now + time.monotonic_ns() - self._live_since

    # Which nodes there are.

    def states(self) -> list[NodeState]:
        """Return all nodes that have not been destroyed, in order of creation."""
        return list(self._states.values())

    def spinning_nodes(self) -> list[NodeState]:
        """Return the nodes whose callbacks run, in order of creation."""
        return [state for state in self.states() if state.spinning]

    def named(self, name: str) -> NodeState | None:
        """Return the node of this full name."""
        return next((state for state in self.states() if state.name == name), None)

    def state_of(self, node: Node | None) -> NodeState | None:
        """Return what is known of a node."""
        return self._states.get(node)

    def name_of(self, node: Node) -> str | None:
        """Return the full name of a node that is or was here; a destroyed one cannot say it."""
        return self._names.get(node)

    def graph(self) -> GraphSnapshot:
        """Return the graph as it is now, or as it was when the session ended."""
        if self._last_graph is not None:
            return self._last_graph
        own = snapshot(self.states(), self.shared())
        return (
            own if self.graph_observer is None else with_other_processes(own, self.graph_observer)
        )

    def shared(self) -> tuple[tuple[str, ...], ...]:
        """Return the names of nodes that share a process, in order of creation.

        Live, one executor runs all nodes; each is taken for a process of its own there, too.
        """
        found = {id(state.process): state.process for state in self.states()}
        names = (tuple(state.name for state in one.states) for one in found.values())
        return tuple(group for group in names if len(group) > 1)

    def known_topics(self) -> set[str]:
        """Return every topic of which it is known what was published."""
        outside = self.external_messages.topics() if self.external_messages else ()
        return self.recorder.topics().union(outside)

    def next_number(self) -> int:
        """Return the place of a new entity in the order of creation."""
        self._count += 1
        return self._count

    # Nodes come, run, rest and go.

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""
        state.spinning, state.paused = True, False
        executor = self.live or self.virtual
        state.node.executor = executor  # type: ignore[union-attr]
        executor.wake()
        self.virtual.resume(state)

    def rest_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`; its messages wait in queues."""
        state.spinning = False
        state.process.refresh()
        if self.live is not None:
            self.live.wake()  # it may be waiting for this node

    def end_process(self, process: Process) -> None:
        """Run no callbacks of a process any more; its nodes stay in the graph until destroyed."""
        for state in list(process.states):
            self.rest_node(state)
            state.ended = True
        for call in [one for one in process.calls if one.wait is not None]:
            self.virtual.break_off(call)

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
    def starting(self, start: Launch, process: Process | None = None) -> Iterator[None]:
        """Let nodes that are made in this block be started so, in a process of theirs."""
        before, self.start = self.start, start
        caller, self.virtual.current = self.virtual.current, Call(process or Process())
        try:
            yield
        finally:
            self.start, self.virtual.current = before, caller

    # What the hooks tell.

    def node_begins(self, name: str, namespace: str) -> None:
        """Make room for a node that is about to be made: one of the same name is destroyed.

        It has to go first: rcl keeps one log publisher for each name and removes it with the first
        node of that name that is destroyed.
        """
        old = self.named(full_name(name, namespace))
        if old is not None:
            program = old.process.program
            if program is not None:
                program.kill()
            self.destroy(old)

    def node_made(self, node: Node) -> None:
        """Note that `Node.__init__` has returned."""
        self.entity_begins(node)
        show_sim_time(node, self.live is None)

    def entity_begins(self, node: Node) -> None:
        """Give a new node a clock of the session, before anything of it reads the time."""
        clock = node.__dict__.get("_clock")
        if isinstance(clock, SessionClock):
            clock.move()
        elif clock is not None:
            node._clock = make_clock(self.virtual)
        if node not in self._states:
            name = node.get_fully_qualified_name()
            call = self.virtual.current
            process = call.process if call is not None and self.live is None else Process()
            state = NodeState(len(self._states), name, node, process, born_ns=self.now())
            process.states.append(state)
            self._states[node] = state
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

    def action_made(
        self,
        node: Node,
        kind: str,
        entity: Any,  # noqa: ANN401
        name: str,
        options: dict[str, Any],
    ) -> None:
        """Note that an action server or client was made."""
        state = self._states[node]
        state.actions.append(ActionEnd(self, state, kind, entity, name, options))
        self._action_ends.add(entity)

    def node_ends(self, node: Node) -> None:
        """Forget a node that is about to be destroyed."""
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
        """Return the logger that the node's code gets."""
        state = self._states.get(node)
        if state is None:
            return original
        if state.logger is None:
            state.logger = SessionLogger(original.name, self._logged, node._clock)
        return state.logger

    def explain_init(self) -> None:
        """Answer `rclpy.init()` of a learner."""
        note("rclpy.init() has nothing to do here: the session has started ROS already.")

    def explain_shutdown(self) -> None:
        """Answer `rclpy.shutdown()` of a learner: in a callback it ends that node's process."""
        call = self.virtual.current
        state = call.state if call is not None else None
        if self.live is not None and self.live.is_this_thread():
            state = self.state_of(self.live.current)
        if state is None:
            note("rclpy.shutdown() leaves this session open; `ros.close()` ends it.")
            return
        for one in state.process.states:
            one.spinning, one.ended = False, True
        state.process.refresh()
        note(f"{state.name} called rclpy.shutdown() and stops; the other nodes go on.")

    def refuse_in_callback(self, call: str) -> None:
        """Refuse what would run the simulation, when a node calls it.

        Raises:
            SessionError: If code of one of this session's nodes is running, in this thread.
        """
        running = self.virtual.running and get_ident() == self.virtual.thread
        if running or (self.live is not None and self.live.is_this_thread()):
            raise called_in_callback(call)

    @property
    def counts_limits(self) -> bool:
        """Whether deadlines and lifespans of what is made now are counted here; see `Limits`."""
        return self.live is None and self.external_messages is None

    # What the executors tell.

    def callback_ran(self, entity: Any, node: Node | None) -> None:  # noqa: ANN401
        """Record a callback that is about to run, live or through rclpy's wait set."""
        entry = self._entries.get(entity)
        state = self.state_of(node)
        if entry is not None:
            entry.calls += 1
            label = entry.label
        elif state is not None:
            kind, name = waitable_kind(entity), waitable_name(entity)
            source = event_source(entity, topic_of(entity, node)) if kind == "event" else ""
            if action_of(entity, state):
                return  # which tells when it knows what it was
            label = self.recorder.label(state.name, kind, name, source)
            self.virtual.calling = label
        else:
            return
        with self.recorder.lock:
            self.recorder.add_callback(self.now(), label.number)

    def entity_raised(self, node: Node | None, entity: Any, error: BaseException) -> None:  # noqa: ANN401
        """Record an exception that left a callback, in live mode."""
        entry = self._entries.get(entity)
        state = entry.state if entry else self.state_of(node)
        name = entry.label.name if entry else "a task" if entity is None else waitable_name(entity)
        self.callback_raised(state, name, error)

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """Record an exception that left a callback; end its process, and let the others go on."""
        node = state.name if state else "A task"
        self.recorder.faults.append(fault_of(error, self.now(), node, name))
        mend_message_classes()
        if state is not None:
            self.end_process(state.process)
        if self.live is None:
            self.show_news()
            others = [one.name for one in state.process.states if one is not state] if state else []
            if others:
                note(f"{', '.join(others)} ran in the same process, which has ended.")

    def deadlocked(self, waits: Sequence[Wait]) -> None:
        """Record that callbacks wait for ever, at the line where the first of them waits."""
        for wait in waits:
            wait.told = True
        call, error = waits[0].call, deadlock(waits)
        if call is None:
            return
        thread = waits[0].thread
        frame = thread.gr_frame if thread is not getcurrent() else sys._getframe(1)
        now, name = self.now(), type(error).__name__
        fault = Fault(now, call.node, call.name, name, str(error), *line_of(frame))
        self.recorder.faults.append(fault)
        self._shown_faults += 1
        self.console.deadlock(fault, error)

    def program_failed(self, fault: Fault) -> None:
        """Record that a program ended with an exception, whose traceback is printed by itself."""
        self.recorder.faults.append(fault)
        self._shown_faults += 1

    def heard(self, state: NodeState, kind: str, name: str, source: str) -> None:
        """Record a callback of an action that is about to run."""
        self.virtual.calling = label = self.recorder.label(state.name, kind, name, source)
        with self.recorder.lock:
            self.recorder.add_callback(self.now(), label.number)

    def work_raised(self, state: NodeState, name: str, error: BaseException) -> None:
        """Record an exception that left the work on a goal; rclpy aborts the goal and logs it."""
        fault = fault_of(error, self.now(), state.name, name)
        self.recorder.faults.append(fault)
        self._shown_faults += 1
        self.console.work(fault)

    # What actions ask; see `actions.Place`.

    def sent(self, kind: str, name: str, origin: NodeState) -> None:
        """Note that a node sent something to the `kind` entities called `name`."""
        self._sender(kind, name, origin)()

    def wait(
        self,
        call: str,
        reason: str,
        done: Callable[[], bool],
        seconds: float | None,
        needs: Any,  # noqa: ANN401 - any entity of rclpy
    ) -> bool:
        """Wait until something is done, in a callback as in a cell."""
        if self.live is not None:
            self.refuse_in_callback(call)
            return wait_by_the_wall(done, seconds)
        if self.virtual.in_callback:
            needed = self._own(needs)
            return self.virtual.block(reason, self.virtual.after(seconds), done, needs=needed)
        return self.wait_until(done, seconds)

    def next_goal(self) -> int:
        """Return how many goals were sent here; 0 in a domain with other processes in it."""
        self._goals += 1
        return self._goals if self.external_messages is None else 0

    # What is printed.

    def show_news(self) -> None:
        """Print the log lines and faults that have not been printed yet."""
        logs = self.recorder.logs
        while self._shown_logs < len(logs):
            self._shown_logs += 1
            self.console.log(logs[self._shown_logs - 1])
        self.show_faults()

    def show_faults(self) -> None:
        """Print the faults that have not been printed yet."""
        faults = self.recorder.faults
        while self._shown_faults < len(faults):
            self._shown_faults += 1
            self.console.fault(faults[self._shown_faults - 1])

    # Running.

    @contextmanager
    def running(self, code: Iterable[object] = ()) -> Iterator[None]:
        """Make nodes feel at home while they run in this thread.

        Their context is rclpy's default, the random numbers they draw are the session's, and what
        waits takes virtual time.

        Args:
            code: Classes and functions that are about to run, besides those of the nodes.
        """
        before = self.context.install()
        try:
            with ExitStack() as stack:
                stack.enter_context(self._random.lent())
                if self.live is None:
                    stack.enter_context(self._waits.installed([*self._code(), *code]))
                yield
        finally:
            self.context.uninstall(before)

    def wait_until(self, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run virtual time for a cell until `done` is true, at most so many seconds.

        Without a limit it ends, too, when nothing can happen any more.
        """
        limit = self.virtual.after(seconds)
        with self.running():
            self.virtual.run_until(self.virtual.longest() if limit is None else limit, done,
                                   ends_idle=limit is None)  # fmt: skip
        return bool(done())

    def go_live(self) -> None:
        """Run the nodes against the wall clock, in a background thread.

        Raises:
            SessionError: If a callback waits: it can go on in virtual time only.
        """
        waiting = [call for call in self.virtual.suspended if call.wait is not None]
        if waiting:
            raise asleep_while_going_live(waiting[0].node, waiting[0].name)
        self.live = LiveExecutor(self.context, self)
        self.virtual.deadlines.forget()
        self._live_since = time.monotonic_ns()
        self._change_over(self.live, virtual=False)
        self.live.start()

    def go_virtual(self) -> None:
        """End live mode; virtual time goes on from where the wall clock has come to."""
        if self.live is None:
            return
        self.live.finish()
        self.virtual.now, self.live = self.now(), None
        self._change_over(self.virtual, virtual=True)
        self.virtual.look_anew()

    def hurry(self) -> None:
        """End a callback that hangs: Interrupt was pressed while the nodes run live."""
        if self.live is not None:
            self.live.hurry()

    def close(self) -> None:
        """Destroy the nodes, end the context and give the domain id back."""
        if self.closed:
            return
        if self.panel is not None:
            self.panel.close()
        self.closed = True
        self.go_virtual()
        self._last_graph = self.graph()
        self.virtual.close()
        for state in reversed(self.states()):
            self.destroy(state)
        for entity in list(self._action_ends):  # destroying its node leaves it in the graph
            with suppress(Exception):  # destroyed already, or half-made
                entity.destroy()
        if self.graph_observer is not None:
            self.graph_observer.destroy_node()
        self.virtual.shutdown()
        self.context.end()
        if self._lease:
            self._lease.release()

    # How it works.

    def _code(self) -> Iterator[object]:
        """Yield classes and functions in whose modules `from time import sleep` may stand."""
        for state in self.states():
            yield type(state.node)
            for entry in state.entries:
                yield getattr(entry.entity, "callback", None)

    def _change_over(self, executor: LiveExecutor | VirtualTimeExecutor, virtual: bool) -> None:
        self.virtual.is_live = not virtual
        for state in self.states():
            clock: SessionClock = state.node._clock  # type: ignore[union-attr]
            if virtual:
                clock.follow_session()
            else:
                clock.follow_wall()
            show_sim_time(state.node, virtual)
            if state.spinning:
                state.node.executor = executor  # type: ignore[union-attr]
            for entry in state.entries:
                # Each timer begins a new period: its deadline is a reading of the other clock.
                if entry.kind.endswith("timer"):
                    _restart(entry)

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
        if not isinstance(entry.entity.clock, SessionClock):
            entry.kind = "wall timer"
            note(
                f"a timer of {entry.state.name} has a clock of its own, which counts real time: it "
                "fires only while the session is live."
            )
            return
        tap_timer(entry.entity, entry.entity.clock.move, partial(self._timer_reset, entry))

    def _timer_reset(self, entry: Entry) -> None:
        if self.live is None:
            self.virtual.timer_reset(entry)

    def _client(self, entry: Entry) -> None:
        asked = self._sender("service", entry.name, entry.state)
        tap_client(entry.entity, partial(self._check_call, entry), asked,
                   partial(self._wait_for_answer, entry.entity))  # fmt: skip

    def _check_call(self, entry: Entry) -> None:
        if self.live is not None:
            self.refuse_in_callback("client.call")
        if not entry.state.spinning and entry.state.process.program is None:
            raise asks_before_it_runs(entry.state.name, entry.name)

    def _subscription(self, entry: Entry) -> None:
        entry.born = self.recorder.mark()
        taps = [tap for state in self.states() for tap in state.taps if tap.topic == entry.name]
        wait_for_stored(taps, entry)
        if self.counts_limits:
            self.limits.subscription_made(entry)
        if self.external_messages is not None:
            self.external_messages.watch_subscription(entry.entity)

    def _tap_publisher(self, state: NodeState, publisher: Any) -> None:  # noqa: ANN401
        topic = publisher.topic_name
        memory = Memory(publisher.msg_type)
        happened = self.virtual.sender("subscription", topic, state)
        if topic in INFRASTRUCTURE_TOPICS:
            quiet = self._sender("subscription", topic, state)
            state.taps.append(PublisherTap(publisher, memory, lambda _: quiet()))
            return
        kind = type_name(publisher.msg_type)
        channel = self.recorder.channel(topic, kind, state.name, memory)
        heard = self._published(happened, partial(self.recorder.add_sample, channel.number))
        tap = PublisherTap(publisher, memory, heard)
        tap.channel = channel
        state.taps.append(tap)
        if self.counts_limits:
            self.limits.publisher_made(state, publisher, tap)
        if self.external_messages is not None:
            self.external_messages.watch_publisher(publisher)

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

    def _sender(self, kind: str, name: str, origin: NodeState | None = None) -> Callable[[], None]:
        happened = self.virtual.sender(kind, name, origin)

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
        """Do what `client.call` does when it has sent its request (rclpy, `client.py`)."""
        in_callback = self.live is None and self.virtual.in_callback
        if in_callback:
            reason = f"an answer from {client.service_name}"
            until, needed = self.virtual.after(timeout_sec), self._own(client)
            self.virtual.block(reason, until, future.done, needs=needed)
        elif self.live is None:
            self.wait_until(future.done, timeout_sec)
        else:
            self.live.wait_for(future, timeout_sec)
        if not future.done():
            client.remove_pending_request(future)
            if timeout_sec is None and not in_callback:
                raise unanswered_call(client.service_name)
        return future.result()

    def _own(self, entity: Any) -> Any:  # noqa: ANN401 - any entity of rclpy
        """Return an entity if it belongs to the process that runs now, else None."""
        call = self.virtual.current
        mine = call.process.states if call is not None else []
        found = (one.entity for state in mine for one in (*state.entries, *state.actions))
        return entity if any(one is entity for one in found) else None

    def _sleep(self, entry: Entry, original: Callable[[], None]) -> None:
        calls = entry.calls
        if self.live is not None:
            self.refuse_in_callback("rate.sleep")
            original()
        elif self.virtual.in_callback:
            needed = self._own(entry.entity)
            self.virtual.block("a rate", None, lambda: entry.calls > calls, needs=needed)
        else:
            self.wait_until(lambda: entry.calls > calls, None)


def _name_of(kind: str, entity: Any) -> str:  # noqa: ANN401
    name: str = entity.topic_name if kind == "subscription" else entity.service_name
    return name


def _restart(entry: Entry) -> None:
    with suppress(InvalidHandle):  # destroyed by its node
        if not entry.entity.is_canceled():
            entry.entity.reset()


# From what a caller names to what a session has of it.


def state_of(world: World, node: Node) -> NodeState:
    """What is known of a node.

    Raises:
        NodeClassError: If it does not belong to the session.
    """
    state = world.state_of(node)
    if state is None:
        raise foreign_node(node, world.name_of(node))
    return state


def find(world: World, node: Node | str) -> NodeState:
    """A node, given itself or by name.

    Raises:
        SessionError: If the session has no such node.
    """
    if isinstance(node, Node):
        return state_of(world, node)
    name = "/" + str(node).lstrip("/")
    state = world.named(name)
    if state is None:
        raise no_such_node(name, [other.name for other in world.states()])
    return state


def samples(world: World, topic: Any) -> tuple[Sample, ...]:  # noqa: ANN401 - unchecked input
    """The messages of a topic.

    Raises:
        UnknownTopicError: If it never had a publisher.
        SessionError: If `topic` is not a name.
    """
    name = "/" + check_name("messages", topic).lstrip("/")
    known = world.known_topics()
    if name not in known:
        raise unknown_topic(name, known, world.graph())
    return tuple(world.recorder.samples(name))


def log_lines(world: World, node: Node | str | None) -> tuple[LogRecord, ...]:
    """The log lines of one node, or of all.

    Raises:
        SessionError: If `node` is neither a name nor a node that is or was in the session.
    """
    records = tuple(world.recorder.logs)
    if node is None:
        return records
    wanted = _checked_name(world, node).strip("/").replace("/", ".")
    return tuple(record for record in records if record.name == wanted)


def observation(world: World, seed: int) -> Observation:
    """Everything that was recorded so far, as plain data."""
    recorder = world.recorder
    return Observation(
        world.now(),
        seed,
        tuple(recorder.samples()),
        tuple(recorder.logs),
        tuple(recorder.callbacks()),
        tuple(recorder.faults),
        world.graph(),
        waits=world.virtual.all_waits(),
    )


def _checked_name(world: World, node: Node | str) -> str:
    if not isinstance(node, Node):
        return check_name("logs", node)
    name = world.name_of(node)
    if name is None:
        raise foreign_node(node)
    return name


def full_topic(call: str, topic: Any) -> str:  # noqa: ANN401 - unchecked input
    """The full name of a topic, such as `/temperature`; nobody need use it.

    Args:
        call: Who asks, for the error.
        topic: What was typed.

    Raises:
        SessionError: If it is no text, or ROS does not allow it as a name.
    """
    name = "/" + check_name(call, topic).lstrip("/")
    try:
        validate_full_topic_name(name)
    except InvalidTopicNameException as error:
        raise SessionError(
            f"{topic!r} cannot be the name of a topic.",
            f"ROS does not allow it: {_reason(error)}.",
            "Names have letters, digits, `_` and `/`, and no part of them begins with a digit: "
            "`room_1/temperature`.",
        ) from None
    return name


def _reason(error: InvalidTopicNameException) -> str:
    """What is wrong, from an exception that also repeats the name and draws an arrow below it."""
    parts = str(error).split("\n")[0].split(":")
    return parts[1].strip() if len(parts) > 1 else "it breaks the rules for names"

"""Hold a session's state: its context, clock, executor, recorder, processes and nodes."""

from __future__ import annotations

import time
from _thread import get_ident
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from itertools import count
from typing import Any
from weakref import WeakKeyDictionary, WeakSet

from rclpy.exceptions import InvalidHandle, InvalidTopicNameException
from rclpy.executors import Executor
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.node import Node
from rclpy.validate_full_topic_name import validate_full_topic_name

from rosbeat.errors import SessionError
from rosbeat.records import NANOSECONDS, GraphSnapshot, LogRecord
from rosbeat.ros import hooks  # noqa: F401 - its import lets rclpy tell sessions of nodes
from rosbeat.ros.clock import START, VirtualClock, VirtualNames, make_clock
from rosbeat.ros.context import SessionContext
from rosbeat.ros.engine import LONGEST_WAIT, VirtualTime
from rosbeat.ros.entity_watch import EntityWatch
from rosbeat.ros.errors import INSTEAD_OF_WAITING, Console, check_name, note
from rosbeat.ros.graph import ExternalMessages, GraphObserver, poll, snapshot, with_other_processes
from rosbeat.ros.isolation import SeededRandom, quitting_raises
from rosbeat.ros.launch import Launch, Maker
from rosbeat.ros.live import LiveExecutor
from rosbeat.ros.logs import bind, close_host, open_host
from rosbeat.ros.node_lives import NodeLives, end_coroutines
from rosbeat.ros.node_registry import NodeRegistry
from rosbeat.ros.processes import SHUT_DOWN, Ending, NodeState, Process, full_name
from rosbeat.ros.qos_events import Limits
from rosbeat.ros.recording import Entity, Recorder, repair_message_classes
from rosbeat.ros.reports import Reports
from rosbeat.ros.waits import _BOARD, Call


class SessionCore:
    """Hold the internal state of a `Session`.

    The hooks of `recording` and `actions` notify it of new nodes and entities, and the executors
    query it for nodes. It never refers to the `Session`, so that a session is closed as soon as
    nothing else refers to it.

    Attributes:
        nodes: Which nodes and entities there are.
        lives: Runs, rests, restarts and ends nodes.
        watch: Replaces methods of each new entity.
        reports: What is recorded and printed of callbacks, faults and log lines.
        virtual: The engine of virtual time; it also keeps the time while nothing runs.
        live: The live executor while the session is live, else None.
        domain_id: The domain that the session has joined; None in a private session.
        graph_observer: Observes the other processes; None in a private session, which has none.
        external_messages: Records messages from other processes; None in a private session.
        threads: How many a `MultiThreadedExecutor()` has, the same on each machine.
        start: How the node that is being created is started.
        replaces_nodes: Whether a new node takes the place of one of the same name, as on a page,
            where a cell is run again. On a robot both run.
        has_separate_types: Whether two processes may use one topic with two types, as on a robot. A
            page refuses the second one, and says so.
        topic_types: The first type of each topic.
        makers: The factory of each node, and how the node was started.
        next_number: Returns the position of a new entity in the order of creation.
    """

    def __init__(
        self,
        seed: int = 0,
        domain_id: int | None = None,
        console: Console | None = None,
        start_time: int = START,
    ) -> None:
        self.nodes = NodeRegistry()
        self.replaces_nodes = False
        self.has_separate_types = domain_id is None
        self.topic_types: dict[str, type] = {}
        # A destroyed action stays in the graph.
        self.action_ends: WeakSet[Any] = WeakSet()
        self._goals = count(1)
        self.next_number = count(1).__next__
        repair_message_classes()
        self.domain_id = domain_id
        self.threads = 4
        self.start = Launch()
        self.recorder = Recorder()
        self.console = console or Console()
        self.reports = Reports(self)
        self.watch = EntityWatch(self)
        self.lives = NodeLives(self)
        self.context = SessionContext(self, domain_id)
        self.virtual = VirtualTime(self.recorder, self, start_time * NANOSECONDS)
        self.live: LiveExecutor | None = None
        self.limits = Limits(self)
        self.closed = False
        self.panel: Any = None
        self.makers: WeakKeyDictionary[Node, Maker] = WeakKeyDictionary()
        self._names_of_time = VirtualNames(self.virtual, self.nodes.entry_of)
        self._random = SeededRandom(seed)
        self._live_since = 0
        self._last_graph: GraphSnapshot | None = None
        self.graph_observer = None if domain_id is None else GraphObserver(self.context)
        self.external_messages = self.graph_observer and ExternalMessages(
            self.graph_observer, self.recorder, self.now
        )
        self.context.install()
        open_host(self)

    def now(self) -> int:
        """Return nanoseconds since the session began."""
        if self.live is None:
            return self.virtual.now
        return self.virtual.now + time.monotonic_ns() - self._live_since

    def graph(self) -> GraphSnapshot:
        """Return the graph as it is now, or as it was when the session ended."""
        if self._last_graph is not None:
            return self._last_graph
        own = snapshot(self.nodes.states())
        return with_other_processes(own, self.graph_observer) if self.graph_observer else own

    # How nodes are started.

    @contextmanager
    def starting(self, start: Launch, process: Process | None = None) -> Iterator[None]:
        """Let nodes that are made in this block be started so, in a process of theirs."""
        before, self.start = self.start, start
        caller, self.virtual.current = self.virtual.current, Call(process or Process())
        token = _BOARD.set(self.virtual if self.live is None else None)
        try:
            yield
        finally:
            _BOARD.reset(token)
            self.start, self.virtual.current = before, caller

    # What the hooks tell.

    def node_begins(self, name: str, namespace: str) -> None:
        """Make room for a node that is about to be made: on a page, one of its name is destroyed.

        It has to go first: rcl keeps one log publisher for each name and removes it with the first
        node of that name that is destroyed.
        """
        old = self.nodes.named(full_name(name, namespace)) if self.replaces_nodes else None
        if old is not None:
            call, program = self.virtual.current, old.process.program
            if program is not None and (call is None or call.process is not old.process):
                program.kill()
            self.lives.destroy(old)

    def node_made(self, node: Node) -> None:
        """Note that `Node.__init__` has returned."""
        self.entity_begins(node)

    def entity_begins(self, node: Node) -> None:
        """Give a new node a clock of the session, before anything of it reads the time."""
        clock = node.__dict__.get("_clock")
        if isinstance(clock, VirtualClock):
            clock.move()
        elif clock is not None:
            # In the place of the clock that rclpy's constructor has just made.
            node._clock = make_clock(self.virtual)
        if node not in self.nodes:
            call = self.virtual.current
            process = call.process if call is not None and self.live is None else Process()
            self.nodes.add_node(node, process, self.now())

    def entity_made(self, node: Node, kind: str, entity: Entity) -> None:
        """Tap what sends; run the callbacks of whatever has some."""
        self.virtual.entities_changed()
        self.watch.begin(self.nodes[node], kind, entity)

    def waitable_made(self, node: Node) -> None:
        """Let rclpy's own executor run a node that has guard conditions or waitables."""
        self.entity_begins(node)
        self.virtual.hand_over(self.nodes[node].process)

    def node_ends(self, node: Node) -> None:
        """Forget a node that is about to be destroyed."""
        state = self.nodes.remove_node(node)
        if state is None:
            return
        state.spinning, state.ended = False, True
        self.virtual.forget(state)
        if isinstance(node.executor, Executor):
            end_coroutines(node.executor, state)
        self.nodes.remove_entries(state)
        if node.executor is not None:
            node.executor.remove_node(node)

    def executor_changed(self, executor: Executor, node: Node, spins: bool) -> None:
        """Note that an executor has begun or ceased to spin a node."""
        state = self.nodes.state_of(node)
        if state is None:
            return
        state.spinning = spins and not (state.paused or state.ended)
        state.process.refresh()
        if spins and state.process.program is not None:
            self.watch.adopt(state)
        if spins:
            self.virtual.entities_changed()
        elif executor is state.process.executor and self.virtual.in_callback:
            note(
                f"a spin function of rclpy has removed {state.name} from the executor of its "
                "process, so its callbacks no longer run."
            )

    def logger_of(self, node: Node, logger: RcutilsLogger) -> RcutilsLogger:
        """Return the logger that the node's code gets: its lines come to this session."""
        state = self.nodes.state_of(node)
        if state is not None:
            bind(logger, self, state)
        return logger

    def explain_init(self) -> None:
        """Answer `rclpy.init()` of a learner."""
        note("rclpy.init() has no effect here, because the session has already started ROS.")

    def explain_shutdown(self) -> None:
        """Answer `rclpy.shutdown()` of a learner: in a callback it ends that node's process."""
        call = self.virtual.current
        state = call.state if call is not None else None
        if self.live is not None and self.live.is_this_thread():
            state = self.nodes.state_of(self.live.current)
        if state is None:
            note("rclpy.shutdown() does not close this session; use `ros.close()`.")
            return
        label = self.recorder.newest_callback() if self.live is not None else self.virtual.calling
        name = label.name if label is not None else "a callback"
        ending = Ending(SHUT_DOWN, state.name, name, self.now())
        process = state.process
        for other in process.states:
            other.spinning, other.ended, other.ending = False, True, other.ending or ending
        process.is_over = True
        process.refresh()
        if process.spinner is not None:
            self.virtual.break_off(process.spinner)
        note(f"{state.name} called rclpy.shutdown() and stops; the other nodes keep running.")
        self.reports.note_neighbors(state)

    def refuse_in_callback(self, call: str) -> None:
        """Refuse a call that runs the simulation, if a node makes it.

        Raises:
            SessionError: If the caller is a callback.
        """
        running = self.virtual.running and get_ident() == self.virtual.thread
        if running or (self.live is not None and self.live.is_this_thread()):
            raise SessionError(
                f"`{call}` was called from inside a callback.",
                f"`{call}` waits for other callbacks, which cannot run until this one returns: "
                "this is a deadlock, on a real robot too.",
                INSTEAD_OF_WAITING,
            )

    @property
    def counts_limits(self) -> bool:
        """Return whether `limits` counts deadlines and lifespans of what is made now."""
        return self.live is None and self.external_messages is None

    # What the executors and actions tell.

    def sent(self, kind: str, name: str, origin: NodeState | None = None) -> None:
        """Note that a node sent something to the `kind` entities called `name`."""
        if self.live is None:
            self.virtual.happened(kind, name, origin)

    def wait(
        self,
        call: str,
        done: Callable[[], bool],
        seconds: float | None,
    ) -> bool:
        """Wait until something is done, in a cell."""
        if self.live is not None:
            self.refuse_in_callback(call)
            return poll(done, None if seconds is None else time.monotonic() + seconds)
        return self.wait_until(done, seconds)

    @contextmanager
    def waiting_for(self, reason: str, needs: Entity) -> Iterator[None]:
        """Say what code of a node waits for in this block, and the entity that has to run first."""
        call = self.virtual.current
        if call is None:
            yield
            return
        call.hint = reason, needs if self._is_in_current_process(needs) else None
        try:
            yield
        finally:
            call.hint = None

    def next_goal(self) -> int:
        """Return how many goals were sent here; 0 in a domain with other processes in it."""
        return next(self._goals) if self.external_messages is None else 0

    # Running.

    @contextmanager
    def running(self, code: Iterable[object] = ()) -> Iterator[None]:
        """Prepare this thread for running nodes, and classes and functions besides.

        Their context is rclpy's default, the random numbers they draw are the session's, and what
        waits takes virtual time.
        """
        before = self.context.install()
        try:
            virtually = self._names_of_time.installed([*self._code(), *code])
            quitting = quitting_raises(lambda: self.virtual.in_callback)
            waiting = virtually if self.live is None else nullcontext()
            with self._random.lent(), quitting, waiting:
                yield
        finally:
            self.context.uninstall(before)

    def _code(self) -> Iterator[object]:
        """Yield classes and functions in whose modules `from time import sleep` may stand."""
        for state in self.nodes.states():
            yield type(state.node)
            for entry in state.entries:
                yield getattr(entry.entity, "callback", None)

    def wait_until(self, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run virtual time for a cell until `done` is true, at most so many seconds.

        Without a limit it ends, too, when nothing can happen any more.
        """
        limit = self.virtual.after(seconds)
        with self.running():
            end = self.virtual.now + LONGEST_WAIT if limit is None else limit
            self.virtual.run_until(end, done, ends_idle=limit is None)
        return bool(done())

    def go_live(self) -> None:
        """Run the nodes against the wall clock.

        Raises:
            SessionError: If a callback still waits in virtual time.
        """
        waiting = [call for call in self.virtual.suspended if not call.idle]
        if waiting:
            raise SessionError(
                f"The session cannot go live: `{waiting[0].name}` of {waiting[0].node} is still "
                "waiting.",
                "The callback started in virtual time, and the event that it waits for happens "
                "in virtual time.",
                "Let the callback return first, with `ros.run(seconds)`, or remove the node.",
            )
        self.live = LiveExecutor(self.context, self)
        self.virtual.deadlines.forget()
        self._live_since = time.monotonic_ns()
        self._change_executor(self.live)
        self.live.start()

    def go_virtual(self) -> None:
        """End live mode; virtual time goes on from where the wall clock has come to."""
        if self.live is None:
            return
        live = self.live
        live.finish()
        state, callback = self.nodes.state_of(live.current), self.recorder.newest_callback()
        if live.is_stuck and state is not None and callback is not None:
            note(
                f"{callback.name} of {state.name} has not returned, and cannot be interrupted "
                "while it sleeps or waits. Until it returns, no other callback of its callback "
                "group runs."
            )
            # It holds its group, which only rclpy's own executor asks.
            self.virtual.hand_over(state.process)
        self.virtual.now, self.live = self.now(), None
        self._change_executor(None)
        self.virtual.look_anew()

    def _change_executor(self, live: LiveExecutor | None) -> None:
        is_virtual = live is None
        self.virtual.is_live = not is_virtual
        for state in self.nodes.states():
            # Not `get_clock`, which a learner's class may have replaced.
            clocks = {id(clock): clock for clock in (state.node._clock, *_timer_clocks(state))}
            for clock in clocks.values():
                clock.follow_session() if is_virtual else clock.follow_wall()
            if state.spinning and live is not None:
                state.node.executor = live
            elif state.spinning:
                self.lives.spin_in_process(state)
            for timer in (one.entity for one in state.entries if one.kind.endswith("timer")):
                # Each timer begins a new period: its deadline is a reading of the other clock.
                with suppress(InvalidHandle):  # destroyed by its node
                    if not timer.is_canceled():
                        timer.reset()

    def interrupt(self) -> None:
        """End a callback that hangs: Interrupt was pressed while the nodes run live."""
        if self.live is not None:
            self.live.interrupt()

    def close(self) -> None:
        """Destroy the nodes and end the context."""
        if self.closed:
            return
        if self.panel is not None:
            self.panel.close()
        self.closed = True
        self.go_virtual()
        self._last_graph = self.graph()
        self.virtual.close()
        for process in self.nodes.processes:
            for executor in (process.executor, process.global_executor):
                if executor is not None:
                    end_coroutines(executor)
                    with suppress(Exception):  # a program may have destroyed it
                        executor.shutdown(timeout_sec=0)
        for state in reversed(self.nodes.states()):
            self.lives.destroy(state)
        for entity in list(self.action_ends):
            with suppress(Exception):  # destroyed already, or half-made
                entity.destroy()
        if self.graph_observer is not None:
            self.graph_observer.destroy_node()
        self.context.end()
        close_host(self)

    # What the loggers ask and tell; see `logs.LogHost`.

    def has_this_thread(self) -> bool:
        """Return whether its nodes run, or would run, in the calling thread."""
        is_live_thread = self.live is not None and self.live.is_this_thread()
        return is_live_thread or get_ident() == self.virtual.thread

    def runs_here(self) -> bool:
        """Return whether code of its nodes is running in the calling thread."""
        if self.live is not None and self.live.is_this_thread():
            return True
        return self.virtual.in_callback

    def process_here(self) -> Process | None:
        """Return the simulated process whose code is running, or None if a cell is."""
        call = self.virtual.current if self.live is None else None
        return None if call is None else call.process

    def logged(self, level: str, name: str, text: str, function: str, line: int) -> None:
        """Record a line; print it at once, in virtual time."""
        self.recorder.logs.append(LogRecord(self.now(), level, name, text, function, line))
        self.sent("subscription", "/rosout")
        if self.live is None:
            self.reports.show_news()

    # Calls that wait.

    def _is_in_current_process(self, entity: Entity) -> bool:
        call = self.virtual.current
        states = call.process.states if call is not None else []
        return any(one.entity is entity for state in states
                   for one in (*state.entries, *state.actions))  # fmt: skip


def full_topic(call: str, topic: object) -> str:
    """Return the full name of a topic.

    Raises:
        SessionError: If the name is not a string, or ROS does not allow it.
    """
    name = "/" + check_name(call, topic).lstrip("/")
    try:
        validate_full_topic_name(name)
    except InvalidTopicNameException as error:
        # The exception also repeats the name and draws an arrow below it.
        _, _, reason = str(error).split("\n")[0].partition(":")
        reason = reason.split(":")[0].strip() or "it breaks the rules for names"
        raise SessionError(
            f"{topic!r} cannot be the name of a topic.",
            f"ROS does not allow it: {reason}.",
            "A topic name consists of letters, digits, `_` and `/`, and none of its parts begins "
            "with a digit, as in `room_1/temperature`.",
        ) from None
    return name


def _timer_clocks(state: NodeState) -> Iterator[VirtualClock]:
    timers = (entry.entity for entry in state.entries if entry.kind == "timer")
    return (timer.clock for timer in timers if isinstance(timer.clock, VirtualClock))

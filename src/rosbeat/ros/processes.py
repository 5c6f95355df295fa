"""Describe nodes, their entities, and the simulated processes that run their callbacks.

On a robot most nodes are processes of their own, and each process has one executor. A callback that
sleeps or waits blocks its own process only. The unit of the simulation is therefore the process:
its nodes, the number of threads of its executor, and the callbacks that have started but not yet
returned.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from inspect import iscoroutinefunction
from typing import TYPE_CHECKING, Any

from greenlet import greenlet
from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.task import Future

from rosbeat.ros.exception_origin import asking

if TYPE_CHECKING:
    from rosbeat.ros.recording import CallbackLabel, Message, PublisherTap
    from rosbeat.ros.simulated_program import SimulatedProgram
    from rosbeat.ros.virtual_time import VirtualTimeExecutor


# Nodes and entities.


def full_name(name: str, namespace: str) -> str:
    """Return a node's full name, such as `/room/sensor`."""
    return f"/{namespace.strip('/')}/{name}".replace("//", "/")


def callback_name(callback: Any) -> str:  # noqa: ANN401 - a callback may be any callable
    """Return the name a learner gave to a function, also when it is a lambda or an object."""
    if callback is None:
        return "nothing"  # a timer whose callback was left out, or that of a rate
    return getattr(callback, "__name__", type(callback).__name__)


#: Why a node has ended, as `Ending.kind` says it.
RAISED, SHUT_DOWN, INTERRUPTED = "raised", "shut down", "interrupted"


@dataclass(frozen=True)
class Ending:
    """Say why the nodes of a process have ended.

    Attributes:
        kind: `RAISED`: a callback raised; `SHUT_DOWN`: it called `rclpy.shutdown()`; `INTERRUPTED`:
            it did not return, and was interrupted.
        node: Full name of the node whose callback it was, one of the process.
        callback: The callback.
        time_ns: When it was, in nanoseconds since the session began.
    """

    kind: str
    node: str
    callback: str
    time_ns: int


@dataclass(eq=False)
class NodeState:
    """Hold the state of one node of a session.

    Attributes:
        number: Order of creation.
        name: Full name.
        spinning: Whether its callbacks run: it was added, has no fault and is not paused.
        born_ns: When it was created, in nanoseconds since the session began.
        open: Whether its callbacks can run at once: it spins, and nothing in its process waits.
        paused: Whether the session was told to pause it.
        ended: Whether it raised in a callback or requested a shutdown; this is permanent.
        ending: Why it has ended, if that is known.
        entries: Its timers, subscriptions, servers and clients, in order of creation.
        taps: The taps on its publishers, in order of creation.
        actions: Its action servers and clients, in order of creation; see `actions`.
    """

    number: int
    name: str
    node: Node
    process: Process
    spinning: bool = False
    born_ns: int = 0
    open: bool = False
    paused: bool = False
    ended: bool = False
    ending: Ending | None = None
    entries: list[Entry] = field(default_factory=list)
    taps: list[PublisherTap] = field(default_factory=list)
    actions: list[Any] = field(default_factory=list)


@dataclass(eq=False, slots=True)
class Entry:
    """Hold one timer, subscription, server or client, with the data that the executor needs.

    Attributes:
        number: Order of creation over the whole session.
        kind: `timer`, `wall timer` (on a clock other than the session's: it fires in live mode
            only), `subscription`, `service`, `client` or `event`.
        entity: The rclpy object; rclpy's entities share no base class.
        name: Full topic or service name; empty for a timer.
        label: The label under which its runs are recorded.
        take: Takes one item that has arrived; a timer has none. See `TAKERS`.
        handle: The entity's handle, cached because the property is slow; None for an event.
        calls: How often its callback has run.
        born: Of a subscription: how many messages had been recorded when it was created.
        deadline: Position of a timer in the agenda, in nanoseconds; None if the agenda has set it
            aside.
    """

    number: int
    state: NodeState
    kind: str
    entity: Any
    name: str
    label: CallbackLabel
    take: Callable[..., Any] | None = None
    label_number: int = field(init=False)
    handle: Any = field(init=False)
    calls: int = 0
    born: int = 0
    deadline: int | None = None

    def __post_init__(self) -> None:
        self.label_number = self.label.number
        self.handle = getattr(self.entity, "handle", None)


# Taking what has arrived, straight from rclpy's handles: to rebuild a wait set for it, as rclpy's
# executor does, takes 1 ms for six nodes. Each function takes one thing from one entity and returns
# `(callback, arguments)`, or None if there was nothing.


Work = tuple[Callable[..., Any], tuple[Any, ...]]

_MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


def take_message(entry: Entry, _: object) -> Work | None:
    """Take one message from a subscription."""
    subscription, handle = entry.entity, entry.handle
    with handle:
        taken = handle.take_message(subscription.msg_type, subscription.raw)
    if taken is None:
        return None
    # Not by `message_work`: one more call would slow every message down.
    arguments = taken[:1] if subscription._callback_type is _MESSAGE_ONLY else taken
    return subscription.callback, arguments


def message_work(entry: Entry, taken: tuple[Any, ...]) -> Work:
    """Return the callback of a subscription, and its arguments for a message and its info."""
    subscription = entry.entity
    # rclpy looks once at what a callback takes, and keeps the answer in this attribute.
    only = subscription._callback_type is _MESSAGE_ONLY
    return subscription.callback, taken[:1] if only else taken


def take_request(entry: Entry, executor: VirtualTimeExecutor) -> Work | None:
    """Take one request from a service's server."""
    service = entry.entity
    with service.handle:
        request, header = service.handle.service_take_request(service.srv_type.Request)
    if header is None:
        return None
    serve = _serve_later if iscoroutinefunction(service.callback) else _serve
    return serve, (entry, request, header, executor)


async def _serve_later(entry: Entry, *asked: Any) -> None:  # noqa: ANN401 - see `_answer`
    response = await entry.entity.callback(asked[0], entry.entity.srv_type.Response())
    _answer(entry, response, *asked[1:])


def _serve(entry: Entry, *asked: Any) -> None:  # noqa: ANN401 - see `_answer`
    response = entry.entity.callback(asked[0], entry.entity.srv_type.Response())
    _answer(entry, response, *asked[1:])


def _answer(entry: Entry, response: Message, header: Any, executor: VirtualTimeExecutor) -> None:  # noqa: ANN401 - filled in C
    with asking("send_response", response):
        entry.entity.send_response(response, header)
    executor.happened("client", entry.name, entry.state)


def take_answer(entry: Entry, executor: VirtualTimeExecutor) -> Work | None:
    """Take one response to a client's request."""
    client = entry.entity
    with client.handle:
        header, response = client.handle.take_response(client.srv_type.Response)
    if header is None:
        return None
    try:
        future: Future = client.get_pending_request(header.request_id.sequence_number)
    except KeyError:
        return None  # the request was withdrawn
    future._set_executor(executor)  # so that its done callbacks become tasks, as rclpy does it
    return future.set_result, (response,)


TAKERS: dict[str, Callable[[Entry, Any], Work | None]] = {
    "subscription": take_message,
    "service": take_request,
    "client": take_answer,
}


# Processes.


#: The order in which rclpy's executor takes what is ready in a node (`_wait_for_ready_callbacks`).
_RANK = {"event": 0, "timer": 1, "subscription": 2, "client": 3, "service": 4}


@dataclass(eq=False, slots=True)
class Spin:
    """Represent one call of a `spin` function, during which callbacks of its process run.

    It spins `states`, or all nodes of the process, and `left` more callbacks may begin, or any
    number if it is None.
    """

    states: Collection[NodeState] | None = None
    left: int | None = None


class Process:
    """Simulate an operating-system process: nodes, and the one executor that runs their callbacks.

    Args:
        threads: 1 for rclpy's `SingleThreadedExecutor`, more for a `MultiThreadedExecutor`.
        program: The program that runs in the process; without one its nodes spin from the
            beginning, as in the `main` of most programs.

    Attributes:
        spins: The active calls of `spin`, innermost last. Callbacks run only during such a call.
        calls: Callbacks that have begun and are waiting, in the order in which they began.
        pending: Entities that are ready but could not run at once: timers that are due, and
            entities whose queues may hold something.
        due: How many of its timers are due at this instant and have not run yet.
    """

    def __init__(self, threads: int = 1, program: SimulatedProgram | None = None) -> None:
        self.threads, self.program = threads, program
        self.states: list[NodeState] = []
        self.spins: list[Spin] = [] if program else [Spin()]
        self.calls: list[Call] = []
        self.pending: dict[Entry, int] = {}
        self.due = 0
        self._round: deque[Entry] = deque()

    def adopt(self, state: NodeState) -> None:
        """Let a node that was made elsewhere run here from now on."""
        if state.process is not self:
            state.process.states.remove(state)
            state.process.refresh()
            state.process = self
            self.states.append(state)

    def refresh(self) -> None:
        """Note for each node whether its callbacks can run at once, which is the common case."""
        idle = bool(self.spins) and not self.calls and not self.pending
        spin = self.spins[-1] if idle else None
        for state in self.states:
            state.open = (
                spin is not None
                and spin.left is None
                and state.spinning
                and (spin.states is None or state in spin.states)
            )

    def has_thread(self) -> bool:
        """Return whether a thread of the executor is free, and may begin another callback."""
        if not self.spins or self.spins[-1].left == 0:
            return False
        return sum(not call.spinning for call in self.calls) < self.threads

    def can_begin(self, entry: Entry) -> bool:
        """Return whether the callback of this entity can run now."""
        return self.has_thread() and self._is_spun(entry) and is_free(entry)

    def next_ready(self) -> Entry | None:
        """Return what the executor would take next, in the order of rclpy's wait set.

        rclpy looks at everything, then handles what was ready: node by node, timers first, one
        message of each subscription. Only then it looks again.
        """
        if not self.has_thread():
            return None
        while self._round:
            entry = self._round.popleft()
            if entry in self.pending and self._is_spun(entry) and is_free(entry):
                return entry
        ready = [entry for entry in self.pending if self._is_spun(entry) and is_free(entry)]
        self._round = deque(sorted(ready, key=_place))
        return self._round.popleft() if self._round else None

    def is_in_round(self) -> bool:
        """Return whether something that the last look found ready has not had its turn."""
        return any(entry in self.pending for entry in self._round)

    def count_down(self) -> None:
        """Note that a callback has ended: `spin_once` waits for one."""
        if self.spins and self.spins[-1].left:
            self.spins[-1].left -= 1

    def forget(self, state: NodeState) -> None:
        """Drop a node that is destroyed."""
        self.states.remove(state)
        for entry in state.entries:
            self.pending.pop(entry, None)
        self.refresh()

    def _is_spun(self, entry: Entry) -> bool:
        states = self.spins[-1].states if self.spins else ()
        return entry.state.spinning and (states is None or entry.state in states)


def is_free(entry: Entry) -> bool:
    """Return whether the callback group of an entity lets its callback run."""
    return bool(entry.entity.callback_group.can_execute(entry.entity))


def _place(entry: Entry) -> tuple[int, int, int]:
    return entry.state.number, _RANK[entry.kind], entry.number


@dataclass(eq=False, slots=True)
class Call:
    """Represent running code of a node: a callback, a constructor, or the `main` of a program.

    Attributes:
        state: The node whose callback it is; None for a constructor or a `main`.
        entry: The entity whose callback it is, if there is one.
        began_ns: When it first began to wait, in nanoseconds; -1 if it never has.
        spinning: Whether it waits in a `spin`, so that its thread runs other callbacks.
        wait: The current wait, if there is one.
        holds_group: Whether it occupies its callback group.
        broken: How often it was told to end from outside; above 0, it must not wait again.
    """

    process: Process
    state: NodeState | None = None
    entry: Entry | None = None
    label: CallbackLabel | None = None
    began_ns: int = -1
    spinning: bool = False
    wait: Wait | None = None
    holds_group: bool = False
    broken: int = 0

    @property
    def node(self) -> str:
        """Return the full name of the node whose code runs, or of the first node of its process."""
        states = self.process.states
        return self.state.name if self.state else states[0].name if states else ""

    @property
    def name(self) -> str:
        """Return the name of the function, such as `publish_temperature`."""
        if self.label is not None:
            return self.label.name
        return "main" if self.process.program else "__init__"


@dataclass(eq=False, slots=True)
class Wait:
    """Describe the condition that a call waits for.

    Attributes:
        thread: The greenlet that resumes when the wait is over.
        reason: Short description of the condition: `sleep`, or `an answer from /add`.
        began_ns: When the wait began, in nanoseconds of virtual time.
        until_ns: When the wait times out; None without a limit.
        met: Returns whether the condition holds; None if only time or `end_wait` ends the wait.
        needs: The entity of the same process whose callback has to run first, if there is one.
        error: The exception to raise in the call when it resumes.
        reported: Whether the wait was reported as a deadlock.
    """

    call: Call | None
    thread: greenlet
    reason: str
    began_ns: int
    until_ns: int | None = None
    met: Callable[[], object] | None = None
    needs: Any = None
    over: bool = False
    error: BaseException | None = None
    reported: bool = False

    def is_for_good(self) -> bool:
        """Return whether nothing but an event of the simulation can end it.

        The `spin` of a program waits for whatever comes, and is not meant.
        """
        spins = self.call is not None and self.call.spinning and self.call.entry is None
        return self.until_ns is None and not spins

    def can_end(self) -> bool:
        """Return whether it may still come true: its process has a thread for what it needs.

        A single-threaded executor that waits in a callback takes no answer; nor does another one
        if the answer's callback group is the one that this very callback occupies.
        """
        if self.until_ns is not None or self.needs is None or self.call is None:
            return True
        process, own = self.call.process, self.call.entry
        if not process.spins:
            return False
        group = self.needs.callback_group
        if self.call.holds_group and own is not None and own.entity.callback_group is group:
            return bool(group.can_execute(self.needs))
        if self.call.spinning:
            return True
        busy = [call for call in process.calls if not call.spinning]
        waits = [call.wait for call in busy]
        # Of those that wait without a limit for this very process none will free a thread.
        stuck = [one for one in waits if one and one.until_ns is None and one.needs is not None]
        return len(busy) < process.threads or len(stuck) < len(busy)

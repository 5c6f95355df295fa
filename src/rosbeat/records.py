"""Define what was observed, as plain data.

Everything here is a frozen dataclass of numbers, strings, tuples and dicts. Nothing says right or
wrong, nothing needs ROS, and nothing differs between two runs of one program: there is no wall
time, no process id, no path and no address in any of it.

Times are integers in nanoseconds of virtual time since the session began (`time_ns`); the
property `time` gives the same in seconds. Names of nodes and topics are fully qualified
(`/temperature`), as `ros2 node list` and `ros2 topic list` print them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

NANOSECONDS = 1_000_000_000

#: Topics that every node brings along; pictures and lists leave them out unless asked.
INFRASTRUCTURE_TOPICS = frozenset({"/rosout", "/parameter_events", "/clock"})
#: What the topics and services that an action is made of have in their names.
ACTION_PART = "/_action/"


def is_hidden(name: str) -> bool:
    """Return whether a part of a ROS name begins with an underscore, which hides it in lists."""
    return any(part.startswith("_") for part in name.split("/"))


class Timed:
    """Add `time`, in seconds, to a record that has `time_ns`."""

    __slots__ = ()
    time_ns: int

    @property
    def time(self) -> float:
        """Return the seconds of virtual time since the session began."""
        return self.time_ns / NANOSECONDS


@dataclass(frozen=True, slots=True)
class Sample(Timed):
    """Hold one message as it was published.

    Attributes:
        time_ns: When it was published, in nanoseconds of virtual time. What another process
            published has the time at which a node of this session got it.
        topic: The topic's full name, such as `/temperature`.
        type_name: The message type, such as `std_msgs/msg/Float32`.
        node: Full name of the node that published it; `?` if it was in another process and cannot
            be told from others there.
        data: The message as plain data: a dict from field name to value, nested where the
            message is nested, arrays as lists. A `float32` field holds what was sent, rounded to
            32 bits, as a subscriber receives it.
    """

    time_ns: int
    topic: str
    type_name: str
    node: str
    data: dict[str, Any]

    @property
    def value(self) -> Any:  # noqa: ANN401 - a message field may be of any plain type
        """Return the only field's value if the message has one field, else the whole `data`."""
        return next(iter(self.data.values())) if len(self.data) == 1 else self.data


@dataclass(frozen=True, slots=True)
class LogRecord(Timed):
    """Hold one log line of a session's code: of a node, of a module, or of rclpy itself.

    Attributes:
        time_ns: When it was logged, in nanoseconds of virtual time.
        level: `DEBUG`, `INFO`, `WARN`, `ERROR` or `FATAL`.
        name: The logger's name: the node's name without the leading slash, dots for namespaces; or
            what a module has passed to `rclpy.logging.get_logger`.
        text: The message.
        function: The function that logged.
        line: The line in the source (in a page: in the cell) that logged.
    """

    time_ns: int
    level: str
    name: str
    text: str
    function: str
    line: int


@dataclass(frozen=True, slots=True)
class CallbackRecord(Timed):
    """Hold one run of a callback.

    Attributes:
        time_ns: When it began, in nanoseconds of virtual time. It takes none, unless it waits.
        node: Full name of the node whose callback it was.
        kind: `timer`, `subscription`, `service`, `client`, `action server`, `action client`,
            `event`, `guard condition`, `waitable` or `task`; or `expired`, for a subscription's
            callback that did not run: its message was older than a lifespan allows.
        name: The callback function's name, such as `publish_temperature`.
        source: What it answered: the topic or service name; for a timer its period, as in `1 s`;
            for an event of the middleware which one, as in `deadline of /temperature`.
    """

    time_ns: int
    node: str
    kind: str
    name: str
    source: str


@dataclass(frozen=True, slots=True)
class WaitRecord(Timed):
    """Hold one wait of a callback, in which virtual time passed.

    Attributes:
        time_ns: When the wait began, in nanoseconds of virtual time.
        until_ns: When it ended; the end of the observation if it still lasts.
        node: Full name of the node whose callback waited.
        callback: The callback function's name, as in its `CallbackRecord`.
        reason: `sleep`, or what it waited for, such as `an answer from /add`.
    """

    time_ns: int
    until_ns: int
    node: str
    callback: str
    reason: str


@dataclass(frozen=True)
class Argument:
    """Describe one argument of a call, without keeping it.

    Attributes:
        kind: What it is: `message_type`, `type`, `message`, `method`, `function`, or the name of
            its type.
        name: For these: which one.
        parameters: Of a method or function: the names of its parameters; None if unknown.
    """

    kind: str
    name: str = ""
    parameters: tuple[str, ...] | None = None


@dataclass(frozen=True)
class FailedCall:
    """Describe a call of rclpy that raised.

    Attributes:
        method: What was called, such as `create_publisher`.
        given: What it was given without a name, in order.
        named: What it was given by name.
    """

    method: str
    given: tuple[Argument, ...] = ()
    named: dict[str, Argument] = field(default_factory=dict)


def is_argument(code: str, name: str) -> bool:
    """Return whether a line calls a method in order to hand over what it returns.

    Args:
        code: A line of source, perhaps one of several of a call.
        name: The method.
    """
    call = rf"\.{re.escape(name)}\([^()]*\)"
    at_once = r"(?:(?!\blambda\b).)*"  # what stands in a lambda is called later
    made = r"(create_\w+|add_\w+_callback)\("
    handed = rf"{made}{at_once}{call}|^\w+{call},$|^callback=\w+{call}"
    return re.search(handed, code) is not None


def called_callback(name: str) -> FailedCall:
    """Return the call that is recorded where a callback was called while one was prepared."""
    return FailedCall("create", (Argument("called", name),))


@dataclass(frozen=True, slots=True)
class Fault(Timed):
    """Hold an exception that left a callback and ended its node, or a goal that was worked on.

    Attributes:
        time_ns: When it happened, in nanoseconds of virtual time.
        node: Full name of the node.
        callback: Name of the callback function.
        kind: The exception's class name, such as `ZeroDivisionError`.
        text: The exception's message.
        line: Line number of the learner's own line nearest to the fault, 0 if unknown.
        code: That line's text, stripped, or an empty string.
        asked: The call of rclpy that failed, with the types of what it was given; None if it was
            none. If a callback was called while a call was being prepared, the method is `create`,
            and what it was given is of the kind `called`. If a field of a message refused a value,
            the method is `field`.
    """

    time_ns: int
    node: str
    callback: str
    kind: str
    text: str
    line: int
    code: str
    asked: FailedCall | None = None


@dataclass(frozen=True)
class QoS:
    """Hold the quality of service of one endpoint, in ROS's own words.

    Attributes:
        reliability: `RELIABLE` or `BEST_EFFORT`.
        durability: `VOLATILE` or `TRANSIENT_LOCAL`.
        history: `KEEP_LAST` or `KEEP_ALL`; `UNKNOWN` in another process, which does not tell.
        depth: Queue length for `KEEP_LAST`, in messages; 0 if unknown.
        deadline_ns: The longest time from one message to the next that is offered or asked for, in
            nanoseconds; 0 if there is no such limit.
        lifespan_ns: How old a message may get, in nanoseconds, before it is dropped from the queue
            of this endpoint; 0 if there is no such limit.
        policy_alone: The policy that was handed over in the place of a profile, and so counts as a
            depth, such as `TRANSIENT_LOCAL`; or empty.
    """

    reliability: str = "RELIABLE"
    durability: str = "VOLATILE"
    history: str = "KEEP_LAST"
    depth: int = 10
    deadline_ns: int = 0
    lifespan_ns: int = 0
    policy_alone: str = ""


@dataclass(frozen=True)
class Endpoint:
    """Hold one endpoint of a topic or service.

    Attributes:
        node: Full name of the node it belongs to.
        name: Full name of the topic or service.
        type_name: Its type, such as `std_msgs/msg/Float32`.
        kind: `publisher`, `subscription`, `server`, `client`, `action server` or `action client`.
            After an action's end come those of its services and topics.
        qos: Its quality of service.
        matched: How many endpoints on the other side it is connected to, or -1 if unknown.
    """

    node: str
    name: str
    type_name: str
    kind: str
    qos: QoS
    matched: int = -1


@dataclass(frozen=True)
class TimerRecord:
    """Hold one timer of a node.

    Attributes:
        node: Full name of the node.
        callback: Name of the function it calls.
        period_ns: Its period in nanoseconds.
        calls: How often it has fired so far.
    """

    node: str
    callback: str
    period_ns: int
    calls: int


@dataclass(frozen=True)
class GraphSnapshot:
    """Hold the ROS graph at one moment.

    Attributes:
        nodes: Full names of the nodes, in order of creation; then those of other processes, if the
            session has joined their domain, sorted.
        endpoints: Their endpoints, in the same order, those that every node has included.
        timers: Their timers, in order of creation.
        processes: For each process with more than one node, the full names of its nodes, in order
            of creation. Every node that is not named here has a process of its own.
    """

    nodes: tuple[str, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    timers: tuple[TimerRecord, ...] = ()
    processes: tuple[tuple[str, ...], ...] = ()

    def topics(self, infrastructure: bool = False) -> tuple[str, ...]:
        """Return the topics' names, sorted; `infrastructure` adds what nodes and actions bring."""
        names = {end.name for end in self.endpoints if end.kind in ("publisher", "subscription")}
        seen = {name for name in names - INFRASTRUCTURE_TOPICS if ACTION_PART not in name}
        return tuple(sorted(names if infrastructure else seen))

    def on(self, name: str, kind: str) -> tuple[Endpoint, ...]:
        """Return the endpoints of one kind on one topic or service, in order of creation."""
        return tuple(end for end in self.endpoints if end.name == name and end.kind == kind)


@dataclass(frozen=True, slots=True)
class Reply(Timed):
    """Hold what a step of a scenario received in reply.

    Attributes:
        time_ns: When it came, in nanoseconds of virtual time.
        name: Full name of the service, action or node that was asked.
        number: Which question to this name it answers, counted from 1.
        word: `response`, `parameters`, or of an action `goal`, `feedback`, `cancel` or `result`.
        data: What it holds, as in a `Sample`; of a result also its `status`.
    """

    time_ns: int
    name: str
    number: int
    word: str
    data: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Observation(Timed):
    """Hold all that a session saw, from its beginning to `time_ns`.

    Attributes:
        time_ns: How far the session had run, in nanoseconds of virtual time.
        seed: The seed of the random numbers its nodes drew.
        samples: Every message published, in order, infrastructure topics left out.
        logs: Every log line, in order.
        callbacks: Every run of a callback, in order.
        faults: Every exception that left a callback, in order.
        graph: The graph at the end.
        subject: Full name of the node that was looked at, among others; empty if there was none.
        printed: How many characters it printed.
        replies: What the steps of a scenario got that ask for something, in order.
        waits: Every wait of a callback, in the order in which they began.
    """

    time_ns: int
    seed: int
    samples: tuple[Sample, ...] = ()
    logs: tuple[LogRecord, ...] = ()
    callbacks: tuple[CallbackRecord, ...] = ()
    faults: tuple[Fault, ...] = ()
    graph: GraphSnapshot = GraphSnapshot()
    subject: str = ""
    printed: int = 0
    replies: tuple[Reply, ...] = ()
    waits: tuple[WaitRecord, ...] = ()


@dataclass(frozen=True)
class ProgramRun:
    """Hold one run of a program in a process of its own, ended with Ctrl+C.

    Attributes:
        program: What was run, such as `temperature_publisher`.
        output: What it printed, both streams in one, up to a limit.
        exit_code: How it ended; negative for the number of a signal; None if it had to be killed.
        ended_early: Whether it ended before it was interrupted.
    """

    program: str
    output: str
    exit_code: int | None
    ended_early: bool = False


@dataclass(frozen=True)
class Part:
    """Hold one requirement of an exercise that gives points for each.

    Attributes:
        id: Its name, such as `R1`.
        text: What is required, one sentence.
        met: Whether it is met.
        evidence: What was observed, one or two sentences.
        out_of: Points that there are for it; a part that is not met gives none.
        optional: Whether the exercise can be passed without it.
    """

    id: str
    text: str
    met: bool
    evidence: str = ""
    out_of: int = 1
    optional: bool = False

    @property
    def points(self) -> int:
        """Return the points that were reached."""
        return self.out_of if self.met else 0


@dataclass(frozen=True)
class Outcome:
    """Hold what a judge says of an observation.

    Attributes:
        exercise: The exercise's id, such as `03a`.
        status: `passed`, `failed` or `not attempted`.
        evidence: What was observed, one or two sentences.
        hint: What to think about next; empty if nothing is wrong.
        mistake: Id of the recognised mistake, `new-to-me` if none was; empty unless failed.
        points: Points that were reached.
        out_of: Points that there are.
        remarks: What is worth knowing although the answer is right.
        parts: The requirements, if there are points for each; empty for all or nothing.
    """

    exercise: str
    status: str
    evidence: str = ""
    hint: str = ""
    mistake: str = ""
    points: int = 0
    out_of: int = 1
    remarks: tuple[str, ...] = ()
    parts: tuple[Part, ...] = ()


@dataclass(frozen=True, slots=True)
class QueueStep(Timed):
    """Hold one change of a subscription's queue.

    Attributes:
        time_ns: When, in nanoseconds of virtual time.
        kind: `arrived`, `taken` or `dropped`.
        number: Which message of the topic it concerns, counted from 1 in order of arrival.
        length: Messages in the queue after the step.
    """

    time_ns: int
    kind: str
    number: int
    length: int


def queue_steps(arrivals: Sequence[int], takes: Sequence[int], depth: int) -> tuple[QueueStep, ...]:
    """Replay a KEEP_LAST queue: what waits, what is taken, what is dropped.

    A full queue drops its oldest message to make room for the newest; that is what the history
    policy KEEP_LAST means (ROS 2 documentation, "About Quality of Service settings").

    Args:
        arrivals: Times at which messages arrive, in nanoseconds, ascending.
        takes: Times at which the subscriber takes one, in nanoseconds, ascending. At equal times
            an arrival comes before a take.
        depth: Queue length in messages, at least 1.

    Returns:
        The steps in order of time.

    Raises:
        ValueError: If `depth` is below 1.
    """
    if depth < 1:
        raise ValueError(f"depth must be at least 1, got {depth}")
    moments = [(at, 0, number) for number, at in enumerate(arrivals, 1)]
    moments += [(at, 1, 0) for at in takes]
    queue: list[int] = []
    steps: list[QueueStep] = []
    for at, is_take, number in sorted(moments):
        if is_take:
            if queue:
                steps.append(QueueStep(at, "taken", queue.pop(0), len(queue)))
            continue
        if len(queue) == depth:
            steps.append(QueueStep(at, "dropped", queue.pop(0), len(queue)))
        queue.append(number)
        steps.append(QueueStep(at, "arrived", number, len(queue)))
    return tuple(steps)

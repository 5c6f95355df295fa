"""Running a learner's node and writing down what it did.

A scenario says nothing about right or wrong. Whatever goes wrong in the learner's code becomes a
fault in the observation; nothing is printed and nothing is raised, and it takes no longer than its
deadline. Afterwards the kernel is as it was.
"""

from __future__ import annotations

import gc
import sys
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from inspect import isclass
from itertools import islice
from types import FrameType
from typing import Any

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter

from rosbeat.errors import NodeClassError, NodeConstructionError, NoSystemError, RosbeatError
from rosbeat.records import (
    NANOSECONDS,
    CallbackRecord,
    Fault,
    GraphSnapshot,
    Observation,
    QoS,
    Reply,
)
from rosbeat.ros.entities import NodeState
from rosbeat.ros.errors import duration_ns
from rosbeat.ros.faults import fault_of, line_of
from rosbeat.ros.isolation import Deadline, DeadlinePassed, apart, unharmed, within
from rosbeat.ros.launch import Launch as Launch
from rosbeat.ros.launch import Maker as Maker
from rosbeat.ros.launch import checked
from rosbeat.ros.recording import message_class as message_class
from rosbeat.ros.recording import plain
from rosbeat.ros.session import Session
from rosbeat.ros.test_nodes import BARE, message, profile
from rosbeat.ros.test_nodes import feeder as feeder
from rosbeat.ros.world import World

# What a scenario does to its nodes at a certain time, as plain data.


@dataclass(frozen=True)
class Step:
    """Something that is done at a time.

    Attributes:
        at: When, in virtual seconds. What is due at the same instant happens before.
        node: The node that it is done to, by name; empty for the learner's.
    """

    at: float
    node: str = ""

    @property
    def at_ns(self) -> int:
        """When, in nanoseconds of virtual time."""
        return round(self.at * NANOSECONDS)


@dataclass(frozen=True)
class Publish(Step):
    """Publish messages, all at one instant, from a node `/tester`.

    Attributes:
        topic: Where.
        type_name: Their type, such as `std_msgs/msg/Float32`.
        values: Each is what the field `data` holds, or a dict from field name to value.
        qos: The quality of service of the publisher, which is there from the beginning.
    """

    topic: str = ""
    type_name: str = "std_msgs/msg/Float32"
    values: tuple[Any, ...] = ()
    qos: QoS = field(default_factory=QoS)


@dataclass(frozen=True)
class Pause(Step):
    """Run none of a node's callbacks, as if it were busy."""


@dataclass(frozen=True)
class Resume(Step):
    """Run a node's callbacks again."""


@dataclass(frozen=True)
class SetParameter(Step):
    """Set a parameter, as `ros2 param set` does.

    Attributes:
        name: The parameter.
        value: Its new value.
    """

    name: str = ""
    value: Any = None


@dataclass(frozen=True)
class SetParameters(Step):
    """Set parameters, all at once or none.

    Attributes:
        values: Their new values by their names.
    """

    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Call(Step):
    """Call a service from a node `/tester`; the answer is a `Reply`.

    Attributes:
        service: Which.
        type_name: Its type, such as `std_srvs/srv/Trigger`.
        values: The fields of the request.
    """

    service: str = ""
    type_name: str = "std_srvs/srv/Trigger"
    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class SendGoal(Step):
    """Send a goal from a node `/tester`; what comes back are `Reply`s.

    Attributes:
        action: To which action.
        type_name: Its type, such as `test_msgs/action/Fibonacci`.
        goal: The fields of the goal.
        cancel_after: After how many seconds it is canceled, if it was accepted; None for never.
    """

    action: str = ""
    type_name: str = "test_msgs/action/Fibonacci"
    goal: dict[str, Any] = field(default_factory=dict)
    cancel_after: float | None = None


@dataclass(frozen=True)
class Cancel(Step):
    """Cancel a goal; a `SendGoal` with `cancel_after` brings it along.

    Attributes:
        sent: The step that sent it.
    """

    sent: SendGoal = field(default_factory=lambda: SendGoal(0))


@dataclass(frozen=True)
class Remove(Step):
    """Destroy a node."""


@dataclass(frozen=True)
class Add(Step):
    """Add another node.

    Attributes:
        make: A node class, or a function that returns a node.
        start: How it is started.
    """

    make: Any = None
    start: Launch = field(default_factory=Launch)


# The node `/tester` of a scenario: it publishes, calls services and sends goals.


#: The node that publishes and asks.
TESTER = "tester"

_STATUS = {
    GoalStatus.STATUS_SUCCEEDED: "SUCCEEDED",
    GoalStatus.STATUS_CANCELED: "CANCELED",
    GoalStatus.STATUS_ABORTED: "ABORTED",
    GoalStatus.STATUS_UNKNOWN: "UNKNOWN",
}


class Tester:
    """What steps send goes out here, and what comes back is written down.

    Args:
        world: The session's world.

    Attributes:
        replies: What came back, in order.
    """

    def __init__(self, world: World) -> None:
        self.replies: list[Reply] = []
        self._world = world
        self._ends: dict[int, Any] = {}
        self._goals: dict[int, Any] = {}
        self._counts: Counter[str] = Counter()

    def prepare(self, node: Node, steps: Iterable[Publish | Call | SendGoal]) -> None:
        """Make what the steps need: publishers, and clients of services and actions."""
        made: dict[tuple[str, ...], Any] = {}
        for step in steps:
            if isinstance(step, Publish):
                kind = message_class(step.type_name)
                end = node.create_publisher(kind, step.topic, profile(step.qos))
            else:
                end = made.get(_address(step)) or _client(node, step)
                made[_address(step)] = end
            self._ends[id(step)] = end

    def publish(self, step: Publish) -> None:
        """Publish what a step says."""
        for value in step.values:
            self._ends[id(step)].publish(message(step.type_name, value))

    def call(self, step: Call) -> None:
        """Call a service."""
        client = self._ends[id(step)]
        request = client.srv_type.Request(**step.values)
        note = self._noting(client.service_name)
        client.call_async(request).add_done_callback(
            lambda future: note("response", plain(future.result()))
        )

    def send(self, step: SendGoal) -> None:
        """Send a goal, and ask for its result."""
        client = self._ends[id(step)]
        goal = client._action_type.Goal(**step.goal)
        note = self._noting(f"/{step.action.lstrip('/')}")
        sent = client.send_goal_async(goal, lambda heard: note("feedback", plain(heard.feedback)))
        sent.add_done_callback(lambda future: self._decided(step, note, future.result()))

    def _decided(self, step: SendGoal, note: Any, goal: Any) -> None:  # noqa: ANN401
        note("goal", {"accepted": goal.accepted})
        if goal.accepted:
            self._goals[id(step)] = (goal, note)
            goal.get_result_async().add_done_callback(
                lambda future: note("result", _result(future.result()))
            )

    def cancel(self, step: SendGoal) -> None:
        """Cancel the goal of a step, if it was accepted."""
        goal, note = self._goals.get(id(step), (None, None))
        if goal is not None:
            goal.cancel_goal_async().add_done_callback(
                lambda future: note("cancel", {"count": len(future.result().goals_canceling)})
            )

    def set_parameters(self, step: SetParameters, name: str, node: Node) -> str:
        """Set parameters of a node, all at once; `accepted`, or why they were refused."""
        note = self._noting(name)
        missing = [one for one in step.values if not node.has_parameter(one)]
        if missing:
            note("parameters", {"successful": False, "reason": "not declared", "values": {}})
            return "refused, not declared"
        wanted = [Parameter(one, value=value) for one, value in step.values.items()]
        result = node.set_parameters_atomically(wanted)
        values = {one: node.get_parameter(one).value for one in step.values}
        note("parameters", {**plain(result), "values": values})
        return "accepted" if result.successful else f"refused, {result.reason}".rstrip(", ")

    def _noting(self, name: str) -> partial[None]:
        self._counts[name] += 1
        return partial(self._note, name, self._counts[name])

    def _note(self, name: str, number: int, word: str, data: dict[str, Any]) -> None:
        self.replies.append(Reply(self._world.now(), name, number, word, data))


def _address(step: Call | SendGoal) -> tuple[str, ...]:
    name = step.service if isinstance(step, Call) else step.action
    return type(step).__name__, name, step.type_name


def _client(node: Node, step: Call | SendGoal) -> Any:  # noqa: ANN401 - of a service or action
    kind = message_class(step.type_name)
    if isinstance(step, Call):
        return node.create_client(kind, step.service)
    return ActionClient(node, kind, step.action)


def _result(response: Any) -> dict[str, Any]:  # noqa: ANN401 - of any action
    return {"status": _STATUS.get(response.status, "OTHER"), **plain(response.result)}


# Carrying out the steps of a scenario.


class Stage:
    """Runs virtual time from step to step.

    Args:
        session: The session.
        steps: What is to be done, in any order.

    Attributes:
        subject: Full name of the learner's node, to which steps without a name are done.
        records: What was done: callbacks of the kind `step`.
    """

    def __init__(self, session: Session, steps: Iterable[Step]) -> None:
        self.subject = ""
        self.records: list[CallbackRecord] = []
        self._session, self._world = session, session._world
        self._todo = deque(sorted(_with_cancels(steps), key=lambda step: step.at_ns))
        self._tester = Tester(self._world)

    def prepare(self) -> None:
        """Make the node that the steps publish, call and send goals from, if any do."""
        wanted = [step for step in self._todo if isinstance(step, Publish | Call | SendGoal)]
        if wanted:
            self._tester.prepare(self._session.add(lambda: Node(TESTER, **BARE)), wanted)

    @property
    def replies(self) -> tuple[Reply, ...]:
        """What came back to those who asked."""
        return tuple(self._tester.replies)

    def advance(self, end: int, run: Callable[[int], None]) -> None:
        """Let virtual time pass, and do on the way what is to be done.

        Args:
            end: Until when, in nanoseconds.
            run: Runs the nodes until a time.
        """
        while self._todo and self._todo[0].at_ns <= end:
            step = self._todo.popleft()
            run(max(step.at_ns, self._world.now()))
            self._do(step)
        run(end)

    # The steps.

    def _do(self, step: Step) -> None:
        name = step.node or self.subject
        if isinstance(step, Publish | Call | SendGoal | Cancel):
            self._note(step, f"/{TESTER}", self._sent(step))
            return
        if isinstance(step, Add):
            self._join(step)
            return
        state = self._world.named("/" + name.lstrip("/"))
        if state is None or state.node is None:
            self._note(step, name, "no such node")
        elif isinstance(step, SetParameter | SetParameters):
            self._set(step, state)
        else:
            self._move(step, state)

    def _join(self, step: Add) -> None:
        """Add a node."""
        self._session.add(step.make, **step.start.options())

    def _sent(self, step: Publish | Call | SendGoal | Cancel) -> str:
        """Let the tester send something; where to."""
        if isinstance(step, Publish):
            self._tester.publish(step)
            return step.topic
        if isinstance(step, Call):
            self._tester.call(step)
            return step.service
        if isinstance(step, SendGoal):
            self._tester.send(step)
            return step.action
        self._tester.cancel(step.sent)
        return step.sent.action

    def _move(self, step: Step, state: NodeState) -> None:
        if isinstance(step, Remove):
            self._world.destroy(state)
        elif isinstance(step, Pause):
            self._world.pause_node(state)
        elif isinstance(step, Resume) and not state.ended:
            self._world.spin_node(state)
        self._note(step, state.name, "")

    def _set(self, step: SetParameter | SetParameters, state: NodeState) -> None:
        try:
            answer = self._answer(step, state)
        except RosbeatError:
            raise
        except Exception as error:  # a callback of the learner's own
            self._world.callback_raised(state, "set_parameters", error)
            answer = f"raised {type(error).__name__}"
        names = step.name if isinstance(step, SetParameter) else ", ".join(step.values)
        self._note(step, state.name, f"{names}: {answer}")

    def _answer(self, step: SetParameter | SetParameters, state: NodeState) -> str:
        if isinstance(step, SetParameter):
            return _set_parameter(state, step)
        if state.node is None:
            return "refused, not declared"
        return self._tester.set_parameters(step, state.name, state.node)

    def _note(self, step: Step, node: str, source: str) -> None:
        kind = type(step).__name__
        self.records.append(CallbackRecord(self._world.now(), node, "step", kind, source))


def _with_cancels(steps: Iterable[Step]) -> Iterator[Step]:
    for step in steps:
        yield step
        if isinstance(step, SendGoal) and step.cancel_after is not None:
            yield Cancel(step.at + step.cancel_after, sent=step)


def _set_parameter(state: NodeState, step: SetParameter) -> str:
    """Set a parameter of a node; `accepted`, or why it was refused."""
    node = state.node
    if node is None or not node.has_parameter(step.name):
        return "refused, not declared"
    (result,) = node.set_parameters([Parameter(step.name, value=step.value)])
    return "accepted" if result.successful else f"refused, {result.reason}".rstrip(", ")


# One run of a learner's node among others, in a session of its own.


#: Records of one kind that an observation holds at most; and one that was broken off: a callback
#: that publishes or logs without end fills no memory with them, and takes no time.
MOST_RECORDS, MOST_OF_BROKEN_OFF = 100_000, 2_000
#: What may run beside an answer.
Others = Iterable[Callable[[], Node] | Maker]
#: Seconds of wall time in which a graph is read and nodes are destroyed, at most.
_TO_TIDY = 1.0


class _NeverMade(BaseException):
    """Raised in a constructor that waits for longer than the run lasts."""


class Scene:
    """Runs an answer, and remembers what went wrong.

    Args:
        seed: Seed of the random numbers that nodes draw.
        seconds: Virtual seconds to run.
        steps: What is done meanwhile.
    """

    def __init__(self, seed: int, seconds: float, steps: Iterable[Step]) -> None:
        self.subject = ""
        self._seed, self._end = seed, duration_ns(seconds)
        self._session = session = Session(seed=seed)
        self._world = session._world
        self._stage = Stage(session, steps)
        self._faults: list[Fault] = []
        self._making = False
        # How long the constructor has slept; and who never came back from a wait.
        self._slept = 0
        self._never_back: Fault | None = None
        self._limit: Deadline | None = None
        # What was running when the time was up, and how many faults there had been by then.
        self._stuck: tuple[str, str] = ("", "run")
        self._known = 0

    # Running.

    def play(self, answer: Maker, others: Others, deadline: float) -> None:
        """Run everything, at most `deadline` seconds of wall time; whatever is raised is a fault.

        Raises:
            KeyboardInterrupt: If Interrupt was pressed.
        """
        # What has to be put back stands outside of the deadline, which hits what it finds.
        limit = within(deadline, self._note_stuck, self._wake)
        with self._world.running([answer.make]), limit as self._limit:
            apart(lambda: self._try_to_play(answer, others))

    def _try_to_play(self, answer: Maker, others: Others) -> None:
        try:
            self._perform(answer, others)
        except DeadlinePassed:
            raise
        except _NeverMade:
            return
        except BaseException as error:  # a learner may raise anything
            self._faults.append(self._refused(error))

    def _perform(self, answer: Maker, others: Others) -> None:
        self._stage.prepare()
        for other in others:
            made = other if isinstance(other, Maker) else Maker(other)
            self._session.add(made.make, **made.start.options())
        self._add(answer)
        self._world.console.begin(quiet=True)
        self._stage.advance(self._end, self._world.virtual.run_until)
        self._note_who_waits()

    def _add(self, answer: Maker) -> None:
        make = type(answer.make) if isinstance(answer.make, Node) else answer.make
        with self._starting():
            made = self._session.add(make, **answer.start.options())
            self.subject = self._stage.subject = self._world.name_of(made) or ""

    @contextmanager
    def _starting(self) -> Iterator[None]:
        """Make the answer's nodes in this block.

        A node of the same name would make room: here it is another process, and stays. And a
        constructor that sleeps takes no time: the run begins when the node is there.
        """
        self._making = True
        self._world.node_begins = _let_be  # type: ignore[method-assign]
        self._world.virtual.nap = self._nap
        try:
            yield
        finally:
            self._world.virtual.nap = None
            del self._world.node_begins
        self._making = False

    def _wake(self) -> None:
        """Wake executors that wait in C, where no exception reaches them."""
        for state in self._world.states():
            executor = getattr(state.node, "executor", None)
            if executor is not None and executor is not self._world.virtual:
                executor.wake()

    # Waiting.

    def _nap(self, span_ns: int, reason: str) -> None:
        self._slept += span_ns
        if self._slept > self._end:
            self._never_back = self._late_fault("", "__init__", reason, sys._getframe(1))
            raise _NeverMade

    def _note_who_waits(self) -> None:
        """Note a callback that waits on when the run is over, if it has waited for long."""
        for call in self._world.virtual.suspended:
            wait = call.wait
            if wait is None or call.spinning:
                continue
            if call.began_ns > self._end / 2 and (wait.until_ns or 0) < 2 * self._end:
                continue
            frame = wait.thread.gr_frame
            self._never_back = self._late_fault(call.node, call.name, wait.reason, frame)
            return

    def _late_fault(self, node: str, callback: str, reason: str, frame: FrameType | None) -> Fault:
        known = {"sleep": "asleep", "spin": "spinning"}
        doing = known.get(reason, f"waiting for {reason}")
        text = f"still {doing} after {self._end / NANOSECONDS:g} s"
        place = line_of(frame)
        return Fault(self._world.now(), node, callback, "DeadlinePassed", text, *place)

    # What went wrong.

    def _note_stuck(self) -> None:
        calling = self._world.virtual.calling
        if self._making:
            self._stuck = ("", "__init__")
        elif calling is not None:
            self._stuck = (calling.node, calling.name)
        # Not `len`: this is called in the midst of code that may have put something in its place.
        self._known = self._world.recorder.faults.__len__()

    def _refused(self, error: BaseException) -> Fault:
        now, cause = self._world.now(), error.__cause__
        if isinstance(error, NodeConstructionError) and cause is not None:
            return fault_of(cause, now, "", "__init__")
        if isinstance(error, RosbeatError):
            call = "add" if isinstance(error, NodeClassError) else "run"
            return Fault(now, "", call, type(error).__name__, error.what, 0, "")
        self._note_stuck()
        return fault_of(error, now, *self._stuck)

    def _all_faults(self) -> tuple[Fault, ...]:
        found = [*self._world.recorder.faults, *self._faults]
        if self._limit is None or not self._limit.passed:
            return (*found, self._never_back) if self._never_back else tuple(found)
        node, callback = self._stuck
        text = f"still running after {self._limit.seconds:g} s"
        stuck = Fault(self._world.now(), node, callback, "DeadlinePassed", text, *self._limit.place)
        # What was raised afterwards was raised by the shot.
        return (*found[: self._known], stuck)

    # The result.

    def observation(self, printed: int) -> Observation:
        """What was seen.

        Args:
            printed: How many characters the learner's code printed.
        """
        recorder = self._world.recorder
        broken_off = (self._limit and self._limit.passed) or self._never_back
        most = MOST_OF_BROKEN_OFF if broken_off else MOST_RECORDS
        callbacks = [*islice(recorder.callbacks(), most), *self._stage.records]
        graph = self._graph()
        return Observation(
            self._world.now(),
            self._seed,
            tuple(islice(recorder.samples(), most)),
            tuple(recorder.logs[:most]),
            tuple(sorted(callbacks, key=_time_of)),
            self._all_faults(),
            graph,
            self.subject,
            printed,
            self._stage.replies,
            self._world.virtual.all_waits()[:most],
        )

    def _graph(self) -> GraphSnapshot:
        graph = GraphSnapshot()
        with within(_TO_TIDY), suppress(Exception):  # a node may have properties of its own
            graph = self._world.graph()
        return graph

    def close(self) -> None:
        """End the session, whatever the nodes do against it."""
        kinds = [type(node) for node in self._session.nodes]
        with within(_TO_TIDY, nudge=self._wake):
            apart(self._destroy_nodes)
        self._session.close()
        del self._session, self._world, self._stage
        if any(hasattr(kind, "__del__") for kind in kinds):
            with within(_TO_TIDY):
                apart(gc.collect)  # here, where it has a deadline, and not at any later time

    def _destroy_nodes(self) -> None:
        self._world.interrupt()
        for node in reversed(self._session.nodes):
            with suppress(Exception):
                Node.destroy_node(node)  # and not what its class makes of that


def _let_be(name: str, namespace: str) -> None:
    """Make no room for a new node."""


def _time_of(record: CallbackRecord) -> int:
    return record.time_ns


#: Seconds of wall time that an observation may take.
DEADLINE = 5.0


def observe(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    others: Iterable[Callable[[], Node] | Maker] = (),
    start: Launch | None = None,
    seed: int = 0,
    steps: Iterable[Step] = (),
    deadline: float = DEADLINE,
) -> Observation:
    """Run an answer among other nodes in virtual time.

    Args:
        answer: What should be a node class, or a function that returns a node. Of a node the class
            is taken.
        seconds: Virtual seconds to run.
        others: Nodes to run beside it. They are added first, so that what clashes with them is
            raised by the answer's own line. A `Maker` also says how a node is started.
        start: How the answer is started: under which name, with which topics and parameters.
        seed: Seed of the random numbers that nodes draw.
        steps: What is done while it runs; each that was done is a callback of the kind `step`.
        deadline: Seconds of wall time after which it is broken off.

    Returns:
        What happened. An answer that cannot be made into a node, an endless chain, and a deadline
        that passed are faults.

    Raises:
        KeyboardInterrupt: If Interrupt was pressed.
        DomainsExhaustedError: If no private domain id is left on this machine.
    """
    scene = Scene(seed, seconds, steps)
    try:
        with unharmed() as count:
            scene.play(Maker(answer, start or Launch()), others, deadline)
        # What the learner's code has changed is put back before anything else is done.
        with unharmed():
            return scene.observation(count.characters)
    finally:
        with unharmed():
            scene.close()


# Running a whole system of a learner's: several nodes, as a launch file would start them.
#
# What `observe` does for one node: nothing is printed or raised, there is a deadline, and
# whatever goes wrong is a fault in the observation. A node that cannot be made, or raises, ends
# alone; the others go on, as processes do.


#: A system of more nodes is taken for a slip.
MOST_NODES = 30
_OPTIONS = ("name", "namespace", "remappings", "parameters")


def observe_system(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    others: Iterable[Callable[[], Node]] = (),
    parameters: Mapping[str, Any] | None = None,
    steps: Iterable[Step] = (),
    seed: int = 0,
    deadline: float = DEADLINE,
) -> Observation:
    """Run the nodes of an answer among others in virtual time.

    Args:
        answer: What should be a function that returns a list, or the list. Its members are node
            classes, functions that return a node, or pairs of one of these and a dict with
            `name`, `namespace`, `remappings` and `parameters`.
        seconds: Virtual seconds to run.
        others: Nodes to run beside them, added first.
        parameters: Values with which each of the answer's nodes is started, besides its own.
        steps: What is done meanwhile.
        seed: Seed of the random numbers that nodes draw.
        deadline: Seconds of wall time after which it is broken off.

    Returns:
        What happened. An answer that is no list of nodes is a fault of the kind `NoSystemError`.

    Raises:
        KeyboardInterrupt: If Interrupt was pressed.
        DomainsExhaustedError: If no private domain id is left on this machine.
    """
    scene = _SystemScene(seed, seconds, steps)
    try:
        with unharmed() as count:
            scene.play(Maker(answer, Launch(parameters=parameters or {})), others, deadline)
        with unharmed():
            return scene.observation(count.characters)
    finally:
        with unharmed():
            scene.close()


class _SystemScene(Scene):
    """Runs the nodes of a system."""

    def _add(self, answer: Maker) -> None:
        with self._starting():
            for member in members(answer.make):
                self._add_one(member, answer.start)

    def _add_one(self, member: Maker, given: Launch) -> None:
        try:
            if isinstance(member.make, Node):
                self._session.add(member.make)
                return
            both = {**member.start.parameters, **given.parameters}
            self._session.add(member.make, **replace(member.start, parameters=both).options())
        except RosbeatError as error:
            self._faults.append(self._refused(error))


def members(answer: Any) -> list[Maker]:  # noqa: ANN401
    """The nodes of a system, and how each is started.

    Args:
        answer: A list, or a function that returns one.

    Raises:
        NoSystemError: If it is neither.
        SessionError: If a node cannot be started as the list says.
    """
    found = answer() if callable(answer) and not _is_node(answer) else answer
    if found is None:
        raise _no_system(
            "The function gave nothing back.", "It needs a `return`, and behind it the list."
        )
    if isinstance(found, str | Mapping | Node) or _is_node(found):
        raise _no_system(f"What came is {_kind(found)}.", "A system is a list of nodes.")
    try:
        listed = list(found)
    except TypeError:
        raise _no_system(f"What came is {_kind(found)}.", "A system is a list.") from None
    if not 0 < len(listed) <= MOST_NODES:
        raise _no_system(f"The list holds {len(listed)} nodes.", "Each node of yours stands once.")
    return [_member(one) for one in listed]


def _member(one: Any) -> Maker:  # noqa: ANN401
    if isinstance(one, Maker):
        return one
    if not isinstance(one, tuple | list):
        return Maker(one)
    may = f"The dict may hold {', '.join(_OPTIONS)}, as `ros.add` takes them."
    if len(one) != 2 or not isinstance(one[1], Mapping):
        raise _no_system("A pair in the list is not of a class and a dict.", may)
    strange = [option for option in one[1] if option not in _OPTIONS]
    if strange:
        known = f"known are {', '.join(_OPTIONS)}"
        raise _no_system(f"A node cannot be started with {strange[0]!r}; {known}.", may)
    return Maker(one[0], checked(*(one[1].get(option) for option in _OPTIONS)))


def _is_node(found: object) -> bool:
    return isinstance(found, Node) or (isclass(found) and issubclass(found, Node))


def _kind(found: object) -> str:
    if isclass(found):
        return "one class, and no list"
    return "one node, and no list" if _is_node(found) else f"of type {type(found).__name__}"


def _no_system(what: str, means: str) -> NoSystemError:
    return NoSystemError(what, means, "Return a list of classes: `return [SomeNode, OtherNode]`.")

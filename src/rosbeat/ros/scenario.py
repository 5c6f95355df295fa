"""Run a learner's node, or a system of nodes, and record what happens.

A scenario does not judge. Any error in the learner's code becomes a fault in the observation:
nothing is printed or raised, a deadline limits the time, and afterwards the process's state is
restored.
"""

from __future__ import annotations

import gc
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import cache, partial
from inspect import isclass
from itertools import islice
from operator import attrgetter
from types import FrameType
from typing import Any
from weakref import ref

from action_msgs.msg import GoalStatus
from rcl_interfaces.msg import SetParametersResult
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future

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
from rosbeat.ros.errors import duration_ns
from rosbeat.ros.exception_origin import fault_of, line_of
from rosbeat.ros.isolation import Deadline, DeadlinePassed, run_in_generator, unharmed
from rosbeat.ros.launch import Launch, Maker, checked
from rosbeat.ros.processes import NodeState
from rosbeat.ros.recording import message_class, plain
from rosbeat.ros.session import Session
from rosbeat.ros.tester import BARE, message, profile

# What is done to the nodes while they run, as plain data.


@dataclass(frozen=True)
class Step:
    """Do something `at` a time, in virtual seconds, after everything else that is due then.

    It is done to the node of the name `node`; by default the learner's.
    """

    at: float
    node: str = ""

    @property
    def at_ns(self) -> int:
        """Return when it is done, in nanoseconds."""
        return round(self.at * NANOSECONDS)


@dataclass(frozen=True, kw_only=True)
class Publish(Step):
    """Publish messages at one instant; see `test_nodes.message` for the values.

    The publisher belongs to the node `/tester` and exists from the beginning.
    """

    topic: str
    type_name: str = "std_msgs/msg/Float32"
    values: tuple[Any, ...] = ()
    qos: QoS = field(default_factory=QoS)


@dataclass(frozen=True)
class Pause(Step):
    """Run none of a node's callbacks, as if it were busy."""


@dataclass(frozen=True)
class Resume(Step):
    """Run a node's callbacks again."""


@dataclass(frozen=True, kw_only=True)
class SetParameter(Step):
    """Set a parameter, as `ros2 param set` does."""

    name: str
    value: Any


@dataclass(frozen=True, kw_only=True)
class SetParameters(Step):
    """Set all parameters or, if one is refused, none; the result is a `Reply`."""

    values: Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Call(Step):
    """Call a service from the node `/tester`; the response is a `Reply`."""

    service: str
    type_name: str = "std_srvs/srv/Trigger"
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class SendGoal(Step):
    """Send a goal from the node `/tester`; its acceptance, feedback and result are `Reply`s.

    An accepted goal is canceled after `cancel_after` seconds, if that is given.
    """

    action: str
    type_name: str = "test_msgs/action/Fibonacci"
    goal: Mapping[str, Any]
    cancel_after: float | None = None


@dataclass(frozen=True, kw_only=True)
class Cancel(Step):
    """Cancel a goal; `SendGoal` with `cancel_after` includes this step."""

    sent: SendGoal


@dataclass(frozen=True)
class Remove(Step):
    """Destroy a node."""


@dataclass(frozen=True, kw_only=True)
class Add(Step):
    """Add a node from a node class, or a function that returns a node."""

    make: Callable[[], Node]
    start: Launch = field(default_factory=Launch)


#: Steps that the node `/tester` carries out.
Sent = Publish | Call | SendGoal | Cancel
TESTER = "tester"

_STATUS = {
    GoalStatus.STATUS_SUCCEEDED: "SUCCEEDED",
    GoalStatus.STATUS_CANCELED: "CANCELED",
    GoalStatus.STATUS_ABORTED: "ABORTED",
    GoalStatus.STATUS_UNKNOWN: "UNKNOWN",
}


class Steps:
    """Carry out steps, given in any order, at their times.

    Attributes:
        subject: Full name of the learner's node.
        records: A callback record of the kind `step` for each completed step.
        replies: Replies of services, actions and parameters.
    """

    def __init__(self, session: Session, steps: Iterable[Step]) -> None:
        self.subject = ""
        self.records: list[CallbackRecord] = []
        self.replies: list[Reply] = []
        self._session, self._core = session, session._core
        self._steps = sorted(_with_cancels(steps), key=attrgetter("at_ns"))
        # By the id of a step: its publisher or client, and the goal that it sent.
        self._entities: dict[int, Any] = {}
        self._goals: dict[int, tuple[Any, partial[None]]] = {}
        self._requests: Counter[str] = Counter()

    def prepare(self) -> None:
        """Make the node that publishes, calls services and sends goals, if a step does."""
        sending = [one for one in self._steps if isinstance(one, Publish | Call | SendGoal)]
        if not sending:
            return
        node = self._session.add(lambda: Node(TESTER, **BARE))
        service, action = cache(node.create_client), cache(partial(ActionClient, node))
        for step in sending:
            kind = message_class(step.type_name)
            if isinstance(step, Publish):
                self._entities[id(step)] = node.create_publisher(
                    kind, step.topic, profile(step.qos)
                )
            elif isinstance(step, Call):
                self._entities[id(step)] = service(kind, step.service)
            else:
                self._entities[id(step)] = action(kind, step.action)

    def run_until(self, end_ns: int) -> None:
        """Run virtual time until `end_ns`, and carry out the steps on the way."""
        run_until = self._core.virtual.run_until
        for step in self._steps:
            if step.at_ns > end_ns:
                break
            run_until(max(step.at_ns, self._core.now()))
            if isinstance(step, Add):
                self._session.add(step.make, **step.start.options())
                continue
            node, source = self._send(step) if isinstance(step, Sent) else self._change(step)
            kind, now = type(step).__name__, self._core.now()
            self.records.append(CallbackRecord(now, node, "step", kind, source))
        run_until(end_ns)

    # Both ways of carrying out a step return what is recorded: a node's name and a text.

    def _send(self, step: Sent) -> tuple[str, str]:
        entity: Any = self._entities.get(id(step))
        if isinstance(step, Publish):
            for value in step.values:
                entity.publish(message(step.type_name, value))
            return f"/{TESTER}", step.topic
        if isinstance(step, Call):
            self._call(step, entity)
            return f"/{TESTER}", step.service
        if isinstance(step, SendGoal):
            self._send_goal(step, entity)
            return f"/{TESTER}", step.action
        self._cancel(step.sent)
        return f"/{TESTER}", step.sent.action

    def _call(self, step: Call, client: Any) -> None:  # noqa: ANN401 - of any service
        reply = self._replier(client.service_name)
        future = client.call_async(client.srv_type.Request(**step.values))
        future.add_done_callback(lambda future: reply("response", plain(future.result())))

    def _send_goal(self, step: SendGoal, client: Any) -> None:  # noqa: ANN401 - of any action
        reply = self._replier(f"/{step.action.lstrip('/')}")

        def accepted_or_rejected(future: Future) -> None:
            goal = future.result()
            reply("goal", {"accepted": goal.accepted})
            if goal.accepted:
                self._goals[id(step)] = goal, reply
                goal.get_result_async().add_done_callback(
                    lambda future: reply("result", _result(future.result()))
                )

        # An action client has no public name for its type.
        goal = client._action_type.Goal(**step.goal)
        sent = client.send_goal_async(goal, lambda heard: reply("feedback", plain(heard.feedback)))
        sent.add_done_callback(accepted_or_rejected)

    def _cancel(self, sent: SendGoal) -> None:
        if id(sent) in self._goals:
            goal, reply = self._goals[id(sent)]
            goal.cancel_goal_async().add_done_callback(
                lambda future: reply("cancel", {"count": len(future.result().goals_canceling)})
            )

    def _replier(self, name: str) -> partial[None]:
        """Return a function that records a reply to the next request to `name`."""
        self._requests[name] += 1
        return partial(self._reply, name, self._requests[name])

    def _reply(self, name: str, number: int, word: str, data: dict[str, Any]) -> None:
        self.replies.append(Reply(self._core.now(), name, number, word, data))

    def _change(self, step: Step) -> tuple[str, str]:
        name, text = step.node or self.subject, ""
        state = self._core.nodes.named("/" + name.lstrip("/"))
        if state is None:
            return name, "no such node"
        if isinstance(step, Remove):
            self._core.lives.destroy(state)
        elif isinstance(step, Pause):
            self._core.lives.pause_node(state)
        elif isinstance(step, Resume) and not state.ended:
            self._core.lives.spin_node(state)
        elif isinstance(step, SetParameter | SetParameters):
            text = self._set(step, state, state.node)
        return state.name, text

    def _set(self, step: SetParameter | SetParameters, state: NodeState, node: Node) -> str:
        reply = self._replier(state.name) if isinstance(step, SetParameters) else None
        values = {step.name: step.value} if isinstance(step, SetParameter) else step.values
        result = SetParametersResult(reason="not declared")
        try:
            declared = all(map(node.has_parameter, values))
            if declared:
                parameters = [Parameter(name, value=value) for name, value in values.items()]
                result = node.set_parameters_atomically(parameters)
            if reply:
                now = {name: node.get_parameter(name).value for name in values if declared}
                reply("parameters", {**plain(result), "values": now})
            text = "accepted" if result.successful else f"refused, {result.reason}".rstrip(", ")
        except RosbeatError:
            raise
        except Exception as error:  # a callback of the learner's own
            self._core.reports.callback_raised(state, "set_parameters", error)
            text = f"raised {type(error).__name__}"
        return f"{', '.join(values)}: {text}"


def _with_cancels(steps: Iterable[Step]) -> Iterator[Step]:
    for step in steps:
        yield step
        if isinstance(step, SendGoal) and step.cancel_after is not None:
            yield Cancel(step.at + step.cancel_after, sent=step)


def _result(response: Any) -> dict[str, Any]:  # noqa: ANN401 - of any action
    return {"status": _STATUS.get(response.status, "OTHER"), **plain(response.result)}


# One run of a learner's nodes among others, in a session of its own.

#: A node that runs beside the learner's, and how it is started.
Other = Callable[[], Node] | Maker
#: Seconds of wall time that an observation may take.
DEADLINE = 5.0
#: Seconds of wall time in which a graph is read and nodes are destroyed, at most.
_TO_TIDY = 1.0
#: Records of one kind in an observation, and in one that was broken off: a callback may publish or
#: log without end.
MOST_RECORDS, MOST_OF_BROKEN_OFF = 100_000, 2_000
#: As many publishers on one topic, or timers, are made by a callback that makes one at each call.
_MANY = 20
#: Nodes in a system; a longer list is taken for a mistake.
MOST_NODES = 30


class _NeverMade(BaseException):
    """Raised in a constructor that waits for longer than the run lasts."""


def _refuse_init() -> None:
    """Answer `rclpy.init()` of a node: the program around it has called it before."""
    raise RuntimeError("Context.init() must only be called once")


class _Run:
    """Runs the learner's nodes, and records what goes wrong; see `observe`."""

    def __init__(
        self,
        add: Callable[[_Run, Maker], None],
        answer: Maker,
        seconds: float,
        others: Iterable[Other] = (),
        steps: Iterable[Step] = (),
        seed: int = 0,
        deadline: float = DEADLINE,
    ) -> None:
        self._add_answer, self._answer, self._others = add, answer, others
        self._seed, self._end = seed, duration_ns(seconds)
        self._session = Session(seed=seed)
        self._core = self._session._core
        # A second type for a topic is a slip of an answer, and is named.
        self._core.has_separate_types = False
        self._steps = Steps(self._session, steps)
        self._deadline = Deadline(deadline, self._note_expiry, self._gets_on)
        self._took = 0.0  # seconds until the time was up
        self._is_slow = False
        self._faults: list[Fault] = []
        self._late: Fault | None = None  # of a callback or constructor that never came to an end
        self._slept = 0  # in the constructor
        self._constructing = False
        self._ended_early = False  # by rclpy.shutdown() in its constructor
        # What was running at the deadline, and how many faults there had been.
        self._expired: tuple[tuple[str, str], int] = ("", "run"), 0

    def play(self) -> None:
        """Run everything; whatever is raised becomes a fault."""
        self._began = time.monotonic()
        # What has to be put back stands outside of the deadline, which hits what it finds.
        with self._core.running([self._answer.make]), self._deadline:
            run_in_generator(self._play)

    def _play(self) -> None:
        try:
            self._steps.prepare()
            for other in self._others:
                self._add(_maker(other))
            with self._starting():
                self._add_answer(self, self._answer)
            self._core.console.begin(quiet=True)
            self._steps.run_until(self._end)
            self._note_waiting()
        except DeadlinePassed:
            raise
        except _NeverMade:
            pass
        except BaseException as error:  # a learner may raise anything
            self._faults.append(self._fault_of(error))

    @contextmanager
    def _starting(self) -> Iterator[None]:
        """Make the learner's nodes in this block.

        A node of the same name is another process here, and stays. A constructor that sleeps takes
        no time: the run begins when the nodes are there.
        """
        self._constructing = True
        self._core.node_begins = lambda *_: None  # type: ignore[method-assign]  # undone below
        self._core.virtual.constructor_waits = self._count_wait
        try:
            yield
        finally:
            self._core.virtual.constructor_waits = None
            del self._core.node_begins
        self._constructing = False

    def _add(self, maker: Maker) -> Node:
        return self._session.add(maker.make, **maker.start.options())

    def add_node(self, answer: Maker) -> None:
        """Add the learner's node; of an instance, its class is used."""
        make = type(answer.make) if isinstance(answer.make, Node) else answer.make
        if isclass(make):  # a function may be a program's main, which calls both
            self._core.explain_init = _refuse_init  # type: ignore[method-assign]  # this session only
            self._core.explain_shutdown = self._shut_down  # type: ignore[method-assign]  # the same
        node = self._add(replace(answer, make=make))
        self._steps.subject = self._core.nodes.name_of(node) or ""
        state = self._core.nodes.state_of(node)
        if self._ended_early and state is not None:
            state.spinning, state.ended = False, True
            state.process.refresh()

    def _shut_down(self) -> None:
        """Answer `rclpy.shutdown()` of a node: it ends, at the latest when it is made."""
        if self._constructing:
            self._ended_early = True
        else:
            type(self._core).explain_shutdown(self._core)

    def add_system(self, answer: Maker) -> None:
        """Add the nodes of a learner's system; one that cannot be made is left out."""
        for maker in _makers(answer.make):
            start = maker.start
            start = replace(start, parameters={**start.parameters, **answer.start.parameters})
            try:
                self._add(Maker(maker.make, Launch() if isinstance(maker.make, Node) else start))
            except RosbeatError as error:
                self._faults.append(self._fault_of(error))

    # What goes wrong.

    def _count_wait(self, span_ns: int, reason: str) -> None:
        self._slept += span_ns
        if self._slept > self._end:
            self._late = self._late_fault("", "__init__", reason, sys._getframe(1))
            raise _NeverMade

    def _note_waiting(self) -> None:
        """Note the first callback that has waited for long when the run is over."""
        for call in self._core.virtual.suspended:
            wait = call.wait
            is_long = call.began_ns <= self._end / 2
            if wait and not call.idle and (is_long or (wait.until_ns or 0) >= 2 * self._end):
                frame = wait.thread.gr_frame
                self._late = self._late_fault(call.node, call.name, wait.reason, frame)
                return

    def _late_fault(self, node: str, callback: str, reason: str, frame: FrameType | None) -> Fault:
        doing = {"sleep": "asleep", "spin": "spinning"}.get(reason, f"waiting for {reason}")
        text = f"still {doing} after {self._end / NANOSECONDS:g} s"
        return Fault(self._core.now(), node, callback, "DeadlinePassed", text, *line_of(frame))

    def _callback(self) -> tuple[str, str]:
        """Return the node and the callback that is running."""
        calling = self._core.virtual.calling
        if self._constructing:
            return "", "__init__"
        return ("", "run") if calling is None else (calling.node, calling.name)

    def _is_new(self) -> bool:
        """Return whether a callback has begun lately, so that none is endless."""
        # An endless call has had all of the time for itself, unless the run had none left.
        return time.monotonic() - self._core.recorder.began < self._deadline.seconds / 2

    def _gets_on(self) -> bool:
        """Return whether callbacks come to an end, and do not make things anew."""
        return self._is_new() and not self._made_anew(*self._callback())

    def _note_expiry(self) -> None:
        self._is_slow = self._is_new()
        self._took = time.monotonic() - self._began
        # Not `len`: the code that is running may have replaced it.
        self._expired = self._callback(), self._core.recorder.faults.__len__()

    def _fault_of(self, error: BaseException) -> Fault:
        now, cause = self._core.now(), error.__cause__
        if isinstance(error, NodeConstructionError) and cause is not None:
            return fault_of(cause, now, "", "__init__")
        if isinstance(error, RosbeatError):
            call = "add" if isinstance(error, NodeClassError) else "run"
            return Fault(now, "", call, type(error).__name__, error.what, 0, "")
        return fault_of(error, now, *self._callback())

    # The result.

    def observation(self, printed: int) -> Observation:
        """Return what happened; the learner's code printed so many characters."""
        recorder, deadline = self._core.recorder, self._deadline
        faults = [*recorder.faults, *self._faults, *filter(None, [self._late])]
        if deadline.passed:
            callback, known = self._expired
            text = f"still running after {deadline.seconds:g} s"
            with Deadline(_TO_TIDY), suppress(Exception):  # a node may have properties of its own
                slow = f"{recorder.calls()} calls of callbacks took {self._took:.0f} s"
                text = self._made_anew(*callback) or (slow if self._is_slow else text)
            now = self._core.now()
            # What was raised after the deadline was raised because of it.
            faults[known:] = [Fault(now, *callback, "DeadlinePassed", text, *deadline.place)]
        most = MOST_OF_BROKEN_OFF if deadline.passed or self._late else MOST_RECORDS
        callbacks = [*islice(recorder.callbacks(), most), *self._steps.records]
        graph = GraphSnapshot()
        with Deadline(_TO_TIDY), suppress(Exception):  # a node may have properties of its own
            graph = self._core.graph()
        return Observation(
            self._core.now(),
            self._seed,
            tuple(islice(recorder.samples(), most)),
            tuple(recorder.logs[:most]),
            tuple(sorted(callbacks, key=attrgetter("time_ns"))),
            tuple(faults),
            graph,
            self._steps.subject,
            printed,
            tuple(self._steps.replies),
            self._core.virtual.all_waits()[:most],
        )

    def _made_anew(self, node: str, callback: str) -> str:
        """Return what a callback has made call after call, until all was slow; or an empty text."""
        calls = [one for one in self._core.recorder.callbacks()
                 if (one.node, one.name) == (node, callback)]  # fmt: skip
        state = self._core.nodes.named(node)
        if state is None or len(calls) < _MANY:  # else it has made them in one call
            return ""
        made = Counter(f"publishers on {one.topic_name}" for one in state.node.publishers)
        made.update(f"subscriptions to {one.topic_name}" for one in state.node.subscriptions)
        made["timers"] = len(list(state.node.timers))
        what, count = made.most_common(1)[0]
        return f"{count} {what} in {len(calls)} calls" if count >= _MANY else ""

    def close(self) -> None:
        """End the session, whatever the nodes do against it."""
        with_finalizer = [ref(one) for one in self._session.nodes if hasattr(type(one), "__del__")]
        with Deadline(_TO_TIDY):
            run_in_generator(self._destroy_nodes)
        self._session.close()
        del self._session, self._core, self._steps
        # What a class does in `__del__` happens here, where it has a deadline, and not later. On
        # a busy machine another thread may still hold such a node for a moment.
        end = time.monotonic() + _TO_TIDY
        while any(one() is not None for one in with_finalizer) and time.monotonic() < end:
            with Deadline(_TO_TIDY):
                run_in_generator(gc.collect)

    def _destroy_nodes(self) -> None:
        # Not in `close`, whose variables would keep a node from being collected.
        self._core.interrupt()
        for node in reversed(self._session.nodes):
            with suppress(Exception):
                Node.destroy_node(node)  # and not what its class makes of that


def observe(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    others: Iterable[Other] = (),
    start: Launch | None = None,
    seed: int = 0,
    steps: Iterable[Step] = (),
    deadline: float = DEADLINE,
) -> Observation:
    """Run an answer among other nodes in virtual time, and return what happened.

    An answer that cannot be made into a node, an endless chain, and a deadline that passed are
    faults.

    Args:
        answer: What should be a node class, or a function that returns a node. Of a node the class
            is taken.
        seconds: Virtual seconds to run.
        others: Nodes to run beside it. They are added first, so that what clashes with them is
            raised by the answer's own line. A `Maker` also says how a node is started.
        start: How the answer is started.
        seed: Seed of the random numbers that nodes draw.
        steps: What is done while it runs; each that was done is a callback of the kind `step`.
        deadline: Seconds of wall time after which it is broken off; while callbacks return and
            others begin, it begins anew, within limits.

    Raises:
        KeyboardInterrupt: If Interrupt was pressed.
    """
    maker = Maker(answer, start or Launch())
    return _observe(_Run(_Run.add_node, maker, seconds, others, steps, seed, deadline))


def observe_system(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    parameters: Mapping[str, Any] | None = None,
    **options: Any,  # noqa: ANN401 - those of `observe`
) -> Observation:
    """Run the nodes of an answer, as a launch file would start them; otherwise like `observe`.

    `answer` should be a list, or a function that returns one. Its members are node classes,
    functions that return a node, or pairs of one of these and a dict of `name`, `namespace`,
    `remappings` and `parameters`. Each is started with `parameters`, too. A node that cannot be
    made, or raises, ends alone. What is no list of nodes is a fault of the kind `NoSystemError`.
    """
    start = Launch(parameters=parameters or {})
    return _observe(_Run(_Run.add_system, Maker(answer, start), seconds, **options))


def _observe(run: _Run) -> Observation:
    try:
        with unharmed() as printed:
            run.play()
        # What the learner's code has changed is put back before anything else is done.
        with unharmed():
            return run.observation(printed.characters)
    finally:
        with unharmed():
            run.close()


def _makers(answer: Any) -> list[Maker]:  # noqa: ANN401 - whatever a learner hands over
    """Return the nodes of a system; raise a NoSystemError if the answer is no list of nodes."""
    is_node = isinstance(answer, Node) or (isclass(answer) and issubclass(answer, Node))
    found = answer() if callable(answer) and not is_node else answer
    if found is None:
        raise _no_system("The function returned nothing.")
    try:
        listed = None if isinstance(found, str | Mapping) else list(found)
    except TypeError:
        listed = None
    if listed is None:
        kind = f"of type {type(found).__name__}"
        kind = "one node, not a list" if isinstance(found, Node) else kind
        kind = "one class, not a list" if isclass(found) else kind
        raise _no_system(f"The returned object is {kind}.")
    if not 0 < len(listed) <= MOST_NODES:
        raise _no_system(f"The list holds {len(listed)} nodes.")
    return [_maker(one) for one in listed]


def _maker(one: Any) -> Maker:  # noqa: ANN401 - whatever a learner hands over
    if isinstance(one, Maker):
        return one
    if not isinstance(one, tuple | list):
        return Maker(one)
    if len(one) != 2 or not isinstance(one[1], Mapping):
        raise _no_system("A pair in the list does not consist of a class and a dict.")
    known = ("name", "namespace", "remappings", "parameters")
    for option in one[1]:
        if option not in known:
            raise _no_system(
                f"A node cannot be started with {option!r}; the options are {', '.join(known)}."
            )
    return Maker(one[0], checked(**one[1]))


def _no_system(what: str) -> NoSystemError:
    return NoSystemError(
        what,
        "A system is a list of nodes, each with a dict of options if it needs any.",
        "Return a list of classes: `return [SomeNode, OtherNode]`.",
    )

"""Test ROS nodes in virtual time: a session that publishes, calls, waits, and fails on exceptions.

A robot goes on when one of its nodes crashes, and so does a `rosbeat.ros.session.Session`. A test
must fail then, so a `TestSession` raises what a node's callback has raised, in the test itself.
"""

from __future__ import annotations

import linecache
import logging
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, TypeVar
from weakref import WeakSet

from rosbeat.errors import (
    ExitCodeError,
    NodeConstructionError,
    NoFaultError,
    ParameterError,
    SessionError,
    TimeUpError,
    UnknownServerError,
    UnknownTopicError,
    called_as,
)
from rosbeat.records import INFRASTRUCTURE_TOPICS, Endpoint, Fault, LogRecord, Sample
from rosbeat.ros.clock import START
from rosbeat.ros.errors import Console, check_name, check_whole, duration_ns, nearest
from rosbeat.ros.session import Session
from rosbeat.ros.tester import Tester, message, parameters_request, profile

if TYPE_CHECKING:
    from typing_extensions import Self

    from rosbeat.ros.launch import Launch
    from rosbeat.ros.launching import SimulatedLaunch
    from rosbeat.ros.simulated_program import SimulatedProgram

__all__ = ["ExpectedFault", "GoalResult", "TestSession"]

#: The parent of the loggers of Python's `logging` through which nodes' log lines come.
LOGGER = "ros"
#: Threads of a `MultiThreadedExecutor()` without a number, on every machine.
THREADS = 4

_LEVELS = {"WARN": logging.WARNING, "FATAL": logging.CRITICAL}
#: Frames in these folders, at the outer end of a traceback, say nothing about a node.
_MACHINERY = (f"{Path(__file__).parent}/", "/rclpy/")
#: Sessions that have not ended: the plugin looks at each of them after a test.
_open_sessions: WeakSet[TestSession] = WeakSet()

_Value = TypeVar("_Value")


@dataclass(frozen=True)
class GoalResult:
    """Hold how a goal ended.

    Attributes:
        status: `SUCCEEDED`, `ABORTED`, `CANCELED` or `REJECTED`.
        result: The result message; None if the goal was rejected.
        feedback: The feedback messages, in order.
    """

    status: str
    result: Any
    feedback: tuple[Any, ...]

    @property
    def accepted(self) -> bool:
        """Return whether the server accepted the goal."""
        return self.status != "REJECTED"


class ExpectedFault:
    """Hold the exceptions that a test expected, once they were raised.

    Attributes:
        raised: Each record of an exception with the exception itself, in order.
    """

    def __init__(
        self, kinds: type[BaseException] | tuple[type[BaseException], ...], match: str
    ) -> None:
        self._kinds, self._match = kinds, match
        self.raised: list[tuple[Fault, BaseException]] = []

    def covers(self, error: BaseException) -> bool:
        """Return whether an exception is of the expected kind, with the expected words."""
        return isinstance(error, self._kinds) and bool(re.search(self._match, str(error)))

    @property
    def value(self) -> BaseException:
        """Return the first exception."""
        return self._first[1]

    @property
    def node(self) -> str:
        """Return the full name of the node that raised it, or the name of the program."""
        return self._first[0].node

    @property
    def callback(self) -> str:
        """Return the name of the callback that raised it; `main`, of a program."""
        return self._first[0].callback

    @property
    def time(self) -> float:
        """Return when it was raised, in seconds of the session."""
        return self._first[0].time

    @property
    def _first(self) -> tuple[Fault, BaseException]:
        if not self.raised:
            raise self.missing()
        return self.raised[0]

    def missing(self) -> NoFaultError:
        """Return the error for an exception that has not been raised."""
        kinds = self._kinds if isinstance(self._kinds, tuple) else (self._kinds,)
        names = " or ".join(kind.__name__ for kind in kinds)
        words = f" that matches {self._match!r}" if self._match else ""
        return NoFaultError(
            f"No callback raised {names}{words}.",
            "The block of `expect_fault` has ended, and the nodes it ran did not raise the "
            "exception.",
            "Run the session inside the block for as long as the nodes need, and look at "
            "`logs()` for what they did.",
        )


class _TestConsole(Console):
    """Hand log lines to Python's `logging`, and keep exceptions until the test gets them."""

    add_again = create_again = "run the test again."

    def __init__(self) -> None:
        super().__init__()
        self.expected: list[ExpectedFault] = []
        self.unchecked: list[SimulatedProgram] = []
        #: Exceptions that the test has not got yet; if a program ended with it, with the program.
        self.pending: list[tuple[BaseException, SimulatedProgram | None]] = []
        parent = logging.getLogger(LOGGER)
        if parent.level == logging.NOTSET:
            # ROS decides by a node's own level which lines there are; Python's root would leave
            # out those below WARNING.
            parent.setLevel(logging.DEBUG)

    def log(self, record: LogRecord) -> None:
        if self._quiet:
            return
        logger = logging.getLogger(f"{LOGGER}.{record.name}")
        level = _LEVELS.get(record.level) or logging.getLevelName(record.level)
        if logger.isEnabledFor(level):
            file = _file_of(record, sys._getframe(1))
            place = logger.name, level, file, record.line, record.text, (), None, record.function
            logger.handle(logger.makeRecord(*place, extra={"ros_time": record.time}))

    def end(self) -> None:
        self.begin()  # `quiet` is for one run

    def raised(self, fault: Fault, error: BaseException) -> None:
        if isinstance(error, SystemExit):
            code = error.code if isinstance(error.code, int) else int(error.code is not None)
            if code != 0:
                self.pending.append((_exit_code_error(fault.node, code), None))
        elif not self._expects(fault, error):
            self.pending.append((error, None))

    def program_ended(self, program: SimulatedProgram) -> None:
        code, failure = program.returncode or 0, program.failure
        # A negative code is that of a signal, and only a test sends signals.
        if code <= 0 or program in self.unchecked:
            return
        if failure is None:
            self.pending.append((_exit_code_error(program.name, code), program))
        elif not self._expects(*failure):
            self.pending.append((failure[1], program))

    def leave_unchecked(self, program: SimulatedProgram) -> None:
        """Let a program end as it does; it may have ended already."""
        self.unchecked.append(program)
        self.pending[:] = [entry for entry in self.pending if entry[1] is not program]

    def _expects(self, fault: Fault, error: BaseException) -> bool:
        for expected in reversed(self.expected):
            if expected.covers(error):
                expected.raised.append((fault, error))
                return True
        return False


class TestSession(Session):
    """Run the nodes under test in virtual time, and talk to them.

    ::

        def test_a_high_temperature_is_reported(virtual_ros):
            virtual_ros.add(TemperatureMonitor)
            virtual_ros.publish("temperature", 30.0, at=1.0)
            virtual_ros.run(2)
            assert "High" in virtual_ros.logs()[-1].text

    What a callback raises ends its node, as on a robot, and is raised in the test as well: by the
    call that runs the nodes, at that moment, or else at the end of the test. So is an exit code
    other than 0. Log lines of nodes go to Python's `logging`, as `ros.NAME`. Everything else is as
    in `rosbeat.ros.session.Session`, which `docs/testing.md` introduces.

    Args:
        seed: Seed of the random numbers that the nodes draw with Python's `random` or NumPy's
            global generator.
        threads: How many threads a `MultiThreadedExecutor()` has whose program gives no number;
            rclpy itself takes the machine's number of processors.
        domain_id: The ROS domain to join, to talk with real processes in live mode. By default a
            session is private.
        start_time: What clocks show when the session begins, in seconds since 1970.

    Raises:
        SessionError: If an option is not a whole number in its range, or the middleware is not
            Fast DDS.
    """

    #: Tells pytest that this is no class of tests.
    __test__ = False
    _console_class = _TestConsole
    _tester: Tester | None = None

    @called_as("TestSession(seed=7)")
    def __init__(
        self,
        *,
        seed: int = 0,
        threads: int = THREADS,
        domain_id: int | None = None,
        start_time: int = START,
    ) -> None:
        check_whole("threads", threads, 2, 1000, "TestSession(threads=4)")
        super().__init__(seed=seed, domain_id=domain_id, start_time=start_time)
        self._core.threads = threads
        _open_sessions.add(self)

    @property
    def _console(self) -> _TestConsole:
        console = self._core.console
        assert isinstance(console, _TestConsole)
        return console

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        __tracebackhide__ = True
        self.close()
        if not any(raised):
            self.raise_faults()

    # Exceptions of nodes.

    def raise_faults(self) -> None:
        """Raise the first exception of a node that the test has not got yet, if there is one.

        The calls that run nodes do so themselves, and the plugin does at the end of a test.
        """
        __tracebackhide__ = True
        if self._console.pending:
            error, _ = self._console.pending.pop(0)
            raise error.with_traceback(_without_machinery(error.__traceback__))

    @contextmanager
    def expect_fault(
        self,
        kind: type[BaseException] | tuple[type[BaseException], ...],
        *,
        match: str = "",
    ) -> Iterator[ExpectedFault]:
        """Expect that a callback, or a program, raises an exception in this block.

        Unlike `pytest.raises` it lets the session go on: the other nodes run as long as the block
        says, so that a test can look at what they do without the one that has crashed.

        Args:
            kind: The class of the exception, or several.
            match: A regular expression to be found in its text.

        Raises:
            NoFaultError: If the block ends and no callback has raised such an exception.
        """
        expected = ExpectedFault(kind, match)
        self._console.expected.append(expected)
        try:
            yield expected
        finally:
            self._console.expected.remove(expected)
        if not expected.raised:
            raise expected.missing()

    # Processes.

    def _start_process(
        self, given: tuple[Any, ...], start: Launch, threads: int
    ) -> tuple[Any, ...]:
        """Start a process for `add`; what a constructor raises is raised as it is."""
        __tracebackhide__ = True
        try:
            made = super()._start_process(given, start, threads)
        except NodeConstructionError as error:
            cause = error.__cause__
            if cause is None:
                raise
        else:
            self.raise_faults()
            return made
        raise cause.with_traceback(_without_machinery(cause.__traceback__))

    @called_as('ros.spawn("sensor.py")')
    def spawn(self, program: Any, *arguments: str, check: bool = True) -> SimulatedProgram:  # noqa: ANN401 - unchecked input
        """Start a program, as `Session.spawn` does.

        Args:
            program: The file, or a function such as `main`.
            arguments: Its arguments, such as `"--ros-args", "-r", "temperature:=humidity"`.
            check: Whether the test fails if the program ends with an exit code other than 0, or
                with an exception. Without, the test looks at `returncode` and `stderr` itself. A
                program that a signal of the test has ended never fails it.

        Raises:
            ExitCodeError: If the program has ended already, with another exit code than 0.
        """
        __tracebackhide__ = True
        started = super().spawn(program, *arguments)
        if not check:
            self._console.leave_unchecked(started)
        self.raise_faults()
        return started

    @called_as('ros.launch("greenhouse.launch.py")')
    def launch(
        self,
        source: Any,  # noqa: ANN401 - unchecked input
        arguments: Mapping[str, Any] | None = None,
        *,
        check: bool = True,
    ) -> SimulatedLaunch:
        """Launch the nodes of a launch file, as `Session.launch` does.

        Args:
            source: The launch file in Python, XML or YAML, or a `LaunchDescription`.
            arguments: The values of its arguments: `{"rate": 2.0}`.
            check: Whether the test fails if one of its nodes, or the launch itself, ends with an
                exit code other than 0, or with an exception.

        Raises:
            SessionError: If it cannot be launched.
            ExitCodeError: If a node has ended already, with another exit code than 0.
        """
        __tracebackhide__ = True
        leave = self._console.leave_unchecked
        try:
            started = self._launch(source, arguments or {}, (lambda _: None) if check else leave)
        except SessionError:
            self._console.pending.clear()  # it says what the exit code would say
            raise
        if not check:
            leave(started)
        self.raise_faults()
        return started

    # Time.

    @called_as("ros.run(seconds=60)")
    def run(self, seconds: float, *, quiet: bool = False) -> None:
        """Advance virtual time and run every callback that is due.

        Timers due exactly at the end run too: a 1 Hz timer fires 60 times in the first 60 seconds.
        When a callback raises, the run ends at that moment and raises the exception; a further
        `run` goes on with the other nodes.

        Args:
            seconds: Virtual seconds, 0 or more.
            quiet: Keep log lines out of Python's `logging`; `logs()` has them all the same.

        Raises:
            DurationError: If `seconds` is not a number from 0 up.
        """
        __tracebackhide__ = True
        self.raise_faults()
        super().run(seconds, quiet=quiet)
        self.raise_faults()

    @called_as("ros.run_until(lambda: monitor.alarms, within=10)")
    def run_until(self, predicate: Callable[[], _Value], *, within: float = 10.0) -> _Value:
        """Run the nodes until something is true, and return it.

        Args:
            predicate: What to look at; it is called at the beginning, and whenever no message is on
                its way.
            within: Virtual seconds after which to give up.

        Raises:
            TimeUpError: If it is still false then.
            DurationError: If `within` is not a number from 0 up.
        """
        __tracebackhide__ = True
        values: list[_Value] = []

        def is_true() -> bool:
            values[:] = [predicate()]
            return bool(values[0])

        begun = self.time
        self._run_until("run_until", is_true, within)
        if not values[0]:
            raise TimeUpError(
                f"{_source_of(predicate)} is still {values[0]!r} after {within:g} s.",
                f"The nodes ran from {begun:g} s to {self.time:g} s, and it was looked at whenever "
                "no message was on its way.",
                "Look at `logs()` and `messages(...)` for what the nodes did, or give them more "
                "time with `within`.",
            )
        return values[0]

    def _run_until(self, call: str, done: Callable[[], bool], within: float) -> None:
        """Run until something is true, at most so long; raise what a node raises meanwhile."""
        __tracebackhide__ = True
        span = duration_ns(within, f"{call}(within=...)")
        self.raise_faults()
        with self._running(call):
            if not done():
                end = self._core.now() + span
                self._run_nodes(end, lambda: done() or bool(self._console.pending))
        self.raise_faults()

    @called_as("ros.wait(seconds=5)")
    def wait(
        self, seconds: float | None = None, *, until: Callable[[], object] | None = None
    ) -> bool:
        """Let a live session run, until a time, a condition, or an exception of a node.

        Args:
            seconds: Wall-clock seconds at most; None waits until Interrupt.
            until: Stop waiting as soon as this returns something true.

        Returns:
            Whether `until` came true; False if the time was up first.
        """
        __tracebackhide__ = True
        pending = self._console.pending
        done = super().wait(seconds, until=lambda: pending or (until is not None and until()))
        self.raise_faults()
        return done

    # Messages.

    @called_as('ros.publish("temperature", 30.0, at=1.0)')
    def publish(self, topic: str, value: Any, *, at: float | None = None) -> None:  # noqa: ANN401 - of any type
        """Publish a message, now or at a later time of the session.

        It comes from a node `/tester`. Its QoS profile is that of the first subscription to the
        topic, so that it is compatible; without a subscription it is ROS's default, with depth 10.

        Args:
            topic: The topic's name; `temperature` and `/temperature` are the same.
            value: A message of any type. If a node subscribes to the topic already, also the value
                of the field `data`, or a dict with the values of fields: the type is then the
                subscription's.
            at: Seconds of virtual time since the start of the session, not before `ros.time`. Now,
                if it is left out; `ros.run` delivers the message in both cases.

        Raises:
            SessionError: If the type is not known, a field does not fit, or `at` has passed.
            DurationError: If `at` is not a number from 0 up.
        """
        name = _full_name("publish", topic)
        heard = self.graph().on(name, "subscription")
        if not hasattr(type(value), "get_fields_and_field_types"):
            value = _message(name, value, heard)
        wait = None if at is None else duration_ns(at, "publish(at=...)") / 1e9 - self.time
        if wait is not None and wait < 0:
            raise SessionError(
                f"`at={at}` has passed: it is {self.time:g} s.",
                "`at` counts from the start of the session, and time only goes forward.",
                "Publish before `ros.run`, or leave `at` out to publish now.",
            )
        self._own_tester().publish(name, value, profile(heard[0].qos if heard else 10), wait)

    @called_as('ros.messages("temperature")')
    def messages(self, topic: str) -> tuple[Sample, ...]:
        """Return what was published on a topic, in order; nothing, if a topic was silent.

        Args:
            topic: The topic's name; `temperature` and `/temperature` are the same.

        Raises:
            UnknownTopicError: If no node publishes on the topic or subscribes to it: a name that is
                misspelled would look like silence.
        """
        try:
            return super().messages(topic)
        except UnknownTopicError:
            name = _full_name("messages", topic)
            ends = self.graph().on(name, "subscription")
            if not ends or name in INFRASTRUCTURE_TOPICS or any(end.matched for end in ends):
                raise
            return ()

    # Services, actions and parameters.

    @called_as('ros.call("add_two_ints", {"a": 1, "b": 2})')
    def call(self, service: str, request: Any = None, *, within: float = 10.0) -> Any:  # noqa: ANN401 - of any service
        """Call a service, run the nodes until it has answered, and return the response.

        Args:
            service: The service's name; `reset` and `/reset` are the same.
            request: The request: a message, or a dict with the values of fields. Without it, an
                empty one.
            within: Virtual seconds that the service may take, also until it is there.

        Raises:
            UnknownServerError: If no node offers the service.
            TimeUpError: If it has not answered in time.
            SessionError: If a field does not fit.
        """
        __tracebackhide__ = True
        name, begun, tester = _full_name("call", service), self.time, self._own_tester()
        kind = self._type_of("call", "service", name, tester.offered_services, within)
        future = self._asking(name, kind, lambda: tester.ask(name, kind, request or {}))
        left = max(0.0, begun + within - self.time)
        self._run_until("call", future.done, left)
        if not future.done():
            raise TimeUpError(
                f"{name} has not answered within {within:g} s.",
                "A node offers the service, but its callback has not returned, or the node's "
                "executor is busy with another one.",
                "Look at `logs()` for what that node does, or give it more time with `within`.",
            )
        return future.result()

    @called_as('ros.send_goal("fibonacci", {"order": 5})')
    def send_goal(
        self,
        action: str,
        goal: Any = None,  # noqa: ANN401 - of any action
        *,
        cancel_after: float | None = None,
        within: float = 60.0,
    ) -> GoalResult:
        """Send a goal, run the nodes until it has ended, and return its result.

        Args:
            action: The action's name; `fibonacci` and `/fibonacci` are the same.
            goal: The goal: a message, or a dict with the values of fields. Without it, an empty
                one.
            cancel_after: Cancel the goal so many virtual seconds after it was accepted.
            within: Virtual seconds that the goal may take, also until the server is there.

        Raises:
            UnknownServerError: If no node offers the action.
            TimeUpError: If the goal has not ended in time.
            SessionError: If a field does not fit.
            DurationError: If `cancel_after` is not a number from 0 up.
        """
        __tracebackhide__ = True
        if cancel_after is not None:
            duration_ns(cancel_after, "send_goal(cancel_after=...)")
        name, begun, tester = _full_name("send_goal", action), self.time, self._own_tester()
        kind = self._type_of("send_goal", "action", name, tester.offered_actions, within)
        sent = self._asking(name, kind, lambda: tester.send(name, kind, goal or {}, cancel_after))
        left = max(0.0, begun + within - self.time)
        self._run_until("send_goal", lambda: bool(sent.status), left)
        if not sent.status:
            stage = "was accepted, but has not ended" if sent.accepted else "was not answered"
            raise TimeUpError(
                f"The goal of {name} {stage} within {within:g} s.",
                f"{len(sent.feedback)} feedback messages have come meanwhile.",
                "Look at `logs()` for what the node of the server does, or give it more time with "
                "`within`.",
            )
        return GoalResult(sent.status, sent.result, tuple(sent.feedback))

    @called_as('ros.set_parameters("sensor", {"rate": 2.0})')
    def set_parameters(
        self,
        node: Any,  # noqa: ANN401 - a node of rclpy, or a string
        values: Mapping[str, Any],
        *,
        within: float = 10.0,
    ) -> None:
        """Set parameters of a node by its service, as `ros2 param set` does: all of them or none.

        Args:
            node: The node, or its name.
            values: The new values, by name.
            within: Virtual seconds that the node may take.

        Raises:
            ParameterError: If the node refuses; the text says for which reason.
            UnknownServerError: If the node has no services for parameters.
            TimeUpError: If the node has not answered in time.
            SessionError: If `node` is neither a name nor a node of this session.
        """
        __tracebackhide__ = True
        name = self._core.nodes.name_of(node) if not isinstance(node, str) else node
        name = _full_name("set_parameters", name)
        request = parameters_request(values)
        response = self.call(f"{name}/set_parameters_atomically", request, within=within)
        if not response.result.successful:
            raise ParameterError(
                f"{name} refused {', '.join(values)}: {response.result.reason or 'no reason'}.",
                "No parameter was changed: they are set together, or not at all.",
                "Declare the parameter in the node, or give a value that the node accepts.",
            )

    # How it works.

    def _run_nodes(self, end_ns: int, done: Callable[[], object] | None = None) -> None:
        pending = self._console.pending
        super()._run_nodes(end_ns, done or (lambda: pending))

    def _own_tester(self) -> Tester:
        if self._tester is None:
            self._tester = super().add(Tester)
        return self._tester

    def _type_of(
        self, call: str, what: str, name: str, offered: Callable[[], dict[str, str]], within: float
    ) -> str:
        """Return the type of a service or an action, for which it waits."""
        __tracebackhide__ = True
        self._run_until(call, lambda: name in offered(), within)
        known = offered()
        if name not in known:
            names = [other for other in sorted(known) if not other.startswith("/tester/")]
            raise UnknownServerError(
                f"No node offers the {what} {name}.",
                f"{within:g} s of virtual time have passed without it. Offered are: "
                f"{', '.join(_without_parameters(names)) or 'none'}.",
                nearest(name, names, "Add the node that offers it first, with `add(...)`."),
            )
        return known[name]

    def _asking(self, name: str, kind: str, ask: Callable[[], _Value]) -> _Value:
        """Send a request; refuse one that does not fit.

        Raises:
            SessionError: If a field does not fit.
        """
        self._check_call("call")
        try:
            with self._core.running():
                return ask()
        except (AssertionError, AttributeError, TypeError) as error:
            raise SessionError(
                f"The request does not fit into {kind}, the type of {name}.",
                f"A dict holds fields. {error}",
                f"See its fields with `ros2 interface show {kind}`.",
            ) from None


def open_sessions() -> list[TestSession]:
    """Return the sessions of tests that have not ended, for the plugin of pytest."""
    return [session for session in _open_sessions if not session.has_ended]


def _full_name(call: str, name: object) -> str:
    return "/" + check_name(call, name).lstrip("/")


def _without_parameters(services: list[str]) -> list[str]:
    """Leave out the seven services that every node has."""
    common = ("parameters", "parameters_atomically", "parameter_types", "type_description")
    return [name for name in services if not name.endswith(common)]


def _message(topic: str, value: object, heard: tuple[Endpoint, ...]) -> Any:  # noqa: ANN401 - a message
    """Return a message of the type of the first subscription.

    Raises:
        SessionError: If there is no subscription, or its type has no such fields.
    """
    if not heard:
        raise SessionError(
            f"No node subscribes to {topic}, so {value!r} has no message type.",
            "The type of a plain value is that of the subscription to the topic.",
            "Add the node first, or publish a message: "
            f'`ros.publish("{topic}", Float32(data=30.0))`.',
        )
    type_name = heard[0].type_name
    try:
        return message(type_name, value)
    except (AssertionError, AttributeError, TypeError) as error:
        raise SessionError(
            f"{value!r} does not fit into {type_name}, the type of {topic}.",
            f"A plain value is the field `data`, and a dict holds fields. {error}",
            f"See its fields with `ros2 interface show {type_name}`.",
        ) from None


def _exit_code_error(name: str, code: int) -> ExitCodeError:
    return ExitCodeError(
        f"{name} ended with exit code {code}.",
        "An exit code other than 0 says that a program has failed, so the test fails, too.",
        "If the test expects it, write `with pytest.raises(ExitCodeError)` around the call. For a "
        "program there is also `spawn(..., check=False)`, and then its `returncode`.",
    )


def _without_machinery(trace: TracebackType | None) -> TracebackType | None:
    """Return a traceback that begins in code of the nodes, not in what has called it."""
    inner = trace
    while inner is not None:
        file = inner.tb_frame.f_code.co_filename
        if not any(folder in file for folder in _MACHINERY):
            return inner
        inner = inner.tb_next
    return trace


def _file_of(record: LogRecord, frame: FrameType | None) -> str:
    """Return the file of the line that is logging; an unknown one has no name."""
    while frame is not None:
        if (frame.f_code.co_name, frame.f_lineno) == (record.function, record.line):
            return frame.f_code.co_filename
        frame = frame.f_back
    return "?"


def _source_of(predicate: Callable[[], object]) -> str:
    """Return how a predicate is called: its name, or the line of source that a lambda is in."""
    code = getattr(predicate, "__code__", None)
    name = getattr(predicate, "__name__", repr(predicate))
    if code is None or name != "<lambda>":
        return f"`{name}`"
    line = linecache.getline(code.co_filename, code.co_firstlineno).strip()
    return f"The condition in line {code.co_firstlineno}, `{line}`," if line else "The condition"

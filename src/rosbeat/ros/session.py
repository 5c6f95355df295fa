"""Run real ROS nodes in virtual time or live: the session."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, cast, overload
from weakref import finalize

from rclpy.node import Node

from rosbeat.domains import LAST_DOMAIN
from rosbeat.errors import SessionError, called_as
from rosbeat.records import GraphSnapshot, LogRecord, Observation, Sample
from rosbeat.ros.clock import LATEST_START, START
from rosbeat.ros.context import show_briefly
from rosbeat.ros.errors import (
    Console,
    check_middleware,
    check_name,
    check_whole,
    duration_ns,
    foreign_node,
    node_name,
    session_has_ended,
    session_is_live,
    session_is_not_live,
    unknown_topic,
)
from rosbeat.ros.graph import poll, wait_for_nodes
from rosbeat.ros.launch import Launch, Maker, Start, build_in, checked
from rosbeat.ros.launching import SimulatedLaunch, check_launch
from rosbeat.ros.processes import Process
from rosbeat.ros.session_core import SessionCore
from rosbeat.ros.simulated_program import SimulatedProgram

if TYPE_CHECKING:
    from typing_extensions import Self, Unpack


SomeNode = TypeVar("SomeNode", bound=Node)


class Session:
    """Run ROS nodes in virtual time or live, and record what they do.

    `rosbeat.testing` has the session of a test, and `rosbeat.page_session` that of a page, which
    also explains the arguments.
    """

    #: What prints and explains; a subclass has one of its own.
    _console_class: ClassVar[type[Console]] = Console

    @called_as("Session(seed=7)")
    def __init__(
        self, *, seed: int = 0, domain_id: int | None = None, start_time: int = START
    ) -> None:
        check_whole("seed", seed, 0, 2**63)
        check_whole("start_time", start_time, 0, LATEST_START)
        check_middleware()
        if domain_id is not None:
            check_whole("domain_id", domain_id, 0, LAST_DOMAIN)
        self._seed = seed
        self._core = SessionCore(
            seed, domain_id, console=self._console_class(), start_time=start_time
        )
        # Also runs at interpreter exit, before the middleware is torn down.
        self._finalizer = finalize(self, self._core.close)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._core.closed:
            return "Session(closed)"
        names = ", ".join(state.name for state in self._core.nodes.states()) or "no nodes"
        mode = "live" if self.is_live else "virtual time"
        return f"Session({mode}, {self.time:g} s, {names})"

    # State.

    @property
    def time(self) -> float:
        """Return the seconds since the session began; live time counts as it passes."""
        return self._core.now() / 1e9

    @property
    def domain_id(self) -> int | None:
        """Return the ROS domain that the session has joined; None if it is private."""
        return self._core.domain_id

    @property
    def is_live(self) -> bool:
        """Return whether the nodes run against the wall clock now."""
        return self._core.live is not None

    @property
    def has_ended(self) -> bool:
        """Return whether the session is closed."""
        return self._core.closed

    @property
    def nodes(self) -> tuple[Node, ...]:
        """Return the nodes of this session, in order of creation."""
        return tuple(state.node for state in self._core.nodes.states())

    # Nodes.

    @overload  # a class is a function that makes one, too
    def add(self, node: Callable[[], SomeNode], /, **start: Unpack[Start]) -> SomeNode: ...
    @overload
    def add(self, node: SomeNode, /) -> SomeNode: ...
    @overload
    def add(self, *nodes: object, threads: int = 1) -> tuple[Node, ...]: ...
    @called_as("ros.add(TemperatureSensor)")
    def add(
        self,
        *nodes: Any,
        name: str | None = None,
        namespace: str | None = None,
        remappings: Mapping[str, str] | None = None,
        parameters: Mapping[str, Any] | None = None,
        threads: int = 1,
    ) -> Any:
        """Start a process, and run the callbacks of its nodes from now on.

        One node is a process of its own, as `ros2 run` starts it. Several nodes share one process
        and its executor: while a callback of one of them runs, or sleeps, the others wait.

        On a page, a node of the same name that runs in this session is replaced; in a test both
        run. `name` and the arguments after it do what `ros2 run` does behind `--ros-args`, with
        `-r` and `-p`; the class stays as it is.

        Args:
            nodes: Node classes, functions that return a node, or nodes made in this session.
            name: The node's name, in the place of its own.
            namespace: A namespace before its name and its relative topics, such as `greenhouse`.
            remappings: New names of topics and services: `{"temperature": "humidity"}`.
            parameters: Values of parameters that the node declares: `{"high": 60.0}`.
            threads: 1 for a `SingleThreadedExecutor`. With more, a `MultiThreadedExecutor` runs so
                many callbacks at a time, as far as their callback groups allow.

        Returns:
            The node; of several nodes, a tuple.

        Raises:
            NodeClassError: If one is none of these, or belongs to another context.
            NodeConstructionError: If a constructor raises.
            SessionError: If it cannot be started so, or exists already and is to be renamed.
            ClosedSessionError: If the session has ended.
        """
        __tracebackhide__ = True  # pytest shows the frames of the node, and none of ours
        start = checked(name, namespace, remappings, parameters)
        check_whole("threads", threads, 1, 1000, "ros.add(TemperatureSensor, threads=4)")
        if not nodes:
            raise SessionError(
                "`ros.add()` was called without a node.",
                "`ros.add` starts a process, and a process without a node does nothing.",
                "Pass a class, without parentheses: `ros.add(TemperatureSensor)`.",
            )
        if name is not None and len(nodes) > 1:
            raise SessionError(
                f"One call cannot give the name {name!r} to several nodes.",
                "`name` renames every node that is started, as `__node` does on a command line.",
                "Add the nodes without `name`, or each one in its own call.",
            )
        with self._running("add", [node for node in nodes if not isinstance(node, Node)]):
            made = self._start_process(nodes, start, threads)
        return made if len(made) > 1 else made[0]

    def _start_process(
        self, given: tuple[Any, ...], start: Launch, threads: int
    ) -> tuple[Node, ...]:
        ready = [node for node in given if isinstance(node, Node)]
        if start and ready:
            raise SessionError(
                f"The node {node_name(ready[0])} already exists, so it cannot be started with "
                "other options.",
                "A node's name, topics and parameters are set while the node is created.",
                "Pass the class, without parentheses, so that the session creates the node.",
            )
        process = Process(threads)
        made = build_in(self._core, given, start, process)
        states = [self._core.nodes.member(node) for node in made]
        for state in states:
            process.adopt(state)
        for state in states:
            self._core.lives.spin_node(state)
        for maker, node in zip(given, made, strict=True):
            if node is not maker:
                self._core.makers[node] = Maker(maker, start)
        return made

    @called_as('ros.spawn("sensor.py")')
    def spawn(self, program: Any, *arguments: str) -> SimulatedProgram:  # noqa: ANN401 - unchecked input
        """Start a program: a Python file or a function, run unchanged in virtual time.

        It is a process of its own, as one that `ros2 run` starts, with its own default context and
        command line. It goes on whenever the session runs.

        Args:
            program: The file, or a function such as `main`.
            arguments: Its arguments, such as `"--ros-args", "-r", "temperature:=humidity"`.

        Returns:
            The program. `program.send_signal(signal.SIGINT)` presses Ctrl+C, and
            `program.returncode` and `program.stderr` say how it ended.

        Raises:
            SessionError: If it is no program, or the session is live.
            ClosedSessionError: If the session has ended.
        """
        for word in arguments:
            check_name("spawn", word)
        with self._running("spawn", [program]):
            if self.is_live:
                raise session_is_live("spawn")
            made = SimulatedProgram(self._core, program, arguments)
            made.start()
        return made

    @called_as('ros.launch("greenhouse.launch.py")')
    def launch(
        self,
        source: Any,  # noqa: ANN401 - unchecked input
        arguments: Mapping[str, Any] | None = None,
    ) -> SimulatedLaunch:
        """Launch the nodes of a launch file in virtual time, as `ros2 launch` does.

        Each node is a program that goes on whenever the session runs, with the parameters,
        remappings and namespace of the launch file. Timers and event handlers of the launch file
        count in virtual time.

        Args:
            source: The launch file in Python, XML or YAML, or a `LaunchDescription`.
            arguments: The values of its arguments: `{"rate": 2.0}`.

        Returns:
            The launch, which is a program as those of `spawn`: `send_signal(signal.SIGINT)` ends
            it with all its nodes. Its `programs` has those of the nodes.

        Raises:
            SessionError: If it cannot be launched, or the session is live.
            ClosedSessionError: If the session has ended.
        """
        return self._launch(source, arguments or {}, lambda _: None)

    def _launch(
        self,
        source: object,
        arguments: Mapping[str, object],
        on_start: Callable[[SimulatedProgram], None],
    ) -> SimulatedLaunch:
        with self._running("launch"):
            if self.is_live:
                raise session_is_live("launch")
            check_launch()
            made = SimulatedLaunch(self._core, source, arguments, on_start)
            made.start()
        return made

    @called_as('ros.remove("sensor")')
    def remove(self, node: Node | str) -> None:
        """Destroy a node, given itself or by name.

        Raises:
            SessionError: If the session has no such node.
        """
        self._check_open()
        self._core.lives.destroy(self._core.nodes.find(node))

    @called_as('ros.pause("sensor")')
    def pause(self, node: Node | str) -> None:
        """Run no callbacks of a node, given itself or by name, as if it were busy.

        Messages go on arriving and wait in its queues, as many as each queue holds.

        Raises:
            SessionError: If the session has no such node.
        """
        self._check_open()
        self._core.lives.pause(node)

    @called_as('ros.resume("sensor")')
    def resume(self, node: Node | str) -> None:
        """Run the callbacks of a paused node, given itself or by name, again.

        It first gets what waits in its queues.

        Raises:
            SessionError: If the session has no such node, or it ended with an exception.
        """
        self._check_open()
        self._core.lives.resume(node)

    # Time.

    @called_as("ros.run(seconds=60)")
    def run(self, seconds: float, *, quiet: bool = False) -> None:
        """Advance virtual time and run every callback that is due.

        Timers due exactly at the end run too: a 1 Hz timer fires 60 times in the first 60 seconds.
        A callback that still sleeps or waits at the end goes on in the next run.

        Args:
            seconds: Virtual seconds, 0 or more.
            quiet: Print no log lines; `logs()` has them all the same.

        Raises:
            DurationError: If `seconds` is not a number from 0 up.
            EndlessChainError: If callbacks cause one another for ever while no time passes.
            SessionError: If the session is live, or `run` is called from a callback.
        """
        span = duration_ns(seconds)
        with self._running("run"):
            if self.is_live:
                raise session_is_live()
            self._core.console.begin(quiet)
            try:
                self._run_nodes(self._core.now() + span)
            except KeyboardInterrupt as interrupt:
                ended = self._core.reports.break_endless_off(interrupt)
                usual = f"stopped at {self.time:g} s; the session is still open."
                show_briefly(interrupt, ended or usual)
                raise
            finally:
                self._core.console.end()

    @called_as("ros.start()")
    def start(self) -> None:
        """Go live: run the nodes against the wall clock, in a background thread.

        In a domain that was joined with `domain_id`, other processes see the nodes and can talk to
        them; nobody sees those of a private session. A session that is live already stays so. Each
        timer begins a new period; the parameter `use_sim_time` reads False while the session is
        live.

        Raises:
            SessionError: If `start` is called from a callback.
        """
        self._check_call("start")
        if not self.is_live:
            self._core.go_live()

    @called_as("ros.wait(seconds=5)")
    def wait(
        self, seconds: float | None = None, *, until: Callable[[], object] | None = None
    ) -> bool:
        """Let a live session run, and print what its nodes log meanwhile.

        Args:
            seconds: Wall-clock seconds at most; None waits until Interrupt.
            until: Stop waiting as soon as this returns something true.

        Returns:
            Whether `until` came true; False if the time was up first.

        Raises:
            DurationError: If `seconds` is not a number from 0 up.
            SessionError: If the session is not live, or `wait` is called from a callback.
        """
        self._check_call("wait")
        if not self.is_live:
            raise session_is_not_live()
        deadline = None
        if seconds is not None:
            deadline = time.monotonic() + duration_ns(seconds, "wait(seconds=...)") / 1e9

        def is_done() -> object:
            self._core.reports.show_news()
            return until is not None and until()

        self._core.console.begin()
        try:
            return poll(is_done, deadline)
        except KeyboardInterrupt as interrupt:
            show_briefly(interrupt, "you stopped waiting; the session is still live.")
            self._core.interrupt()
            raise
        finally:
            self._core.reports.show_news()
            self._core.console.end()

    @called_as('ros.wait_for_nodes("sensor")')
    def wait_for_nodes(self, *names: str, timeout: float = 10.0) -> None:
        """Wait until nodes are in the graph, those of other processes too, as a terminal's.

        Processes need up to some seconds to find each other. The session need not be live.

        Args:
            names: Names of the nodes; `sensor` and `/sensor` are the same.
            timeout: Wall-clock seconds at most.

        Raises:
            DurationError: If `timeout` is not a number from 0 up.
            SessionError: If they do not come, the session has no `domain_id`, a name is not a text,
                or `wait_for_nodes` is called from a callback.
        """
        self._check_call("wait_for_nodes")
        wanted = ["/" + check_name("wait_for_nodes", name).lstrip("/") for name in names]
        seconds = duration_ns(timeout, "wait_for_nodes(timeout=...)") / 1e9
        wait_for_nodes(self._core, wanted, seconds)

    @called_as("ros.stop()")
    def stop(self) -> None:
        """End live mode; virtual time goes on from here. Does nothing if the session is not live.

        Each timer begins a new period. A callback that has not returned after two seconds is broken
        off.

        Raises:
            SessionError: If `stop` is called from a callback.
        """
        self._check_call("stop")
        self._core.go_virtual()
        self._core.reports.show_news()

    @called_as("ros.close()")
    def close(self) -> None:
        """End the session: destroy its nodes and its ROS context. A second call does nothing."""
        self._finalizer()

    # What happened.

    @called_as('ros.messages("temperature")')
    def messages(self, topic: str) -> tuple[Sample, ...]:
        """Return what was published on a topic, in order.

        In a domain that was joined with `domain_id`, what other processes publish is included from
        the moment at which a node of this session subscribes.

        Args:
            topic: The topic's name; `temperature` and `/temperature` are the same.

        Raises:
            UnknownTopicError: If the topic never had a publisher in this session.
            SessionError: If `topic` is not a name.
        """
        self._core.reports.show_faults()
        name = "/" + check_name("messages", topic).lstrip("/")
        outside = self._core.external_messages
        known = self._core.recorder.topics().union(outside.topics() if outside else ())
        if name not in known:
            raise unknown_topic(name, known, self._core.graph())
        return tuple(self._core.recorder.samples(name))

    @called_as('ros.logs("sensor")')
    def logs(self, node: Node | str | None = None) -> tuple[LogRecord, ...]:
        """Return the log lines in order: of nodes, of modules' loggers, and of rclpy itself.

        Args:
            node: Only the lines of this node, given itself or by name, or of the logger of a name.

        Raises:
            SessionError: If `node` is neither a name nor a node that is or was in this session.
        """
        self._core.reports.show_faults()
        records = tuple(self._core.recorder.logs)
        if node is None:
            return records
        name = (
            self._core.nodes.name_of(node) if isinstance(node, Node) else check_name("logs", node)
        )
        if name is None:
            raise foreign_node(cast(Node, node))
        wanted = name.strip("/").replace("/", ".")
        return tuple(record for record in records if record.name == wanted)

    @called_as("ros.graph()")
    def graph(self) -> GraphSnapshot:
        """Return the nodes, topics, services and timers as they are now, or were at the end.

        In a domain that was joined with `domain_id`, the nodes of other processes are included as
        far as they are known yet; see `wait_for_nodes`.
        """
        self._core.reports.show_faults()
        return self._core.graph()

    @called_as("ros.observation()")
    def observation(self) -> Observation:
        """Return everything that was recorded so far, as plain data.

        Of a session that has ended it holds the graph as it was just before the end.
        """
        self._core.reports.show_faults()
        recorder = self._core.recorder
        return Observation(
            self._core.now(),
            self._seed,
            tuple(recorder.samples()),
            tuple(recorder.logs),
            tuple(recorder.callbacks()),
            tuple(recorder.faults),
            self._core.graph(),
            waits=self._core.virtual.all_waits(),
        )

    # How it works.

    def _run_nodes(self, end_ns: int, done: Callable[[], object] | None = None) -> None:
        """Run until a time, in nanoseconds, or until something is true."""
        self._core.virtual.run_until(end_ns, done)

    @contextmanager
    def _running(self, what: str, code: Iterable[object] = ()) -> Iterator[None]:
        """Let nodes of this session run in this thread, and classes that make some."""
        self._check_call(what)
        with self._core.running(code):
            yield

    def _check_call(self, what: str) -> None:
        """Refuse a call that runs nodes, in a callback and after the end of the session."""
        self._check_open()
        self._core.refuse_in_callback(f"ros.{what}")

    def _check_open(self) -> None:
        if self._core.closed:
            raise session_has_ended()
        self._core.reports.show_faults()

"""Run programs in operating-system processes, and a node of this process beside them."""

from __future__ import annotations

import itertools
import os
import re
import signal
import subprocess
import sys
import threading
import time
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat import environment
from rosbeat.domains import lease_domain
from rosbeat.records import Endpoint, LogRecord, ProgramRun
from rosbeat.ros.graph import poll
from rosbeat.ros.session import Session

#: Characters of output that are kept; the rest is read and dropped, so that no program blocks.
MOST_OUTPUT = 200_000
#: Seconds that a program may take to end after Ctrl+C.
GRACE = 5.0
#: A line as the environment below has ROS print it.
_LOG = re.compile(r"^\[(?P<level>[A-Z]+)\] \[(?P<name>[\w./]+)\]: (?P<text>.*)\n", re.MULTILINE)
# What a kernel and its tests set for themselves, and what would change what programs print.
_DROPPED = (
    *("PYTEST_CURRENT_TEST", "JPY_PARENT_PID", "JPY_SESSION_NAME", "MPLBACKEND", "COLCON_HOME"),
    *("PYTHONDONTWRITEBYTECODE", "PYTHONSTARTUP", "PYTHONINSPECT", "FORCE_COLOR", "PYTHONPATH"),
)


def program_environment(home: Path, domain_id: int) -> dict[str, str]:
    """Return the course's environment for a program with its own home folder and ROS domain."""
    found = {name: value for name, value in os.environ.items() if name not in _DROPPED}
    environment.apply(found)
    own = str(Path(sys.prefix) / "bin")
    return {
        **found,
        "PATH": os.pathsep.join([own, found.get("PATH", os.defpath)]),
        "HOME": str(home),
        "ROS_LOG_DIR": str(home / "log"),
        "ROS_DOMAIN_ID": str(domain_id),
        "PYTHONUNBUFFERED": "1",
        "RCUTILS_COLORIZED_OUTPUT": "0",
        "NO_COLOR": "1",
        "RCUTILS_CONSOLE_OUTPUT_FORMAT": "[{severity}] [{name}]: {message}",
    }


@contextmanager
def private_domain() -> Iterator[int]:
    """Hold a ROS domain id that nobody else has.

    Raises:
        DomainsExhaustedError: If all of them are in use on this machine.
    """
    lease = lease_domain()
    try:
        yield lease.domain_id
    finally:
        lease.release()


class Program:
    """Run a program in a `with` block, and kill its process group at the end.

    Its `name` in the record is by default the last word of the command.

    Raises:
        OSError: If the program cannot be started.
    """

    def __init__(
        self, command: Sequence[str], env: Mapping[str, str], cwd: Path, name: str = ""
    ) -> None:
        self._name = name or Path(command[-1]).name
        self._kept: list[str] = []
        self._times_ns: list[int] = []
        self._length = 0
        # In a session of its own, so that Ctrl+C in our terminal does not reach it, and its whole
        # process group can be killed.
        self._process = subprocess.Popen(
            list(command), env=dict(env), cwd=cwd, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
        )  # fmt: skip
        self._reader = threading.Thread(target=self._read, name="rosbeat program", daemon=True)
        self._reader.start()

    def __enter__(self) -> Program:
        return self

    def __exit__(self, *_: object) -> None:
        self._kill()

    @property
    def output(self) -> str:
        """Return what it has printed so far, both streams in one."""
        return "".join(self._kept)

    def logs(self, begin: int = 0) -> tuple[LogRecord, ...]:
        """Return the lines that its nodes have logged, each with the time at which it was read.

        Args:
            begin: Where in the output to begin, in characters.
        """
        kept = list(self._kept)  # the reader may add to it meanwhile
        ends = list(itertools.accumulate(map(len, kept)))
        found = _LOG.finditer("".join(kept), begin)
        read = ((one, self._times_ns[bisect_right(ends, one.end() - 1)]) for one in found)
        return tuple(
            LogRecord(time_ns, one["level"], one["name"], one["text"], "", 0)
            for one, time_ns in read
        )

    @property
    def running(self) -> bool:
        """Return whether it has not ended yet."""
        return self._process.poll() is None

    def wait(self, until: Callable[[str], object], seconds: float) -> bool:
        """Wait until `until(output)` is true, or the program or the time has ended; return it."""
        poll(lambda: until(self.output) or not self.running, time.monotonic() + seconds)
        if not until(self.output) and not self.running:
            self._reader.join(GRACE)
        return bool(until(self.output))

    def finish(self, grace: float = GRACE) -> ProgramRun:
        """Press Ctrl+C, kill the program after `grace` seconds, and return what it did."""
        early = not self.running
        if not early:
            self._send(signal.SIGINT)
        code: int | None = None
        with suppress(subprocess.TimeoutExpired):
            code = self._process.wait(grace)
        self._kill()
        return ProgramRun(self._name, self.output, code, early)

    def _kill(self) -> None:
        # The program's children may outlive it.
        self._send(signal.SIGKILL)
        self._process.wait()
        self._reader.join(GRACE)

    def _send(self, number: int) -> None:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, number)

    def _read(self) -> None:
        stream = self._process.stdout
        assert stream is not None
        with stream:
            while data := os.read(stream.fileno(), 65536):
                if self._length < MOST_OUTPUT:
                    # Before the text, which another thread may look at as soon as it is there.
                    self._times_ns.append(time.time_ns())
                    self._kept.append(data.decode("utf-8", "replace"))
                    self._length += len(data)


@contextmanager
def domain_probe(domain_id: int, topic: str) -> Iterator[DomainProbe]:
    """Join a ROS domain with a node that publishes and receives numbers on a topic."""
    with Session(domain_id=domain_id) as session:
        yield DomainProbe(session, topic)


class DomainProbe:
    """Publish and receive `Float32` messages; see `domain_probe`."""

    def __init__(self, session: Session, topic: str) -> None:
        self._session = session
        self._received: list[tuple[float, float]] = []
        self._node = session.add(lambda: Node("domain_probe"))
        self._publisher = self._node.create_publisher(Float32, topic, 10)
        self._node.create_subscription(Float32, topic, self._receive, 10)
        session.start()

    def _receive(self, message: Float32) -> None:
        self._received.append((time.monotonic(), message.data))

    def clear(self) -> None:
        """Forget what was received so far."""
        self._received.clear()

    @property
    def received(self) -> tuple[tuple[float, float], ...]:
        """Return when each number came, in seconds since the first of them, and the number."""
        received = list(self._received)
        return tuple((at - received[0][0], value) for at, value in received)

    def publish(self, value: float) -> None:
        """Publish a number."""
        self._publisher.publish(Float32(data=value))

    def has_subscriber(self) -> bool:
        """Return whether a program subscribes to the topic."""
        return bool(self._publisher.get_subscription_count() > 1)

    def publishers(self) -> tuple[Endpoint, ...]:
        """Return what the programs publish, without the topics that every node has."""
        graph = self._session.graph()
        ends = (end for topic in graph.topics() for end in graph.on(topic, "publisher"))
        return tuple(end for end in ends if end.node != self._node.get_fully_qualified_name())

    def wait(self, until: Callable[[], object], seconds: float) -> bool:
        """Wait until something is true, at most so many seconds; return whether it came true."""
        return poll(until, time.monotonic() + seconds)

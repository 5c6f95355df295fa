"""Programs in processes of their own, and a node of ours among them."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat import environment
from rosbeat.domains import lease_domain
from rosbeat.records import Endpoint, LogRecord, ProgramRun
from rosbeat.ros.graph import poll
from rosbeat.ros.session import Session

# Programs in processes of their own: started, watched, ended with Ctrl+C, and nothing left behind.
#
# Nothing here needs rclpy: a node that runs as a program is a process like any other.


#: Characters of output that are kept; the rest is read and forgotten, so that nobody waits.
MOST_OUTPUT = 200_000
#: Seconds that a program may take to end after Ctrl+C.
GRACE = 5.0
_LOOK_EVERY = 0.02

#: Runs `main` of a file as its entry point would.
_START_MAIN = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location(sys.argv[1], sys.argv[2])
module = importlib.util.module_from_spec(spec)
del sys.argv[1:3]
sys.modules[spec.name] = module
spec.loader.exec_module(module)
sys.exit(module.main())
"""
# What a kernel and its tests set for themselves, and what would change what programs print.
_DROPPED = (
    *("PYTEST_CURRENT_TEST", "JPY_PARENT_PID", "JPY_SESSION_NAME", "MPLBACKEND", "COLCON_HOME"),
    *("PYTHONDONTWRITEBYTECODE", "PYTHONSTARTUP", "PYTHONINSPECT", "FORCE_COLOR", "PYTHONPATH"),
)
_LOG = re.compile(r"^\[(DEBUG|INFO|WARN|ERROR|FATAL)\] \[([\w./]+)\]: (.*)$", re.MULTILINE)


def surroundings(home: Path, domain_id: int) -> dict[str, str]:
    """What a program finds in its environment: the course, a home and a ROS domain of its own.

    Args:
        home: An empty folder.
        domain_id: The ROS domain.
    """
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


def main_of(file: Path) -> list[str]:
    """The command that runs `main()` of a Python file, as an entry point does."""
    return [sys.executable, "-c", _START_MAIN, file.stem, str(file)]


def log_lines(output: str) -> tuple[LogRecord, ...]:
    """The log lines in what a program printed, times left at 0."""
    found = _LOG.findall(output)
    return tuple(LogRecord(0, level, name, text, "", 0) for level, name, text in found)


class Program:
    """A program that runs; use it in a `with` block, which kills what is left of it.

    Args:
        command: The program and its arguments.
        env: Its environment.
        cwd: Where it runs.
        name: What it is called in the record; by default the last word of the command.

    Raises:
        OSError: If it cannot be started.
    """

    def __init__(
        self, command: Sequence[str], env: Mapping[str, str], cwd: Path, name: str = ""
    ) -> None:
        self._name = name or Path(command[-1]).name
        self._kept: list[str] = []
        self._length = 0
        # A session of its own: Ctrl+C in our terminal is not meant for it, and its whole process
        # group can be reached.
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
        """What it has printed so far, both streams in one."""
        return "".join(self._kept)

    @property
    def running(self) -> bool:
        """Whether it has not ended yet."""
        return self._process.poll() is None

    def wait(self, until: Callable[[str], object], seconds: float) -> bool:
        """Wait until its output is as wanted.

        Args:
            until: Asked with the output again and again.
            seconds: How long to wait at most, in seconds of wall time.

        Returns:
            Whether it came; False also if the program ended without it.
        """
        deadline = time.monotonic() + seconds
        while not until(self.output):
            if not self.running:
                self._reader.join(GRACE)
                return bool(until(self.output))
            if time.monotonic() > deadline:
                return False
            time.sleep(_LOOK_EVERY)
        return True

    def finish(self, grace: float = GRACE) -> ProgramRun:
        """Press Ctrl+C, wait for its end, and say what it did.

        Args:
            grace: Seconds of wall time after which it is killed.
        """
        early = not self.running
        if not early:
            self._send(signal.SIGINT)
        code = self._wait_for_end(grace)
        self._kill()
        return ProgramRun(self._name, self.output, code, early, log_lines(self.output))

    def _wait_for_end(self, grace: float) -> int | None:
        try:
            return self._process.wait(grace)
        except subprocess.TimeoutExpired:
            return None

    def _kill(self) -> None:
        # The group may outlive the process that began it: children that it has left behind.
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
                    self._kept.append(data.decode("utf-8", "replace"))
                    self._length += len(data)


def run_program(
    command: Sequence[str] | Path,
    until: Callable[[str], object] = bool,
    seconds: float = 10.0,
    *,
    domain_id: int | None = None,
    env: Mapping[str, str] | None = None,
    cwd: Path | None = None,
) -> ProgramRun:
    """Run a program until its output is as wanted, then press Ctrl+C.

    Args:
        command: The program and its arguments, or a Python file whose `main()` is run.
        until: Asked with its output; by default any output will do.
        seconds: Seconds of wall time after which it is interrupted anyway.
        domain_id: The ROS domain; by default a private one.
        env: More variables of its environment.
        cwd: Where it runs; by default an empty folder.

    Raises:
        OSError: If it cannot be started.
        DomainsExhaustedError: If no private domain id is left on this machine.
    """
    words = main_of(command.resolve()) if isinstance(command, Path) else list(command)
    name = command.stem if isinstance(command, Path) else ""
    with TemporaryDirectory(prefix="rosbeat-") as folder, private_domain(domain_id) as domain:
        home = Path(folder)
        surround = {**surroundings(home, domain), **(env or {})}
        with Program(words, surround, cwd or home, name) as program:
            program.wait(until, seconds)
            return program.finish()


@contextmanager
def private_domain(domain_id: int | None = None) -> Iterator[int]:
    """Hold a ROS domain id that no session has.

    Args:
        domain_id: The id to use instead, if it is known.

    Raises:
        DomainsExhaustedError: If no private domain id is left on this machine.
    """
    if domain_id is not None:
        yield domain_id
        return
    lease = lease_domain()
    try:
        yield lease.domain_id
    finally:
        lease.release()


# A node of ours among programs: it says numbers on a topic, and hears what the programs say.


NAME = "outpost"


class Outpost:
    """A live session in the domain of some programs; use it in a `with` block.

    Args:
        domain_id: The domain.
        topic: A topic of numbers, `std_msgs/msg/Float32`.
    """

    def __init__(self, domain_id: int, topic: str) -> None:
        self._heard: list[tuple[float, float]] = []
        self._topic = topic
        self._session = Session(domain_id=domain_id)

    def __enter__(self) -> Outpost:
        try:
            node: Any = self._session.add(lambda: Node(NAME))
            self._publisher = node.create_publisher(Float32, self._topic, 10)
            node.create_subscription(Float32, self._topic, self._hear, 10)
            self._session.start()
        except BaseException:
            self._session.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self._session.close()

    def _hear(self, message: Any) -> None:  # noqa: ANN401 - rclpy carries no types
        self._heard.append((time.monotonic(), message.data))

    def listen_anew(self) -> None:
        """Forget what was heard so far."""
        self._heard.clear()

    @property
    def heard(self) -> tuple[tuple[float, float], ...]:
        """When each number came, in seconds since the first of them, and the number."""
        heard = list(self._heard)
        return tuple((at - heard[0][0], value) for at, value in heard)

    def say(self, value: float) -> None:
        """Publish a number."""
        self._publisher.publish(Float32(data=value))

    def has_listener(self) -> bool:
        """Whether somebody else listens."""
        return bool(self._publisher.get_subscription_count() > 1)

    def publishers(self) -> tuple[Endpoint, ...]:
        """What the programs publish, topics that every node has left out."""
        graph = self._session.graph()
        return tuple(
            end
            for topic in graph.topics()
            for end in graph.on(topic, "publisher")
            if end.node != f"/{NAME}"
        )

    def wait(self, until: Callable[[], object], seconds: float) -> bool:
        """Wait until something is so, at most so many seconds of wall time; say whether it is."""
        return poll(until, time.monotonic() + seconds)

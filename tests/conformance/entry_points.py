"""Programs with a `main`, run as `ros2 run` runs them, and ended by a signal.

Here they are real processes, each with a Python of its own; `virtual.run_program` runs the same
files in virtual time. What is compared: the exit code, the last line of the traceback and those of
its frames that belong to the program, what it printed, and each node's log lines and their times.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from queue import Queue

from conformance.machine import Watch
from distributions import IS_KILTED, PROFILE_VARIABLE

FOLDER = Path(__file__).parent

#: What has real programs talk by UDP within this machine, without shared memory: a process that is
#: killed leaves its locks behind there, and one that starts later waits for them, up to seconds.
#: (While the discovery range is LOCALHOST, rmw_fastrtps takes shared memory, whatever the profile
#: says. The profile itself keeps to the loopback interface.)
LOOPBACK = {
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
    PROFILE_VARIABLE: str(FOLDER / "loopback.xml"),
}

#: What the script of an entry point does: import the module, call main, exit with what it returns.
_ENTRY_POINT = """
import sys
from importlib import import_module
sys.path.insert(0, {folder!r})
sys.argv[0] = {name!r}
sys.exit(import_module({name!r}).main())
"""
#: A line as rcutils prints it by default.
LOG = re.compile(r"\[(?P<level>\w+)\] \[(?P<stamp>[\d.]+)\] \[(?P<node>[^\]]+)\]: (?P<text>.*)")
#: The line of rcl's C code that noticed an error, and a hint that only the interpreter itself gives
#: (before Python 3.12).
_BESIDE_THE_POINT = re.compile(r", at \S+:\d+$|\. Did you mean: .*\?$")
_FRAME = re.compile(r'\s*File "(?P<file>[^"]*)", line (?P<line>\d+), in (?P<function>\S+)')
#: How far the log lines of a program may lie apart, in seconds. Its first line is time zero on both
#: sides, and its timers are made some hundredths of a second before or after that.
LINES_APART = 0.2
#: How long before a signal nothing happens, in seconds: which of two comes first is a race.
QUIET = 0.06
#: Programs that run at once, beside the cases; a start keeps a core busy for half a second.
AT_ONCE = 3


@dataclass(frozen=True)
class Run:
    """A program and its end.

    Attributes:
        name: The name of the test.
        file: Its file, in the folder of this one.
        arguments: Its arguments.
        signal: What ends it; None if it ends by itself.
        at: When the signal is sent, in seconds after its first log line.
        first_line: When that comes, in seconds of virtual time after its start.
        differs: Why virtual time does something else, on purpose.
        is_script: Whether it is run as `python file.py`, for it has no function `main`.
        beside: Files of programs that run beside it. When they start differs from run to run, so
            times are not compared, and equal lines that follow each other count once.
    """

    name: str
    file: str
    arguments: tuple[str, ...] = ()
    signal: signal.Signals | None = None
    at: float = 1.5
    beside: tuple[str, ...] = ()
    first_line: float = 0.0
    differs: str = ""
    is_script: bool = False


@dataclass(frozen=True)
class Line:
    """A log line.

    Attributes:
        time: Seconds since the first line.
        level: Such as INFO.
        text: The first line of what it says; measured temperatures are left out.
    """

    time: float
    level: str
    text: str


@dataclass(frozen=True)
class Outcome:
    """How a program ended, and what it did.

    Attributes:
        returncode: The exit code, negative for a signal; None if the program runs on.
        error: The last line of its traceback, or nothing.
        frames: The lines of its own code in the traceback: number and function.
        printed: The lines that it printed itself.
        logs: Its log lines, of each node.
        race: Which race within rclpy decided how it ended; empty in most runs.
        late: How late its signal was sent, in seconds, by the clock of its own log lines.
    """

    returncode: int | None
    error: str
    frames: tuple[tuple[int, str], ...]
    printed: list[str]
    logs: dict[str, list[Line]]
    race: str = ""
    late: float = 0.0


def _both(name: str, file: str, at: float = 1.5) -> list[Run]:
    return [
        Run(f"{name}-{number.name}", file, signal=number, at=at)
        for number in (signal.SIGINT, signal.SIGTERM)
    ]


_REMAPPED = ("-r", "__node:=x", "-r", "temperature:=humidity", "-p", "limit:=3.5", "-p", "unit:=F")

_CONTEXT_STILL_WORKS = "What belongs to a context that was shut down still works in a session."

RUNS = {
    run.name: run
    for run in [
        *_both("tutorial_publisher", "tutorial/temperature_publisher.py"),
        *_both("tutorial_subscriber", "tutorial/temperature_subscriber.py"),
        Run(
            "tutorial_pair", "tutorial/temperature_subscriber.py", signal=signal.SIGINT, at=2.5,
            beside=("tutorial/temperature_publisher.py",),
        ),
        Run("misspelled", "mains/misspelled.py"),
        Run("spin_once_loop", "mains/spin_once_loop.py", signal=signal.SIGTERM, at=1.45),
        Run("sleep_loop", "mains/sleep_loop.py", signal=signal.SIGTERM, at=1.25),
        Run("raising", "mains/raising.py"),
        Run("exiting_with_threads", "mains/exiting_with_threads.py", signal=signal.SIGINT, at=1.4),
        Run("two_nodes", "mains/two_nodes.py", signal=signal.SIGTERM, at=1.75),
        *_both("external_shutdown", "mains/external_shutdown.py", at=1.4),
        *(_both("init_for_with", "mains/init_for_with.py", at=1.4) if IS_KILTED else ()),
        Run("init_for_with", "mains/init_for_with.py", ("--shut-down",)),
        *_both("sleeping_callback", "mains/sleeping_callback.py", at=1.5),
        Run("shutting_down", "mains/shutting_down.py"),
        Run("publish_after_shutdown", "mains/publish_after_shutdown.py"),
        Run("add_service", "mains/add_service.py", signal=signal.SIGINT, at=0.8),
        Run(
            "add_client_without_server-SIGINT", "mains/add_client.py", ("2", "3"), signal.SIGINT,
            at=1.6, first_line=1.0,
        ),
        Run(
            "add_client_without_server-SIGTERM", "mains/add_client.py", ("2", "3"), signal.SIGTERM,
            at=1.6, first_line=1.0,
        ),
        Run("add_client", "mains/add_client.py", ("2", "3"), beside=("mains/add_service.py",)),
        Run("arguments", "mains/arguments.py", ("one", "--ros-args", *_REMAPPED, "--", "two"),
            signal.SIGTERM, at=1.4),
        Run("script", "mains/script.py", is_script=True),
        Run("guarded_script", "mains/guarded_script.py", is_script=True),
        Run("guarded_script-SIGINT", "mains/guarded_script.py", ("--ros-args", "-r", "__node:=x"),
            signal.SIGINT, at=1.0, is_script=True),
        Run("closing_client", "mains/closing_client.py", beside=("mains/add_service.py",)),
        Run("publishing_at_the_end", "mains/publishing_at_the_end.py", (), signal.SIGINT, at=1.0),
        Run("debug_lines", "mains/debug_lines.py",
            ("--ros-args", "--log-level", "talkative:=debug", "--log-level", "module:=warn"),
            signal.SIGTERM, at=1.0),
        Run("wrong_argument", "mains/arguments.py", ("--ros-args", "-p", "limit:=3")),
    ]
}  # fmt: skip


def outcome_of(
    returncode: int | None,
    printed: str,
    stderr: str,
    logs: Iterable[tuple[float, str, str, str]],
) -> Outcome:
    """Return an outcome of what a process left.

    Args:
        returncode: The exit code.
        printed: What came on standard output; a session shows log lines there, too.
        stderr: The traceback, with or without log lines around it.
        logs: Time, level, node and text of each log line.
    """
    lines: dict[str, list[Line]] = {}
    began: float | None = None
    further: set[str] = set()  # the lines of a text after its first
    for seconds, level, node, text in logs:
        further.update(text.splitlines()[1:])
        began = seconds if began is None else began
        shown = re.sub(r"\d+\.\d\dC", "#C", text.partition("\n")[0])
        lines.setdefault(node, []).append(Line(seconds - began, level, shown))
    _, traceback, trace = stderr.partition("Traceback (most recent call last):")
    rest = [line for line in trace.splitlines() if line.strip() and not LOG.match(line)]
    own = [
        (int(found["line"]), found["function"])
        for line in rest
        if (found := _FRAME.match(line)) and Path(found["file"]).is_relative_to(FOLDER)
    ]
    error = next((line for line in reversed(rest) if not line.startswith(" ")), "")
    error = _BESIDE_THE_POINT.sub("", error) if traceback else ""
    shown = [one for one in printed.splitlines() if not LOG.match(one) and one not in further]
    return Outcome(returncode, error, tuple(own), shown, lines)


class _Process:
    """A real process, and what it writes to standard error, read as it comes."""

    def __init__(
        self, file: str, arguments: Sequence[str], domain: int, is_script: bool = False
    ) -> None:
        path = FOLDER / file
        code = _ENTRY_POINT.format(folder=str(path.parent), name=path.stem)
        program = [str(path)] if is_script else ["-c", code]
        private = {"ROS_DOMAIN_ID": str(domain), **LOOPBACK}
        self.process = subprocess.Popen(
            [sys.executable, *program, *arguments],
            env=os.environ | private, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.stderr: list[str] = []
        self.has_logged = threading.Event()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.stderr.append(line)
            if LOG.match(line):
                self.has_logged.set()
        self.has_logged.set()  # it has ended

    def wait_for_start(self) -> None:
        if not self.has_logged.wait(30):
            raise TimeoutError("it neither logged anything nor ended")

    def signal_after(self, seconds: float, number: signal.Signals) -> float:
        """Send a signal so long after the first log line, and return how late it was sent.

        Counted from the line's own stamp: on a busy machine the line is read later.
        """
        logs = self.logs()
        due = (logs[0][0] if logs else time.time()) + seconds
        while (left := due - time.time()) > 0:
            time.sleep(left)
        self.process.send_signal(number)
        return time.time() - due

    def __enter__(self) -> _Process:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self._reader.join()
        self.process.__exit__(None, None, None)  # closes the pipes

    def end(self) -> str:
        """Wait until it has ended, and return what it printed."""
        assert self.process.stdout is not None
        printed = self.process.stdout.read()
        self.process.wait()
        self._reader.join()
        return printed

    def logs(self) -> list[tuple[float, str, str, str]]:
        found = [LOG.match(line.rstrip("\n")) for line in self.stderr]
        return [
            (float(one["stamp"]), one["level"], one["node"], one["text"]) for one in found if one
        ]


def run_program(run: Run, domain: int) -> Outcome:
    """Run a program as a real process and return how it ended."""
    with ExitStack() as stack:
        others = []
        for file in run.beside:
            others.append(stack.enter_context(_Process(file, (), domain)))
            others[-1].wait_for_start()
        one = stack.enter_context(_Process(run.file, run.arguments, domain, run.is_script))
        one.wait_for_start()
        late = 0.0
        if run.signal is not None:
            late = one.signal_after(run.at, run.signal)
        ended = _ends(one.process, 15)
        if not ended and run.signal is not signal.SIGTERM:
            raise TimeoutError(f"{run.name} does not end")
        one.process.kill()
        printed = one.end()
        logs = sorted(line for each in (*others, one) for line in each.logs())
        outcome = outcome_of(one.process.returncode, printed, "".join(one.stderr), logs)
        return replace(outcome, race=_race(outcome) if ended else LOST, late=late)


def _ends(process: subprocess.Popen[str], seconds: float) -> bool:
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


#: The executor was woken and waited again before its context was shut down.
LOST = "the signal was lost"


def _race(outcome: Outcome) -> str:
    """Return which race within rclpy ended a program, if one did, and not the program's own code.

    On a signal a thread of rclpy's wakes the executors and then shuts the contexts down, while the
    executors go on. Nothing outside of the process decides who is quicker: of 60 SIGTERMs that a
    subscriber got, long after it had begun to wait, 58 ended its `spin`, one was lost, and one
    came while the next wait set was being made.
    """
    if "failed to initialize wait set" in outcome.error:
        return "the executor made its next wait set while its context was shut down"
    if outcome.returncode == -signal.SIGSEGV:  # 10 of 260 ends of `two_nodes` by SIGINT
        # By faulthandler, `main` is in `destroy_node`, and a thread crashes that is not Python's.
        return "nodes were destroyed while rclpy's thread was shutting their context down"
    return ""


def is_close(run: Run, outcome: Outcome) -> bool:
    """Return whether a program logged a line just before it got its signal."""
    if run.signal is None or run.beside:
        return False
    sent = run.at + outcome.late
    return any(0 <= sent - line.time < QUIET for each in outcome.logs.values() for line in each)


def measure_programs(
    runs: Sequence[Run], domains: Sequence[int], file: Path, deadline: float = 60.0
) -> dict[str, Outcome | str]:
    """Run programs as real processes, several at once.

    What is measured anew, whatever came of it, is a program during which the machine stood still,
    or whose signal was sent late or just after a log line.

    Args:
        runs: The programs.
        domains: Private domain ids, one for each of `AT_ONCE` programs.
        file: A file to write to.
        deadline: After how many seconds nothing is measured anew.

    Returns:
        The outcome of each, or why there is none that says anything about rclpy.
    """
    free: Queue[int] = Queue()
    for domain in domains:
        free.put(domain)
    give_up = time.monotonic() + deadline

    def measured(run: Run) -> Outcome | str:
        while True:
            domain = free.get()
            began = time.monotonic()
            try:
                outcome = run_program(run, domain)
            finally:
                free.put(domain)
            lag = max(watch.lag(began, time.monotonic()), outcome.late)
            if lag <= LINES_APART / 3 and not is_close(run, outcome):
                return outcome
            if time.monotonic() > give_up:
                return f"the machine stood still for {lag:.3f} s, or a line came with the signal"

    with Watch(file) as watch, ThreadPoolExecutor(AT_ONCE) as pool:
        return dict(zip((run.name for run in runs), pool.map(measured, runs), strict=True))

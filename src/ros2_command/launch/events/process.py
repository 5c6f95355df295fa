"""Define what may happen to a process."""

from __future__ import annotations

import signal
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from launch.events import Event

if TYPE_CHECKING:
    from launch.processes import ExecuteLocal


class RunningProcessEvent(Event):
    """Say that something happened to a process.

    Args:
        action: What started it.
        name: Its name, such as `talker-1`.
        cmd: Its words.
        cwd: Its folder; None for that of the launch.
        env: Its environment.
        pid: Its process id.
    """

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self, *, action: ExecuteLocal, name: str, cmd: list[str], cwd: str | None,
        env: Mapping[str, str], pid: int,
    ) -> None:  # fmt: skip
        self.action, self.process_name = action, name
        self.cmd, self.cwd, self.env, self.pid = cmd, cwd, env, pid

    @property
    def execute_process_action(self) -> ExecuteLocal:
        """Return what started the process."""
        return self.action


class ProcessStarted(RunningProcessEvent):
    """Say that a process has started."""

    name = "launch.events.process.ProcessStarted"


class ProcessExited(RunningProcessEvent):
    """Say that a process has ended.

    Args:
        returncode: Its exit code; minus the number of the signal that ended it.
        **known: What is known of the process.
    """

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **known: object) -> None:
        super().__init__(**known)  # type: ignore[arg-type] # as RunningProcessEvent has them
        self.returncode = returncode


class ProcessIO(RunningProcessEvent):
    """Say that a process has printed something.

    Args:
        text: What.
        fd: 1 for its output, 2 for its errors.
        **known: What is known of the process.
    """

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **known: object) -> None:
        super().__init__(**known)  # type: ignore[arg-type] # as RunningProcessEvent has them
        self.text, self.fd = text, fd

    @property
    def from_stdin(self) -> bool:
        """Return whether it was written to the process."""
        return self.fd == 0

    @property
    def from_stdout(self) -> bool:
        """Return whether the process printed it."""
        return self.fd == 1

    @property
    def from_stderr(self) -> bool:
        """Return whether the process printed it as an error."""
        return self.fd == 2


class ProcessTargetedEvent(Event):
    """Ask something of the processes that a matcher names."""

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[ExecuteLocal], bool]) -> None:
        self.process_matcher = process_matcher


class ShutdownProcess(ProcessTargetedEvent):
    """Ask processes to end."""

    name = "launch.events.process.ShutdownProcess"


class SignalProcess(ProcessTargetedEvent):
    """Send a signal to processes.

    Args:
        signal_number: Its number or its name.
        process_matcher: Tells which processes get it.
    """

    name = "launch.events.process.SignalProcess"

    def __init__(
        self, *, signal_number: int | str | signal.Signals,
        process_matcher: Callable[[ExecuteLocal], bool],
    ) -> None:  # fmt: skip
        super().__init__(process_matcher=process_matcher)
        if isinstance(signal_number, str):
            name = signal_number if signal_number.startswith("SIG") else f"SIG{signal_number}"
            self.signal = signal.Signals[name]
        else:
            self.signal = signal.Signals(signal_number)

    @property
    def signal_name(self) -> str:
        """Return the signal's name, such as `SIGINT`."""
        return self.signal.name


def matches_name(name: str) -> Callable[[ExecuteLocal], bool]:
    """Return what tells whether a process has this name."""
    return lambda action: (action.process_details or {}).get("name") == name


def matches_pid(pid: int) -> Callable[[ExecuteLocal], bool]:
    """Return what tells whether a process has this process id."""
    return lambda action: (action.process_details or {}).get("pid") == pid

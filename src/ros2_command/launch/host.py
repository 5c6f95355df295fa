"""Define what a launch needs from the place where it runs: processes, time, and a log.

The rest of this package visits a launch description, and asks its host for everything else.
`launch.real_host` starts processes of the operating system.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Mapping, MutableMapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from launch.processes import ExecuteLocal


class RunningProcess(Protocol):
    """Be a process that runs."""

    @property
    def pid(self) -> int:
        """Return its process id."""

    def send_signal(self, number: int) -> None:
        """Send it a signal; one that has ended gets none."""


class Watcher(Protocol):
    """Hear what becomes of a process."""

    def started(self, process: RunningProcess) -> None:
        """Hear that it runs."""

    def printed(self, fd: int, data: bytes) -> None:
        """Hear what it has printed, on 1 or 2."""

    def ended(self, returncode: int) -> None:
        """Hear that it has ended; nothing comes after that."""

    def failed(self, error: OSError) -> None:
        """Hear that it could not be started; nothing comes after that."""


@dataclass(frozen=True)
class Order:
    """Say what process to start.

    Attributes:
        action: What asks for it.
        name: Its name in the log.
        words: Its command line.
        folder: Where it runs; None for the folder of the launch.
        environment: Its environment.
        in_shell: Whether a shell reads the words.
        with_terminal: Whether its output looks like a terminal to it.
    """

    action: ExecuteLocal
    name: str
    words: Sequence[str]
    folder: str | None
    environment: Mapping[str, str]
    in_shell: bool
    with_terminal: bool


class Host(Protocol):
    """Be the place where a launch runs.

    Attributes:
        environment: The variables that actions set and processes get.
    """

    environment: MutableMapping[str, str]

    def wake(self) -> None:
        """Let the launch look soon at what there is to do."""

    def call_later(self, seconds: float, call: Callable[[], None]) -> Callable[[], None]:
        """Call something after some seconds, and return what cancels that."""

    def start(self, order: Order, watcher: Watcher) -> None:
        """Start a process, and tell the watcher what becomes of it."""

    def log(self, level: int, name: str, text: str) -> None:
        """Log a line of the launch itself."""

    def note(self, *lines: str) -> None:
        """Show what the original does not say: what something means, and what to try."""

    def write(self, line: str, process: str, stream: str, places: frozenset[str]) -> None:
        """Show or keep a line that a process has printed.

        Args:
            line: The line, with the name of the process before it.
            process: The name of the process.
            stream: `stdout` or `stderr`.
            places: Some of `screen`, `log` and `own_log`.
        """

    def log_folder(self) -> str:
        """Return the folder of this launch's log files."""


class SilentHost:
    """Be a place for a launch description that is only looked at."""

    def __init__(self) -> None:
        self.environment: MutableMapping[str, str] = dict(os.environ)

    def wake(self) -> None:
        """Do nothing."""

    def call_later(self, seconds: float, call: Callable[[], None]) -> Callable[[], None]:
        """Refuse; only a launch that runs has a clock."""
        del seconds, call
        raise RuntimeError("this launch does not run")

    def start(self, order: Order, watcher: Watcher) -> None:
        """Refuse; only a launch that runs starts processes."""
        del order, watcher
        raise RuntimeError("this launch does not run")

    def log(self, level: int, name: str, text: str) -> None:
        """Log to wherever this process logs."""
        logging.getLogger(name).log(level, "%s", text)

    def note(self, *lines: str) -> None:
        """Drop the lines."""

    def write(self, line: str, process: str, stream: str, places: frozenset[str]) -> None:
        """Drop the line."""

    def log_folder(self) -> str:
        """Return the current folder."""
        return os.curdir

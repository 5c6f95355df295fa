"""End every process that a kernel's terminals have started, however the kernel ended.

The kernel starts this file as a program of its own. It waits until the kernel is gone, which it
notices by a pipe that closes and by the process itself, and then looks for the kernel's mark in the
environment of every process: `setsid`, `nohup` and daemons keep their environment. Standard library
only, and quick to start.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import time
from contextlib import suppress

#: The variable that carries the mark: `<kernel>.<terminal>`.
VARIABLE = "ROSBEAT_TERMINAL"
#: Seconds in which a program may end by itself.
GRACE = 1.0
_GIVE_UP = 10.0


def marked(mark: str) -> list[int]:
    """Return the processes whose environment carries a mark, or one that begins with it."""
    wanted = f"\0{VARIABLE}={mark}".encode()
    return [pid for pid in _processes() if wanted in _environ(pid)]


def end_marked(mark: str, grace: float = GRACE) -> None:
    """End the processes of a mark: politely first, then for certain.

    A shell ends last, because with it goes the terminal, and with that its programs.

    Args:
        mark: The mark of a kernel, or of one terminal.
        grace: Seconds in which they may end by themselves.
    """
    deadline = time.monotonic() + grace
    _send(_followers(mark), signal.SIGTERM)
    while _followers(mark) and time.monotonic() < deadline:
        time.sleep(0.02)
    deadline = time.monotonic() + _GIVE_UP
    left = marked(mark)
    while left and time.monotonic() < deadline:
        _send(left, signal.SIGKILL)
        time.sleep(0.01)
        left = marked(mark)


def _followers(mark: str) -> list[int]:
    """Return the marked processes that do not lead a session, as a shell does."""
    return [pid for pid in marked(mark) if not _leads(pid)]


def _leads(pid: int) -> bool:
    try:
        return os.getsid(pid) == pid
    except OSError:
        return False


def _processes() -> list[int]:
    try:
        names = os.listdir("/proc")
    except OSError:  # not Linux: the terminals' own ends have to do
        return []
    own = os.getpid()
    return [int(name) for name in names if name.isdigit() and int(name) != own]


def _environ(pid: int) -> bytes:
    try:
        with open(f"/proc/{pid}/environ", "rb") as file:
            return b"\0" + file.read()
    except OSError:  # somebody else's, or gone by now
        return b""


def _send(pids: list[int], number: int) -> None:
    for pid in pids:
        try:
            os.kill(pid, number)
        except OSError:
            continue


def _wait_for_end(parent: int) -> None:
    """Return when the pipe at standard input is closed, or the parent is gone."""
    watched = [0]
    with suppress(AttributeError, OSError):  # an old kernel: the pipe alone has to do
        watched.append(os.pidfd_open(parent))
    if os.getppid() == parent:
        select.select(watched, [], [])


def main() -> None:
    """Wait for the end of a kernel, then end what it has left."""
    mark, parent = sys.argv[1], int(sys.argv[2])
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    _wait_for_end(parent)
    end_marked(mark)


if __name__ == "__main__":
    main()

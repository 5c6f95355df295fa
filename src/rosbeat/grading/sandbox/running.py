"""Running something in a sandbox, and watching it from outside."""

from __future__ import annotations

import os
import selectors
import signal
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.sandbox.cage import Cage, Ends, become_gate

#: Seconds between two looks at how much memory is used.
_LOOK = 0.05
_PAGE = os.sysconf("SC_PAGE_SIZE")

Become = Callable[[Cage, str, Ends, Callable[[int], None]], None]


@dataclass(frozen=True)
class Ending:
    """How a run in a sandbox ended.

    Attributes:
        how: `ended`, `exit`, `signal`, `deadline`, `memory`, `output` or `result`: it came to its
            end, left with an exit code, was ended by a signal, or used too much of something.
        number: The exit code or the number of the signal.
        result: What it wrote as its result; hostile until it is parsed.
        output: What it printed, as far as it was read; hostile, too.
        seconds: How long it took, by the clock on the wall.
    """

    how: str
    number: int
    result: bytes
    output: bytes
    seconds: float


@dataclass
class _Watch:
    """What is known of a run while it goes on."""

    gate: int
    cage: Cage
    began: float = field(default_factory=time.monotonic)
    result: bytearray = field(default_factory=bytearray)
    output: bytearray = field(default_factory=bytearray)
    control: bytearray = field(default_factory=bytearray)
    stopped: str = ""


def run_caged(work: Callable[[int], None], cage: Cage, become: Become = become_gate) -> Ending:
    """Run a function in a sandbox.

    Args:
        work: What to run; it gets the descriptor to which it writes its result.
        cage: How the sandbox is furnished.
        become: What the forked child does; by default it becomes the gate of a sandbox.

    Raises:
        GradingError: If the sandbox cannot be made on this machine.
    """
    with tempfile.TemporaryDirectory(prefix="rosbeat-") as root:
        os.chmod(root, 0o755)
        pipes = [os.pipe() for _ in range(3)]
        gate = os.fork()
        if gate == 0:
            for reading, _ in pipes:
                os.close(reading)
            become(cage, root, Ends(*(writing for _, writing in pipes)), work)
        for _, writing in pipes:
            os.close(writing)
        watch = _Watch(gate, cage)
        try:
            _listen(watch, [reading for reading, _ in pipes])
        finally:
            status = _end(watch)
    return _ending(watch, status)


def _listen(watch: _Watch, readings: list[int]) -> None:
    """Read the pipes until all are closed, or something is used up."""
    limits = watch.cage.limits
    kept = (watch.result, watch.output, watch.control)
    most = (limits.result, limits.output, 10_000)
    names = ("result", "", "")
    with selectors.DefaultSelector() as selector:
        for entry in zip(readings, kept, most, names, strict=True):
            selector.register(entry[0], selectors.EVENT_READ, entry)
        while selector.get_map() and not watch.stopped:
            for key, _ in selector.select(_LOOK):
                if not _take(watch, *key.data):
                    selector.unregister(key.fd)
            _look(watch)
    for reading in readings:
        os.close(reading)


def _take(watch: _Watch, reading: int, kept: bytearray, most: int, name: str) -> bool:
    """Read once; say whether more may come."""
    data = os.read(reading, 65_536)
    if len(kept) + len(data) > most and name:
        watch.stopped = name
    kept += data[: most - len(kept)]
    return bool(data)


def _look(watch: _Watch) -> None:
    limits = watch.cage.limits
    if time.monotonic() - watch.began > limits.wall:
        watch.stopped = watch.stopped or "deadline"
    elif _memory_below(watch.gate) > limits.memory:
        watch.stopped = watch.stopped or "memory"


def _memory_below(process: int) -> int:
    """Bytes of memory of all descendants of a process."""
    total, left = 0, _children(process)
    while left:
        one = left.pop()
        left += _children(one)
        with suppress(OSError, IndexError, ValueError):
            # Resident pages less those shared with others, as with the parent of a fork.
            words = Path(f"/proc/{one}/statm").read_text(encoding="ascii").split()
            total += (int(words[1]) - int(words[2])) * _PAGE
    return total


def _children(process: int) -> list[int]:
    found: list[int] = []
    with suppress(OSError):
        for task in os.listdir(f"/proc/{process}/task"):
            path = Path(f"/proc/{process}/task/{task}/children")
            with suppress(OSError):
                found += map(int, path.read_text(encoding="ascii").split())
    return found


def _end(watch: _Watch) -> int:
    """End the first process, and with it all others; give the gate's exit code."""
    if watch.stopped:
        for child in _children(watch.gate):
            with suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)
        if not _children(watch.gate):
            with suppress(ProcessLookupError):
                os.kill(watch.gate, signal.SIGKILL)
    _, status = os.waitpid(watch.gate, 0)
    return os.waitstatus_to_exitcode(status)


def _ending(watch: _Watch, code: int) -> Ending:
    said = watch.control.decode("utf-8", "replace")
    if "!" in said or not (said or watch.stopped):
        raise cannot_be_made(said.partition("!")[2].strip() or "it ended early")
    seconds = time.monotonic() - watch.began
    how, number = watch.stopped, 0
    if not how:
        how, number = ("signal", code - 128) if code > 128 else ("exit" if code else "ended", code)
    return Ending(how, number, bytes(watch.result), bytes(watch.output), seconds)


def cannot_be_made(why: str) -> GradingError:
    """The error for a machine on which no sandbox can be made.

    Args:
        why: What the kernel said.
    """
    return GradingError(
        f"This machine does not let the sandbox be made: {why}.",
        "Other people's code would run here with all that you may do, so nothing was run.",
        "Allow user namespaces (`sudo sysctl kernel.unprivileged_userns_clone=1`, on Ubuntu 24.04 "
        "also `kernel.apparmor_restrict_unprivileged_userns=0`), or grade as root or in a "
        "virtual machine.",
    )

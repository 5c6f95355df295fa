"""Running something in a sandbox, and watching it from outside."""

from __future__ import annotations

import os
import selectors
import time
from dataclasses import dataclass, field

from rosbeat.grading.sandbox import linux
from rosbeat.grading.sandbox.cage import TROUBLE, Cage, Ends, Work
from rosbeat.grading.sandbox.place import Place, cannot_be_made
from rosbeat.grading.sandbox.processes import memory_of

#: Seconds between two looks at how much memory is used.
_LOOK = 0.05
_MOST_CONTROL = 10_000


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
class _Pipe:
    """What comes out of one pipe.

    Attributes:
        reading: Its descriptor.
        most: Bytes of it that are kept.
        name: What is used up if there are more; empty if the rest may be lost.
        kept: What has come.
    """

    reading: int
    most: int
    name: str = ""
    kept: bytearray = field(default_factory=bytearray)


@dataclass
class _Watch:
    """What is known of a run while it goes on."""

    place: Place
    cage: Cage
    result: _Pipe
    output: _Pipe
    control: _Pipe
    began: float = field(default_factory=time.monotonic)
    looked: float = 0.0
    stopped: str = ""


def run_caged(work: Work, cage: Cage, place: Place) -> Ending:
    """Run a function where it can do no harm.

    Args:
        work: What to run; it gets the descriptor to which it writes its result.
        cage: Its environment and limits.
        place: The sandboxes, or what stands for them.

    Raises:
        GradingError: If the sandbox cannot be made on this machine.
    """
    (result, to_result), (output, to_output), (control, to_control) = (os.pipe() for _ in range(3))
    pipes = (
        _Pipe(result, cage.limits.result, "result"),
        _Pipe(output, cage.limits.output),
        _Pipe(control, _MOST_CONTROL),
    )
    for pipe in pipes:
        os.set_blocking(pipe.reading, False)
    watch, code = _Watch(place, cage, *pipes), 0
    try:
        process = _started(watch, work, Ends(to_result, to_output, to_control))
        try:
            _listen(watch, process)
        finally:
            os.close(process)
            code = place.end()
        for pipe in pipes:
            _drain(watch, pipe)
    finally:
        for pipe in pipes:
            os.close(pipe.reading)
    return _ending(watch, code)


def _started(watch: _Watch, work: Work, ends: Ends) -> int:
    """Start the work; give a descriptor of its process."""
    try:
        return linux.descriptor_of(watch.place.start(watch.cage, ends, work))
    finally:
        for writing in (ends.result, ends.output, ends.control):
            os.close(writing)


def _listen(watch: _Watch, process: int) -> None:
    """Read the pipes until the process has ended, or something is used up."""
    with selectors.DefaultSelector() as selector:
        selector.register(process, selectors.EVENT_READ)
        for pipe in (watch.result, watch.output, watch.control):
            selector.register(pipe.reading, selectors.EVENT_READ, pipe)
        while not watch.stopped:
            ready = [key.data for key, _ in selector.select(_LOOK)]
            if None in ready:
                break
            for pipe in ready:
                if not _take(watch, pipe):
                    selector.unregister(pipe.reading)
            _look(watch)


def _drain(watch: _Watch, pipe: _Pipe) -> None:
    """Read what is left in a pipe; nobody is there any more to write to it."""
    with selectors.DefaultSelector() as selector:
        selector.register(pipe.reading, selectors.EVENT_READ)
        # A pipe that was sent through a socket may stay open for a while.
        while not watch.stopped and selector.select(0) and _take(watch, pipe):
            pass


def _take(watch: _Watch, pipe: _Pipe) -> bool:
    """Read once; say whether more may come."""
    try:
        data = os.read(pipe.reading, 65_536)
    except BlockingIOError:
        return True  # somebody in there has taken it away meanwhile
    if len(pipe.kept) + len(data) > pipe.most and pipe.name:
        watch.stopped = pipe.name
    pipe.kept += data[: pipe.most - len(pipe.kept)]
    return bool(data)


def _look(watch: _Watch) -> None:
    now, limits = time.monotonic(), watch.cage.limits
    if now - watch.looked < _LOOK:
        return
    watch.looked = now
    if now - watch.began > limits.wall:
        watch.stopped = watch.stopped or "deadline"
    elif memory_of(watch.place.inhabitants()) > limits.memory:
        watch.stopped = watch.stopped or "memory"


def _ending(watch: _Watch, code: int) -> Ending:
    said = bytes(watch.control.kept)
    if TROUBLE in said or not (said or watch.stopped):
        why = said.decode("utf-8", "replace").partition(TROUBLE.decode())[2].strip()
        raise cannot_be_made(why or "it ended early")
    how, number = watch.stopped, 0
    if not how and code < 0:
        how, number = "signal", -code
    elif not how:
        how, number = ("exit" if code else "ended"), code
    seconds = time.monotonic() - watch.began
    return Ending(how, number, bytes(watch.result.kept), bytes(watch.output.kept), seconds)

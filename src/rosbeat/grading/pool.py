"""Keep the worker processes that observe answers: their start, their jobs, and their replacement.

A worker that dies or does not answer in time is replaced, and its current answer is tried once more
in the new one; an answer that loses two workers is given up. The others continue.
"""

from __future__ import annotations

import json
import os
import select
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from queue import SimpleQueue
from types import MappingProxyType
from typing import TypeVar

from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import from_json
from rosbeat.grading.jobs import Evidence, PageCell, PageEvidence, PageJob, lost, read_line, to_line
from rosbeat.grading.worker import UNSAFE, environment
from rosbeat.records import Observation
from rosbeat.workspace.prerequisites import catch_up

Key = TypeVar("Key")
_MODULE = "rosbeat.grading.worker"
#: Seconds that a worker may be silent: the longest job, and a machine that is busy.
PATIENCE = 400.0
_TRIES = 2
#: A program that certainly works, and has all that most answers need: a node, both ends of a topic,
#: a timer, a log. No learner pays for a sandbox in which nothing can be observed.
REHEARSAL = PageJob(
    "03",
    (
        PageCell(
            """\
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat import check

class Rehearsal(Node):
    def __init__(self):
        super().__init__("rehearsal")
        self.publisher = self.create_publisher(Float32, "rehearsal", 10)
        self.create_subscription(Float32, "rehearsal", self.hear, 10)
        self.create_timer(1.0, self.say)

    def say(self):
        self.publisher.publish(Float32(data=21.0))

    def hear(self, message):
        self.get_logger().info(str(message.data))

check("03a", Rehearsal)
""",
            checks=("03a",),
        ),
    ),
    {"03a": "Rehearsal"},
)


class Worker:
    """Start a prepared process, and have it observe submissions.

    Args:
        unsafe: Whether it runs answers with limits only.
        patience: Seconds that it may be silent.
    """

    def __init__(self, unsafe: bool = False, patience: float = PATIENCE) -> None:
        options = [UNSAFE] if unsafe else []
        self._patience = patience
        self._process = subprocess.Popen(
            [sys.executable, "-m", _MODULE, *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment(),
            cwd="/",  # Python imports from there, and here there may be anything
            start_new_session=True,
        )
        self._is_rehearsed = False

    @property
    def pid(self) -> int:
        """Return the number of its process."""
        return self._process.pid

    def observe(self, jobs: Sequence[PageJob]) -> Iterator[PageEvidence]:
        """Have the jobs of a submission done.

        Yields:
            Evidence for one after the other; less if the worker is lost, or says what cannot be
            understood.

        Raises:
            GradingError: If the worker cannot start, or cannot make a sandbox, or the workspace of
                a page cannot be made.
        """
        if not self._is_rehearsed:
            _require_rehearsed(next(self._exchange([REHEARSAL]), None))
            self._is_rehearsed = True
        yield from self._exchange([with_files(job) for job in jobs])

    def _exchange(self, jobs: Sequence[PageJob]) -> Iterator[PageEvidence]:
        assert self._process.stdin is not None
        try:
            line = json.dumps([to_line(job) for job in jobs])
            self._process.stdin.write(f"{line}\n".encode())
            self._process.stdin.flush()
        except OSError:
            return
        for _ in jobs:
            evidence = _understood(self._line())
            if evidence is None:
                return
            yield evidence

    def _line(self) -> str:
        """Return the next line; empty if the worker has ended or is silent for too long."""
        assert self._process.stdout is not None
        descriptor, found = self._process.stdout.fileno(), self._rest
        deadline = time.monotonic() + self._patience
        while b"\n" not in found:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([descriptor], [], [], left)[0]:
                return ""
            data = os.read(descriptor, 1 << 20)
            if not data:
                return ""
            found += data
        line, _, self._rest = found.partition(b"\n")
        return line.decode("utf-8", "replace")

    #: What was read beyond the last line.
    _rest = b""

    def kill(self) -> None:
        """End it and everything that it has started; whoever waits for its answer gets none."""
        self._process.kill()

    def close(self) -> None:
        """End it, and forget it."""
        self.kill()
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                assert pipe is not None
                pipe.close()
        self._process.wait()


def _understood(line: str) -> PageEvidence | None:
    if line.startswith('{"refused"'):
        raise GradingError(*json.loads(line)["refused"])
    try:
        return read_line(PageEvidence, line)
    except GradingError:
        return None


def _require_rehearsed(evidence: PageEvidence | None) -> None:
    """Refuse to go on with a worker in which not even the course's own program can be observed."""
    if evidence is None:  # it has lost no answer: the next one would not start either
        raise GradingError(
            "A process that watches answers does not start.",
            "What it printed, above, says why; nothing was judged, and no mark is lost.",
            "`course doctor` says what this computer lacks. Then run the command again.",
        )
    said = _failed(evidence.exercises.get("03a", Evidence("ended")))
    if said:
        raise GradingError(
            f"Nothing can be observed in the sandbox of this machine: {said}",
            "A program that certainly works did not work in there, so every mark would be wrong.",
            "`./environment/course doctor` says what is missing, or which other ROS is in the way; "
            "`--unsafe-no-sandbox` tells whether it is the sandbox.",
        )


def _failed(evidence: Evidence) -> str:
    """Return why the rehearsal is no proof that answers can be observed; empty if it is one."""
    if evidence.how != "ended" or not evidence.seen:
        how = f"it ended with {evidence.how} {evidence.number}"
        return evidence.text or evidence.output[-300:] or how
    found: Observation = from_json(evidence.seen)
    if found.faults:
        return found.faults[0].text
    return "" if found.logs else "a node does not hear what it publishes"


class Pool:
    """Have submissions observed by several workers; usable in a `with` block.

    Args:
        size: How many; by default one for each processor.
        unsafe: Whether they run answers with limits only.
        patience: Seconds that one may be silent.
    """

    def __init__(
        self, size: int | None = None, unsafe: bool = False, patience: float = PATIENCE
    ) -> None:
        self.size = size or os.cpu_count() or 1
        self._unsafe, self._patience = unsafe, patience
        self._lock, self._is_closed = threading.Lock(), False
        self._threads = ThreadPoolExecutor(self.size)
        self._idle: SimpleQueue[Worker] = SimpleQueue()
        self._all: set[Worker] = set()
        for _ in range(self.size):
            self._idle.put(self._new_worker())

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def pids(self) -> frozenset[int]:
        """Return the numbers of the workers' processes."""
        with self._lock:
            return frozenset(worker.pid for worker in self._all)

    def observe(
        self, submissions: Iterable[Sequence[tuple[Key, PageJob]]]
    ) -> Iterator[tuple[Key, PageEvidence]]:
        """Have submissions observed, several at a time; evidence comes as it is ready.

        Raises:
            GradingError: If no sandbox can be made.
        """
        results: SimpleQueue[tuple[Key, PageEvidence] | Future[None]] = SimpleQueue()
        left = 0
        for one in submissions:
            future = self._threads.submit(self._serve, list(one), results.put)
            future.add_done_callback(results.put)
            left += 1
        while left:
            found = results.get()
            if isinstance(found, Future):
                found.result()  # raises what went wrong
                left -= 1
            else:
                yield found

    def _serve(
        self, left: list[tuple[Key, PageJob]], tell: Callable[[tuple[Key, PageEvidence]], None]
    ) -> None:
        """Observe a submission with an idle worker, or with those that come after it."""
        worker, tries = self._idle.get(), 0
        try:
            while left and not self._is_closed:
                for evidence in worker.observe([job for _, job in left]):
                    tell((left.pop(0)[0], evidence))
                    tries = 0
                if left:
                    worker, tries = self._replaced(worker), tries + 1
                if left and tries == _TRIES:
                    key, job = left.pop(0)
                    tell((key, lost(job)))
                    tries = 0
        finally:
            self._idle.put(worker)

    def _new_worker(self) -> Worker:
        worker = Worker(self._unsafe, self._patience)
        self._all.add(worker)
        return worker

    def _replaced(self, worker: Worker) -> Worker:
        """Return a new worker; the old one, of no use, if there is to be none any more."""
        with self._lock:
            if self._is_closed:
                return worker
            self._all.discard(worker)
            worker.close()
            return self._new_worker()

    def close(self) -> None:
        """End all workers; answers that are being observed are given up."""
        with self._lock:
            self._is_closed = True
        for worker in self._all:
            worker.kill()
        self._threads.shutdown(cancel_futures=True)
        for worker in self._all:
            worker.close()


# The workspace that a page of terminals starts from.

_ONE_AT_A_TIME = threading.Lock()


def with_files(job: PageJob) -> PageJob:
    """Return a job as it is sent: a page of terminals with the workspace that it starts from.

    Raises:
        GradingError: If the workspace cannot be made on this machine.
    """
    if not job.needs_files:
        return job
    with _ONE_AT_A_TIME:  # making one starts programs, and takes a while
        return replace(job, files=dict(files_before(job.page)))


@cache
def files_before(page: str) -> Mapping[str, str]:
    """Make what the pages before this one leave, somewhere else, and read it.

    Returns:
        Content in Latin-1 by path in the workspace; a folder's path ends with `/` and has none. It
        is made once in a process.

    Raises:
        GradingError: If it cannot be made on this machine.
    """
    with tempfile.TemporaryDirectory(prefix="rosbeat-") as root:
        report = catch_up(page, Path(root))
        if report.attention:
            raise GradingError(
                f"The workspace of page {page} cannot be made: {report.attention[0]}",
                "Exercises of that page are about what is typed in it.",
                "`course doctor` says what this computer lacks.",
            )
        found = sorted(Path(root).rglob("*"))
        return MappingProxyType(dict(_entry(path, Path(root)) for path in found))


def _entry(path: Path, root: Path) -> tuple[str, str]:
    name = path.relative_to(root).as_posix()
    return (f"{name}/", "") if path.is_dir() else (name, path.read_bytes().decode("latin-1"))

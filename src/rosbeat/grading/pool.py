"""Prepared workers, each a process of its own, and the jobs that are handed to them.

A worker that dies or does not answer in time is replaced, and its job is tried once more in the new
one; a job that loses two workers is given up. The others go on.
"""

from __future__ import annotations

import json
import os
import select
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import suppress
from itertools import islice
from queue import SimpleQueue
from typing import TypeVar

from rosbeat.errors import GradingError
from rosbeat.grading.jobs import LOST, READY, Job, Observed, read_observed, write_line
from rosbeat.grading.start_worker import UNSAFE
from rosbeat.grading.workspaces import workspace_line

#: What a worker runs, and the option that takes its sandboxes away.
_MODULE = "rosbeat.grading.start_worker"
#: The middleware's thousands of functions are looked up once, as it is loaded (ld.so(8)); else each
#: answer would do so anew, for itself. Answers see nothing of it: their environment is their own.
_BOUND = {"LD_BIND_NOW": "1"}
#: Seconds that a worker may be silent: the longest job, and a machine that is busy.
PATIENCE = 400.0
_TRIES = 2
#: Jobs that wait for each worker.
_AHEAD = 2

Key = TypeVar("Key")


class Worker:
    """One prepared process.

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
            env={**os.environ, **_BOUND},
            cwd="/",  # Python imports from there, and here there may be anything
            start_new_session=True,
        )
        self._is_ready = False
        self._shown: set[str] = set()

    @property
    def pid(self) -> int:
        """The number of its process."""
        return self._process.pid

    def observe(self, job: Job) -> Observed | None:
        """Have a job done.

        Returns:
            What was observed, or None if the worker is lost, or says what cannot be understood.

        Raises:
            GradingError: If the worker cannot start, or cannot make a sandbox, or the workspace of
                a page cannot be made.
        """
        self._wait_until_ready()
        workspace = workspace_line(job.page) if job.replay and job.page not in self._shown else ""
        try:
            if workspace:
                self._write(workspace)
                self._shown.add(job.page)
            self._write(write_line(job))
            line = self._read()
        except OSError:
            return None
        return _heard(line) if line else None

    def _wait_until_ready(self) -> None:
        """One that does not even start has lost no job: the next would not start either."""
        if not self._is_ready and self._read().rstrip() != READY:
            raise GradingError(
                "A process that watches answers does not start.",
                "What it printed, above, says why; nothing was judged, and no mark is lost.",
                "`course doctor` says what this computer lacks. Then run the command again.",
            )
        self._is_ready = True

    def _write(self, line: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(f"{line}\n".encode())
        self._process.stdin.flush()

    def _read(self) -> str:
        """The next line; empty if the worker has ended or is silent for too long."""
        assert self._process.stdout is not None
        descriptor, found = self._process.stdout.fileno(), bytearray()
        deadline = time.monotonic() + self._patience
        while not found.endswith(b"\n"):
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([descriptor], [], [], left)[0]:
                return ""
            data = os.read(descriptor, 1 << 20)
            if not data:
                return ""
            found += data
        return found.decode("utf-8", "replace")

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


def understood(line: str) -> Observed:
    """Read what a worker has answered.

    Args:
        line: One line of JSON.

    Raises:
        GradingError: If it says why nothing was observed, or is no such line.
    """
    refused = _refusal(line)
    if refused is not None:
        raise refused
    return read_observed(line)


def _heard(line: str) -> Observed | None:
    refused = _refusal(line)
    if refused is not None:
        raise refused
    try:
        return read_observed(line)
    except GradingError:
        return None


def _refusal(line: str) -> GradingError | None:
    if not line.startswith('{"refused"'):
        return None
    return GradingError(*json.loads(line)["refused"])


class Pool:
    """Several workers; usable in a `with` block.

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
        self._idle: SimpleQueue[Worker] = SimpleQueue()
        self._all: set[Worker] = set()
        self._lock, self._is_closed = threading.Lock(), False
        self._threads = ThreadPoolExecutor(self.size, thread_name_prefix="grading")
        for _ in range(self.size):
            self._idle.put(self._new_worker())

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def pids(self) -> frozenset[int]:
        """The numbers of the workers' processes."""
        with self._lock:
            return frozenset(worker.pid for worker in self._all)

    def observe(self, jobs: Iterable[tuple[Key, Job]]) -> Iterator[tuple[Key, Observed]]:
        """Have jobs done, several at a time; results come as they are ready.

        Args:
            jobs: Jobs, each with something to know it by.

        Raises:
            GradingError: If no sandbox can be made.
        """
        todo = iter(jobs)
        running: dict[Future[Observed], Key] = {}
        try:
            while True:
                for key, job in islice(todo, self.size * _AHEAD - len(running)):
                    running[self._threads.submit(self._one, job)] = key
                if not running:
                    return
                done, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in done:
                    yield running.pop(future), future.result()
        finally:
            for future in running:
                future.cancel()

    def _one(self, job: Job) -> Observed:
        for _ in range(_TRIES):
            worker = self._idle.get()
            try:
                found = worker.observe(job)
            except GradingError:
                self._idle.put(worker)
                raise
            self._idle.put(worker if found is not None else self._replaced(worker))
            if found is not None:
                return found
            if self._is_closed:
                break
        return Observed(LOST)

    def _new_worker(self) -> Worker:
        worker = Worker(self._unsafe, self._patience)
        self._all.add(worker)
        return worker

    def _replaced(self, worker: Worker) -> Worker:
        """A new worker; the old one, which is of no use, if there is to be none any more."""
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
        self._threads.shutdown(wait=True, cancel_futures=True)
        for worker in self._all:
            worker.close()


Observer = Callable[[Iterable[tuple[Key, Job]]], Iterator[tuple[Key, Observed]]]

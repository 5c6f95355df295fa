"""A class that outgrows one machine: its jobs go to a cluster of Dask, and are judged here.

Each worker of the cluster keeps prepared processes (`cluster_worker`), which make the same sandbox
as on one machine. A job whose worker is lost is sent to another by Dask; one that loses several is
given up. Everything that is written stays on this computer.
"""

from __future__ import annotations

import secrets
from collections.abc import Iterable, Iterator
from concurrent.futures import CancelledError
from importlib import import_module
from itertools import islice
from typing import Any, TypeVar

from rosbeat.errors import GradingError
from rosbeat.grading.jobs import LOST, Job, Observed, write_line
from rosbeat.grading.ledger import course_version
from rosbeat.grading.pool import understood
from rosbeat.grading.remarks import printable

Key = TypeVar("Key")

#: Seconds until a scheduler has answered, and until it has a worker.
PATIENCE = 15.0
#: Seconds between two looks whether there is a worker still.
_LOOK = 20.0
#: Jobs that are under way for each thread of the cluster.
_AHEAD = 3


class Cluster:
    """A connection to a cluster, with the shape of a `Pool`; usable in a `with` block.

    Args:
        address: Where its scheduler listens, such as `tcp://10.0.0.5:8786`.
        patience: Seconds until it has answered, and until it has a worker.

    Raises:
        GradingError: If Dask is not installed, nothing answers there, there is no worker, or
            workers do not have the course.
    """

    def __init__(self, address: str, patience: float = PATIENCE) -> None:
        self._dask = _dask()
        self._address = printable(address)
        self._name = f"rosbeat-grade-{secrets.token_hex(4)}"
        self._version = course_version()
        self._client = self._connected(address, patience)
        try:
            self._prepare(patience)
        except BaseException:
            self._client.close()
            raise

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def observe(self, jobs: Iterable[tuple[Key, Job]]) -> Iterator[tuple[Key, Observed]]:
        """Have jobs done, several at a time; results come as they are ready.

        Args:
            jobs: Jobs, each with something to know it by.

        Raises:
            GradingError: If a worker cannot make a sandbox or has another course, or the cluster
                is gone.
        """
        todo = iter(jobs)
        running: dict[Any, Key] = {}
        try:
            while True:
                for key, job in islice(todo, max(0, self._room() - len(running))):
                    running[self._submitted(job)] = key
                if not running:
                    return
                for future in self._done(list(running)):
                    yield running.pop(future), self._observed(future)
        except (OSError, CancelledError, self._dask.client.ClosedClientError) as error:
            raise self._gone(error) from error
        finally:
            if self._client.status == "running":
                self._client.cancel(list(running))

    def close(self) -> None:
        """End what was prepared on the workers, and hang up."""
        if self._client.status == "running":
            self._client.unregister_worker_plugin(self._name)
        self._client.close()

    def _connected(self, address: str, patience: float) -> Any:  # noqa: ANN401 - Dask's client
        try:
            return self._dask.Client(address, timeout=patience, set_as_default=False)
        except (OSError, self._dask.TimeoutError, ValueError) as error:
            raise GradingError(
                f"No scheduler of Dask answers at {self._address}.",
                f"Nothing was graded. {printable(str(error), 200)}",
                "Start one with `dask scheduler`, its workers with `dask worker ADDRESS`, and "
                "give the address that it prints. Without --scheduler, this computer grades.",
            ) from error

    def _prepare(self, patience: float) -> None:
        try:
            self._client.wait_for_workers(1, timeout=patience)
        except self._dask.TimeoutError as error:  # before Python 3.11 it is not the built-in one
            raise self._nobody() from error
        worker = import_module("rosbeat.grading.cluster_worker")
        try:
            self._client.register_plugin(worker.Prepared(self._name))
        except Exception as error:  # whatever importing another course raises there
            raise worker.another_course(f"{type(error).__name__}: {_first(error)}") from error

    def _room(self) -> int:
        threads: int = sum(self._client.nthreads().values())
        return _AHEAD * max(1, threads)

    def _submitted(self, job: Job) -> Any:  # noqa: ANN401 - Dask's future
        run = import_module("rosbeat.grading.cluster_worker").observe_line
        return self._client.submit(run, write_line(job), self._name, self._version, pure=False)

    def _done(self, futures: list[Any]) -> set[Any]:
        """Wait until some have ended; workers may be restarted meanwhile, but not all be gone."""
        while True:
            try:
                with self._client.as_current():
                    found = self._dask.wait(futures, timeout=_LOOK, return_when="FIRST_COMPLETED")
                return set(found.done)
            except self._dask.TimeoutError as error:
                if not self._client.nthreads():
                    raise self._nobody() from error

    def _observed(self, future: Any) -> Observed:  # noqa: ANN401 - Dask's future
        if future.status == "finished":
            return understood(str(future.result()))
        error = future.exception() if future.status == "error" else None
        if isinstance(error, self._dask.KilledWorker):
            return Observed(LOST)
        raise self._gone(error)

    def _nobody(self) -> GradingError:
        return GradingError(
            f"The scheduler at {self._address} has no worker.",
            "Nobody is there to run answers. What is graded already stays graded.",
            f"Start workers with `dask worker {self._address}`, and run the command again.",
        )

    def _gone(self, error: BaseException | None) -> GradingError:
        why = f" {type(error).__name__}: {_first(error)}." if error else ""
        return GradingError(
            f"The cluster at {self._address} has dropped an answer.{why}",
            "Its scheduler was stopped, or a worker is of another make.",
            "Look at the cluster, and run the command again: what is graded stays graded.",
        )


def _first(error: BaseException) -> str:
    return printable(str(error).split("\n")[0], 200)


def _dask() -> Any:  # noqa: ANN401 - a module that need not be there
    try:
        return import_module("distributed")
    except ImportError as error:
        raise GradingError(
            "Dask is not installed here, and --scheduler needs it.",
            "A cluster is for classes that outgrow one machine; most do not.",
            'Install it with `pip install "rosbeat[cluster]"`, or leave --scheduler out.',
        ) from error

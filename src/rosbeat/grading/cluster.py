"""Observe the answers of a class on a Dask cluster; judging stays on this computer.

Each worker of the cluster keeps a pool, which creates the same sandboxes as on one machine. If a
submission's worker is lost, Dask sends the submission to another one; a submission that loses
several workers is given up. Client and worker exchange lines of JSON; a submission is never
pickled, and all files are written on this computer. Only this module depends on Dask, and it is
only imported when a cluster is requested; without Dask, importing it raises a `GradingError`.
"""

from __future__ import annotations

import json
import secrets
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import CancelledError
from itertools import islice
from typing import Any, TypeVar

from rosbeat.errors import GradingError
from rosbeat.grading.files import printable
from rosbeat.grading.ledger import course_version
from rosbeat.page_runs.jobs import PageEvidence, PageJob, lost, read_line, to_line
from rosbeat.page_runs.pool import Pool

try:
    import distributed
    from distributed import WorkerPlugin, get_worker
except ImportError as error:
    raise GradingError(
        "Dask is not installed here, and --scheduler needs it.",
        "A cluster is for classes that outgrow one machine; most do not.",
        "Run `python -m pip install distributed` in the shell of the course, or leave --scheduler "
        "out.",
    ) from error

Key = TypeVar("Key")
Submission = Sequence[tuple[Key, PageJob]]

#: Seconds until a scheduler has answered, and until it has a worker.
PATIENCE = 15.0
#: Seconds between two looks whether there is a worker still.
_LOOK = 20.0
#: Submissions that are under way for each thread of the cluster.
_AHEAD = 2


class Prepared(WorkerPlugin):  # type: ignore[misc, unused-ignore]  # Dask has no types
    """Keep a pool on one worker of Dask, with a sandbox for each of its threads.

    Dask sets it up on every worker, on those too that join or are restarted later.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self._version = ""
        self._pool: Pool | None = None

    def setup(self, worker: distributed.Worker) -> None:
        """Make the pool."""
        self._version = course_version()
        self._pool = Pool(worker.state.nthreads)

    def teardown(self, worker: distributed.Worker) -> None:
        """End its sandboxes."""
        if self._pool is not None:
            self._pool.close()

    def observe(self, lines: Sequence[str], version: str) -> list[str]:
        """Have the jobs of a submission done, and return evidence, a line each.

        Raises:
            GradingError: If the course is another one here, or no sandbox can be made.
        """
        if self._version != version:
            raise another_course(f"{self._version}, not {version}")
        assert self._pool is not None
        jobs = [read_line(PageJob, line) for line in lines]
        found = dict(self._pool.observe([list(enumerate(jobs))]))
        return [to_line(found[number]) for number in range(len(lines))]


def observe_lines(lines: Sequence[str], name: str, version: str) -> list[str] | str:
    """Run on a worker of Dask: `name` is the plugin's, the rest as in `Prepared.observe`.

    Returns:
        Evidence, or the three parts of why there is none, as a line of JSON.
    """
    plugin: Prepared = get_worker().plugins[name]
    try:
        return plugin.observe(lines, version)
    except GradingError as error:
        return json.dumps([error.what, error.means, error.to_try])


class Cluster:
    """Have submissions observed by a cluster, as a `Pool` does; usable in a `with` block.

    Args:
        address: Where its scheduler listens, such as `tcp://10.0.0.5:8786`.
        patience: Seconds until it has answered, and until it has a worker.

    Raises:
        GradingError: If nothing answers there, there is no worker, or workers do not have the
            course.
    """

    def __init__(self, address: str, patience: float = PATIENCE) -> None:
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

    def observe(self, submissions: Iterable[Submission[Key]]) -> Iterator[tuple[Key, PageEvidence]]:
        """Have submissions observed, several at a time; evidence comes as it is ready.

        Raises:
            GradingError: If a worker cannot make a sandbox or has another course, or the cluster
                is gone.
        """
        todo = iter(submissions)
        running: dict[Any, Submission[Key]] = {}
        try:
            while True:
                for one in islice(todo, max(0, self._room() - len(running))):
                    running[self._submitted([job for _, job in one])] = one
                if not running:
                    return
                for future in self._done(list(running)):
                    found = self._found(future, running[future])
                    if found:
                        keys = [key for key, _ in running.pop(future)]
                        yield from zip(keys, found, strict=True)
        except (OSError, CancelledError, distributed.client.ClosedClientError) as error:
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
            return distributed.Client(address, timeout=patience, set_as_default=False)
        except (OSError, distributed.TimeoutError, ValueError, TypeError) as error:
            raise GradingError(
                f"No scheduler of Dask answers at {self._address}.",
                f"Nothing was graded. {printable(str(error), 200)}",
                "Start one with `dask scheduler`, its workers with `dask worker ADDRESS`, and "
                "give the address that it prints. Without --scheduler, this computer grades.",
            ) from error

    def _prepare(self, patience: float) -> None:
        try:
            self._client.wait_for_workers(1, timeout=patience)
        except distributed.TimeoutError as error:  # before Python 3.11 it is not the built-in one
            raise self._nobody() from error
        try:
            self._client.register_plugin(Prepared(self._name))
        except Exception as error:  # whatever importing another course raises there
            raise another_course(f"{type(error).__name__}: {_first(error)}") from error

    def _room(self) -> int:
        threads: int = sum(self._client.nthreads().values())
        return _AHEAD * max(1, threads)

    def _submitted(self, jobs: Sequence[PageJob]) -> Any:  # noqa: ANN401 - Dask's future
        lines = [to_line(job) for job in jobs]
        return self._client.submit(observe_lines, lines, self._name, self._version, pure=False)

    def _done(self, futures: list[Any]) -> set[Any]:
        """Wait until some have ended; workers may be restarted meanwhile, but not all be gone."""
        while True:
            try:
                with self._client.as_current():
                    found = distributed.wait(futures, timeout=_LOOK, return_when="FIRST_COMPLETED")
                # Dask counts among these what was finished, and was lost with its worker before it
                # was fetched. Another worker is at it again.
                return {one for one in found.done if one.status != "lost"}
            except distributed.TimeoutError as error:
                if not self._client.nthreads():
                    raise self._nobody() from error

    def _found(self, future: Any, pages: Submission[Key]) -> list[PageEvidence]:  # noqa: ANN401 - Dask's future
        """Fetch the evidence of a submission; none if it is lost just now, and made again."""
        try:
            found = future.result(timeout=_LOOK)
        except distributed.TimeoutError:
            return []
        except distributed.KilledWorker:
            return [lost(job) for _, job in pages]
        except (OSError, CancelledError, distributed.client.ClosedClientError):
            raise
        except Exception as error:
            raise self._gone(error) from error
        if isinstance(found, str):
            raise GradingError(*json.loads(found))
        return [read_line(PageEvidence, line) for line in found]

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


def another_course(why: str) -> GradingError:
    """Return the error for a cluster that has not the course that judges."""
    return GradingError(
        f"A worker of the cluster has another course than this computer: {why}.",
        "What it observes could be another thing than what is judged here.",
        "Install the same version of the course on every worker, and restart the workers.",
    )


def _first(error: BaseException) -> str:
    return printable(str(error).split("\n")[0], 200)

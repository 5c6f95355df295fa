"""What runs on a worker of a Dask cluster: prepared processes, and the jobs that they are handed.

Only this module and `cluster` know of Dask, and only they need it. Between client and worker go
lines of JSON; a submission is never pickled, and nothing is judged here.
"""

from __future__ import annotations

import json

from distributed import Worker, WorkerPlugin, get_worker

from rosbeat.errors import GradingError
from rosbeat.grading.jobs import read_job, write_line
from rosbeat.grading.ledger import course_version
from rosbeat.grading.pool import Pool


class Prepared(WorkerPlugin):  # type: ignore[misc, unused-ignore]
    """Prepared processes on one worker of Dask, one for each of its threads.

    Dask sets it up on every worker, on those too that join or are restarted later.

    Args:
        name: What it is known by.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self._version = ""
        self._pool: Pool | None = None

    def setup(self, worker: Worker) -> None:
        """Start the processes.

        Args:
            worker: Dask's worker.
        """
        self._version = course_version()
        self._pool = Pool(worker.state.nthreads)

    def teardown(self, worker: Worker) -> None:
        """End the processes.

        Args:
            worker: Dask's worker.
        """
        if self._pool is not None:
            self._pool.close()

    def observe(self, line: str, version: str) -> str:
        """Have a job done.

        Args:
            line: The job, as `jobs.write_line` writes it.
            version: The version of the course that will judge.

        Returns:
            What was observed, a line as well.

        Raises:
            GradingError: If the course is another one here, or no sandbox can be made.
        """
        if self._version != version:
            raise another_course(f"{self._version}, not {version}")
        assert self._pool is not None
        _, observed = next(self._pool.observe([("", read_job(line))]))
        return write_line(observed)


def observe_line(line: str, name: str, version: str) -> str:
    """What Dask runs for each job; `name` is the plugin's, the rest as in `Prepared.observe`.

    Returns:
        What was observed, or the three parts of why it was not, as a line of JSON.
    """
    plugin: Prepared = get_worker().plugins[name]
    try:
        return plugin.observe(line, version)
    except GradingError as error:
        return json.dumps({"refused": [error.what, error.means, error.to_try]})


def another_course(why: str) -> GradingError:
    """The error for a cluster that has not the course that judges.

    Args:
        why: What was found.
    """
    return GradingError(
        f"A worker of the cluster has another course than this computer: {why}.",
        "What it observes could be another thing than what is judged here.",
        "Install the same version of the course on every worker, and restart the workers.",
    )

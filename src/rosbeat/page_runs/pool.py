"""Have the submissions of a class observed, several at a time, each in a sandbox of its own.

If a sandbox is ended by somebody else, its current page is tried once more in a new one; a page
that loses two of them is given up. The others continue.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from pathlib import Path
from queue import SimpleQueue
from types import MappingProxyType
from typing import TypeVar

from rosbeat.environment import PROFILE_VARIABLES
from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import from_json
from rosbeat.page_runs.jobs import Evidence, PageCell, PageEvidence, PageJob, lost
from rosbeat.page_runs.sandbox import Sandbox, View, python_folders
from rosbeat.page_runs.transcript import observe_page
from rosbeat.page_runs.worker import Limits
from rosbeat.records import Observation
from rosbeat.workspace.prerequisites import catch_up

Key = TypeVar("Key")
#: What runs inside of a sandbox.
_MODULE = "rosbeat.page_runs.worker"
#: Variables that name a file of settings.
_FILES = (*PROFILE_VARIABLES, "COLCON_DEFAULTS_FILE")
#: Variables of the environment that ROS needs; nothing else of it reaches a sandbox.
_KEPT = (
    *("AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "ROS_PYTHON_CHECK_FIELDS", "LANG", "LC_ALL", "TZ"),
    *(*_FILES, "RMW_FASTRTPS_USE_QOS_FROM_XML"),
)
#: Folders of this package that hold solutions, or are nobody's business in there.
_HIDDEN = ("exercises/solved", "grading", "authoring", "workspace/finished", "course/solutions")
#: Seconds that one run of a page may take by the clock on the wall, and bytes of its evidence.
WALL, RESULT = 240.0, 60_000_000
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


def environment() -> dict[str, str]:
    """Return what process 1 of a sandbox starts with: what Python and ROS need, and nothing else.

    The middleware's thousands of functions are looked up once, as it is loaded (ld.so(8)); else
    each answer would do so anew, for itself. Answers see nothing of this: see `View.environment`.
    """
    names = (*_KEPT, "PYTHONPATH", "PYTHONHOME")
    kept = {name: os.environ[name] for name in names if name in os.environ}
    return {**kept, "PATH": "/usr/bin:/bin", "HOME": "/tmp", "LD_BIND_NOW": "1"}


def view_of_answers() -> View:
    """Return what answers see: Python, ROS and a part of this package; an empty environment."""
    kept = {name: os.environ[name] for name in _KEPT if name in os.environ}
    package = Path(__file__).resolve().parents[1]
    return View(
        [*python_folders(), *_programs(), *(kept[name] for name in _FILES if name in kept)],
        [str(package / name) for name in _HIDDEN],
        {**kept, "PATH": "/usr/bin:/bin", "HOME": "/tmp"},
    )


def _programs() -> list[str]:
    """Return the folders of the `ros2` command and of Rosie, where they are the course's own."""
    specs = [importlib.util.find_spec(name) for name in ("ros2_command", "rosie")]
    folders = [place for spec in specs if spec for place in spec.submodule_search_locations or ()]
    return [str(Path(folder).resolve().parent) for folder in folders]


def limits_of(job: PageJob, seconds: float = WALL) -> Limits:
    """Return what a run of a page may use; builds and programs in terminals need more processes.

    Args:
        job: The page.
        seconds: How long it may take, by the clock on the wall.
    """
    processes, wall = 512 if job.needs_files else 128, min(WALL, seconds)
    return Limits(wall=wall, cpu=int(wall) + 1, processes=processes, result=RESULT)


@cache
def _compile() -> None:
    """Have Python compile once what sandboxes import: in there it could keep nothing of that."""
    names = ("rclpy", "numpy", "IPython", "matplotlib", _MODULE)
    specs = [importlib.util.find_spec(name) for name in names]
    sources = [spec.origin for spec in specs if spec and spec.origin]
    if not all(os.path.exists(importlib.util.cache_from_source(one)) for one in sources):
        program = f"import rosbeat.viz.diagrams, {_MODULE} as worker; worker.prepare()"
        words = [sys.executable, "-c", program]
        subprocess.run(words, cwd="/", capture_output=True, check=False)


class Worker:
    """Observe submissions one after the other, each in a sandbox of its own.

    Args:
        unsafe: Whether it runs answers with limits only.
    """

    def __init__(self, unsafe: bool = False) -> None:
        self._sandbox = Sandbox(view_of_answers(), _MODULE, not unsafe, environment())
        self._is_rehearsed = False

    @property
    def pid(self) -> int:
        """Return the number of the outermost process of its sandbox; 0 while there is none."""
        return self._sandbox.pid

    def observe(self, jobs: Sequence[PageJob]) -> Iterator[PageEvidence]:
        """Have the jobs of a submission done.

        Yields:
            Evidence for one after the other; less if the sandbox is lost.

        Raises:
            GradingError: If a sandbox cannot be made, or nothing can be observed in it, or the
                workspace of a page cannot be made.
        """
        _compile()
        with self._sandbox:
            if not self._is_rehearsed:
                _require_rehearsed(self._observed(REHEARSAL))
                self._is_rehearsed = True
            for job in jobs:
                evidence = self._observed(with_files(job))
                if evidence is None:
                    return
                yield evidence

    def _observed(self, job: PageJob) -> PageEvidence | None:
        """Return the evidence of a page; none if the sandbox is lost."""
        try:
            return observe_page(
                job, lambda work, seconds: self._sandbox.run(work, limits_of(job, seconds))
            )
        except OSError:
            return None

    def kill(self) -> None:
        """End everything that it has started, for good; whoever waits for evidence gets none."""
        self._sandbox.kill()


def _require_rehearsed(evidence: PageEvidence | None) -> None:
    """Refuse to go on with a worker in which not even the course's own program can be observed."""
    if evidence is None:  # it has lost no answer: the next one would not start either
        raise GradingError(
            "The process that runs pages in a sandbox does not start.",
            "What it printed, above, says why; nothing was judged, and no mark is lost.",
            "`rosbeat doctor` says what this computer lacks. Then run the command again.",
        )
    said = _failed(evidence.exercises.get("03a", Evidence("ended")))
    if said:
        raise GradingError(
            f"Nothing can be observed in the sandbox of this machine: {said}",
            "A program that certainly works did not work in there, so every mark would be wrong.",
            "`rosbeat doctor` says what is missing, or which other ROS is in the way; "
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
    """

    def __init__(self, size: int | None = None, unsafe: bool = False) -> None:
        self.size = size or os.cpu_count() or 1
        self._is_closed = False
        self._threads = ThreadPoolExecutor(self.size)
        self._all = [Worker(unsafe) for _ in range(self.size)]
        self._idle: SimpleQueue[Worker] = SimpleQueue()
        for worker in self._all:
            self._idle.put(worker)

    def __enter__(self) -> Pool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def pids(self) -> frozenset[int]:
        """Return the numbers of the outermost processes of all sandboxes that are there."""
        return frozenset(worker.pid for worker in self._all if worker.pid)

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
        """Observe a submission with an idle worker, in as many sandboxes as that takes."""
        worker, tries = self._idle.get(), 0
        try:
            while left and not self._is_closed:
                for evidence in worker.observe([job for _, job in left]):
                    tell((left.pop(0)[0], evidence))
                    tries = 0
                tries += 1
                if left and tries == _TRIES and not self._is_closed:
                    key, job = left.pop(0)
                    tell((key, lost(job)))
                    tries = 0
        finally:
            self._idle.put(worker)

    def close(self) -> None:
        """End all sandboxes; answers that are being observed are given up."""
        self._is_closed = True
        for worker in self._all:
            worker.kill()
        self._threads.shutdown(cancel_futures=True)


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
                "`rosbeat doctor` says what this computer lacks.",
            )
        found = sorted(Path(root).rglob("*"))
        return MappingProxyType(dict(_entry(path, Path(root)) for path in found))


def _entry(path: Path, root: Path) -> tuple[str, str]:
    name = path.relative_to(root).as_posix()
    return (f"{name}/", "") if path.is_dir() else (name, path.read_bytes().decode("latin-1"))

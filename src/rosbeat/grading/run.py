"""Judge a class: from its submissions to its gradebook, with the workers that observe answers.

Answers that agree in everything that affects the result are observed once. A worker that dies or
does not answer in time is replaced, and its current answer is tried once more in the new one; an
answer that loses two workers is given up. The others continue.
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
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from queue import SimpleQueue
from types import MappingProxyType
from typing import TypeVar

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import GradingError
from rosbeat.exercises.evidence import from_json
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.answers import NOT_THERE, Answer, answers_on
from rosbeat.grading.files import printable
from rosbeat.grading.jobs import LOST, Evidence, Job, read_line, to_line
from rosbeat.grading.judging import WATCHER_LOST, judge_and_trace, untouched
from rosbeat.grading.ledger import Ledger, key_of
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark, Points, Solution, scaled
from rosbeat.grading.notebook import Cell, CoursePage
from rosbeat.grading.submissions import REACHES_INSIDE, Collection, HandedIn, Remark, Submission
from rosbeat.grading.worker import UNSAFE, environment
from rosbeat.records import Observation, Outcome
from rosbeat.workspace.prerequisites import catch_up

Key = TypeVar("Key")
#: Has the jobs of submissions done, and gives evidence as it comes.
Observe = Callable[[Iterable[Sequence[tuple[str, Job]]]], Iterator[tuple[str, Evidence]]]
#: Is told how many answers are judged, of how many; first, how many were judged in earlier runs.
Tell = Callable[[int, int], None]


@dataclass(frozen=True)
class Plan:
    """Say how a class is graded.

    Attributes:
        pages: The pages that count, in the order of the course.
        version: The version of the course.
        points: What exercises are worth.
        seed: From what the inputs of scenarios are drawn; 0 on a page. See `ledger.seed_of`.
        solved: The same pages with the published solutions, as far as there are any.
        excuses: Whether a learner who handed in nothing gets no grade instead of 0 points.
    """

    pages: tuple[CoursePage, ...]
    version: str
    points: Points = field(default_factory=Points)
    seed: int = 0
    solved: Mapping[str, tuple[Cell, ...]] = field(default_factory=dict)
    excuses: bool = False

    def out_of(self, exercise: str) -> float:
        """Return what an exercise is worth."""
        return self.points.of(exercise, EXERCISES[exercise].points)


#: The answers by learner and page.
Answers = Mapping[tuple[str, str], tuple[Answer, ...]]


def grade(
    collection: Collection, plan: Plan, ledger: Ledger, observe: Observe, tell: Tell
) -> Gradebook:
    """Judge every exercise of every submission.

    Raises:
        GradingError: If no sandbox can be made, or the ledger cannot be written.
    """
    answers = all_answers(collection, plan)
    published = tuple(one for page in plan.pages for one in _published(page, plan))
    submitted = [
        [one for handed in each.pages for one in answers.get((each.learner, handed.page), ())]
        for each in collection.submissions
    ]
    jobs = _different_jobs([published, *submitted], plan)
    todo = [[(key, job) for key, job in some if ledger.get(key) is None] for some in jobs]
    _judge_new([some for some in todo if some], sum(map(len, jobs)), plan, ledger, observe, tell)
    learners = tuple(_graded(one, answers, plan, ledger) for one in collection.submissions)
    solutions = tuple(
        Solution(one.exercise, one.source, ledger.trace(_key(one, plan))) for one in published
    )
    return Gradebook(plan.version, learners, collection.remarks, solutions)


def _published(page: CoursePage, plan: Plan) -> tuple[Answer, ...]:
    """Return the published solutions of a page, found as a learner's answers are."""
    found = answers_on(page, plan.solved.get(page.lesson, ()), seed=plan.seed)
    return tuple(one for one in found if plan.out_of(one.exercise) > 0 and one.job)


def _key(answer: Answer, plan: Plan) -> str:
    """Return what an answer is known by in the ledger; empty if nothing has to be observed."""
    return key_of(answer.job, plan.version) if answer.job else ""


def all_answers(collection: Collection, plan: Plan) -> Answers:
    """Return the answers by learner and page; exercises without points are left out."""
    pages = {page.lesson: page for page in plan.pages}
    return {
        (one.learner, handed.page): tuple(
            answer
            for answer in answers_on(pages[handed.page], handed.notebook.cells, plan.seed)
            if plan.out_of(answer.exercise) > 0
        )
        for one in collection.submissions
        for handed in one.pages
        if handed.page in pages and not handed.notebook.problem
    }


def _different_jobs(
    submissions: Iterable[Sequence[Answer]], plan: Plan
) -> list[list[tuple[str, Job]]]:
    """Return what there is to observe by submission; of equal answers the first one only."""
    known: set[str] = set()
    found: list[list[tuple[str, Job]]] = []
    for answers in submissions:
        jobs = {_key(one, plan): one.job for one in answers if one.job is not None}
        found.append([(key, job) for key, job in jobs.items() if key not in known])
        known.update(jobs)
    return found


def _judge_new(
    todo: Sequence[Sequence[tuple[str, Job]]],
    total: int,
    plan: Plan,
    ledger: Ledger,
    observe: Observe,
    tell: Tell,
) -> None:
    jobs = {key: job for some in todo for key, job in some}
    known = total - len(jobs)
    tell(known, total)
    if not jobs:
        return
    for done, (key, evidence) in enumerate(observe(todo), known + 1):
        # Who loses workers may have had bad luck; the next run tries that answer again.
        stays = evidence.how != LOST
        outcome, trace = judge_and_trace(EXERCISES[jobs[key].exercise], evidence, plan.seed)
        ledger.add(key, outcome, stays, trace)
        tell(done, total)


# Marks.


def _graded(one: Submission, answers: Answers, plan: Plan, ledger: Ledger) -> Graded:
    handed = {page.page: page for page in one.pages}
    marks: list[Mark] = []
    for page in plan.pages:
        there = handed.get(page.lesson)
        if there is None or there.notebook.problem:
            marks += _without_page(page, one, there, plan)
        else:
            found = answers[one.learner, page.lesson]
            marks += [_mark(answer, there, plan, ledger) for answer in found]
    remarks = (*one.remarks, *_remarks(one, answers))
    files = tuple((page.page, page.path) for page in one.pages)
    excused = plan.excuses and all(mark.status == MISSING for mark in marks)
    return Graded(
        *(one.learner, one.name, one.system, tuple(marks), remarks), excused=excused, files=files
    )


def _remarks(one: Submission, answers: Answers) -> Iterator[Remark]:
    """Give what an instructor should know of answers, beside marks that stand."""
    for handed in one.pages:
        for answer in answers.get((one.learner, handed.page), ()):
            if answer.remarks:
                said = printable("; ".join(answer.remarks[:3]), 300)
                text = f"Exercise {answer.exercise}: {said}. The mark stands; look at the answer."
                yield Remark(REACHES_INSIDE, handed.path, text)


def _mark(answer: Answer, handed: HandedIn, plan: Plan, ledger: Ledger) -> Mark:
    """Return the mark of an answer; what no machine could watch is held: it may be right."""
    exercise, key = EXERCISES[answer.exercise], _key(answer, plan)
    outcome = ledger.get(key) or untouched(exercise)
    if outcome.status == NOT_ATTEMPTED and NOT_THERE in answer.repairs:
        outcome = replace(outcome, evidence=NOT_THERE)
    out_of = plan.out_of(exercise.id)
    points = scaled(outcome, out_of)
    mark = Mark(
        *(exercise.id, exercise.title, handed.page, outcome.status),
        *(round(points * (1 - handed.off), 2), out_of),
        cause=cause_of(outcome),
        mistake=outcome.mistake,
        evidence=outcome.evidence,
        hint=outcome.hint,
        remarks=outcome.remarks,
        parts=outcome.parts,
        repairs=answer.repairs,
        judged=points,
        late=handed.late,
        source=answer.source,
        trace=ledger.trace(key),
    )
    if outcome.evidence != WATCHER_LOST:
        return mark
    return replace(
        mark,
        status=HELD,
        points=0.0,
        judged=0.0,
        cause=f"Held for a person to look at: {WATCHER_LOST}",
        mistake="",
        hint="It was tried more than once. Your instructor looks at it.",
        answer=answer.source,
        file=handed.path,
    )


def cause_of(outcome: Outcome) -> str:
    """Return why an outcome has its points, one sentence for a table."""
    if outcome.status == PASSED:
        return "It does what is asked."
    if outcome.status == NOT_ATTEMPTED:
        return NOT_THERE if outcome.evidence == NOT_THERE else "Nothing was tried yet."
    known = MISTAKES.get(outcome.mistake)
    first = outcome.evidence.split("\n")[0]
    if outcome.parts:
        met = sum(part.met for part in outcome.parts)
        first = f"{met} of {len(outcome.parts)} requirements are met."
    named = f"{known.heading}: {first}" if known else first
    return printable(named, 400) if outcome.status == FAILED else named


def _without_page(
    page: CoursePage, one: Submission, handed: HandedIn | None, plan: Plan
) -> Iterator[Mark]:
    """Yield the marks of a page that is not there, or was and cannot be read: nobody has 0 then."""
    file, cause = "", "The page is not among the files that were handed in."
    if handed is not None:
        file, cause = handed.path, f"The page cannot be read. {handed.notebook.problem}"
    elif one.unread:
        file, why = one.unread[0].path, one.unread[0].text
        cause = f"The page cannot be read. It may be in {file}. {why}"
    for exercise in dict.fromkeys(wanted.exercise for wanted in page.wanted):
        out_of = plan.out_of(exercise)
        if out_of > 0:
            status, title = HELD if file else MISSING, EXERCISES[exercise].title
            yield Mark(
                *(exercise, title, page.lesson, status, 0.0, out_of, cause),
                evidence=cause if file else "",
                hint="Hand the page in again." if file else "",
                late=handed is not None and handed.late,
                file=file,
            )


# The workspace that a page of terminals starts from.

_ONE_AT_A_TIME = threading.Lock()


def with_files(job: Job) -> Job:
    """Return a job as it is sent: a page of terminals with the workspace that it starts from.

    Raises:
        GradingError: If the workspace cannot be made on this machine.
    """
    if not job.replay:
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


# Workers.

_MODULE = "rosbeat.grading.worker"
#: Seconds that a worker may be silent: the longest job, and a machine that is busy.
PATIENCE = 400.0
_TRIES = 2
#: A program that certainly works, and has all that most answers need: a node, both ends of a topic,
#: a timer, a log. No learner pays for a sandbox in which nothing can be observed.
REHEARSAL = Job(
    "03a",
    "Rehearsal",
    """
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
""",
    imports="from rclpy.node import Node\nfrom std_msgs.msg import Float32",
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

    def observe(self, jobs: Sequence[Job]) -> Iterator[Evidence]:
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

    def _exchange(self, jobs: Sequence[Job]) -> Iterator[Evidence]:
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


def _understood(line: str) -> Evidence | None:
    if line.startswith('{"refused"'):
        raise GradingError(*json.loads(line)["refused"])
    try:
        return read_line(Evidence, line)
    except GradingError:
        return None


def _require_rehearsed(evidence: Evidence | None) -> None:
    """Refuse to go on with a worker in which not even the course's own program can be observed."""
    if evidence is None:  # it has lost no answer: the next one would not start either
        raise GradingError(
            "A process that watches answers does not start.",
            "What it printed, above, says why; nothing was judged, and no mark is lost.",
            "`course doctor` says what this computer lacks. Then run the command again.",
        )
    said = _failed(evidence)
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
        self, submissions: Iterable[Sequence[tuple[Key, Job]]]
    ) -> Iterator[tuple[Key, Evidence]]:
        """Have submissions observed, several at a time; evidence comes as it is ready.

        Raises:
            GradingError: If no sandbox can be made.
        """
        results: SimpleQueue[tuple[Key, Evidence] | Future[None]] = SimpleQueue()
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
        self, left: list[tuple[Key, Job]], tell: Callable[[tuple[Key, Evidence]], None]
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
                    tell((left.pop(0)[0], Evidence(LOST)))
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

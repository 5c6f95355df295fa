"""A class from what was handed in to its gradebook."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED, Exercise
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.collecting import Collection, HandedIn, Submission
from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.inspecting import Reason
from rosbeat.grading.jobs import LOST, Job, Observed
from rosbeat.grading.judging import WATCHER_LOST, judge_and_trace, untouched
from rosbeat.grading.ledger import Ledger, key_of
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark, Solution
from rosbeat.grading.mending import NOT_THERE
from rosbeat.grading.notebook import Cell
from rosbeat.grading.remarks import printable
from rosbeat.grading.sampling import Candidate, Sampled, choose, disagreements
from rosbeat.grading.tasks import Task, tasks_of
from rosbeat.grading.weights import Points, scaled
from rosbeat.records import Outcome

#: Has jobs done, and gives what was observed as it comes.
Observe = Callable[[Iterable[tuple[str, Job]]], Iterator[tuple[str, Observed]]]
#: Is told how many answers are judged, of how many; first, how many were judged in earlier runs.
Tell = Callable[[int, int], None]


@dataclass(frozen=True)
class Plan:
    """How a class is graded.

    Attributes:
        pages: The pages that count, in the order of the course.
        version: The version of the course.
        points: What exercises are worth.
        sample: How many answers run in a kernel of Jupyter, too.
        solved: The same pages with the published solutions, as far as there are any.
    """

    pages: tuple[CoursePage, ...]
    version: str
    points: Points = field(default_factory=Points)
    sample: int = 0
    solved: Mapping[str, tuple[Cell, ...]] = field(default_factory=dict)

    def out_of(self, exercise: str) -> float:
        """What an exercise is worth."""
        return self.points.of(exercise, EXERCISES[exercise].points)


Tasks = Mapping[tuple[str, str], tuple[Task, ...]]


def grade(
    collection: Collection, plan: Plan, ledger: Ledger, observe: Observe, tell: Tell
) -> Gradebook:
    """Judge every exercise of every submission.

    Args:
        collection: What was handed in.
        plan: How it is graded.
        ledger: What has been judged already; what is judged now is added.
        observe: Has jobs done.
        tell: Is told how far it is.

    Raises:
        GradingError: If no sandbox can be made, or the ledger cannot be written.
    """
    tasks = all_tasks(collection, plan)
    sampled = choose(_candidates(collection, plan, tasks), plan.sample)
    published = [task for page in plan.pages for task in _published(page, plan)]
    jobs = _different_jobs({**tasks, ("", ""): tuple(published)}, sampled, plan)
    new = {key: job for key, job in jobs.items() if ledger.get(key) is None}
    _judge_new(new, len(jobs) - len(new), ledger, observe, tell)
    learners = tuple(_graded(one, tasks, plan, ledger) for one in collection.submissions)
    remarks = disagreements(sampled, lambda job: ledger.get(key_of(job, plan.version)))
    solutions = tuple(
        Solution(task.exercise, text_of(task), _trace(task, plan, ledger)) for task in published
    )
    return Gradebook(plan.version, learners, (*collection.remarks, *remarks), solutions)


def _published(page: CoursePage, plan: Plan) -> tuple[Task, ...]:
    """Return the published solutions of a page, found as a learner's answers are."""
    cells = plan.solved.get(page.lesson, ())
    return tuple(one for one in tasks_of(page, cells) if plan.out_of(one.exercise) > 0 and one.job)


def text_of(task: Task) -> str:
    """Return the text of the cells of an answer; empty if nobody has filled them in."""
    if task.job is None:
        return task.source
    return "\n\n".join((*task.job.parts, task.job.answer))


def _trace(task: Task, plan: Plan, ledger: Ledger) -> str:
    return ledger.trace(key_of(task.job, plan.version)) if task.job else ""


def all_tasks(collection: Collection, plan: Plan) -> Tasks:
    """The tasks by learner and page; exercises without points are left out.

    Args:
        collection: What was handed in.
        plan: How it is graded.
    """
    pages = {page.lesson: page for page in plan.pages}
    return {
        (one.learner, handed.page): tuple(
            task
            for task in tasks_of(pages[handed.page], handed.notebook.cells, handed.notebook.cut)
            if plan.out_of(task.exercise) > 0
        )
        for one in collection.submissions
        for handed in one.pages
        if handed.page in pages
    }


def _candidates(collection: Collection, plan: Plan, tasks: Tasks) -> Iterator[Candidate]:
    """The answers of which a sample is taken."""
    pages = {page.lesson: page for page in plan.pages}
    for one in collection.submissions:
        for handed in one.pages:
            for task in tasks.get((one.learner, handed.page), ()):
                if task.job is not None:
                    page = pages[handed.page]
                    yield Candidate(handed.path, page, handed.notebook.cells, task.job)


def _different_jobs(tasks: Tasks, sampled: Sequence[Sampled], plan: Plan) -> dict[str, Job]:
    """What there is to observe, the slow first; answers equal in all that counts only once."""
    jobs = [one.slow for one in sampled]
    jobs += [task.job for some in tasks.values() for task in some if task.job is not None]
    return {key_of(job, plan.version): job for job in jobs}


def _judge_new(
    jobs: Mapping[str, Job], known: int, ledger: Ledger, observe: Observe, tell: Tell
) -> None:
    total = known + len(jobs)
    tell(known, total)
    if not jobs:
        return
    for done, (key, observed) in enumerate(observe(jobs.items()), known + 1):
        # Who loses workers may have had bad luck; the next run tries that answer again.
        stays = observed.how != LOST
        outcome, trace = judge_and_trace(EXERCISES[jobs[key].exercise], observed)
        ledger.add(key, outcome, stays, trace)
        tell(done, total)


def _graded(one: Submission, tasks: Tasks, plan: Plan, ledger: Ledger) -> Graded:
    handed = {page.page: page for page in one.pages}
    marks = [
        mark
        for page in plan.pages
        for mark in (
            _marks(page, handed[page.lesson], tasks[one.learner, page.lesson], plan, ledger)
            if page.lesson in handed
            else _missing(page, plan)
        )
    ]
    files = tuple((page.page, page.path) for page in one.pages)
    return Graded(one.learner, one.name, one.system, tuple(marks), one.remarks, files=files)


def _marks(
    page: CoursePage, handed: HandedIn, tasks: Sequence[Task], plan: Plan, ledger: Ledger
) -> Iterator[Mark]:
    for task in tasks:
        exercise = EXERCISES[task.exercise]
        out_of = plan.out_of(task.exercise)
        if task.reasons or task.cut:
            yield _held(page, exercise, task, out_of, handed)
            continue
        known = ledger.get(key_of(task.job, plan.version)) if task.job else None
        if task.job and known and known.evidence == WATCHER_LOST:
            yield _unwatched(page, exercise, task.job, out_of, handed)
            continue
        outcome = known or _untried(exercise, task)
        mark = _mark(page, exercise, task, outcome, out_of, handed.late)
        yield replace(mark, source=text_of(task), trace=_trace(task, plan, ledger))


def _untried(exercise: Exercise[object], task: Task) -> Outcome:
    outcome = untouched(exercise)
    return replace(outcome, evidence=NOT_THERE) if NOT_THERE in task.repairs else outcome


def _mark(
    page: CoursePage,
    exercise: Exercise[object],
    task: Task,
    outcome: Outcome,
    out_of: float,
    late: bool,
) -> Mark:
    points = scaled(outcome, out_of)
    return Mark(
        *(exercise.id, exercise.title, page.lesson, outcome.status, points, out_of),
        cause=cause_of(outcome),
        mistake=outcome.mistake,
        evidence=outcome.evidence,
        hint=outcome.hint,
        remarks=outcome.remarks,
        parts=outcome.parts,
        repairs=task.repairs,
        judged=points,
        late=late,
    )


def cause_of(outcome: Outcome) -> str:
    """Why an outcome has its points, one sentence for a table."""
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


def _held(
    page: CoursePage, exercise: Exercise[object], task: Task, out_of: float, handed: HandedIn
) -> Mark:
    mark = Mark(
        *(exercise.id, exercise.title, page.lesson, HELD, 0.0, out_of),
        cause=f"Held for a person to look at: {told(task.reasons)}.",
        evidence=f"The answer was not run: {told(task.reasons)}.",
        hint="No exercise asks for that. Your instructor looks at it.",
        repairs=task.repairs,
        late=handed.late,
        answer=task.source,
        file=handed.path,
        source=task.source,
    )
    if not task.cut:
        return mark
    said = "The file stops before this exercise: hand it in again."
    return replace(mark, cause=said, evidence=said, hint="")


def _unwatched(
    page: CoursePage, exercise: Exercise[object], job: Job, out_of: float, handed: HandedIn
) -> Mark:
    """What the machine could not watch may be right; the next run tries it again."""
    return Mark(
        *(exercise.id, exercise.title, page.lesson, HELD, 0.0, out_of),
        cause=f"Held for a person to look at: {WATCHER_LOST}",
        evidence=WATCHER_LOST,
        hint="It was tried more than once. Your instructor looks at it.",
        late=handed.late,
        answer="\n\n".join((*job.parts, job.answer)),
        file=handed.path,
        source="\n\n".join((*job.parts, job.answer)),
    )


def told(reasons: Sequence[Reason]) -> str:
    """Why a person has to look, in words."""
    return printable("; ".join(f"line {one.line} {one.text}" for one in reasons[:3]), 300)


def _missing(page: CoursePage, plan: Plan) -> Iterator[Mark]:
    for wanted in page.wanted:
        out_of = plan.out_of(wanted.exercise)
        if out_of > 0:
            title = EXERCISES[wanted.exercise].title
            cause = "The page is not among the files that were handed in."
            yield Mark(wanted.exercise, title, page.lesson, MISSING, 0.0, out_of, cause)

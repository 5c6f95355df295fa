"""Judge a class: from its submissions to its gradebook, and what is held for a person.

Pages that agree in everything that affects the result are run once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.files import printable
from rosbeat.grading.jobs import LOST, Evidence, PageEvidence, PageJob
from rosbeat.grading.judging import WATCHER_LOST, judge_and_trace, untouched
from rosbeat.grading.ledger import Ledger, key_of
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark, Points, Solution, scaled
from rosbeat.grading.notebook import Cell, CoursePage
from rosbeat.grading.remarks import REACHES_INSIDE, Remark
from rosbeat.grading.submissions import Collection, HandedIn, Submission
from rosbeat.grading.submitted_page import NOT_THERE, Answer, SubmittedPage, submitted_page
from rosbeat.records import Outcome

#: Has the pages of submissions run, and gives evidence as it comes.
Observe = Callable[[Iterable[Sequence[tuple[str, PageJob]]]], Iterator[tuple[str, PageEvidence]]]
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


#: The pages that were handed in, by learner and lesson.
Pages = Mapping[tuple[str, str], SubmittedPage]


def grade(
    collection: Collection, plan: Plan, ledger: Ledger, observe: Observe, tell: Tell
) -> Gradebook:
    """Judge every exercise of every submission.

    Raises:
        GradingError: If no sandbox can be made, or the ledger cannot be written.
    """
    submitted = all_pages(collection, plan)
    published = [_published(page, plan) for page in plan.pages]
    by_learner = [
        [submitted[key] for page in each.pages if (key := (each.learner, page.page)) in submitted]
        for each in collection.submissions
    ]
    jobs = _different_jobs([published, *by_learner], plan)
    _judge_new(jobs, plan, ledger, observe, tell)
    learners = tuple(_graded(each, submitted, plan, ledger) for each in collection.submissions)
    solutions = tuple(
        Solution(answer.exercise, answer.source, ledger.trace(_key(page, answer.exercise, plan)))
        for page in published
        for answer in page.answers
        if plan.out_of(answer.exercise) > 0 and page.job
    )
    return Gradebook(plan.version, learners, collection.remarks, solutions)


def _published(page: CoursePage, plan: Plan) -> SubmittedPage:
    """Return the published solution of a page, as if a learner had handed it in."""
    return submitted_page(page, plan.solved.get(page.lesson) or page.cells, plan.seed)


def _key(page: SubmittedPage, exercise: str, plan: Plan) -> str:
    """Return what an answer is known by in the ledger; empty if nothing has to be run."""
    return f"{key_of(page.job, plan.version)}/{exercise}" if page.job else ""


def all_pages(collection: Collection, plan: Plan) -> Pages:
    """Return what was handed in, by learner and lesson; what cannot be read is left out."""
    pages = {page.lesson: page for page in plan.pages}
    return {
        (each.learner, handed.page): submitted_page(
            pages[handed.page], handed.notebook.cells, plan.seed
        )
        for each in collection.submissions
        for handed in each.pages
        if handed.page in pages and not handed.notebook.problem
    }


def _different_jobs(
    submissions: Iterable[Sequence[SubmittedPage]], plan: Plan
) -> list[list[tuple[str, PageJob]]]:
    """Return what there is to run by submission; of equal pages the first one only."""
    known: set[str] = set()
    different: list[list[tuple[str, PageJob]]] = []
    for pages in submissions:
        jobs = {key_of(page.job, plan.version): page.job for page in pages if page.job is not None}
        different.append([(key, job) for key, job in jobs.items() if key not in known])
        known.update(jobs)
    return different


def _judge_new(
    jobs: Sequence[Sequence[tuple[str, PageJob]]],
    plan: Plan,
    ledger: Ledger,
    observe: Observe,
    tell: Tell,
) -> None:
    todo = [[(key, job) for key, job in pages if _is_new(key, job, ledger)] for pages in jobs]
    by_key = {key: job for pages in todo for key, job in pages}
    total = sum(len(job.subjects) for pages in jobs for _, job in pages)
    done = total - sum(len(job.subjects) for job in by_key.values())
    tell(done, total)
    if not by_key:
        return
    for key, page in observe([pages for pages in todo if pages]):
        for exercise in by_key[key].subjects:
            done += 1
            if ledger.get(f"{key}/{exercise}") is not None:
                continue  # whoever was stopped in the middle of the page has noted it
            evidence = page.exercises.get(exercise, Evidence(LOST))
            seed = by_key[key].seeds.get(exercise, 0)
            outcome, trace = judge_and_trace(EXERCISES[exercise], evidence, seed)
            # Who loses workers may have had bad luck; the next run tries that page again.
            stays = evidence.how != LOST
            ledger.add(f"{key}/{exercise}", outcome, stays, trace, page.remarks)
        tell(done, total)


def _is_new(key: str, job: PageJob, ledger: Ledger) -> bool:
    return any(ledger.get(f"{key}/{exercise}") is None for exercise in job.subjects)


# Marks.


def _graded(one: Submission, submitted: Pages, plan: Plan, ledger: Ledger) -> Graded:
    handed = {page.page: page for page in one.pages}
    marks: list[Mark] = []
    for page in plan.pages:
        there = handed.get(page.lesson)
        if there is None or there.notebook.problem:
            marks += _without_page(page, one, there, plan)
        else:
            handed_in = submitted[one.learner, page.lesson]
            marks += [
                _mark(answer, handed_in, there, plan, ledger)
                for answer in handed_in.answers
                if plan.out_of(answer.exercise) > 0
            ]
    remarks = (*one.remarks, *_remarks(one, submitted, plan, ledger))
    files = tuple((page.page, page.path) for page in one.pages)
    excused = plan.excuses and all(mark.status == MISSING for mark in marks)
    return Graded(
        *(one.learner, one.name, one.system, tuple(marks), remarks), excused=excused, files=files
    )


def _remarks(one: Submission, submitted: Pages, plan: Plan, ledger: Ledger) -> Iterator[Remark]:
    """Give what an instructor should know of pages, beside marks that stand."""
    for handed in one.pages:
        page = submitted.get((one.learner, handed.page))
        if page is None or page.job is None:
            continue
        keys = [_key(page, answer.exercise, plan) for answer in page.answers]
        reaches = list(dict.fromkeys(reach for key in keys for reach in ledger.reaches(key)))
        if reaches:
            text = (
                f"The page {printable('; '.join(reaches[:3]), 300)}. The marks stand; look at it."
            )
            yield Remark(REACHES_INSIDE, handed.path, text)


def _differs(answer: Answer, outcome: Outcome) -> str:
    """Say that a page shows another outcome than its run; nothing if it does not."""
    if answer.stored != PASSED or outcome.status == PASSED:
        return ""
    return (
        "The page shows that it has passed; run from top to bottom, it has not. "
        f"{cause_of(outcome)} Cells may have run in another order, or were changed since."
    )


def _mark(
    answer: Answer, page: SubmittedPage, handed: HandedIn, plan: Plan, ledger: Ledger
) -> Mark:
    """Return the mark of an answer; what no machine could watch is held: it may be right."""
    exercise, key = EXERCISES[answer.exercise], _key(page, answer.exercise, plan)
    outcome = ledger.get(key) or untouched(exercise)
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
        differs=_differs(answer, outcome),
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

"""Judge a class: from its submissions to its gradebook, and what is held for a person.

Pages that agree in everything that affects the result are run once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.files import printable
from rosbeat.grading.ledger import Ledger, key_of
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark, Points, Solution, scaled
from rosbeat.grading.remarks import REACHES_INSIDE, Remark
from rosbeat.grading.submissions import Collection, HandedIn, Submission
from rosbeat.page_runs.jobs import LOST, Evidence, PageEvidence, PageJob
from rosbeat.page_runs.judging import WATCHER_LOST, judge_and_trace, untouched
from rosbeat.page_runs.notebook import Cell, CoursePage
from rosbeat.page_runs.submitted_page import NOT_THERE, Answer, SubmittedPage, submitted_page
from rosbeat.records import Outcome

#: Has the pages of submissions run, and gives evidence as it comes.
Observe = Callable[[Sequence[Sequence[tuple[str, PageJob]]]], Iterator[tuple[str, PageEvidence]]]
#: Is told how many answers are judged, of how many; first, how many were judged in earlier runs.
Tell = Callable[[int, int], None]


@dataclass(frozen=True)
class Again:
    """Say which answers are judged again although the ledger has their outcomes.

    Attributes:
        learners: Those whose answers are judged again, all of them.
        exercises: Those whose answers are judged again, of all learners.
    """

    learners: frozenset[str] = frozenset()
    exercises: frozenset[str] = frozenset()


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
        again: What is judged again.
    """

    pages: tuple[CoursePage, ...]
    version: str
    points: Points = field(default_factory=Points)
    seed: int = 0
    solved: Mapping[str, tuple[Cell, ...]] = field(default_factory=dict)
    excuses: bool = False
    again: Again = Again()

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
    _judge_new(jobs, _keys_again(submitted, plan), ledger, observe, tell)
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


def _keys_again(submitted: Pages, plan: Plan) -> frozenset[str]:
    """Return what those answers are known by that are judged again."""
    return frozenset(
        _key(page, answer.exercise, plan)
        for (learner, _), page in submitted.items()
        for answer in page.answers
        if learner in plan.again.learners or answer.exercise in plan.again.exercises
    )


def _judge_new(
    jobs: Sequence[Sequence[tuple[str, PageJob]]],
    again: frozenset[str],
    ledger: Ledger,
    observe: Observe,
    tell: Tell,
) -> None:
    """Judge the answers that the ledger does not have, and those that are judged again."""
    by_key = {key: job for pages in jobs for key, job in pages}
    todo = {
        key: [
            exercise
            for exercise in job.subjects
            if f"{key}/{exercise}" in again or ledger.get(f"{key}/{exercise}") is None
        ]
        for key, job in by_key.items()
    }
    total = sum(len(job.subjects) for job in by_key.values())
    done = total - sum(map(len, todo.values()))
    tell(done, total)
    pages_to_run = [[(key, job) for key, job in pages if todo[key]] for pages in jobs]
    if not any(pages_to_run):
        return
    for key, page in observe([pages for pages in pages_to_run if pages]):
        for exercise in todo[key]:
            evidence = page.exercises.get(exercise, Evidence(LOST))
            seed = by_key[key].seeds.get(exercise, 0)
            outcome, trace = judge_and_trace(EXERCISES[exercise], evidence, seed)
            # Who loses workers may have had bad luck; the next run tries that page again.
            stays = evidence.how != LOST
            ledger.add(f"{key}/{exercise}", outcome, stays, trace, page.remarks)
        done += len(todo[key])
        tell(done, total)


# What is judged again.


def named_again(names: Iterable[str], collection: Collection, pages: Iterable[CoursePage]) -> Again:
    """Return what somebody names to be judged again.

    Args:
        names: The id or the name of a learner, an exercise such as `03a`, or a page such as `03`.
        collection: What the class handed in.
        pages: The pages that count.

    Raises:
        GradingError: If a name is nobody's, or that of several learners.
    """
    ids = {each.learner for each in collection.submissions}
    learners: dict[str, set[str]] = {}
    for each in collection.submissions:
        for name in (each.learner, each.name):
            learners.setdefault(name.casefold(), set()).add(each.learner)
    exercises: dict[str, set[str]] = {}
    for page in pages:
        for wanted in page.wanted:
            for name in (wanted.exercise, page.number, page.lesson):
                exercises.setdefault(name, set()).add(wanted.exercise)
    found_learners: set[str] = set()
    found_exercises: set[str] = set()
    for name in names:
        plain = name.strip().casefold()
        who = {name} if name in ids else learners.get(plain, set())
        if len(who) > 1:
            raise _several(name, who)
        if not who and plain not in exercises:
            raise _nobody(name, [*learners, *exercises])
        found_learners |= who
        found_exercises |= exercises.get(plain, set())
    return Again(frozenset(found_learners), frozenset(found_exercises))


_UNCHANGED = "Nothing was judged again; all results are as they were."


def _several(name: str, learners: Iterable[str]) -> GradingError:
    ids = ", ".join(printable(learner) for learner in sorted(learners))
    return GradingError(
        f"{printable(name)!r} is the name of several learners.",
        _UNCHANGED,
        f"Name the learner by the id, as in the column `learner` of grades.csv: {ids}.",
    )


def _nobody(name: str, known: Sequence[str]) -> GradingError:
    near = get_close_matches(name.strip().casefold(), known, 3, 0.5)
    meant = f"Did you mean {' or '.join(map(printable, near))}? " if near else ""
    return GradingError(
        f"This class has neither a learner nor an exercise {printable(name)!r}.",
        _UNCHANGED,
        f"{meant}`grades.csv` has the ids of all learners, and all exercises.",
    )


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
        cause=cause_of(outcome, is_tried=answer.is_tried),
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


def cause_of(outcome: Outcome, *, is_tried: bool = True) -> str:
    """Return why an outcome has its points, one sentence for a table.

    Args:
        outcome: The outcome.
        is_tried: Whether its cells are not as they were released.
    """
    if outcome.status == PASSED:
        missing = [one for one in outcome.parts if not one.met]
        said = "".join(f" Optional, and missing: {one.id} {one.text}" for one in missing)
        return printable(f"It does what is {'required' if missing else 'asked'}.{said}", 400)
    if outcome.status == NOT_ATTEMPTED:
        is_told = is_tried or outcome.evidence == NOT_THERE
        return (is_told and outcome.evidence) or "Nothing was tried yet."
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

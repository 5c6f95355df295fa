"""Judge a class: from its submissions to its gradebook, and what is held for a person.

Answers that agree in everything that affects the result are observed once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.answers import NOT_THERE, Answer, answers_on
from rosbeat.grading.files import printable
from rosbeat.grading.jobs import LOST, Evidence, Job
from rosbeat.grading.judging import WATCHER_LOST, judge_and_trace, untouched
from rosbeat.grading.ledger import Ledger, key_of
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark, Points, Solution, scaled
from rosbeat.grading.notebook import Cell, CoursePage
from rosbeat.grading.remarks import REACHES_INSIDE, Remark
from rosbeat.grading.submissions import Collection, HandedIn, Submission
from rosbeat.records import Outcome

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

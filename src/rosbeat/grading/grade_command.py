"""`rosbeat grade`: from a folder of submissions to a folder of results."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager

from rosbeat.errors import CommandError, StoppedError
from rosbeat.grading.checkout import choose_pages, find_checkout
from rosbeat.grading.cluster import Cluster
from rosbeat.grading.collecting import Collection, collect
from rosbeat.grading.course_pages import CoursePage, course_pages
from rosbeat.grading.deadlines import read_due
from rosbeat.grading.grade_class import Observe, Plan, grade
from rosbeat.grading.grade_options import DEFAULT_ASSIGNMENT
from rosbeat.grading.jobs import Job, Observed
from rosbeat.grading.judging import WATCHER_LOST
from rosbeat.grading.last_run import changes, note_options
from rosbeat.grading.ledger import FILE as LEDGER
from rosbeat.grading.ledger import Ledger, course_version
from rosbeat.grading.manual import FILE as MANUAL
from rosbeat.grading.manual import apply_manual, read_manual
from rosbeat.grading.notebook import Cell, read_notebook
from rosbeat.grading.pool import Pool
from rosbeat.grading.progress_bar import progress_bar
from rosbeat.grading.results import previous_results, require_folder, summary, write_results
from rosbeat.grading.review import review
from rosbeat.grading.submissions import require_apart, require_submissions
from rosbeat.grading.unchanged import remember
from rosbeat.grading.weights import Points, read_points, without_effect

_WARNING = (
    "Warning: --unsafe-no-sandbox lets strangers' programs do here whatever you may do: read and\n"
    "change your files, use the network. Only limits on time and memory are left."
)


def run(options: argparse.Namespace) -> int:
    """Grade what was handed in, and write all results.

    Args:
        options: What `grade_arguments` has declared.

    Raises:
        GradingError: If the submissions cannot be read, no sandbox can be made, or the results
            cannot be written.
        StoppedError: If a person stops it.
    """
    require_folder(options.out)
    require_apart(options.submissions, options.out)
    every = course_pages(find_checkout() / "notebooks")
    pages = choose_pages(every, options.lessons)
    typed = _deciding(options, pages)
    pages = tuple(page for page in pages if page.wanted)
    points = read_points(options.points) if options.points else Points()
    manual = read_manual(options.out / MANUAL)
    due = read_due(options.due) if options.due else None
    # With all pages: what is another page must not be taken for one of those that count.
    collection = collect(options.submissions, every, due)
    require_submissions(options.submissions, collection, bool(options.lessons))
    if not options.lessons:
        pages = handed_in(collection, pages)
    _tell_first(options, typed, without_effect(points, [page.number for page in pages]))
    plan = Plan(pages, course_version(), points, options.sample, _solved(pages))
    with _goes_on() as count, Ledger(options.out / LEDGER) as ledger, progress_bar() as tell:

        def told(done: int, total: int) -> None:
            count(done, total)
            tell(done, total)

        judged = grade(collection, plan, ledger, _observer(options), told)
    gradebook = apply_manual(judged, manual, previous_results(options.out))
    write_results(options.out, gradebook, options.assignment)
    note_options(options.out, typed)
    said = summary(gradebook, options.out)
    print(said)
    if not any(mark.evidence == WATCHER_LOST for one in gradebook.learners for mark in one.marks):
        remember(options, said)
    if options.review:
        review(
            options.out, judged, lambda book: write_results(options.out, book, options.assignment)
        )
    return 0


def _solved(pages: Iterable[CoursePage]) -> dict[str, tuple[Cell, ...]]:
    """Read the published solutions of pages; a checkout may have none."""
    folder = find_checkout() / "solutions"
    paths = {page.lesson: folder / f"{page.lesson}.ipynb" for page in pages}
    return {
        lesson: read_notebook(path.read_bytes()).cells
        for lesson, path in paths.items()
        if path.is_file()
    }


def _deciding(options: argparse.Namespace, pages: Iterable[CoursePage]) -> dict[str, str]:
    """The options that decide about results; without one of them, other marks come out."""
    lessons = " ".join(page.number for page in pages) if options.lessons else ""
    found = {
        **{"lessons": lessons, "points": options.points, "due": options.due},
        "assignment": options.assignment if options.assignment != DEFAULT_ASSIGNMENT else "",
    }
    return {name: str(value) for name, value in found.items() if value}


def _tell_first(options: argparse.Namespace, typed: dict[str, str], points: str) -> None:
    """What to know while there is time to stop."""
    unsafe = _WARNING if options.unsafe_no_sandbox else ""
    for line in (changes(options.out, typed), points, unsafe):
        if line:
            print(line, file=sys.stderr)


@contextmanager
def _goes_on() -> Iterator[Callable[[int, int], None]]:
    """Whoever stops the judging hears what is kept; yields what is told how far it is."""
    far = [0, 0]

    def count(done: int, total: int) -> None:
        far[:] = done, total

    try:
        yield count
    except KeyboardInterrupt:
        kept = f"{far[0] or 'None'} of {far[1]} answers are judged and kept"
        raise StoppedError(
            "interrupted.",
            f"{kept}; the results are as they were before." if far[1] else "Nothing was judged.",
            "Type the same command again, with the same options: it goes on from there.",
        ) from None


def handed_in(collection: Collection, pages: Iterable[CoursePage]) -> tuple[CoursePage, ...]:
    """The pages that anybody has handed in: those count if none were named."""
    found = {page.page for one in collection.submissions for page in one.pages}
    return tuple(page for page in pages if page.lesson in found)


def _observer(options: argparse.Namespace) -> Observe:
    """What has jobs done; workers start only if there is something to do."""
    if options.scheduler and options.unsafe_no_sandbox:
        raise CommandError(
            "--unsafe-no-sandbox does not go with --scheduler.",
            "Without a sandbox, strangers' programs could reach every machine of the cluster.",
            "Leave out one of them.",
        )

    def observe(jobs: Iterable[tuple[str, Job]]) -> Iterator[tuple[str, Observed]]:
        with (
            Cluster(options.scheduler)
            if options.scheduler
            else Pool(options.workers, options.unsafe_no_sandbox)
        ) as pool:
            yield from pool.observe(jobs)

    return observe

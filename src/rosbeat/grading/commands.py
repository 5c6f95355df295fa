"""Run `rosbeat release`, `rosbeat collect` and `rosbeat grade`.

The exit codes of `rosbeat grade` are part of the interface: 0 all answers are marked, 1 nothing was
done, 2 usage error, 3 all results are written but something needs a person, 130 stopped.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from io import StringIO
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeRemainingColumn,
)
from rich.table import Table
from rich.text import Text

from rosbeat.errors import (
    CommandError,
    GradingError,
    RecordError,
    StoppedError,
    SubmissionError,
)
from rosbeat.grading.files import printable, write_whole
from rosbeat.grading.ledger import FILE as LEDGER
from rosbeat.grading.ledger import Ledger, course_version, new_seed, seed_of
from rosbeat.grading.lock import alone_in
from rosbeat.grading.manual_marks import FILE as MANUAL
from rosbeat.grading.manual_marks import apply_manual, read_manual
from rosbeat.grading.marks import HELD, Gradebook, Points, read_points
from rosbeat.grading.one_submission import FORMS
from rosbeat.grading.platforms.autograders import AUTOGRADERS
from rosbeat.grading.release import Released, catches_up, release
from rosbeat.grading.remarks import Remark
from rosbeat.grading.results import RESULTS, summary, write_results
from rosbeat.grading.review import review
from rosbeat.grading.roster import with_dates, with_details
from rosbeat.grading.run import Again, Observe, Plan, Tell, grade, named_again
from rosbeat.grading.submissions import (
    Collection,
    HandedIn,
    Submission,
    collect,
    require_apart,
    require_submissions,
)
from rosbeat.page_runs.jobs import PageEvidence, PageJob
from rosbeat.page_runs.notebook import Cell, CoursePage, course_pages, read_notebook
from rosbeat.page_runs.pool import Pool
from rosbeat.records_json import from_json, to_json
from rosbeat.viz.text_format import count
from rosbeat.workspace.location import course_root

#: Exit codes: nothing was done; all is written, and something waits for a person.
NOTHING_DONE, WAITS = 1, 3
#: Names that are printed of a list.
_MOST_NAMED = 20


def find_checkout() -> Path:
    """Return the checkout that this package was installed from.

    Raises:
        GradingError: If it was installed without one.
    """
    root = course_root()
    if root is None:
        raise GradingError(
            "The course's own pages are not there.",
            "This rosbeat was installed without them, and everything here begins with them.",
            "Run the command in a checkout of the course:  ./environment/course shell",
        )
    return root


def choose_pages(pages: Sequence[CoursePage], names: Iterable[str]) -> tuple[CoursePage, ...]:
    """Return the pages that somebody names, in the order of the course.

    Args:
        pages: The pages of the course.
        names: Such as `03`, `3`, `03_write_a_publisher` or the name of the page's file; none means
            all pages.

    Raises:
        GradingError: If a name fits no page.
    """
    wanted = {_named(pages, name).lesson for name in names}
    return tuple(page for page in pages if not wanted or page.lesson in wanted)


def _named(pages: Sequence[CoursePage], name: str) -> CoursePage:
    stem = Path(name.strip()).name.removesuffix(".ipynb")
    numbers = {stem, stem.zfill(2)} if stem.isdecimal() else set()
    for page in pages:
        if stem == page.lesson or page.number in numbers:
            return page
    raise GradingError(
        f"There is no page {printable(name)!r}.",
        f"The pages are {', '.join(page.number for page in pages)}.",
        "Name them by their numbers:  --lessons 03 04",
    )


# `rosbeat release`.

_TO_BEGIN_WITH = """\
Pages from 05 on begin with the package of page 02 and the nodes of pages 03 and 04. So these are
part of it, in src/rosbeat/workspace/finished; they show one answer to exercise 02a."""


def run_release(options: argparse.Namespace) -> int:
    """Make what learners get, and say what was done.

    Raises:
        GradingError: If the release cannot be made.
    """
    root = find_checkout()
    pages = choose_pages(course_pages(root / "notebooks"), options.lessons)
    chosen = pages if options.lessons else ()
    done = release(root, options.folder, chosen, options.points, options.github)
    print("\n".join(_told(done, options.folder)))
    return 0


def _told(done: Released, folder: Path) -> Iterator[str]:
    """Yield what a release has done, in words."""
    numbers = ", ".join(page.number for page in done.pages)
    yield f"{printable(str(folder), 1000)} has the pages {numbers}, without answers."
    counts = (("written", done.written), ("removed", done.removed))
    said = [f"{len(names)} files {word}" for word, names in counts if names]
    yield f"{', '.join([*said, f'{done.same} were up to date'])}."
    if done.kept:
        yield "Somebody has changed these files, so they stay as they are:"
        yield from (f"    {printable(name)}" for name in done.kept[:_MOST_NAMED])
        more = len(done.kept) - _MOST_NAMED
        yield from [f"    and {more} more"] if more > 0 else []
    if catches_up(done.pages):
        yield _TO_BEGIN_WITH
    yield f"Try it:  {printable(str(folder / 'environment' / 'course'), 1000)} lab"


# `rosbeat collect`.

#: The version of the JSON.
_VERSION = 2
#: Characters of a name in the table; the JSON has all of them.
_NAME = 30


def run_collect(options: argparse.Namespace) -> int:
    """Say who handed in what, and everything that is worth knowing about the files.

    Raises:
        GradingError: If there is nothing that could be submissions.
    """
    pages = course_pages(find_checkout() / "notebooks")
    asked = choose_pages(pages, options.lessons)
    found = collect(options.submissions, pages)
    require_submissions(options.submissions, found)
    found = with_dates(found, options.roster, options.due)
    if not options.lessons:
        asked = handed_in(found, pages)
    print(_as_json(found) if options.json else "\n".join(_as_text(found, asked)))
    return 0


def handed_in(found: Collection, pages: Iterable[CoursePage]) -> tuple[CoursePage, ...]:
    """Return the pages that anybody handed in: those count if none were named."""
    there = {page.page for one in found.submissions for page in one.pages}
    return tuple(page for page in pages if page.lesson in there)


def _as_text(found: Collection, pages: Sequence[CoursePage]) -> Iterator[str]:
    """Yield a table of who handed in what, and a list of all remarks."""
    remarks = [*found.remarks, *(one for each in found.submissions for one in each.remarks)]
    if found.submissions:
        yield from (*_table(found, pages), "")
    yield _total(found, pages, len(remarks))
    yield from [""] if remarks else []
    for one in remarks:
        yield f"{one.about}: {one.path}"
        yield f"    {printable(one.text, 1000)}"


def _table(found: Collection, pages: Sequence[CoursePage]) -> Iterator[str]:
    table = Table(box=None, pad_edge=False, header_style="")
    for head in ("learner", "name"):
        table.add_column(head, no_wrap=True)
    for page in pages:
        table.add_column(page.number)
    table.add_column("remarks", justify="right")
    for one in found.submissions:
        table.add_row(*(Text(cell) for cell in _row(one, pages)))
    target = StringIO()
    # As wide as it needs to be, so that it can be searched and piped; without colours.
    Console(file=target, width=2_000, color_system=None, highlight=False).print(table)
    yield from (line.rstrip() for line in target.getvalue().splitlines())


def _row(one: Submission, pages: Sequence[CoursePage]) -> list[str]:
    handed = {page.page: page for page in one.pages}
    name = printable(one.name, _NAME) if one.name != one.learner else ""
    cells = [_cell(handed.get(page.lesson)) for page in pages]
    return [printable(one.learner, _NAME), name, *cells, str(len(one.remarks) or "")]


def _cell(page: HandedIn | None) -> str:
    if page is None:
        return "-"
    words = ["late"] if page.late else []
    if page.notebook.problem:
        words.append("unreadable")
    return ", ".join(words) or "yes"


def _total(found: Collection, pages: Sequence[CoursePage], remarks: int) -> str:
    asked = {page.lesson for page in pages}
    counts = Counter(page.page for one in found.submissions for page in one.pages)
    there = sum(counts[page] for page in asked)
    nobody = sum(not one.pages for one in found.submissions)
    parts = [f"{count(len(found.submissions), 'learner')}, {count(there, 'page')}"]
    parts += [f"{count(nobody, 'learner')} without any page"] if nobody else []
    others = sum(counts.values()) - there
    parts += [f"{count(others, 'page')} that you did not ask for"] if others else []
    return f"{', '.join(parts)}, {count(remarks, 'remark')}."


def _as_json(found: Collection) -> str:
    learners = [
        {
            **{"learner": one.learner, "name": one.name, "system": one.system},
            **{"pages": [_page(page) for page in one.pages], "remarks": one.remarks},
        }
        for one in found.submissions
    ]
    said = {"version": _VERSION, "learners": learners, "remarks": found.remarks}
    return to_json(said, indent=1)


def _page(page: HandedIn) -> dict[str, Any]:
    return {
        **{"page": page.page, "path": page.path, "late": page.late, "modified": page.modified},
        **{"cells": len(page.notebook.cells), "problem": page.notebook.problem},
    }


# `rosbeat grade`.

_UNSAFE = (
    "Warning: --unsafe-no-sandbox lets strangers' programs do here whatever you may do: read and\n"
    "change your files, use the network. Only limits on time and memory are left."
)
#: How what came of one submission is printed.
_FORMS = {**FORMS, **AUTOGRADERS}
#: Remarks about a line that somebody wrote.
_FOR_A_PERSON = ("manual", "roster")


def run_grade(options: argparse.Namespace) -> int:
    """Grade what was handed in, by a class or by one learner, and write all results.

    Returns:
        The exit code: 0, or `WAITS`.

    Raises:
        CommandError: If options do not go together.
        GradingError: If the submissions cannot be read, no sandbox can be made, or the results
            cannot be written.
        StoppedError: If a person stops it.
    """
    _require_consistent(options)
    if options.out:
        require_apart(options.submissions, options.out)
    every = course_pages(find_checkout() / "notebooks")
    pages = choose_pages(every, options.lessons)
    typed = _deciding(options, pages)
    points = read_points(options.points) if options.points else Points()
    if options.out:
        read_manual(options.out / MANUAL)  # what is refused, is refused before anything is judged
    found = _collected(options, every)
    pages = pages if options.lessons else handed_in(found, pages)
    pages = tuple(page for page in pages if page.wanted)
    plan = Plan(pages, course_version(), points, excuses=options.missing == "empty")
    if not options.out and not found.is_one:
        raise CommandError(
            "--out is missing.",
            f"{count(len(found.submissions), 'learner')} handed in here, and the results of a "
            "class go into a folder.",
            "Name a folder for them:  --out ~/class/grades",
        )
    if options.unsafe_no_sandbox:
        print(_UNSAFE, file=sys.stderr)
    if options.out:
        plan = replace(plan, again=_again(options, found, pages), solved=_solved(pages))
        return _grade_into(options, found, plan, typed)
    book = _judged(found, replace(plan, seed=new_seed()), Ledger(None), options)
    code = WAITS if _waiting(book) else 0
    print(_FORMS[options.format].result(book, code))
    return code


def _collected(options: argparse.Namespace, pages: Sequence[CoursePage]) -> Collection:
    """Return what was handed in; whatever an autograder's platform gives is one learner's.

    Args:
        options: What was typed.
        pages: All of the course: another page must not be taken for one of those that count.
    """
    found = collect(options.submissions, pages, options.format in AUTOGRADERS)
    try:
        require_submissions(options.submissions, found)
    except SubmissionError as error:
        # A program, or a learner on the platform of an autograder, reads no error message.
        refusal = _FORMS[options.format].refusal(error, NOTHING_DONE)
        print(refusal, end="\n" if refusal else "")
        raise
    return with_dates(found, options.roster, options.due, options.late)


def _grade_into(options: argparse.Namespace, found: Collection, plan: Plan, typed: Typed) -> int:
    """Judge a class, write all results and return the exit code, while nobody else does."""
    changed = changes(options.out, typed)
    print(changed, file=sys.stderr, end="\n" if changed else "")
    with alone_in(options.out, partial(print, file=sys.stderr, flush=True)):
        ledger = Ledger(options.out / LEDGER, takes_earlier=bool(options.only))
        plan = replace(plan, seed=seed_of(options.out))
        judged = with_details(_judged(found, plan, ledger, options), found)
        gradebook = apply_manual(judged, read_manual(options.out / MANUAL))
        write_results(options.out, gradebook, options.assignment)
        note_options(options.out, typed)
        code = WAITS if _waiting(gradebook) else 0
        print(_told_of(gradebook, found, options, code))
        if options.review:
            write = partial(write_results, options.out, assignment=options.assignment)
            review(options.out, judged, write)
        return code


def _told_of(book: Gradebook, found: Collection, options: argparse.Namespace, code: int) -> str:
    if found.is_one and len(book.learners) == 1:  # a roster may have brought others
        return _FORMS[options.format].result(book, code)
    if options.format == "json":
        return _summary_json(book, options.out, code)
    return summary(book, options.out)


def _again(options: argparse.Namespace, found: Collection, pages: Sequence[CoursePage]) -> Again:
    """Return what is judged again, of a class that is graded already."""
    if options.only and not (options.out / RESULTS).is_file():
        raise GradingError(
            f"{printable(str(options.out), 1000)} has no results yet.",
            "`--only` judges a part of a class again; the others keep the marks that they have.",
            "Grade the whole class first: the same command without `--only`.",
        )
    return named_again(options.only, found, pages)


def _solved(pages: Iterable[CoursePage]) -> dict[str, tuple[Cell, ...]]:
    """Read the published solutions of pages; a checkout may have none."""
    folder = find_checkout() / "solutions"
    paths = {page.lesson: folder / f"{page.lesson}.ipynb" for page in pages}
    return {
        lesson: read_notebook(path.read_bytes()).cells
        for lesson, path in paths.items()
        if path.is_file()
    }


def _require_consistent(options: argparse.Namespace) -> None:
    if options.scheduler and options.unsafe_no_sandbox:
        raise CommandError(
            "--unsafe-no-sandbox does not go with --scheduler.",
            "Without a sandbox, strangers' programs could reach every machine of the cluster.",
            "Leave out one of them.",
        )
    needing = [name for name in ("roster", "only", "review") if getattr(options, name)]
    if needing and not options.out:
        raise CommandError(
            f"--{needing[0]} needs --out.",
            "It concerns a class, whose results are in a folder.",
            "Name that folder:  --out ~/class/grades",
        )
    if options.late and not options.due:
        raise CommandError(
            "--late needs --due.",
            "Without a deadline, nothing is late.",
            'Give both:  --due "2026-11-30 18:00" --late "10%/day"',
        )


def _judged(
    found: Collection, plan: Plan, ledger: Ledger, options: argparse.Namespace
) -> Gradebook:
    far = [0, 0]
    with ledger, _progress(far) as tell:
        try:
            return grade(found, plan, ledger, _observer(options), tell)
        except KeyboardInterrupt:
            kept = f"{far[0] or 'None'} of {far[1]} answers are judged and kept"
            means = f"{kept}; the results are as they were before."
            goes_on = "Type the same command again, with the same options: it goes on from there."
            if not options.out:
                means, goes_on = "Without --out, nothing is kept.", "Type the command again."
            raise StoppedError(
                "stopped.", means if far[1] else "Nothing was judged.", goes_on
            ) from None


@contextmanager
def _progress(far: list[int]) -> Iterator[Tell]:
    """Show how many answers are to be judged, and on a terminal a bar with the time that is left.

    Args:
        far: Gets how many are judged, of how many.
    """
    console = Console(stderr=True, highlight=False)
    columns = (TextColumn("judging"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal) as shown:
        task = shown.add_task("", visible=False)

        def tell(done: int, total: int) -> None:
            if done < total and not far[1]:
                earlier = f", {done} of them judged already" if done else ""
                console.print(f"{count(total, 'different answer')}{earlier}.")
            far[:] = done, total
            shown.update(task, completed=done, total=total, visible=True)

        yield tell


def _observer(options: argparse.Namespace) -> Observe:
    """Return what has jobs done; workers start only if there is something to do."""

    def observe(
        submissions: Sequence[Sequence[tuple[str, PageJob]]],
    ) -> Iterator[tuple[str, PageEvidence]]:
        if options.scheduler:
            from rosbeat.grading.cluster import Cluster  # it needs Dask, which few have

            made: Cluster | Pool = Cluster(options.scheduler)
        else:
            most = min(os.cpu_count() or 1, len(submissions))
            made = Pool(options.workers or most, options.unsafe_no_sandbox)
        with made as pool:
            yield from pool.observe(submissions)

    return observe


def _waiting(gradebook: Gradebook) -> bool:
    marks = [mark for one in gradebook.learners for mark in one.marks]
    waiting = any(mark.status == HELD or (mark.differs and not mark.manual) for mark in marks)
    return waiting or any(one.about in _FOR_A_PERSON for one in gradebook.remarks)


def _summary_json(gradebook: Gradebook, out: Path, code: int) -> str:
    """Return what has come out, for programs; in ASCII, so that it can be printed anywhere."""
    marks = [(one, mark) for one in gradebook.learners for mark in one.marks]
    remarks: list[Remark] = [one for each in gradebook.learners for one in each.remarks]
    held = [
        {"learner": one.learner, "exercise": mark.exercise, "why": mark.cause, "file": mark.file}
        for one, mark in marks
        if mark.status == HELD
    ]
    graded = [one.points for one in gradebook.with_a_grade]
    said = {
        **{"version": _VERSION, "exit": code, "out": str(out), "course": gradebook.course},
        **{"learners": len(gradebook.learners), "graded": len(graded)},
        "out_of": max((one.out_of for one in gradebook.learners), default=0.0),
        "average": round(sum(graded) / len(graded), 2) if graded else None,
        "marks": dict(sorted(Counter(mark.status for _, mark in marks).items())),
        "held": held,
        "lines": [one for one in gradebook.remarks if one.about in _FOR_A_PERSON],
        "files": dict(sorted(Counter(one.about for one in remarks).items())),
    }
    return to_json(said, indent=1)


# How a class was graded the last time, so that an option that was left out is noticed.

LAST_RUN = "last_run.json"
#: Options by their names without hyphens; what was left out is not among them.
Typed = Mapping[str, str]


@dataclass(frozen=True)
class _LastRun:
    """Hold how a class was graded."""

    options: dict[str, str]


def _deciding(options: argparse.Namespace, pages: Iterable[CoursePage]) -> dict[str, str]:
    """Return the options that decide about results; without one of them, marks differ."""
    lessons = " ".join(page.number for page in pages) if options.lessons else ""
    found = {
        **{"lessons": lessons, "points": options.points, "due": options.due, "late": options.late},
        **{"roster": options.roster, "missing": options.missing.replace("zero", "")},
        "assignment": "" if options.assignment == "rosbeat" else options.assignment,
    }
    return {name: str(value) for name, value in found.items() if value}


def note_options(out: Path, typed: Typed) -> None:
    """Write down how this run was started, once its results are written.

    Raises:
        GradingError: If it cannot be written.
    """
    run = _LastRun(dict(sorted(typed.items())))
    write_whole(out / LAST_RUN, f"{to_json(run, indent=1)}\n")


def changes(out: Path, typed: Typed) -> str:
    """Say in one line which options differ from those of the last time.

    Returns:
        The line; empty if all is the same, or it is not known how the last time was.
    """
    try:
        before = from_json(_LastRun, (out / LAST_RUN).read_bytes(), "options").options
    except (OSError, RecordError):
        return ""
    differ = [name for name in sorted({*before, *typed}) if before.get(name) != typed.get(name)]
    if not differ:
        return ""
    return (
        f"Other options than last time! Last time: {_shown(before, differ) or 'without them'}; "
        f"now {_shown(typed, differ) or 'without'}. Marks may change."
    )


def _shown(typed: Typed, names: list[str]) -> str:
    """Return the options of these names as one would type them; safe to print."""
    found = [f"--{name} {_word(typed[name])}" for name in names if name in typed]
    return printable(", ".join(found), 1000)


def _word(value: str) -> str:
    return value if value.replace(" ", "").isdigit() else shlex.quote(value)

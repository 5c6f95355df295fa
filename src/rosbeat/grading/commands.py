"""`rosbeat release` and `rosbeat collect`; what they need is imported when they run."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rosbeat.grading.grade_options import DUE

if TYPE_CHECKING:
    from rosbeat.grading.release import Released

#: Names that are printed of a list.
_MOST_NAMED = 20
_TO_BEGIN_WITH = """\
Pages from 05 on begin with the package of page 02 and the nodes of pages 03 and 04. So these are
part of it, in src/rosbeat/workspace/finished; they show one answer to exercise 02a."""


def release_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat release`."""
    add = parser.add_argument
    add("folder", type=Path, metavar="DIR", help="a new folder, or an earlier release")
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="03, a name (default: all pages)")
    add("--points", type=Path, metavar="FILE", help="a CSV file with exercise,points")


def run_release(options: argparse.Namespace) -> int:
    """Make what learners get, and say what was done.

    Args:
        options: What `release_arguments` has declared.

    Returns:
        The exit code.

    Raises:
        GradingError: If the release cannot be made.
    """
    from rosbeat.grading.checkout import choose_pages, find_checkout
    from rosbeat.grading.course_pages import course_pages
    from rosbeat.grading.release import release

    root = find_checkout()
    pages = choose_pages(course_pages(root / "notebooks"), options.lessons)
    chosen = pages if options.lessons else ()
    print(_told(release(root, options.folder, chosen, options.points), options.folder))
    return 0


def _told(done: Released, folder: Path) -> str:
    """What a release has done, in words."""
    from rosbeat.grading.release_files import catches_up
    from rosbeat.grading.remarks import printable

    numbers = ", ".join(page.number for page in done.pages)
    lines = [f"{printable(str(folder), 1000)} has the pages {numbers}, without answers."]
    counts = (("written", done.written), ("taken away", done.removed))
    said = [f"{len(names)} files {word}" for word, names in counts if names]
    lines.append(f"{', '.join([*said, f'{done.same} were up to date'])}.")
    if done.kept:
        lines.append("Somebody has changed these files, so they stay as they are:")
        lines += [f"    {printable(name)}" for name in done.kept[:_MOST_NAMED]]
        more = len(done.kept) - _MOST_NAMED
        lines += [f"    and {more} more"] if more > 0 else []
    if catches_up(done.pages):
        lines.append(_TO_BEGIN_WITH)
    lines.append(f"Try it:  {printable(str(folder / 'environment' / 'course'), 1000)} lab")
    return "\n".join(lines)


def collect_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what is typed after `rosbeat collect`."""
    add = parser.add_argument
    add("submissions", type=Path, metavar="SUBMISSIONS", help="a folder or a zip file")
    add("--due", metavar="WHEN", help=DUE)
    add("--lessons", nargs="+", default=(), metavar="PAGE", help="03, a name (default: all pages)")
    add("--json", action="store_true", help="the same as JSON, for programs")


def run_collect(options: argparse.Namespace) -> int:
    """Say who handed in what, and everything that is worth knowing about the files.

    Args:
        options: What `collect_arguments` has declared.

    Returns:
        The exit code: 0, whatever was handed in.

    Raises:
        GradingError: If there is nothing that could be submissions.
    """
    from rosbeat.grading.checkout import choose_pages, find_checkout
    from rosbeat.grading.collected import as_json, as_text
    from rosbeat.grading.collecting import collect
    from rosbeat.grading.course_pages import course_pages
    from rosbeat.grading.deadlines import read_due
    from rosbeat.grading.submissions import require_submissions

    due = read_due(options.due) if options.due else None
    pages = course_pages(find_checkout() / "notebooks")
    asked = choose_pages(pages, options.lessons)
    found = collect(options.submissions, pages, due)
    require_submissions(options.submissions, found, pages_named=True)
    if not options.lessons:
        handed = {page.page for one in found.submissions for page in one.pages}
        asked = tuple(page for page in pages if page.lesson in handed)
    print(as_json(found) if options.json else as_text(found, asked))
    return 0

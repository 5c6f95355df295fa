"""What `rosbeat build` does: every page from its source, compared or written."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from rosbeat.authoring import pages
from rosbeat.authoring.files import Change, compare, stale_pages, write
from rosbeat.authoring.keeping import keep_work
from rosbeat.authoring.lint import check_lessons
from rosbeat.authoring.package import package_files, stale_files
from rosbeat.authoring.solved import answer_files
from rosbeat.authoring.source import Course, Lesson, choose
from rosbeat.authoring.together import solutions
from rosbeat.errors import LessonError


@dataclass(frozen=True)
class Plan:
    """What to build.

    Attributes:
        names: Lessons by number, name or file; none means all.
        check: Compare only; nothing on disk changes.
        run: Build the solution pages too, which means running them.
        fresh: Store new outputs where outputs are not compared, too.
        points: What each exercise is worth, by its id; nbgrader is told so.
    """

    names: tuple[str, ...] = ()
    check: bool = False
    run: bool = True
    fresh: bool = False
    points: Mapping[str, int] = field(default_factory=dict)


def build(course: Course, plan: Plan, tell: Callable[[str], None] = print) -> list[Change]:
    """Build pages, and report each one that differed from what was on disk.

    Args:
        course: Where the sources and the pages are.
        plan: What to build.
        tell: Gets one line of progress per page.

    Raises:
        LessonError: A lesson breaks a rule, or a page does not run.
    """
    lessons = course.lessons()
    chosen = choose(lessons, list(plan.names))
    _refuse_findings(course, lessons, chosen)
    changes = []
    package = {**package_files(course, lessons), **answer_files(course, lessons)}
    # The package first: a page that runs may need what an earlier page saves.
    for path, content in package.items():
        changes += _derive(course, path, content, plan, tell)
    runs = solutions(chosen if plan.run else [], course.solutions, plan.fresh, plan.points)
    with runs as solution:
        for path, make in _pages(course, chosen, plan, solution):
            changes += _derive(course, path, make(), plan, tell)
    for change in [] if plan.names else _all_stale(course, lessons, package, plan.check):
        tell(_line(course, change.path, change))
        changes.append(change)
    return changes


def _derive(
    course: Course, path: Path, content: bytes, plan: Plan, tell: Callable[[str], None]
) -> list[Change]:
    change = compare(path, content)
    if change or path.suffix == ".ipynb":
        tell(_line(course, path, change))
    if change and not plan.check:
        _replace(course, path, content, tell)
    return [change] if change else []


Make = Callable[[], bytes]


def _refuse_findings(course: Course, lessons: list[Lesson], chosen: list[Lesson]) -> None:
    findings = check_lessons(course, lessons, chosen)
    if findings:
        raise LessonError(
            "\n".join(str(finding) for finding in findings),
            f"{len(findings)} rules of the lessons are broken, so nothing was built.",
            "Mend them one by one; `rosbeat lint` shows them without building.",
        )


def _pages(
    course: Course, chosen: list[Lesson], plan: Plan, solution: Callable[[Lesson], bytes]
) -> Iterator[tuple[Path, Make]]:
    for lesson in chosen:
        file = f"{lesson.name}.ipynb"
        yield course.notebooks / file, partial(_notebook, lesson, plan.points)
        if plan.run:
            yield course.solutions / file, partial(solution, lesson)


def _notebook(lesson: Lesson, points: Mapping[str, int]) -> bytes:
    return pages.to_bytes(pages.notebook_page(lesson, points))


def _replace(course: Course, path: Path, content: bytes, tell: Callable[[str], None]) -> None:
    # What is in solutions/ came from the builder, outputs and all; only notebooks/ holds work.
    kept = keep_work(path) if path.parent == course.notebooks else None
    if kept:
        tell(f"kept     {kept.relative_to(course.root)}: somebody had worked in this page")
    write(path, content)


def _line(course: Course, path: Path, change: Change | None) -> str:
    return f"{change.kind if change else 'same':8} {path.relative_to(course.root)}"


def _all_stale(
    course: Course, lessons: list[Lesson], package: Iterable[Path], check: bool
) -> Iterator[Change]:
    yield from _stale(course, lessons, check)
    yield from _stale_package(course, package, check)


def _stale(course: Course, lessons: list[Lesson], check: bool) -> Iterator[Change]:
    names = {lesson.name for lesson in lessons}
    for folder in (course.notebooks, course.solutions):
        for path in stale_pages(folder, names):
            if not check:
                if folder == course.notebooks:
                    keep_work(path)
                path.unlink()
            yield Change(path, "stale")


def _stale_package(course: Course, package: Iterable[Path], check: bool) -> Iterator[Change]:
    for path in stale_files(course, package):
        if not check:
            path.unlink()
        yield Change(path, "stale")

"""Compare or write everything that is derived from the lessons, for `rosbeat build`.

The derived files are both trees of pages, `solutions/sensor_simulator/` (the final content of a
learner's workspace), the files that `workspace.catch_up` adds where they are missing, and the
answers that `hint` gives last.
"""

from __future__ import annotations

import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from rosbeat.authoring import pages
from rosbeat.authoring.lint import check_lessons
from rosbeat.authoring.source import Course, Lesson, choose, with_answers
from rosbeat.errors import LessonError

#: The finished package.
PACKAGE = "sensor_simulator"
#: Where pages with a learner's work go, beside the page; git ignores it and no test runs it.
KEPT = "kept"
#: Pages that run at once, at most. A page may measure how long things take, and more of them than
#: there are cores would disturb one another.
AT_ONCE = 2

_DIFF_LINES = 40
_LONGEST_LINE = 160
_PICTURE = re.compile(
    rb"(?P<data>data:image/[a-z+]+;base64,)[A-Za-z0-9+/=\\n\s]+"
    rb'|(?P<mime>"image/(?:png|jpeg)": )"[^"]*"'
)
_IN_WORKSPACE = f"src/{PACKAGE}/"
#: Bytecode and the like are no part of a package.
_NOT_FILES = {"__pycache__", ".pytest_cache"}
#: Cannot run: it needs ament_copyright, which is on no registry.
_LEFT_OUT = "test/test_copyright.py"


@dataclass(frozen=True)
class Plan:
    """Choose what to build.

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


@dataclass(frozen=True)
class Change:
    """Describe how a file on disk differs from what its source says.

    Attributes:
        path: The file.
        kind: ``"new"``, ``"changed"`` or ``"stale"``; ``"pictures"`` if only they differ.
        diff: The first lines of a unified diff.
    """

    path: Path
    kind: str
    diff: str = ""

    @property
    def matters(self) -> bool:
        """Tell whether the file says something else, and does not only look different."""
        return self.kind != "pictures"


def build(course: Course, plan: Plan, tell: Callable[[str], None] = print) -> list[Change]:
    """Build pages, and report each file that differed from what was on disk.

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
    derived = {**package_files(course, lessons), **answer_files(course, lessons)}
    changes = []
    for path, content in _contents(course, lessons, chosen, plan, derived):
        change = compare(path, content)
        if change or path.suffix == ".ipynb":
            tell(f"{change.kind if change else 'same':8} {path.relative_to(course.root)}")
        if change and not plan.check:
            _keep_work(course, path, tell)
            if content is None:
                path.unlink()
            else:
                write(path, content)
        changes += [change] if change else []
    return changes


def _refuse_findings(course: Course, lessons: list[Lesson], chosen: list[Lesson]) -> None:
    findings = check_lessons(course, lessons, chosen)
    if findings:
        raise LessonError(
            "\n".join(str(finding) for finding in findings),
            f"{len(findings)} rules of the lessons are broken, so nothing was built.",
            "Mend them one by one; `rosbeat lint` shows them without building.",
        )


def _contents(
    course: Course,
    lessons: list[Lesson],
    chosen: list[Lesson],
    plan: Plan,
    derived: Mapping[Path, bytes],
) -> Iterator[tuple[Path, bytes | None]]:
    """Yield what is to be there; the package first, since a page that runs may need it.

    What is to go comes last, without a content.
    """
    yield from derived.items()
    with _runs(chosen if plan.run else [], lessons, course.solutions, plan) as solution:
        for lesson in chosen:
            page = pages.to_bytes(pages.notebook_page(lesson, plan.points, lessons))
            yield course.notebooks / f"{lesson.name}.ipynb", page
            if plan.run:
                yield course.solutions / f"{lesson.name}.ipynb", solution(lesson)
    yield from ((path, None) for path in ([] if plan.names else _stale(course, lessons, derived)))


@contextmanager
def _runs(
    chosen: Sequence[Lesson], lessons: Sequence[Lesson], folder: Path, plan: Plan
) -> Iterator[Callable[[Lesson], bytes]]:
    """Begin to run solution pages, each in a process and a kernel of its own, in their order.

    Yields:
        A function that waits for a lesson's page, and raises what its run raised.
    """
    make = partial(_solution, folder=folder, lessons=lessons, plan=plan)
    if len(chosen) < 2:
        yield make
        return
    # A fork would take along whatever threads this process has.
    workers = min(AT_ONCE, os.cpu_count() or 1)
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        runs = {one.name: pool.submit(make, one) for one in chosen}
        try:
            yield lambda lesson: runs[lesson.name].result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _solution(lesson: Lesson, folder: Path, lessons: Sequence[Lesson], plan: Plan) -> bytes:
    given = (plan.fresh, plan.points, lessons)
    return pages.to_bytes(pages.solution_page(lesson, folder, *given))


def _stale(course: Course, lessons: list[Lesson], derived: Iterable[Path]) -> list[Path]:
    names = {lesson.name for lesson in lessons}
    stale = [
        one for tree in (course.notebooks, course.solutions) for one in stale_pages(tree, names)
    ]
    folders = (course.solutions / PACKAGE, _finished(course), _solved(course))
    keep = set(derived)
    return stale + [path for folder in folders for path in _files(folder) if path not in keep]


def stale_pages(folder: Path, names: set[str]) -> list[Path]:
    """Find pages in a tree that the builder wrote and whose lesson is not among `names`."""
    gone = [path for path in sorted(folder.glob("*.ipynb")) if path.stem not in names]
    read = ((path, pages.read_page(path)) for path in gone)
    return [
        path
        for path, page in read
        if page and page.metadata.get("rosbeat", {}).get("lesson") == path.stem
    ]


# Comparing and writing.


def compare(path: Path, content: bytes | None) -> Change | None:
    """Compare a file on disk with what it should be; None if they are the same.

    The bytes of a picture depend on the versions of matplotlib and its fonts, which differ between
    the Pythons of the course. So a page of which only pictures differ is told apart.

    Args:
        path: The file.
        content: What it should be; None if it should not be there.
    """
    if content is None:
        return Change(path, "stale")
    if not path.exists():
        return Change(path, "new")
    present = path.read_bytes()
    if present == content:
        return None
    old, new = _without_pictures(present), _without_pictures(content)
    return Change(path, "pictures") if old == new else Change(path, "changed", _diff(old, new))


def _without_pictures(page: bytes) -> bytes:
    """Replace the bytes of every picture by a word; the words that describe it stay."""

    def word(match: re.Match[bytes]) -> bytes:
        return match["data"] + b"picture" if match["data"] else match["mime"] + b'"picture"'

    return _PICTURE.sub(word, page)


def _diff(present: bytes, content: bytes) -> str:
    old, new = (text.decode("utf-8", "replace").splitlines() for text in (present, content))
    lines = list(difflib.unified_diff(old, new, "on disk", "from source", n=1, lineterm=""))
    shown = [line[:_LONGEST_LINE] for line in lines[:_DIFF_LINES]]
    hidden = len(lines) - len(shown)
    return "\n".join([*shown, f"... {hidden} more lines"] if hidden else shown)


def write(path: Path, content: bytes) -> None:
    """Replace a file, or make it and its folder, so that nobody ever reads half of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        # mkstemp makes files private; a page is readable like every other file of the checkout.
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def _keep_work(course: Course, path: Path, tell: Callable[[str], None]) -> None:
    """Copy a learner's page aside before it goes, if somebody has worked in it."""
    # What is in solutions/ came from the builder, outputs and all; only notebooks/ holds work.
    if path.parent != course.notebooks or not path.exists() or not _was_worked_in(path):
        return
    folder = path.parent / KEPT
    folder.mkdir(exist_ok=True)
    number = 1
    while (copy := folder / f"{path.stem}-{number}.ipynb").exists():
        number += 1
    shutil.copy2(path, copy)
    tell(f"kept     {copy.relative_to(course.root)}: somebody had worked in this page")


def _was_worked_in(path: Path) -> bool:
    """Tell whether a page was run: the builder writes outputs and counts for no learner."""
    page = pages.read_page(path)
    if page is None:
        return True
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    return any(cell.outputs or cell.execution_count is not None for cell in code)


# What is derived besides pages.


def answer_files(course: Course, lessons: Iterable[Lesson]) -> dict[Path, bytes]:
    """Return the file and the content of every answer: its cells as the solution page has them."""
    if not _solved(course).parent.is_dir():  # such a course has no package to give hints
        return {}
    texts: dict[str, list[str]] = {}
    for cell in (cell for lesson in lessons for cell in lesson.cells):
        if cell.exercise:
            texts.setdefault(cell.exercise, []).append(with_answers(cell.page_text))
    # The parts of an exercise in several cells stand as far apart as classes in a file.
    files = {name: "\n\n\n".join(parts) + "\n" for name, parts in texts.items()}
    return {_solved(course) / f"{name}.txt": text.encode() for name, text in files.items()}


def package_files(course: Course, lessons: Iterable[Lesson]) -> dict[Path, bytes]:
    """Return the files of the finished package, and those of them that pages save.

    `ros2 pkg create` makes the package, the lessons' cells that save a file replace what they
    replace on the pages, and the tests, which no page writes, come from `src/lessons/`.

    Args:
        course: Where they belong.
        lessons: All lessons of the course; without a cell that saves a file there is no package.

    Raises:
        LessonError: `ros2 pkg create` failed.
    """
    saved = {
        cell.saved_as.removeprefix(_IN_WORKSPACE): (with_answers(cell.source) + "\n").encode()
        for lesson in lessons
        for cell in lesson.cells
        if cell.saved_as.startswith(_IN_WORKSPACE)
    }
    if not saved:
        return {}
    whole = {**_created_package(), **saved, **_content(course.sources / PACKAGE)}
    return {
        **{course.solutions / PACKAGE / name: text for name, text in sorted(whole.items())},
        **{_finished(course) / name: text for name, text in sorted(saved.items())},
    }


def _created_package() -> dict[str, bytes]:
    command = [
        *(str(Path(sys.executable).parent / "ros2"), "pkg", "create", PACKAGE),
        *("--build-type", "ament_python", "--dependencies", "rclpy", "std_msgs"),
        *("--license", "Apache-2.0"),
        *("--maintainer-name", "you", "--maintainer-email", "you@example.com"),
    ]
    with tempfile.TemporaryDirectory(prefix="rb-") as name:
        try:
            subprocess.run(command, cwd=name, capture_output=True, text=True, check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            last_words = str(getattr(error, "stderr", "") or error).strip()
            raise LessonError(
                f"ros2 pkg create failed: {last_words[-500:]}",
                f"solutions/{PACKAGE} begins with what it makes.",
                "Run `rosbeat doctor`.",
            ) from error
        files = _content(Path(name) / PACKAGE)
    return {path: text for path, text in files.items() if path != _LEFT_OUT}


def _content(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in _files(folder)}


def _files(folder: Path) -> list[Path]:
    found = sorted(folder.rglob("*"))
    return [path for path in found if path.is_file() and not _NOT_FILES & set(path.parts)]


def _finished(course: Course) -> Path:
    return course.root / "src/rosbeat/workspace/finished"


def _solved(course: Course) -> Path:
    return course.root / "src/rosbeat/exercises/solved"

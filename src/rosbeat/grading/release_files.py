"""What a release holds: all that learners need, and nothing that solves an exercise.

Left out are the lesson sources, the solution pages, the answers that `hint` gives last, the tests
and the history. Pages from 05 on begin with the package of page 02 and the nodes that pages 03 and
04 show (`workspace.catch_up`), also for those who come without them; so these files are part of a
release that has such a page. Its `package.xml` is one answer to exercise 02a.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.release_pages import page_bytes
from rosbeat.grading.weights import Points
from rosbeat.workspace.catching_up import NODES, PACKAGE

#: Folders of the course that learners get, and single files.
_FOLDERS = ("environment", "src/rosbeat", "src/ros2_command", ".devcontainer")
_FILES = (
    *("pyproject.toml", "LICENSE", "COLCON_IGNORE", ".gitignore", ".dockerignore"),
    "docs/troubleshooting.md",
)
_CLUTTER = {"__pycache__", ".ipynb_checkpoints", ".mypy_cache", ".ruff_cache", ".DS_Store"}
_CLUTTER_ENDINGS = (".pyc", ".pyo", ".part", ".swp", "~")
#: Where answers are, within the folders above.
_ANSWERS = ("src/rosbeat/exercises/solved/", "src/rosbeat/workspace/finished/")
#: Of these, what pages need that begin where earlier ones end, and the first of these pages.
_TO_BEGIN_WITH = tuple(
    f"src/rosbeat/workspace/finished/{one}"
    for one in ("package.xml", *(f"{PACKAGE}/{node}.py" for node in NODES))
)
FIRST_TO_CATCH_UP = "05"
POINTS = "points.csv"
_OTHER_POINTS = (
    "These points count. A check on a page says how many of the course's own points you have, and\n"
    "these are other ones."
)


@dataclass(frozen=True)
class File:
    """A file of a release.

    Attributes:
        content: What is in it.
        is_program: Whether it can be executed.
    """

    content: bytes
    is_program: bool = False


def release_files(
    root: Path, pages: Sequence[CoursePage], points: Points | None = None, sheet: bytes = b""
) -> dict[str, File]:
    """Gather the files of a release.

    Args:
        root: The checkout of the course.
        pages: The pages to release.
        points: What exercises are worth, if it is not what the course says.
        sheet: The file that says so.

    Returns:
        The files by their paths, with slashes.

    Raises:
        GradingError: If somebody has worked in a page.
    """
    found = {path: _file(root / path) for path in sorted(_paths(root, catches_up(pages)))}
    released = {page.lesson for page in pages}
    notebooks = page_bytes(root / "notebooks", pages, released)
    found.update({f"notebooks/{name}": File(data) for name, data in notebooks.items()})
    if sheet:
        found[POINTS] = File(sheet)
    found["README.md"] = File(readme(pages, points or Points()).encode("utf-8"))
    return found


def catches_up(pages: Iterable[CoursePage]) -> bool:
    """Whether a release has a page that begins with what earlier pages leave.

    Args:
        pages: The pages to release.
    """
    return any(page.number >= FIRST_TO_CATCH_UP for page in pages)


def _file(path: Path) -> File:
    return File(path.read_bytes(), os.access(path, os.X_OK))


def _paths(root: Path, to_begin_with: bool) -> Iterator[str]:
    needed = _TO_BEGIN_WITH if to_begin_with else ()
    for folder in _FOLDERS:
        for path in _walk(root / folder):
            name = path.relative_to(root).as_posix()
            if name in needed or not name.startswith(_ANSWERS):
                yield name
    yield from (name for name in _FILES if (root / name).is_file())


def _walk(folder: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        folders[:] = [
            one for one in folders if one not in _CLUTTER and not one.endswith(".egg-info")
        ]
        for name in names:
            path = Path(place, name)
            if name in _CLUTTER or name.endswith(_CLUTTER_ENDINGS):
                continue
            if path.is_file() and not path.is_symlink():
                yield path


def readme(pages: Sequence[CoursePage], points: Points) -> str:
    """The first file that a learner reads.

    Args:
        pages: The pages of the release.
        points: What their exercises are worth.
    """
    text = (files("rosbeat.grading") / "release_readme.md").read_text(encoding="utf-8")
    rows = [_row(page, points) for page in pages]
    rows += ["", _OTHER_POINTS] if points.by_exercise else []
    return text.replace("{pages}", "\n".join(rows))


def _row(page: CoursePage, points: Points) -> str:
    exercises = dict.fromkeys(one.exercise for one in page.wanted)
    worth = {one: points.of(one, EXERCISES[one].points) for one in exercises}
    said = (
        f"{one}: {round(many, 2):g}" if many else f"{one}: not graded"
        for one, many in worth.items()
    )
    return f"| [{page.number} {page.title}](notebooks/{page.lesson}.ipynb) | {', '.join(said)} |"

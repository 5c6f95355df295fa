"""The finished package of the course, made from the cells that save its files.

`solutions/sensor_simulator/` is what a learner has in the workspace at the end: `ros2 pkg create`
makes it, the lessons' `save` cells replace what they replace on the pages, and the tests, which no
page writes, come from `src/lessons/sensor_simulator/`. The same files, as far as pages write them,
go into `rosbeat.workspace`, which makes what is missing when pages are opened out of order.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

from rosbeat.authoring.solved import folder_of
from rosbeat.authoring.source import Course, Lesson, with_answers
from rosbeat.errors import LessonError

NAME = "sensor_simulator"
_IN_WORKSPACE = f"src/{NAME}/"
#: Empty folders, bytecode and the like are no part of a package.
_NOT_FILES = ("__pycache__", ".pytest_cache")
#: Cannot run: it needs ament_copyright, which is on no registry.
_LEFT_OUT = ("test/test_copyright.py",)


def package_files(course: Course, lessons: Iterable[Lesson]) -> dict[Path, bytes]:
    """Return every derived file outside of the two trees of pages, with its content.

    Args:
        course: Where they belong.
        lessons: All lessons of the course; without a cell that saves a file there is no package.

    Raises:
        LessonError: `ros2 pkg create` failed.
    """
    saved = saved_files(lessons)
    if not saved:
        return {}
    whole = {**_created(), **saved, **_by_hand(course)}
    package, parts = course.solutions / NAME, course.root / "src/rosbeat/workspace/finished"
    return {
        **{package / name: text for name, text in sorted(whole.items())},
        **{parts / name: text for name, text in sorted(saved.items())},
    }


def saved_files(lessons: Iterable[Lesson]) -> dict[str, bytes]:
    """Return what the pages save in the package, answers filled in, later pages winning.

    Args:
        lessons: The lessons, in order.
    """
    return {
        cell.saved_as.removeprefix(_IN_WORKSPACE): (with_answers(cell.source) + "\n").encode()
        for lesson in lessons
        for cell in lesson.cells
        if cell.saved_as.startswith(_IN_WORKSPACE)
    }


def stale_files(course: Course, wanted: Iterable[Path]) -> list[Path]:
    """Return derived files outside of the two trees of pages that nothing makes any more.

    Args:
        course: Where they are.
        wanted: The files that should be there.
    """
    finished = course.root / "src/rosbeat/workspace/finished"
    folders = (course.solutions / NAME, finished, folder_of(course))
    keep = set(wanted)
    return [path for folder in folders for path in _files(folder) if path not in keep]


def _created() -> dict[str, bytes]:
    with tempfile.TemporaryDirectory(prefix="rb-") as name:
        _create(Path(name))
        files = _content(Path(name) / NAME)
    return {path: text for path, text in files.items() if path not in _LEFT_OUT}


def _create(folder: Path) -> None:
    ros2 = Path(sys.executable).parent / "ros2"
    command = [
        *(str(ros2), "pkg", "create", "--build-type", "ament_python", NAME),
        *("--dependencies", "rclpy", "std_msgs", "--license", "Apache-2.0"),
        *("--maintainer-name", "you", "--maintainer-email", "you@example.com"),
    ]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        last_words, failed = done.stderr.strip(), done.returncode != 0
    except OSError as error:
        last_words, failed = str(error), True
    if failed:
        raise LessonError(
            f"ros2 pkg create failed: {last_words[-500:]}",
            f"solutions/{NAME} begins with what it makes.",
            "Run `./environment/course doctor`.",
        )


def _by_hand(course: Course) -> dict[str, bytes]:
    return _content(course.sources / NAME)


def _content(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in _files(folder)}


def _files(folder: Path) -> list[Path]:
    return [
        path
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not set(_NOT_FILES) & set(path.parts)
    ]

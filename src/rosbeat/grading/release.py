"""Make what learners get, and bring an earlier release up to date without taking anything away."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path, PurePosixPath

from rosbeat.errors import GradingError
from rosbeat.grading.course_pages import CoursePage, course_pages
from rosbeat.grading.release_files import POINTS, File, release_files
from rosbeat.grading.remarks import printable
from rosbeat.grading.weights import read_points
from rosbeat.grading.writing import write_whole

#: The file that says that a folder is a release, and what was released.
MARKER = ".rosbeat-release.json"
_FORMAT = 1

#: For each file, the digests of all its versions that were released.
History = dict[str, list[str]]


@dataclass(frozen=True)
class Released:
    """What a release has done.

    Attributes:
        pages: The pages that are in the folder now.
        written: Paths of files that are new or were brought up to date.
        removed: Paths of files that were released earlier and are not part of the course any more.
        kept: Paths of files that stay as they are, because somebody has changed them.
        same: How many files were up to date already.
    """

    pages: tuple[CoursePage, ...]
    written: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()
    same: int = 0


def release(
    root: Path, target: Path, pages: Sequence[CoursePage] = (), points: Path | None = None
) -> Released:
    """Make a release, or bring one up to date.

    Pages that were released into the folder earlier stay part of it.

    Args:
        root: The checkout of the course.
        target: The folder to make. One that has something in it has to be an earlier release.
        pages: The pages to release, by default all.
        points: A file that says what exercises are worth.

    Returns:
        What was done.

    Raises:
        GradingError: If the folder cannot be used, the points cannot be read, or somebody has
            worked in the course's own pages.
    """
    history = _history(root, target)
    every = course_pages(root / "notebooks")
    wanted = {page.lesson for page in pages or every}
    wanted |= {page.lesson for page in every if f"notebooks/{page.lesson}.ipynb" in history}
    chosen = tuple(page for page in every if page.lesson in wanted)
    if points is None and POINTS in history and (target / POINTS).is_file():
        points = target / POINTS
    worth = read_points(points) if points else None
    files = release_files(root, chosen, worth, points.read_bytes() if points else b"")
    return _put(target, files, history, chosen)


def _history(root: Path, target: Path) -> History:
    """What was released into a folder so far; the folder is looked at before anything is done."""
    place = target.resolve()
    if place == root.resolve() or root.resolve() in place.parents:
        raise _refusal(target, "is inside of the course itself", "Learners get a folder of its own")
    if target.exists() and not target.is_dir():
        raise _refusal(target, "is a file", "A release is a folder")
    if not target.is_dir() or not any(target.iterdir()):
        return {}
    history = _read_marker(target / MARKER)
    if history is None:
        means = "It is no release of this course, and what is in it would be mixed with one"
        raise _refusal(target, "has something in it", means)
    return history


def _refusal(target: Path, what: str, means: str) -> GradingError:
    return GradingError(
        f"{printable(str(target))} {what}.",
        f"{means}; nothing was written.",
        "Name a folder that is not there yet, or an earlier release.",
    )


def _read_marker(path: Path) -> History | None:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if found["format"] != _FORMAT:
            return None
        return {
            str(name): [str(one) for one in digests]
            for name, digests in found["files"].items()
            if is_inside(str(name))
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def is_inside(name: str) -> bool:
    """Whether a path stays within the folder that it starts from.

    Args:
        name: A path with slashes.
    """
    path = PurePosixPath(name)
    return bool(name) and not path.is_absolute() and ".." not in path.parts and "\0" not in name


def _put(
    target: Path, files: Mapping[str, File], history: History, pages: tuple[CoursePage, ...]
) -> Released:
    """Write what nobody has changed; what is being done is noted first, in case it breaks off."""
    _make_folder(target)
    digests = {name: _digest(file.content) for name, file in files.items()}
    after = {name: [*history.get(name, [])] for name in {*history, *files}}
    for name, digest in digests.items():
        after[name] += [digest] if digest not in after[name] else []
    written, kept, same = [], [], 0
    changed = {name for name in after if _is_changed(target, name, after[name])}
    _write_marker(target, after)
    for name, file in sorted(files.items()):
        if name in changed:
            kept.append(name)
        elif _write(target / name, file):
            written.append(name)
        else:
            same += 1
    gone = sorted(set(history) - set(files))
    removed = [name for name in gone if name not in changed and _remove(target, name)]
    _write_marker(target, {name: after[name] for name in after if name in files or name in changed})
    return Released(pages, tuple(written), tuple(removed), tuple(kept), same)


def _make_folder(target: Path) -> None:
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise GradingError(
            f"The folder {printable(str(target), 1000)} cannot be made: {error.strerror or error}.",
            "A release is a folder, and there cannot be one in this place; nothing was written.",
            "Name a folder where you may write, such as  ~/class/pages",
        ) from error


def _digest(content: bytes) -> str:
    return sha256(content).hexdigest()


def _is_changed(target: Path, name: str, digests: Sequence[str]) -> bool:
    """Whether there is something else than any version that was released."""
    path = target / name
    inside = path.parent.resolve().is_relative_to(target.resolve())
    if path.is_symlink() or not inside:
        return True
    if not path.exists():
        return any(one.exists() and not one.is_dir() for one in path.parents)
    return not path.is_file() or _digest(path.read_bytes()) not in digests


def _write(path: Path, file: File) -> bool:
    is_new = write_whole(path, file.content)
    if file.is_program and not os.access(path, os.X_OK):
        path.chmod(path.stat().st_mode | 0o111)
    return is_new


def _remove(target: Path, name: str) -> bool:
    path = target / name
    if not path.is_file():
        return False
    path.unlink()
    for folder in path.parents:
        if folder == target or any(folder.iterdir()):
            break
        folder.rmdir()
    return True


def _write_marker(target: Path, history: History) -> None:
    text = json.dumps({"format": _FORMAT, "files": history}, indent=1, sort_keys=True)
    write_whole(target / MARKER, f"{text}\n")

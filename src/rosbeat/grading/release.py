"""Create the folder that learners get, and update an earlier release without removing anything.

A release contains everything that learners need and nothing that solves an exercise: no lesson
sources, no solution pages, no answers for `hint`, no tests and no history. Pages from 05 on start
with the package of page 02 and the nodes that pages 03 and 04 show (`workspace.catch_up`), even for
learners who skipped those pages, so a release with such a page includes these files. Their
`package.xml` is one answer to exercise 02a.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from importlib.resources import files
from pathlib import Path, PurePosixPath
from typing import Final, Literal

from rosbeat.errors import GradingError, RecordError
from rosbeat.exercises.exercise import BLANK
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.files import printable, write_whole
from rosbeat.grading.marks import Points, read_points
from rosbeat.grading.submissions import MARKER
from rosbeat.page_runs.notebook import CoursePage, course_pages, read_notebook
from rosbeat.records_json import from_json, to_json
from rosbeat.workspace.prerequisites import NODES, PACKAGE

_FORMAT: Final = 1
POINTS = "points.csv"
WORKFLOW = ".github/workflows/check.yml"

#: For each file, the digest of the version that was released last; earlier courses noted all.
History = dict[str, list[str]]


@dataclass(frozen=True)
class _Marker:
    """Hold what marks a folder as a release."""

    files: History
    format: Literal[1]


@dataclass(frozen=True)
class Released:
    """Hold what a release did.

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
    root: Path,
    target: Path,
    pages: Sequence[CoursePage] = (),
    points: Path | None = None,
    github: bool = False,
) -> Released:
    """Make a release, or bring one up to date.

    Pages that were released into the folder earlier stay part of it.

    Args:
        root: The checkout of the course.
        target: The folder to make. One that has something in it has to be an earlier release.
        pages: The pages to release, by default all.
        points: A file that says what exercises are worth.
        github: Whether to add a workflow that checks the pages on each push. One that was released
            earlier stays part of it.

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
    found = release_files(root, chosen, worth, points.read_bytes() if points else b"")
    if github or WORKFLOW in history:
        found[WORKFLOW] = File(workflow(chosen).encode("utf-8"))
    return _put(target, found, history, chosen)


def _history(root: Path, target: Path) -> History:
    """Return what was released into a folder so far; refuse a folder that cannot be used."""
    place = target.resolve()
    if place == root.resolve() or root.resolve() in place.parents:
        raise _refusal(target, "is inside the course itself", "Learners get a folder of their own")
    if target.exists() and not target.is_dir():
        raise _refusal(target, "is a file", "A release is a folder")
    if not target.is_dir() or not any(target.iterdir()):
        return {}
    history = _read_marker(target / MARKER)
    if history is None:
        means = "It is not a release of this course, and what is in it would be mixed with one"
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
        found = from_json(_Marker, path.read_bytes(), "release")
    except (OSError, RecordError):
        return None
    return {name: digests for name, digests in found.files.items() if _is_inside(name)}


def _is_inside(name: str) -> bool:
    """Return whether a path stays within the folder that it starts from."""
    path = PurePosixPath(name)
    return bool(name) and not path.is_absolute() and ".." not in path.parts and "\0" not in name


def _put(
    target: Path, files: Mapping[str, File], history: History, pages: tuple[CoursePage, ...]
) -> Released:
    """Write what nobody has changed."""
    _make_folder(target)
    digests = {name: _digest(file.content) for name, file in files.items()}
    written, kept, same = [], [], 0
    known = {name: (*history.get(name, ()), digests.get(name, "")) for name in {*history, *files}}
    changed = {name for name in known if _is_changed(target, name, known[name])}
    _write_marker(target, history)  # so that a release that breaks off is one
    for name, file in sorted(files.items()):
        if name in changed:
            kept.append(name)
        elif _write(target / name, file):
            written.append(name)
        else:
            same += 1
    gone = sorted(set(history) - set(files))
    removed = [name for name in gone if name not in changed and _remove(target, name)]
    after = {name: [digest] for name, digest in digests.items() if name not in changed}
    _write_marker(target, after | {name: history[name] for name in changed if name in history})
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
    """Return whether there is anything but a version that was released."""
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
    marker = _Marker(dict(sorted(history.items())), _FORMAT)
    write_whole(target / MARKER, f"{to_json(marker, indent=1)}\n")


# What is in it.

#: Folders of the course that learners get, and single files.
_FOLDERS = (
    "environment",
    "src/rosbeat",
    "src/ros2_command",
    "src/rosie",
    ".devcontainer",
    ".binder",
)
_FILES = (
    *("pyproject.toml", "LICENSE", "COLCON_IGNORE"),
    *("docs/cheat_sheet.md", "docs/glossary.md", "docs/help.md", "docs/troubleshooting.md"),
    "docs/two_computers.md",
    *(".gitignore", ".gitattributes", ".dockerignore"),
)
_CLUTTER = {"__pycache__", ".ipynb_checkpoints", ".mypy_cache", ".ruff_cache", ".DS_Store"}
_CLUTTER_ENDINGS = (".pyc", ".pyo", ".part", ".swp", "~")
#: Where answers are, right ones and wrong ones, within the folders above.
_ANSWERS = (
    *("src/rosbeat/exercises/solved/", "src/rosbeat/workspace/finished/"),
    "src/rosbeat/grading/examples.json",
)
#: Of these, what pages need that begin where earlier ones end, and the first of these pages.
_TO_BEGIN_WITH = tuple(
    f"src/rosbeat/workspace/finished/{one}"
    for one in ("package.xml", *(f"{PACKAGE}/{node}.py" for node in NODES))
)
FIRST_TO_CATCH_UP = "05"
_OTHER_POINTS = (
    "These points count. A check on a page says how many of the course's own points you have, and\n"
    "these are other ones."
)


@dataclass(frozen=True)
class File:
    """Hold a file of a release."""

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
    paths = {name: root / name for name in sorted(_paths(root, catches_up(pages)))}
    found = {
        name: File(path.read_bytes(), os.access(path, os.X_OK)) for name, path in paths.items()
    }
    released = {page.lesson for page in pages}
    notebooks = page_bytes(root / "notebooks", pages, released)
    found.update({f"notebooks/{name}": File(data) for name, data in notebooks.items()})
    if sheet:
        found[POINTS] = File(sheet)
    found["README.md"] = File(readme(pages, points or Points()).encode("utf-8"))
    return found


def catches_up(pages: Iterable[CoursePage]) -> bool:
    """Return whether a release has a page that begins with what earlier pages leave."""
    return any(page.number >= FIRST_TO_CATCH_UP for page in pages)


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
    """Return the first file that a learner reads."""
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


def workflow(pages: Iterable[CoursePage]) -> str:
    """Return a GitHub workflow that checks each page on each push, a step for each page."""
    text = (files("rosbeat.grading") / "release_workflow.yml").read_text(encoding="utf-8")
    return text + "".join(map(_step, pages))


def _step(page: CoursePage) -> str:
    name = json.dumps(f"{page.number} {page.title}", ensure_ascii=False)
    command = f"rosbeat check notebooks/{page.lesson}.ipynb"
    return (
        f"      - name: {name}\n"
        "        if: ${{ !cancelled() && steps.environment.outcome == 'success' }}\n"
        f'        run: ./environment/course shell -c "{command}"\n'
    )


# The pages: as learners get them, without an answer in them.

#: The page that shows the whole course.
HOME = "home.ipynb"
#: A link to another page, as it stands in the file of a page.
_LINK = re.compile(r"\[([^\[\]]*)\]\((\d\d_\w+)\.ipynb(?:#[^()\s]*)?\)")


def page_bytes(
    folder: Path, pages: Iterable[CoursePage], released: Collection[str]
) -> dict[str, bytes]:
    """Read the pages, untouched by anybody, with links only to pages that are there.

    The page that shows the whole course comes with them, if there is one.

    Returns:
        The files by their names.

    Raises:
        GradingError: If somebody has worked in a page.
    """
    names = [*(page.lesson for page in pages), *(["home"] if (folder / HOME).is_file() else [])]
    found = {f"{name}.ipynb": (folder / f"{name}.ipynb").read_bytes() for name in names}
    worked = [said for name, data in found.items() for said in worked_in(name, data)]
    if worked:
        raise GradingError(
            f"Somebody has worked in the course's own pages: {'; '.join(worked)}.",
            "Learners would get these pages with answers in them, so nothing is released.",
            "Keep a copy if you need it, and make the pages anew:  rosbeat build --no-run",
        )
    return {name: without_links(data, released) for name, data in found.items()}


def worked_in(name: str, data: bytes) -> list[str]:
    """Say where somebody has worked in a page: what was filled in, or has an output."""
    said = [
        f"{name} has no blank in exercise {cell.exercise}"
        for cell in read_notebook(data).cells
        if cell.exercise and BLANK not in cell.source
    ]
    if any(
        cell.get("outputs") or cell.get("execution_count") for cell in json.loads(data)["cells"]
    ):
        said.append(f"{name} was run")
    return said


def without_links(data: bytes, released: Collection[str]) -> bytes:
    """Turn links to pages that are not released into plain text."""

    def kept(link: re.Match[str]) -> str:
        return link[0] if link[2] in released else link[1]

    return _LINK.sub(kept, data.decode("utf-8")).encode("utf-8")

"""Whether anything has changed since the last run of `rosbeat grade`; if not, all is done already.

What decides about results is put into one digest: every file that was handed in, the course, what
was typed, the files that it names, and the results themselves. It is quick, for nothing is read
twice and nothing of ROS is loaded.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Iterator
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from stat import S_ISREG

from rosbeat.grading.ledger import FILE as LEDGER
from rosbeat.grading.ledger import course_version
from rosbeat.grading.writing import write_whole
from rosbeat.workspace.place import course_root

FILE = "unchanged.json"
#: An instructor's rubric for page 13.
_RUBRIC = "ROSBEAT_RUBRIC"
_BLOCK = 1 << 20


def last_summary(options: argparse.Namespace) -> str | None:
    """What the last run has said, if this one would do the same.

    Args:
        options: What was typed after `rosbeat grade`.

    Returns:
        Its summary; None if there is something to do.
    """
    try:
        said = json.loads((options.out / FILE).read_text(encoding="utf-8"))
        same = said["digest"] == _digest(options)
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return str(said["summary"]) if same else None


def remember(options: argparse.Namespace, summary: str) -> None:
    """Note that everything is done; to be called when all results are written.

    Args:
        options: What was typed.
        summary: What was said at the end.
    """
    with suppress(OSError):  # then the next run does it again
        said = {"digest": _digest(options), "summary": summary}
        write_whole(options.out / FILE, json.dumps(said))


def _digest(options: argparse.Namespace) -> str:
    digest = sha256(course_version().encode())
    typed = {name: str(value) for name, value in vars(options).items() if not callable(value)}
    for text in (*_of_course(), json.dumps(typed, sort_keys=True), *_named(options)):
        digest.update(text.encode("utf-8", "backslashreplace") + b"\0")
    for text in (*_of_files(options.submissions), *_of_results(options.out)):
        digest.update(text.encode("utf-8", "backslashreplace") + b"\0")
    return digest.hexdigest()


def _of_course() -> Iterator[str]:
    root = course_root()
    for path in sorted((root / "notebooks").glob("*.ipynb")) if root else ():
        yield f"{path.name} {_content(path)}"


def _named(options: argparse.Namespace) -> Iterator[str]:
    """The files that an instructor has written."""
    for name in (options.points, os.environ.get(_RUBRIC)):
        yield f"{name} {_content(Path(name)) if name else ''}"


def _of_files(source: Path) -> Iterator[str]:
    """Names, times and contents of all that was handed in."""
    if not source.is_dir():
        yield f"{_times(source)} {_content(source)}"
        return
    for folder, names, files in os.walk(source):
        names.sort()
        for name in sorted(files):
            path = Path(folder, name)
            # Who waits at a pipe waits for ever, and a link leads elsewhere.
            content = _content(path) if S_ISREG(path.lstat().st_mode) else ""
            yield f"{path.relative_to(source)} {_times(path)} {content}"


def _of_results(out: Path) -> Iterator[str]:
    """The results as they are: whoever has taken one away, or edited one, gets it anew."""
    for path in sorted(out.rglob("*")):
        if path.name not in (FILE, LEDGER) and path.is_file():
            yield f"{path.relative_to(out)} {_times(path)}"


def _times(path: Path) -> str:
    found = path.lstat()
    return f"{found.st_size} {found.st_mtime_ns}"


def _content(path: Path) -> str:
    digest = sha256()
    with path.open("rb") as file:
        while block := file.read(_BLOCK):
            digest.update(block)
    return digest.hexdigest()

"""Store the outcomes of judged answers, so that no answer is observed twice.

The file has a line of JSON for each answer, appended and synced to disk as soon as it is judged: a
power failure loses only the answers that were being observed. Each line contains a digest of
itself, so a damaged line is ignored, and its answer is judged again. The key of an answer covers
everything that affects its outcome: the version of the course, and its job. Of several lines with
one key, the last one counts: the answer was judged again.
"""

from __future__ import annotations

import json
import os
import re
import secrets
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import BinaryIO

from rosbeat.errors import GradingError, RecordError
from rosbeat.grading.files import printable
from rosbeat.page_runs.jobs import PageJob, to_line
from rosbeat.records import Outcome
from rosbeat.records_json import from_json, to_json

FILE = "judged.jsonl"
#: Where the seed of a class is kept, in the folder of results.
SEED_FILE = "seed"
_BITS = 63
#: Characters of the digest that each line of the file has.
_DIGEST = 16
_PACKAGE = Path(__file__).resolve().parents[1]
_SOURCES = ("*.py", "*.json", "*.txt", "*.bash")


def course_version() -> str:
    """Return a digest of all that observes and judges: with another, marks may be others."""
    digest = sha256()
    for pattern in _SOURCES:
        for path in sorted(_PACKAGE.rglob(pattern)):
            digest.update(path.relative_to(_PACKAGE).as_posix().encode() + b"\0")
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def key_of(job: PageJob, version: str) -> str:
    """Return what a page is known by; an answer is known by that and its exercise."""
    digest = sha256(to_line(job).encode("utf-8", "backslashreplace")).hexdigest()
    return f"{version}-{digest}"


def seed_of(folder: Path) -> int:
    """Return the seed of a class, from which the inputs of its scenarios are drawn.

    It is made at the first run and kept: with another one, all answers would have to be observed
    again. It is nobody's business but the instructor's: whoever knows it could prepare evidence.

    Raises:
        GradingError: If the seed cannot be read or written.
    """
    path = folder / SEED_FILE
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            _make_seed(path)
        return int(path.read_text(encoding="ascii"))
    except (OSError, ValueError) as error:
        raise _trouble(path, error) from error


def new_seed() -> int:
    """Return a seed that nobody can foresee."""
    return secrets.randbits(_BITS) or 1


def _make_seed(path: Path) -> None:
    """Make the file whole; of two runs that begin at once, one makes it."""
    made = path.with_name(f".{path.name}-{os.getpid()}")
    handle = os.open(made, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    with os.fdopen(handle, "w", encoding="ascii") as file:
        file.write(f"{new_seed()}\n")
    try:
        os.link(made, path)
    except FileExistsError:
        pass
    except OSError:  # a file system without hard links
        made.replace(path)
    finally:
        made.unlink(missing_ok=True)


def _trouble(path: Path, error: Exception) -> GradingError:
    why = getattr(error, "strerror", "") or error
    return GradingError(
        f"{printable(str(path))} cannot be used: {why}.",
        "It belongs to the class, so that nothing is done twice and nothing comes out differently.",
        "Make room, move away what is in its place, or give another folder with --out.",
    )


@dataclass(frozen=True)
class _Entry:
    """Hold what stands before an outcome in its line."""

    key: str
    trace: str = ""
    reaches: tuple[str, ...] = ()


class Ledger:
    """Keep outcomes by key, in a file; usable in a `with` block.

    Args:
        path: The file; None keeps outcomes as long as the ledger is open.
        takes_earlier: Whether an answer that this version of the course has not judged has the
            outcome that the last version gave it.

    Raises:
        GradingError: If it cannot be read or written.
    """

    def __init__(self, path: Path | None, takes_earlier: bool = False) -> None:
        self._path, self._takes_earlier = path, takes_earlier
        self._known: dict[str, tuple[Outcome, _Entry]] = {}
        self._last: dict[str, str] = {}  # the key that an answer had last, without its version
        self._file: BinaryIO | None = None
        if path is None:
            return
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = path.open("ab+")
            self._read(self._file)
        except OSError as error:
            raise _trouble(path, error) from error

    def __enter__(self) -> Ledger:
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()

    def __len__(self) -> int:
        return len(self._known)

    def get(self, key: str) -> Outcome | None:
        """Return the outcome of an answer, if it has been judged."""
        found = self._find(key)
        return found[0] if found else None

    def trace(self, key: str) -> str:
        """Return the trace of an answer; empty if there is none."""
        found = self._find(key)
        return found[1].trace if found else ""

    def reaches(self, key: str) -> tuple[str, ...]:
        """Return what the page of an answer has reached for, of what observes it."""
        found = self._find(key)
        return found[1].reaches if found else ()

    def _find(self, key: str) -> tuple[Outcome, _Entry] | None:
        answer = key.partition("-")[2]
        if self._takes_earlier and answer and key not in self._known:
            key = self._last.get(answer, "")
        return self._known.get(key)

    def _keep(self, entry: _Entry, outcome: Outcome) -> None:
        self._known[entry.key] = outcome, entry
        self._last[entry.key.partition("-")[2]] = entry.key

    def add(
        self,
        key: str,
        outcome: Outcome,
        stays: bool = True,
        trace: str = "",
        reaches: tuple[str, ...] = (),
    ) -> None:
        """Keep an outcome.

        Args:
            key: What the answer is known by.
            outcome: What was said of it.
            stays: Whether it is kept for later runs, too.
            trace: What the answer did over time, as `traces.trace_of` wrote it.
            reaches: What its page has reached for, of what observes it.

        Raises:
            GradingError: If it cannot be written.
        """
        self._keep(_Entry(key, trace, reaches), outcome)
        if not stays or self._file is None or self._path is None:
            return
        head: dict[str, object] = {"key": key}
        head |= {"trace": trace} if trace else {}
        head |= {"reaches": reaches} if reaches else {}
        line = to_json(outcome, head)
        try:
            self._file.write(_with_digest(_as_ascii(line)))
            self._file.flush()
            os.fdatasync(self._file.fileno())
        except OSError as error:
            raise _trouble(self._path, error) from error

    def _read(self, file: BinaryIO) -> None:
        file.seek(0)
        data = file.read()
        for line in data.splitlines():
            self._take(line)
        if data and not data.endswith(b"\n"):  # somebody pulled the plug in the middle of a line
            file.write(b"\n")

    def _take(self, line: bytes) -> None:
        try:
            body = _without_digest(line)
            entry = from_json(_Entry, body, "line")
            self._keep(entry, from_json(Outcome, body, "outcome"))
        except (ValueError, RecordError):
            return  # damaged, or of an older version: it is judged again


def _as_ascii(line: str) -> bytes:
    """Return JSON with all but ASCII escaped, so that a terminal can show the file."""
    return re.sub(r"[^\x00-\x7f]", lambda one: json.dumps(one[0])[1:-1], line).encode("ascii")


def _with_digest(body: bytes) -> bytes:
    """Return a line of the file: a list of JSON with a digest and the outcome."""
    return b'["%s", %s]\n' % (sha256(body).hexdigest()[:_DIGEST].encode(), body)


def _without_digest(line: bytes) -> bytes:
    """Return the outcome of a line, without its newline.

    Raises:
        ValueError: If the line is not as it was written.
    """
    body = line[len('["", ') + _DIGEST : -len("]")]
    if _with_digest(body) != line + b"\n":
        raise ValueError("the line is damaged")
    return body

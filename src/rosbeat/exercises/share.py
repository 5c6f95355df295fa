"""Share a learner's progress with a class, if the learner wants to: `rosbeat share`.

Sharing is off until a learner turns it on. Then each check adds one line to a file of the learner's
own in the folder of the class: exercise, status, named mistake and time. The file's name is random,
and there is no code, no text of the learner's, and no name unless the learner gives one.

The folder may be on a network drive that hangs, on a full disk, or gone: a check hands its line to
a thread and never waits for it, and a line that cannot be written is lost.
"""

from __future__ import annotations

import json
import os
import re
import stat
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from queue import SimpleQueue
from secrets import token_hex
from textwrap import fill
from threading import Thread

from rosbeat.errors import CommandError, RecordError
from rosbeat.exercises.exercise import NOT_ATTEMPTED
from rosbeat.exercises.progress import progress_file
from rosbeat.records import Outcome
from rosbeat.records_json import from_json, to_json
from rosbeat.viz.text_format import count
from rosbeat.workspace.saving import write

#: Names the folder of the class on a computer that a class shares.
SETTING = "ROSBEAT_CLASS"
#: Seconds that a line is kept.
DAY = 24 * 60 * 60
#: Bytes of a learner's file, letters of a name, and lines that are kept.
LARGEST, LONGEST_NAME, _MOST_LINES = 64 * 1024, 40, 200
#: How the files in the folder of a class are named.
FILE_NAME = re.compile(r"[0-9a-f]{32}\.jsonl")
_CONSENT = "share.json"
_SHOWN = 10


@dataclass(frozen=True)
class Consent:
    """Hold what a learner has agreed to.

    Attributes:
        folder: The folder of the class.
        id: A random id, which says nothing about the learner.
        name: What the class may call the learner; empty for no name.
    """

    folder: str
    id: str
    name: str = ""

    @property
    def file(self) -> Path:
        """Return the learner's own file in the folder of the class."""
        return Path(self.folder) / f"{self.id}.jsonl"


def consent() -> Consent | None:
    """Return what this learner has agreed to; None if sharing is off."""
    try:
        found = from_json(Consent, _consent_file().read_bytes(), "sharing")
    except (OSError, RecordError):
        return None
    return found if FILE_NAME.fullmatch(found.file.name) else None


def _consent_file() -> Path:
    return progress_file().path.with_name(_CONSENT)


# What a check writes.


def share(outcome: Outcome, now: Callable[[], float] = time.time) -> None:
    """Add the outcome of a check to what the class sees, if this learner shares.

    An answer that was not attempted is not written: whoever runs all cells of a page tries nothing.

    Args:
        outcome: The outcome.
        now: Returns the time, in seconds since 1970.
    """
    if outcome.status == NOT_ATTEMPTED or not progress_file().counts:
        return
    agreed = consent()
    if agreed is not None:
        _writer().put(lambda: append(agreed, outcome, now()))


def append(agreed: Consent, outcome: Outcome, now: float) -> None:
    """Write one line to the learner's own file, and drop lines that are too old or too many.

    Args:
        agreed: What the learner has agreed to.
        outcome: The outcome of a check.
        now: The time, in seconds since 1970.

    Raises:
        OSError: If it cannot be written.
    """
    said = {
        "exercise": outcome.exercise,
        "status": outcome.status,
        "mistake": outcome.mistake,
        "time": int(now),
        **({"name": agreed.name} if agreed.name else {}),
    }
    present = agreed.file.read_bytes() if agreed.file.exists() else b""
    kept = [one for one in present.splitlines(keepends=True) if _time_of(one) > now - DAY]
    # As it is: escaped, a name in another script would be longer than a reader takes.
    line = f"{json.dumps(said, ensure_ascii=False)}\n".encode()
    _replace(agreed.file, b"".join([*kept[-_MOST_LINES:], line]))


def _replace(path: Path, content: bytes) -> None:
    """Replace a learner's file by one of the learner's own, whatever stands in its place.

    Where the folder gives its own group to files, that group may read it.
    """
    shared = path.parent.stat().st_mode & stat.S_ISGID
    write(path, content, 0o640 if shared else 0o600)


def _time_of(line: bytes) -> float:
    try:
        return float(json.loads(line)["time"])
    except (ValueError, TypeError, KeyError, RecursionError):
        return 0.0


@cache
def _writer() -> SimpleQueue[Callable[[], None]]:
    """Return what a thread does, one after the other, so that nobody waits for a slow folder."""
    waiting: SimpleQueue[Callable[[], None]] = SimpleQueue()

    def run() -> None:
        while True:
            work = waiting.get()
            with suppress(OSError):
                work()

    Thread(target=run, name="rosbeat share", daemon=True).start()
    return waiting


# `rosbeat share`.


def class_folder(chosen: Path | None = None) -> Path | None:
    """Return the folder of the class: the chosen one, or the one that the environment names."""
    named = os.environ.get(SETTING, "")
    return (chosen or Path(named)).expanduser().absolute() if chosen or named else None


def turn_on(name: str = "", chosen: Path | None = None) -> str:
    """Share from now on, and return what that means.

    With another name or folder than before, the earlier file is deleted and a new one begins.

    Args:
        name: What the class may call the learner; empty for no name.
        chosen: The folder of the class; by default the one that the environment names.

    Raises:
        CommandError: If there is no class, or nothing can be written there.
    """
    folder = class_folder(chosen)
    if folder is None:
        raise CommandError(
            "No class is set up on this computer.",
            "Sharing needs a folder that your instructor has created for the class, and nothing "
            "was turned on.",
            "If your instructor has given you a folder, name it: rosbeat share on --class FOLDER.",
        )
    name = "".join(one for one in name if one.isprintable()).strip()[:LONGEST_NAME]
    before = consent()
    if before is None or (before.folder, before.name) != (str(folder), name):
        agreed = Consent(str(folder), token_hex(16), name)
        try:
            _replace(agreed.file, b"")
            _consent_file().parent.mkdir(parents=True, exist_ok=True)
            write(_consent_file(), f"{to_json(agreed)}\n".encode(), 0o600)
        except OSError as error:
            raise CommandError(
                f"You cannot share with {folder}: {error.strerror or error}.",
                "Nothing was turned on, and your checks work as before.",
                "Show this message to your instructor, who can put the folder right.",
            ) from None
        if before is not None:
            _delete(before)
    return state()


def turn_off() -> str:
    """Stop sharing, delete what was written, and say so."""
    before = consent()
    _consent_file().unlink(missing_ok=True)
    if before is None:
        return state()
    gone = _delete(before)
    rest = f"{before.file} is deleted." if gone else f"{before.file} could not be deleted."
    return f"Sharing is off. {rest}"


def _delete(agreed: Consent) -> bool:
    try:
        agreed.file.unlink(missing_ok=True)
    except OSError:
        return False
    return True


def state() -> str:
    """Return whether sharing is on, what has been written, and where."""
    agreed = consent()
    if agreed is None:
        return _off(class_folder())
    named = f"under the name {agreed.name}" if agreed.name else "without your name"
    try:
        lines = agreed.file.read_text(encoding="utf-8", errors="replace").splitlines()
        there_are = f"{count(len(lines), 'line')} so far"
    except OSError as error:
        lines, there_are = [], f"which cannot be read: {error.strerror or error}"
    latest = [f"    {one}" for one in lines[-_SHOWN:]]
    return "\n".join(
        [
            fill(
                f"Sharing is on, {named}. Each check adds a line with the exercise, whether you "
                "passed, the mistake that the check names, and the time. It contains no code. "
                "Lines older than a day are removed with the next check.",
                88,
            ),
            "",
            f"  {agreed.file} ({there_are})",
            *latest,
            "",
            fill(
                "The file belongs to your account, so whoever administers this computer can tell "
                "that it's yours. `rosbeat share off` stops sharing and deletes the file.",
                88,
            ),
        ]
    )


def _off(folder: Path | None) -> str:
    head = "Sharing is off: checks write nothing for anybody else."
    if folder is None:
        return f"{head}\nNo class is set up on this computer, so you don't have to decide anything."
    offer = (
        "With `rosbeat share on`, your instructor sees which exercises the class is stuck on. Each "
        "check then writes a line into the folder of your class: the exercise, whether you passed, "
        "the mistake that the check names, and the time. It contains no code, and no name unless "
        "you add --name."
    )
    return f"{head}\n\n{fill(offer, 88)}\n\n  {folder}"

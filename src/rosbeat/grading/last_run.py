"""How a class was graded the last time, so that an option that was left out is noticed.

Deadline, points and pages decide about every mark. Whoever forgets one of them on the next run gets
other results, with nothing to see it by; so the options are kept beside the results and compared.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping
from pathlib import Path

from rosbeat.grading.remarks import printable
from rosbeat.grading.writing import write_whole

FILE = "last_run.json"
_FORMAT = 1
#: Options by their names without hyphens; what was left out is not among them.
Typed = Mapping[str, str]


def note_options(out: Path, typed: Typed) -> None:
    """Keep how this run was started; to be called when its results are written.

    Args:
        out: The folder with the results.
        typed: The options that decide about results, as they were typed.

    Raises:
        GradingError: If it cannot be written.
    """
    said = {"format": _FORMAT, "options": dict(typed)}
    write_whole(out / FILE, f"{json.dumps(said, indent=1, sort_keys=True)}\n")


def changes(out: Path, typed: Typed) -> str:
    """Say in one line what is typed otherwise than the last time.

    Args:
        out: The folder with the results.
        typed: The options that decide about results, as they were typed.

    Returns:
        The line; empty if all is the same or there was no last time.
    """
    try:
        before = _read(out / FILE)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        place = printable(str(out / FILE), 1000)
        return f"{place} cannot be read, so nobody knows how you graded the last time."
    if before is None:
        return ""
    differ = [name for name in sorted({*before, *typed}) if before.get(name) != typed.get(name)]
    if not differ:
        return ""
    earlier, now = _shown(before, differ), _shown(typed, differ)
    return (
        f"Other options than last time! Last time: {earlier or 'without them'}; "
        f"now {now or 'without'}. Marks may change."
    )


def _read(path: Path) -> dict[str, str] | None:
    try:
        said = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    if said["format"] != _FORMAT:
        raise ValueError("another format")
    return {str(name): str(value) for name, value in said["options"].items()}


def _shown(typed: Typed, names: list[str]) -> str:
    """The options of these names, as one would type them; safe to print, whoever wrote the file."""
    found = [f"--{name} {_word(typed[name])}" for name in names if name in typed]
    return printable(", ".join(found), 1000)


def _word(value: str) -> str:
    return value if value.replace(" ", "").isdigit() else shlex.quote(value)

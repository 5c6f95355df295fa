"""The file that remembers how far somebody is, beside the workspace.

It is small JSON in a hidden folder `.rosbeat`; the variable `ROSBEAT_PROGRESS_IN` names another
place for that folder. Whoever changes it holds a lock and replaces it in
one step, so that two kernels lose nothing and nobody ever reads half of it. A file that cannot be
read is kept under another name. Where nothing can be written, a check and a hint work all the same,
and the kernel remembers until it ends.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from rosbeat.errors import RecordError
from rosbeat.exercises.standing import Standing, parse_standing
from rosbeat.workspace.place import steady_home, workspace_parent
from rosbeat.workspace.saving import only_writer, write

FOLDER, NAME, VERSION = ".rosbeat", "progress.json", 1
SETTING = "ROSBEAT_PROGRESS_IN"
#: Neither git nor colcon looks into the folder.
_IGNORED = {".gitignore": b"*\n", "COLCON_IGNORE": b""}

Standings = Mapping[str, Standing]


class ProgressFile:
    """How far somebody is with each exercise, remembered in a file.

    Args:
        folder: The hidden folder that holds the file; made when something is written.
        tell: Gets one line if something is wrong with the file.
    """

    def __init__(self, folder: Path, tell: Callable[[str], None] = print) -> None:
        self.path = folder / NAME
        self._tell = tell
        self._unsaved: Standings | None = None

    def standings(self) -> Standings:
        """Return every standing by exercise; a file that cannot be read counts as empty."""
        if self._unsaved is not None:
            return self._unsaved
        try:
            return _parse(self.path.read_bytes())
        except (OSError, RecordError):
            return MappingProxyType({})

    def change(self, exercise: str, edit: Callable[[Standing], Standing]) -> Standing:
        """Change the standing of one exercise, and write it down.

        Args:
            exercise: The exercise's id.
            edit: Makes the new standing of the one before.

        Returns:
            The new standing. It is right even if it could not be written.
        """
        try:
            self._prepare()
            with only_writer(self.path.parent):
                return self._written(exercise, edit)
        except OSError as error:
            return self._remembered(exercise, edit, error)

    def _prepare(self) -> None:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        for name, content in _IGNORED.items():
            if not (self.path.parent / name).exists():
                write(self.path.parent / name, content)

    def _written(self, exercise: str, edit: Callable[[Standing], Standing]) -> Standing:
        before = {**self._sound_content(), **(self._unsaved or {})}
        after = edit(before.get(exercise, Standing()))
        write(self.path, _text({**before, exercise: after}))
        self._unsaved = None
        return after

    def _sound_content(self) -> Standings:
        """What the file holds; if that is damaged, it is put aside."""
        try:
            return _parse(self.path.read_bytes())
        except FileNotFoundError:
            return {}
        except RecordError:
            aside = _free_name(self.path)
            self.path.rename(aside)
            self._tell(
                f"# Your progress could not be read. The file is kept as {FOLDER}/{aside.name}, "
                "and a new one begins."
            )
            return {}

    def _remembered(
        self, exercise: str, edit: Callable[[Standing], Standing], error: OSError
    ) -> Standing:
        if self._unsaved is None:
            self._tell(
                f"# Your progress cannot be saved ({error.strerror or error}). Everything else "
                "works; this page remembers it until it is closed."
            )
        before = self.standings()
        after = edit(before.get(exercise, Standing()))
        self._unsaved = {**before, exercise: after}
        return after


def progress_file() -> ProgressFile:
    """Return the file of this learner, beside the workspace unless a setting says otherwise."""
    chosen = os.environ.get(SETTING, "")
    if chosen and steady_home() is None:
        return _at(Path(chosen).expanduser().resolve() / FOLDER)
    return _at(workspace_parent() / FOLDER)


@cache
def _at(folder: Path) -> ProgressFile:
    # One for each folder, so that what is wrong with it is said once in a kernel.
    return ProgressFile(folder)


def _parse(content: bytes) -> Standings:
    try:
        data = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise _unreadable(str(error)) from None
    if not isinstance(data, dict) or data.get("version") != VERSION:
        raise _unreadable(f"it is not version {VERSION}")
    found = data.get("exercises")
    if not isinstance(found, dict):
        raise _unreadable("it names no exercises")
    return {name: parse_standing(one) for name, one in found.items()}


def _text(standings: Standings) -> bytes:
    found = {name: one.as_dict() for name, one in sorted(standings.items())}
    whole = {"version": VERSION, "exercises": found}
    return (json.dumps(whole, indent=1) + "\n").encode()


def _unreadable(why: str) -> RecordError:
    return RecordError(
        f"The file of your progress cannot be read: {why}.",
        "Something else than the course has written it, or another version of the course.",
        "Run a check: it keeps this file under another name and begins a new one.",
    )


def _free_name(path: Path) -> Path:
    number = 1
    while (aside := path.with_name(f"progress-unreadable-{number}.json")).exists():
        number += 1
    return aside

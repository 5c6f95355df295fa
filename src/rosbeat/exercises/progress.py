"""Remember how far somebody is, and show it: `progress`."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Final, Literal

from msgspec import Meta

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import RecordError, called_as
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED, Exercise
from rosbeat.exercises.outcome_display import LOOKS
from rosbeat.exercises.progress_list import ProgressList, Row, is_a_page, totals
from rosbeat.exercises.progress_widget import stored
from rosbeat.exercises.registry import EXERCISES, PAGES, Page, this_page
from rosbeat.records import Outcome
from rosbeat.records_json import from_json, to_json
from rosbeat.workspace.location import is_a_solution, page_file, steady_home, workspace_parent
from rosbeat.workspace.saving import only_writer, write

# How far somebody is with one exercise, as plain data.

#: A number that is not below 0, also if somebody has edited the file.
_Number = Annotated[int, Meta(ge=0)]


@dataclass(frozen=True)
class Standing:
    """Hold how far somebody is with one exercise.

    Attributes:
        outcome: What the last check said: `passed`, `failed` or `not attempted`.
        passed: Whether any check so far said `passed`.
        points: The most points that a check gave.
        attempts: How many checks found an answer, right or wrong.
        hints: How many hints were shown.
        answer: Whether the answer was shown.
        mistake: Id of the last mistake, or an empty text.
        lead: The hint that the last check gave, if it failed and named a mistake; empty once
            `hint` has shown it.
    """

    outcome: str = NOT_ATTEMPTED
    passed: bool = False
    points: _Number = 0
    attempts: _Number = 0
    hints: _Number = 0
    answer: bool = False
    mistake: str = ""
    lead: str = ""

    @property
    def status(self) -> str:
        """Return the best that is known: who has passed once has passed."""
        if self.passed:
            return PASSED
        return FAILED if self.attempts else NOT_ATTEMPTED

    def after(self, outcome: Outcome) -> Standing:
        """Return the standing after one more check.

        Args:
            outcome: What the check said.
        """
        return replace(
            self,
            outcome=outcome.status,
            passed=self.passed or outcome.status == PASSED,
            points=max(self.points, outcome.points),
            attempts=self.attempts + (outcome.status != NOT_ATTEMPTED),
            mistake=outcome.mistake or self.mistake,
            lead=outcome.hint if outcome.mistake in MISTAKES else "",
        )


# The file that remembers how far somebody is, beside the workspace.

FOLDER, NAME = ".rosbeat", "progress.json"
_FILE_VERSION: Final = 2
#: Of the form of `as_data`.
VERSION: Final = 1
SETTING = "ROSBEAT_PROGRESS_IN"
#: Neither git nor colcon looks into the folder.
_IGNORED = {".gitignore": b"*\n", "COLCON_IGNORE": b""}

Standings = Mapping[str, Standing]


#: The exercises of version 1 that are several steps now. The last step asks for what the exercise
#: asked for, under another id, so a pass is a pass of each step.
_STEPS = {"04c": ("04c", "04d", "04e"), "12c": ("12c", "12d", "12e")}


def _renewed(before: Standings) -> dict[str, Standing]:
    """Return the standings of a file of version 1, by the ids of today.

    The hint that a check gave goes: it may be about what an exercise asks no more.
    """
    after: dict[str, Standing] = {}
    for name, one in before.items():
        known = replace(one, lead="")
        steps = _STEPS.get(name, ())
        if not steps:
            after[name] = known
        elif not one.passed:
            after[steps[-1]] = known
        else:
            after |= {step: replace(known, points=EXERCISES[step].points) for step in steps}
    return after


@dataclass(frozen=True)
class _Content:
    """Hold what is in the file. What a later version adds to a standing is passed over."""

    version: Literal[1, 2]
    exercises: dict[str, Standing]


class ProgressFile:
    """Remember in a file how far somebody is with each exercise.

    What cannot be written, and what is not to be written, only the kernel remembers.

    Args:
        folder: The hidden folder that holds the file; made when something is written.
        tell: Gets one line if something is wrong with the file.
        counts: Whether checks here are those of a learner's own page, and are written.
    """

    def __init__(
        self, folder: Path, tell: Callable[[str], None] = print, counts: bool = True
    ) -> None:
        self.path, self.counts = folder / NAME, counts
        self._tell = tell
        self._unsaved: dict[str, Standing] = {}

    def standings(self) -> Standings:
        """Return every standing by exercise; a file that cannot be read counts as empty."""
        try:
            return {**self._read(), **self._unsaved}
        except (OSError, RecordError):
            return self._unsaved

    def change(self, exercise: str, edit: Callable[[Standing], Standing]) -> Standing:
        """Change the standing of one exercise, and write it down.

        Args:
            exercise: The exercise's id.
            edit: Makes the new standing of the one before.

        Returns:
            The new standing. It is right even if it could not be written.
        """
        try:
            if self.counts:
                return self._written(exercise, edit)
        except OSError as error:
            if not self._unsaved:
                self._tell(
                    f"# Your progress cannot be saved ({error.strerror or error}). Everything else "
                    "works; this page remembers it until it is closed."
                )
        self._unsaved[exercise] = edit(self.standings().get(exercise, Standing()))
        return self._unsaved[exercise]

    def _written(self, exercise: str, edit: Callable[[Standing], Standing]) -> Standing:
        folder = self.path.parent
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in _IGNORED.items():
            if not (folder / name).exists():
                write(folder / name, content)
        with only_writer(folder):
            before = {**self._sound_content(), **self._unsaved}
            after = edit(before.get(exercise, Standing()))
            standings = dict(sorted({**before, exercise: after}.items()))
            write(self.path, f"{to_json(_Content(_FILE_VERSION, standings), indent=1)}\n".encode())
        self._unsaved = {}
        return after

    def _read(self) -> Standings:
        content = from_json(_Content, self.path.read_bytes(), "progress")
        return (
            content.exercises if content.version == _FILE_VERSION else _renewed(content.exercises)
        )

    def _sound_content(self) -> Standings:
        """Return what the file holds; if that is damaged, it is put aside."""
        try:
            return self._read()
        except FileNotFoundError:
            return {}
        except RecordError:
            aside = self.path.with_name("progress-unreadable.json")
            self.path.replace(aside)
            self._tell(
                f"# Your progress could not be read. The file is kept as {FOLDER}/{aside.name}, "
                "and a new one begins."
            )
            return {}


def progress_file() -> ProgressFile:
    """Return the file of this learner, beside the workspace unless a setting says otherwise.

    On a solution page and in a program it does not change: only a learner's own pages count.
    Where pages are built or tested, all of them do; each has a file of its own.
    """
    if steady_home() is not None:
        return _at(workspace_parent() / FOLDER, True)
    chosen = os.environ.get(SETTING, "")
    parent = Path(chosen).expanduser().resolve() if chosen else workspace_parent()
    return _at(parent / FOLDER, (bool(chosen) or is_a_page()) and not _is_a_solution())


def _is_a_solution() -> bool:
    """Return whether the page in this kernel is a solution."""
    with suppress(FileNotFoundError):  # the kernel's folder may be gone
        return is_a_solution(page_file())
    return False


@cache
def _at(folder: Path, counts: bool) -> ProgressFile:
    # One for each folder, so that what is wrong with it is said once in a kernel.
    return ProgressFile(folder, counts=counts)


# `progress`: how far somebody is with the course, as a list for the end of a page.


@called_as("progress()")
def progress() -> ProgressList:
    """Show how far you are: the exercises of this page, and the course page by page.

    Returns:
        The list, which Jupyter shows. It changes when a later check passes.
    """
    return ProgressList(rows, this_page(), page_file().parent)


def rows() -> list[Row]:
    """Return how far this learner is now, for each page of the course."""
    standings = progress_file().standings()
    return [Row(page, outcomes(page, standings)) for page in PAGES]


def refresh_home(page: Path) -> None:
    """Store in the course's home page how far this learner is now, so that it opens up to date.

    So does every page beside it that nobody has run yet, at its foot. JupyterLab keeps these lists
    up to date (`progress_widget`), since pages in which nothing else has an output are signed.

    Args:
        page: The notebook. It is written only if something changes; one that is not there, or is
            no notebook, is left alone.

    Raises:
        OSError: A notebook cannot be written.
    """
    numbered = {one.number: one for one in PAGES if one.number}
    for path in (page, *sorted(page.parent.glob("[0-9][0-9]_*.ipynb"))):
        _store_list(path, None if path == page else numbered.get(path.name[:2]))


def _store_list(path: Path, here: Page | None) -> None:
    """Store the list in the only cell of a page that shows it, unless others have outputs."""
    import nbformat  # which takes a while to load
    from nbformat.sign import NotebookNotary

    try:
        notebook = json.loads(path.read_bytes())
        cells = [one for one in notebook["cells"] if one["cell_type"] == "code"]
        (cell,) = [one for one in cells if "".join(one["source"]).strip() == "progress()"]
        if any(one.get("outputs") for one in cells if one is not cell):
            return
    except (OSError, ValueError, KeyError, TypeError):
        return
    data = stored(ProgressList(rows, here, path.absolute().parent))
    outputs = [{"data": one, "metadata": {}, "output_type": "display_data"} for one in data]
    if cell.get("outputs") != outputs:
        cell.update(outputs=outputs, execution_count=None)
        write(path, f"{json.dumps(notebook, indent=1, ensure_ascii=False)}\n".encode())
        # The pages are the course's own, and so is their only output.
        NotebookNotary().sign(nbformat.from_dict(notebook))


def outcomes(page: Page, standings: Standings) -> list[Outcome]:
    """Return the best outcome so far of each exercise of a page.

    Args:
        page: The page.
        standings: How far somebody is, by exercise.
    """
    found = [(one, standings.get(one.id, Standing())) for one in page.exercises]
    return [
        Outcome(one.id, at.status, mistake=at.mistake, points=at.points, out_of=one.points)
        for one, at in found
    ]


# `rosbeat progress`: how far somebody is with the course, as a table in a terminal.

_HEAD = ("", "exercise", "", "outcome", "points", "attempts", "hints")
_Row = tuple[str, ...]


def as_text() -> str:
    """Return the table of all pages, their exercises and the total."""
    standings = progress_file().standings()
    pages = sorted(PAGES, key=lambda page: page.elective)  # the core first, each in its order
    blocks = [(page.heading, [_row(one, standings) for one in page.exercises]) for page in pages]
    every = [row for _, block in blocks for row in block]
    widths = [max(map(len, column)) for column in zip(_HEAD, *every, strict=True)]
    lines = [_line(_HEAD, widths)]
    for title, block in blocks:
        lines += ["", title, *(_line(row, widths) for row in block)]
    return "\n".join([*lines, "", *(f"{name}: {said}" for name, said in totals(rows()).items())])


def as_json() -> str:
    """Return the same as JSON."""
    return to_json(as_data(progress_file().standings()), indent=1)


def as_data(standings: Standings) -> dict[str, Any]:
    """Return the same as plain data, with the version of its form.

    Args:
        standings: How far somebody is, by exercise.
    """
    rows = [
        {
            **{"exercise": one.id, "page": page.number, "title": one.title, "out_of": one.points},
            **{"status": at.status, **asdict(at)},
        }
        for page in PAGES
        for one in page.exercises
        for at in [standings.get(one.id, Standing())]
    ]
    return {
        "version": VERSION,
        "passed": sum(bool(row["passed"]) for row in rows),
        "points": sum(row["points"] for row in rows),
        "out_of": sum(row["out_of"] for row in rows),
        "exercises": rows,
    }


def _row(exercise: Exercise[Any], standings: Standings) -> _Row:
    at = standings.get(exercise.id, Standing())
    sign, word = LOOKS[at.status]
    hints = f"{at.hints} and the answer" if at.answer else str(at.hints)
    points = f"{at.points} of {exercise.points}"
    return f"  {sign}", exercise.id, exercise.title, word, points, str(at.attempts), hints


def _line(row: _Row, widths: list[int]) -> str:
    return "  ".join(part.ljust(width) for part, width in zip(row, widths, strict=True)).rstrip()

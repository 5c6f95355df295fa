"""Show on localhost where a class is stuck, while it works: `rosbeat class`.

`class_folder` reads what learners share. It is counted here by exercise, and by the mistakes of the
last ten minutes. The page asks for the board every two seconds and replaces what has changed; it
sends nothing but such questions. `local_server` says who can reach the page.
"""

from __future__ import annotations

import argparse
import json
import os
import stat
import time
import webbrowser
from collections import Counter
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from http import HTTPStatus
from importlib.resources import files
from typing import Any, cast

from markupsafe import Markup

from rosbeat import viz
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import CommandError, GradingError
from rosbeat.exercises.exercise import FAILED, PASSED
from rosbeat.exercises.registry import EXERCISES, PAGES, Page
from rosbeat.exercises.share import DAY, SETTING, class_folder
from rosbeat.grading.class_folder import ClassFolder, Learner, Reading, Record
from rosbeat.grading.rendering import Segment, render
from rosbeat.local_server import LocalHandler, LocalServer, new_nonce
from rosbeat.page_runs.traces import Picture, picture
from rosbeat.records_json import to_json
from rosbeat.viz.text_format import count

#: Seconds within which a mistake counts, checks after which a learner is stuck, mistakes shown.
WINDOW, STUCK, SHOWN = 10 * 60, 3, 3


# Counts.


@dataclass(frozen=True)
class Tally:
    """Hold how many learners are where with one exercise.

    Attributes:
        passed: Learners of whom a check said `passed`.
        trying: Learners with fewer failed checks than `STUCK`, and no passed one.
        stuck: Learners with as many or more, and no passed one.
        names: Names of those who are stuck and share one.
    """

    exercise: str
    title: str
    passed: int
    trying: int
    stuck: int
    names: tuple[str, ...] = ()

    @property
    def learners(self) -> int:
        """Return how many learners have checked an answer."""
        return self.passed + self.trying + self.stuck


@dataclass(frozen=True)
class Lesson:
    """Hold the tallies of a page."""

    page: Page
    tallies: tuple[Tally, ...]
    is_now: bool


@dataclass(frozen=True)
class Common:
    """Hold a mistake that several learners have made in the last minutes.

    Attributes:
        learners: How many learners have made it.
        since: How many of them have passed the exercise since.
        places: The exercises in which it was made, the most frequent first, and by how many.
        names: Names of those who have not passed since and share one.
    """

    mistake: str
    title: str
    learners: int
    since: int
    places: tuple[tuple[str, int], ...]
    names: tuple[str, ...] = ()


@dataclass(frozen=True)
class Board:
    """Hold what an instructor sees.

    Attributes:
        learners: How many learners share.
        active: How many of them have checked an answer in the last `WINDOW` seconds.
        lessons: The pages on which somebody has checked an answer, those of the last minutes first.
        common: The most common mistakes of the last minutes.
        notices: What is wrong with the folder.
    """

    learners: int
    active: int
    lessons: tuple[Lesson, ...]
    common: tuple[Common, ...]
    notices: tuple[str, ...]

    @property
    def hardest(self) -> Tally | None:
        """Return the exercise of the current pages on which most learners are stuck, if any is."""
        current = [one for lesson in self.lessons if lesson.is_now for one in lesson.tallies]
        most = max(current, key=lambda one: one.stuck, default=None)
        return most if most and most.stuck else None


def board_of(reading: Reading) -> Board:
    """Count what was read from the folder of a class."""
    since = reading.time - WINDOW
    lessons = tuple(
        Lesson(page, tallies, _is_now(page, reading.learners, since))
        for page in PAGES
        if (tallies := _tallies(page, reading.learners))
    )
    return Board(
        learners=len(reading.learners),
        active=sum(who.records[-1].time > since for who in reading.learners if who.records),
        lessons=tuple(sorted(lessons, key=lambda one: not one.is_now)),
        common=_common(reading.learners, since),
        notices=reading.notices,
    )


def _tallies(page: Page, learners: Sequence[Learner]) -> tuple[Tally, ...]:
    found = []
    for exercise in page.exercises:
        where = Counter[str]()
        names = []
        for who in learners:
            state = _state(who.by_exercise.get(exercise.id, ()))
            where[state] += 1
            names += [who.name] if state == "stuck" and who.name else []
        counts = (where["passed"], where["trying"], where["stuck"])
        if any(counts):
            found.append(Tally(exercise.id, exercise.title, *counts, tuple(sorted(names))))
    return tuple(found)


def _state(records: Iterable[Record]) -> str:
    """Return where a learner is with an exercise: whoever has passed once has passed."""
    statuses = [one.status for one in records]
    if PASSED in statuses:
        return "passed"
    return "" if not statuses else "stuck" if len(statuses) >= STUCK else "trying"


def _is_now(page: Page, learners: Sequence[Learner], since: float) -> bool:
    return any(
        who.by_exercise[one.id][-1].time > since
        for who in learners
        for one in page.exercises
        if one.id in who.by_exercise
    )


def _common(learners: Sequence[Learner], since: float) -> tuple[Common, ...]:
    made: dict[str, list[tuple[Learner, set[str]]]] = {}
    for who in learners:
        places: dict[str, set[str]] = {}
        for one in who.records:
            if one.time > since and one.status == FAILED and one.mistake in MISTAKES:
                places.setdefault(one.mistake, set()).add(one.exercise)
        for name, where in places.items():
            made.setdefault(name, []).append((who, where))
    # Equally frequent ones stay in the order of the catalogue, so that they don't change places.
    ranked = sorted((name for name in MISTAKES if name in made), key=lambda name: -len(made[name]))
    return tuple(_counted(name, made[name]) for name in ranked[:SHOWN])


def _counted(name: str, made: list[tuple[Learner, set[str]]]) -> Common:
    where = Counter(exercise for _, places in made for exercise in sorted(places))
    still = [who for who, places in made if places - _passed(who)]
    return Common(
        name,
        MISTAKES[name].heading,
        len(made),
        len(made) - len(still),
        tuple(sorted(where.items(), key=lambda one: (-one[1], one[0]))),
        tuple(sorted(who.name for who in still if who.name)),
    )


def _passed(who: Learner) -> set[str]:
    return {one.exercise for one in who.records if one.status == PASSED}


# What to show and to say about a mistake.


@dataclass(frozen=True)
class Advice:
    """Hold what an instructor can show and say about a mistake in an exercise.

    Attributes:
        seen: What the check says of an answer with this mistake; empty if the course has none.
        hint: The hint that it gives; empty likewise.
        first_hint: The exercise's own first hint.
        drawn: What such an answer does, beside the published solution; None for no picture.
        diagram: The name of a diagram of the course instead; may be empty.
    """

    exercise: str
    title: str
    seen: str = ""
    hint: str = ""
    first_hint: str = ""
    drawn: Picture | None = None
    diagram: str = ""


#: Diagrams of the course, for exercises whose answers are folders, files and terminals.
DIAGRAMS = {
    **dict.fromkeys(("01a", "01b", "02a"), "workspace"),
    **dict.fromkeys(("02b", "06a", "06b"), "overlay"),
    **dict.fromkeys(("05a", "05b"), "entry point"),
}


@cache
def advice(mistake: str, exercise: str) -> Advice:
    """Return what there is to show and to say about a mistake."""
    found = EXERCISES[exercise]
    here = _examples().get(exercise, {})
    known = here.get(mistake, {})
    own, right = known.get("trace"), here.get("", {}).get("trace")
    return Advice(
        exercise,
        found.title,
        known.get("seen", ""),
        known.get("hint", ""),
        next(iter(found.hints), ""),
        picture(to_json(own), to_json(right)) if own else None,
        "" if own else DIAGRAMS.get(exercise, ""),
    )


@cache
def _examples() -> dict[str, dict[str, dict[str, Any]]]:
    """Return what wrong answers do, by exercise and mistake: `tests/bank/examples.py` made it.

    A release for learners has none.
    """
    file = files("rosbeat.grading") / "examples.json"
    text = file.read_bytes() if file.is_file() else b"{}"
    found: dict[str, dict[str, dict[str, Any]]] = json.loads(text)
    return found


# The page.


def run(options: argparse.Namespace) -> int:
    """Serve the page until a person stops it (Ctrl-C), or forget what learners have shared.

    Raises:
        CommandError: If no folder is named.
        GradingError: If the folder cannot be read, or the port is taken.
    """
    path = class_folder(options.folder)
    if path is None:
        raise CommandError(
            "No folder of a class is named.",
            f"It's the folder into which learners share: FOLDER, or what {SETTING} names.",
            "docs/instructors.md says how to create one: Where the class is stuck.",
        )
    folder = ClassFolder(path)
    if options.forget:
        print(f"{count(folder.forget(), 'file')} deleted in {path}.")
        return 0
    folder.read()
    with suppress(GradingError):  # only the owner of the folder can
        folder.forget(time.time() - DAY)
    for one in shortcomings(path.stat()):
        print(f"{path}: {one}")
    with ClassServer(folder, options.port) as server:
        print(f"Where the class is stuck, in a browser on this computer:\n    {server.url}")
        print("The address is secret: it opens the class. Ctrl-C ends it.", flush=True)
        has_screen = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
        if has_screen and not options.no_browser:
            webbrowser.open(server.url)
        with suppress(KeyboardInterrupt):
            server.serve_forever()
    return 0


def shortcomings(state: os.stat_result) -> list[str]:
    """Return what a folder lacks in which learners of several accounts can share, as sentences."""
    mode = state.st_mode
    lacks = [
        (mode & 0o003 == 0o003, "other accounts cannot write into it."),
        (not mode & stat.S_IROTH, "learners can list it."),
        (mode & stat.S_ISVTX, "learners can delete each other's files (no sticky bit)."),
        (mode & stat.S_ISGID, "learners' files don't get its group (no set-group-ID bit)."),
    ]
    return [said for is_well, said in lacks if not is_well]


def board_html(board: Board) -> str:
    """Return the changing part of the page."""
    return render(
        "class_board.html",
        board=board,
        segments=_segments,
        advice=advice,
        window=WINDOW // 60,
        stuck=STUCK,
        most=SHOWN,
    )


def _segments(tally: Tally) -> list[Segment]:
    return [
        Segment("passed", tally.passed, "✓ passed"),
        Segment("trying", tally.trying, "… trying"),
        Segment("stuck", tally.stuck, "✗ stuck"),
    ]


@cache
def _diagram(name: str) -> bytes:
    return viz.diagram(name).svg().encode()


class ClassServer(LocalServer):
    """Serve the page of a class on the loopback interface, at an address that nobody can guess.

    Raises:
        GradingError: If the port is taken.
    """

    def __init__(self, folder: ClassFolder, port: int = 0) -> None:
        try:
            super().__init__(_Handler, port)
        except (OSError, OverflowError) as error:
            said = getattr(error, "strerror", None) or error
            raise GradingError(
                f"The page cannot be served on port {port}: {said}.",
                "It needs a port of its own on this computer, from 1024 to 65535.",
                "Leave out --port, and any free port is taken.",
            ) from error
        self.folder = folder

    def board(self) -> Board:
        """Return where the class is now; if the folder cannot be read, only a notice."""
        try:
            return board_of(self.folder.read())
        except GradingError as error:
            return Board(0, 0, (), (), (f"{error.what} {error.to_try}",))


class _Handler(LocalHandler):
    def get(self, path: str) -> None:
        """Send the page, its changing part, or a diagram."""
        name = path.removeprefix("diagram/").removesuffix(".svg").replace("%20", " ")
        if path in ("", "board"):
            nonce, board = new_nonce(), board_html(cast(ClassServer, self.server).board())
            page = board
            if path == "":
                page = render("class_live.html", board=Markup(board), csp_nonce=nonce)
            allowed = {"connect-src": "'self'", "img-src": "'self' data:", "form-action": "'none'"}
            self.send_page(page, nonce, allowed=allowed)
        elif path.startswith("diagram/") and name in DIAGRAMS.values():
            allowed = {"style-src": "'unsafe-inline'"}
            self.send(_diagram(name), "image/svg+xml", allowed)
        else:
            self.refuse(HTTPStatus.NOT_FOUND)

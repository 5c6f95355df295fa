"""Show on localhost where a class is stuck, while it works: `rosbeat class`.

The page asks for the board every two seconds and replaces what has changed. It sends nothing but
such questions. `class_folder` reads what learners share, `class_board` counts it, and
`local_server` says who can reach the page.
"""

from __future__ import annotations

import argparse
import os
import stat
import time
import webbrowser
from contextlib import suppress
from functools import cache
from http import HTTPStatus
from typing import cast

from markupsafe import Markup

from rosbeat import viz
from rosbeat.errors import CommandError, GradingError
from rosbeat.exercises.share import DAY, SETTING, class_folder
from rosbeat.grading.class_board import (
    DIAGRAMS,
    SHOWN,
    STUCK,
    WINDOW,
    Board,
    Tally,
    advice,
    board_of,
)
from rosbeat.grading.class_folder import ClassFolder
from rosbeat.grading.rendering import Segment, render
from rosbeat.local_server import LocalHandler, LocalServer, new_nonce
from rosbeat.viz.words import count


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
            return Board(0, 0, (), (), (), 0, (f"{error.what} {error.to_try}",))


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

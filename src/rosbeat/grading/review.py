"""Serve a page on localhost on which a person marks a class by eye.

Similar answers are grouped, with their code, their behaviour, and the verdict. Points and comments
for a whole group are written to manual.csv, which remains the instructor's own file: lines about
other answers stay unchanged, and the original file is saved once next to it. Who can reach the page
is in `local_server`.
"""

from __future__ import annotations

import csv
import io
import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from http import HTTPStatus
from pathlib import Path
from typing import Any, cast
from urllib.parse import parse_qs, quote

from rosbeat.errors import GradingError
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.feedback import code_of
from rosbeat.grading.files import cell, number, write_whole
from rosbeat.grading.groups import Group, groups_of
from rosbeat.grading.manual_marks import FILE, apply_manual, meant, points_by_hand, read_manual
from rosbeat.grading.marks import Gradebook, Graded, Mark
from rosbeat.grading.remarks import Remark
from rosbeat.grading.rendering import render
from rosbeat.grading.results import summary
from rosbeat.grading.roster import Lookup, UnusableError
from rosbeat.local_server import LocalHandler, LocalServer, new_nonce
from rosbeat.page_runs.traces import picture

_COLUMNS = ("learner", "name", "exercise", "points", "comment")
#: Bytes that a browser may send: a comment, and the ids of a large class.
_MOST_SENT = 1 << 20


def review(out: Path, judged: Gradebook, write: Callable[[Gradebook], None]) -> None:
    """Serve the review of a class until a person stops it (Ctrl-C).

    Raises:
        GradingError: If no address on this computer is free.
    """
    with ReviewServer(Review(out, judged, write)) as server:
        # For a person: `--json` has standard output for itself.
        said = f"Review the answers in a browser on this computer:\n    {server.url}"
        print(said, file=sys.stderr)
        said = "The address is secret: it opens the class. Ctrl-C ends the review."
        print(said, file=sys.stderr, flush=True)
        if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
            webbrowser.open(server.url)
        with suppress(KeyboardInterrupt):
            server.serve_forever()


@dataclass(frozen=True)
class Given:
    """Hold what a person gives for some answers."""

    members: frozenset[int]
    points: str
    comment: str


class Review:
    """Hold a class that is being reviewed, and what was given by hand."""

    def __init__(self, out: Path, judged: Gradebook, write: Callable[[Gradebook], None]) -> None:
        self.out, self._judged, self._write = out, judged, write
        self._lock = threading.RLock()
        self._lookup = Lookup(judged.learners)
        self.groups = groups_of(judged)
        self.expected = {one.exercise: one.trace for one in judged.solutions}
        self.is_written, self.said = True, ""
        self._read()

    @cached_property
    def exercises(self) -> dict[str, list[int]]:
        """Return the places of the groups of each exercise."""
        found: dict[str, list[int]] = {}
        for place, group in enumerate(self.groups):
            found.setdefault(group.exercise, []).append(place)
        return found

    def mark(self, learner: str, exercise: str) -> Mark:
        """Return the mark of an answer as it is now."""
        return self._marks[learner, exercise]

    def is_settled(self, group: Group) -> bool:
        """Return whether a person has given points for all answers of a group."""
        return all(self.mark(one.learner, group.exercise).manual for one, _ in group.members)

    def remarks(self) -> list[Remark]:
        """Return what is odd about lines of manual.csv."""
        return [one for one in self._book.remarks if one.about == "manual"]

    def _read(self) -> None:
        """Read manual.csv, which a person may have changed in an editor as well."""
        self._manual = read_manual(self.out / FILE)
        self._book = apply_manual(self._judged, self._manual)
        self._marks = {
            (graded.learner, mark.exercise): mark
            for graded in self._book.learners
            for mark in graded.marks
        }

    def give(self, group: Group, given: Given) -> None:
        """Write points and a comment for answers of a group into manual.csv.

        Raises:
            UnusableError: If the points are none, nobody is chosen, or the file cannot be read.
            GradingError: If the file cannot be written.
        """
        chosen = (one for place, (one, _) in enumerate(group.members) if place in given.members)
        members = {one.learner: one for one in chosen}
        if not members:
            raise UnusableError("No answer is chosen.", "Tick at least one.")
        if given.points:
            points_by_hand(given.points, group.first)
        with self._lock:
            try:
                self._read()
            except GradingError as error:
                said = f"{error.what} Nothing was written."
                raise UnusableError(said, "Repair the file first.") from error
            if self._manual.remarks:
                first = self._manual.remarks[0]
                said = f"{first.path}: {first.text} Nothing was written."
                raise UnusableError(said, "Mend this line first.")
            self._write_manual(group.exercise, members, given)
            self._read()
            self.is_written = False

    def _write_manual(self, exercise: str, members: Mapping[str, Graded], given: Given) -> None:
        path = self.out / FILE
        gone = {(learner, exercise) for learner in members}
        rows = []
        for line in self._manual.lines:
            whose, is_gone = "", False
            with suppress(UnusableError):
                graded, mark = meant(line, self._lookup)
                whose = graded.name
                is_gone = mark is not None and (graded.learner, mark.exercise) in gone
            if not is_gone:
                rows.append((line.learner, whose, line.exercise, line.points, line.comment))
        if given.points or given.comment:
            rows += [
                (learner, one.name, exercise, given.points.replace(",", "."), given.comment)
                for learner, one in members.items()
            ]
        kept = path.with_name(f"{FILE}.before-review")
        if path.exists() and not kept.exists():
            write_whole(kept, path.read_bytes())
        write_whole(path, _csv([_COLUMNS, *rows]))

    def regrade(self) -> None:
        """Write all results anew, with what was given by hand.

        Raises:
            GradingError: If one cannot be written.
        """
        with self._lock:
            self._read()
            self._write(self._book)
            self.is_written, self.said = True, summary(self._book, self.out)


def _csv(rows: Iterable[Iterable[str]]) -> str:
    """Return a table in which no cell is a formula; line breaks of comments stay."""
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\r\n")
    for row in rows:
        writer.writerow(["\n".join(map(cell, text.splitlines())) for text in row])
    return "\ufeff" + file.getvalue()


# Pages.


def overview(review: Review, root: str, nonce: str) -> str:
    """Return the page that lists all groups."""
    rows = [
        (exercise, EXERCISES[exercise].title if exercise in EXERCISES else "",
         [(place, review.groups[place], review.is_settled(review.groups[place]))
          for place in places])
        for exercise, places in review.exercises.items()
    ]  # fmt: skip
    said, review.said = review.said, ""
    return render("review.html", rows=rows, said=said, **_shared(review, root, nonce))


def group_page(
    review: Review, root: str, nonce: str, place: int, error: str = "", typed: Given | None = None
) -> str:
    """Return the page of one group.

    Args:
        review: The class.
        root: The path of the overview.
        nonce: What the page's own style and script are known by.
        place: Which group, from 0.
        error: Why what was typed was not taken.
        typed: What was typed, if it was not taken.
    """
    group = review.groups[place]
    marks = [review.mark(one.learner, group.exercise) for one, _ in group.members]
    equal = {(mark.points, mark.manual, mark.comment) for mark in marks}
    points = number(marks[0].points) if len(equal) == 1 and marks[0].manual else ""
    comment = marks[0].comment if len({mark.comment for mark in marks}) == 1 else ""
    here = review.exercises[group.exercise]
    said, review.said = review.said, ""
    return render(
        "review_group.html",
        group=group,
        place=place,
        number_here=here.index(place) + 1,
        many_here=len(here),
        last=len(review.groups) - 1,
        members=[(one, mark) for (one, _), mark in zip(group.members, marks, strict=True)],
        code=code_of(group.first),
        seen=picture(group.first.trace, review.expected.get(group.exercise, "")),
        points=typed.points if typed else points,
        comment=typed.comment if typed else comment,
        chosen=typed.members if typed else range(len(marks)),
        error=error,
        said=said,
        **_shared(review, root, nonce),
    )


def _shared(review: Review, root: str, nonce: str) -> dict[str, Any]:
    return {
        "root": root,
        "csp_nonce": nonce,
        "is_written": review.is_written,
        "remarks": review.remarks(),
        "file": FILE,
    }


# The server.


class ReviewServer(LocalServer):
    """Serve a review on the loopback interface, at an address that nobody can guess.

    Raises:
        GradingError: If no address on this computer is free.
    """

    def __init__(self, review: Review) -> None:
        try:
            super().__init__(_Handler)
        except OSError as error:
            raise GradingError(
                f"The review cannot be served: {error.strerror or error}.",
                "It needs a port on the loopback interface; results are written all the same.",
                "Try it again without other servers, or mark in manual.csv.",
            ) from error
        self.review = review


class _Handler(LocalHandler):
    @property
    def _server(self) -> ReviewServer:
        return cast(ReviewServer, self.server)

    def get(self, path: str) -> None:
        """Send a page."""
        review, nonce = self._server.review, new_nonce()
        if path == "":
            self.send_page(overview(review, self._server.root, nonce), nonce)
        elif (place := self._place(path)) is not None:
            self.send_page(group_page(review, self._server.root, nonce, place), nonce)
        else:
            self.refuse(HTTPStatus.NOT_FOUND)

    def post(self, path: str) -> None:
        """Take points and comments, or write all results."""
        form = self._form()
        if form is None:
            return
        try:
            if path == "regrade":
                self._server.review.regrade()
                self._go(form.get("back", [""])[0])
            elif (place := self._place(path)) is not None:
                self._give(place, form)
            else:
                self.refuse(HTTPStatus.NOT_FOUND)
        except GradingError as error:
            self._server.review.said = str(error)
            self._go("")

    def _give(self, place: int, form: Mapping[str, list[str]]) -> None:
        review, root = self._server.review, self._server.root
        points, comment = (form.get(name, [""])[0].strip() for name in ("points", "comment"))
        members = (int(one) for one in form.get("member", []) if one.isdecimal() and len(one) < 10)
        given = Given(frozenset(members), points, comment)
        try:
            review.give(review.groups[place], given)
        except UnusableError as error:
            nonce = new_nonce()
            page = group_page(review, root, nonce, place, f"{error} {error.to_try}", given)
            self.send_page(page, nonce, HTTPStatus.UNPROCESSABLE_ENTITY)
            return
        step = int("next" in form and place + 1 < len(review.groups))
        self._go(f"group/{place + step}")

    def _place(self, path: str) -> int | None:
        word, _, place = path.partition("/")
        known = word == "group" and place.isdecimal() and len(place) < 10
        found = int(place) if known else -1
        return found if 0 <= found < len(self._server.review.groups) else None

    def _form(self) -> dict[str, list[str]] | None:
        length = self.headers.get("Content-Length", "")
        if not (length.isdecimal() and int(length) <= _MOST_SENT):
            self.refuse(HTTPStatus.REQUEST_ENTITY_TOO_LARGE)
            return None
        text = self.rfile.read(int(length)).decode("utf-8", "replace")
        return parse_qs(text, keep_blank_values=True)

    def _go(self, path: str) -> None:
        """Send the browser to a page, so that loading it again posts nothing."""
        known = path == "" or self._place(path) is not None
        self.send_response(HTTPStatus.SEE_OTHER)
        self.send_header("Location", self._server.root + (quote(path) if known else ""))
        self.send_header("Content-Length", "0")
        self.end_headers()

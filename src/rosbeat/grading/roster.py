"""Read a class's roster, and match names and ids with its learners.

A roster is a file with a name or an id on each line, or CSV. Moodle's grading worksheet and list of
participants and Canvas's gradebook can be used as exported.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Generic, TypeVar

from rosbeat.errors import GradingError
from rosbeat.grading.deadlines import read_extension
from rosbeat.grading.files import Row, cell, printable, read_table
from rosbeat.grading.marks import Graded
from rosbeat.grading.submissions import Collection, Remark, Submission

# Finding a learner.


Learner = TypeVar("Learner", Submission, Graded)


class UnusableError(ValueError):
    """Say why a line, or a cell of it, cannot be used.

    Args:
        what: What is wrong, a sentence.
        to_try: What to write instead, a sentence.
    """

    def __init__(self, what: str, to_try: str) -> None:
        super().__init__(what)
        self.to_try = to_try


_LOOK_UP = "Write the learner as in the column learner of grades.csv."


class Lookup(Generic[Learner]):
    """Find a learner by what a person, or a spreadsheet on the way, made of the id or the name."""

    def __init__(self, learners: Iterable[Learner]) -> None:
        self._forms: list[tuple[Learner, tuple[set[str], ...]]] = [
            (one, _forms(one.learner, one.name, one.system)) for one in learners
        ]

    def find(self, text: str) -> Learner:
        """Return the learner that is meant: by id, by the id as tables show it, or by name.

        Raises:
            UnusableError: If there is no such learner, or more than one.
        """
        if not text:
            raise UnusableError("It names no learner.", _LOOK_UP)
        found = self.all(text)
        if not found:
            raise UnusableError(f"There is no learner {printable(text, 40)!r}.", _LOOK_UP)
        if len(found) > 1:
            said = f"{printable(text, 40)!r} are {len(found)} learners; write the id."
            raise UnusableError(said, _LOOK_UP)
        return found[0]

    def all(self, text: str) -> list[Learner]:
        """Return every learner that may be meant."""
        plain = {_plain(text)}
        for place, wanted in enumerate(({text}, plain, plain, _orders(text))):
            found = [one for one, forms in self._forms if forms[place] & wanted - {""}]
            if found:
                return found
        return []


def _forms(learner: str, name: str, system: str) -> tuple[set[str], ...]:
    """Return what a learner may be called in a table, the most certain first."""
    names = {_plain(name)}
    if system == "moodle":  # as in the column Identifier of moodle.csv
        names.add(_plain(f"Participant {learner}"))
    return {learner}, {_plain(learner)}, names, {"".join(_words(name))}


def _plain(text: str) -> str:
    """Return text without capitals, spare blanks, and zeros that a spreadsheet takes away."""
    plain = " ".join(cell(text).strip("' ").casefold().split())
    return (plain.lstrip("0") or "0") if plain.isdigit() else plain


def _words(name: str) -> list[str]:
    """Return the words of a name; Canvas joins them in names of files."""
    return re.findall(r"[^\W_]+", name.casefold())


def _orders(name: str) -> set[str]:
    """Return a name's letters with the first or the last word at the other end, too."""
    words = _words(name)
    orders = (words, words[-1:] + words[:-1], words[1:] + words[:1])
    return {"".join(one) for one in orders}


# The roster.

#: Columns of a file of one's own, of Moodle's worksheet and participants, of Canvas's gradebook.
_IDS = ("identifier", "id", "learner", "id number", "username")
_NAMES = ("full name", "name", "student")
_FIRST, _LAST = ("first name",), ("last name", "surname")
_OWN = ("due", "extension")
_LIST = ("id",)
_KNOWN = {*_IDS, *_NAMES, *_FIRST, *_LAST, *_OWN}
#: Rows of Canvas's gradebook that are no learner.
_NOBODY = re.compile(r"(?i)points possible|student, test|test student")


@dataclass(frozen=True)
class Person:
    """Hold one learner of the class.

    Attributes:
        line: The line of the file.
        id: What tells the learner from others, or empty.
        name: What the learner is called, or empty.
        due: The learner's own deadline in seconds since 1970; None if it is that of the class.
    """

    line: int
    id: str
    name: str
    due: float | None = None


@dataclass(frozen=True)
class Roster:
    """Hold who is in the class."""

    people: tuple[Person, ...]
    system: str = ""
    file: str = "roster"


def read_roster(path: Path, due: float | None = None) -> Roster:
    """Read who is in the class.

    Args:
        path: The file.
        due: The deadline of the class, from which extensions count, in seconds since 1970.

    Raises:
        GradingError: If it cannot be read, names nobody, or a deadline in it cannot be used.
    """
    table = read_table(path, _LIST, _KNOWN)
    if table.header == _LIST and any(
        re.search(r"[,;\t].*[,;\t]", one.cells["id"]) for one in table.rows
    ):
        raise _not_known(path)
    system = "moodle" if "identifier" in table.header else ""
    if {"student", "id", "section"} <= set(table.header):
        system = "canvas"
    people = []
    for row in table.rows:
        person = _person(row, system, due, path)
        if person.id or person.name:
            people.append(person)
    if not people:
        raise _not_known(path)
    return Roster(tuple(people), system, printable(path.name))


def _not_known(path: Path) -> GradingError:
    return GradingError(
        f"{printable(str(path), 1000)} names no learner: no column of it is known.",
        "Who handed in nothing would be in no list, so nothing was graded.",
        "Write a name or an id on each line, or columns such as id, name, due; or give the export "
        "of Moodle or Canvas, in English.",
    )


def _person(row: Row, system: str, due: float | None, path: Path) -> Person:
    def first(names: Iterable[str]) -> str:
        return next((row.cells[name] for name in names if row.cells.get(name)), "")

    name = first(_NAMES) or " ".join(filter(None, (first(_FIRST), first(_LAST))))
    id_ = first(_IDS)
    number, _, rest = id_.partition(",")
    if not name and number.isdigit() and rest:  # a list without a header: a number and a name
        id_, name = number, rest.strip()
    if system == "moodle":
        id_ = id_.removeprefix("Participant ").strip()
    if _NOBODY.search(name) or (system == "canvas" and not id_):
        return Person(row.line, "", "")
    own = first(_OWN)
    try:
        return Person(row.line, id_, name, read_extension(own, due) if own else None)
    except GradingError as error:
        what = f"{printable(str(path), 1000)}, line {row.line}: {error.what}"
        raise GradingError(what, error.means, error.to_try) from error


def with_roster(
    found: Collection, roster: Roster, due: float | None
) -> tuple[Collection, Callable[[Submission], float | None]]:
    """Add the learners of the class who handed in nothing.

    Args:
        found: What was handed in.
        roster: Who is in the class.
        due: The deadline of the class, in seconds since 1970.

    Returns:
        The class, and a function that returns the deadline of each learner. Remarks with
        `about="roster"` say which lines name several learners, or one a second time, and who
        handed in without being on the roster.
    """
    lookup = Lookup(found.submissions)
    lines: dict[str, int] = {}
    own: dict[str, float] = {}
    absent: dict[str, Submission] = {}
    remarks: list[Remark] = []
    common = {one.system for one in found.submissions}
    for person in roster.people:
        where = f"{roster.file}, line {person.line}"
        meant = lookup.all(person.id)
        if not meant and not (person.id and common == {roster.system}):
            meant = lookup.all(person.name)
        if len(meant) > 1:
            said = f"{printable(person.name or person.id, 60)!r} are {len(meant)} learners who "
            remarks.append(Remark("roster", where, f"{said}handed in; write the id."))
        one = meant[0] if meant else _absent(person, roster.system, common)
        for each in meant or [one]:
            if each.learner in lines and len(meant) < 2:
                said = f"Line {lines[each.learner]} names {printable(each.called, 60)} already."
                remarks.append(Remark("roster", where, said))
            lines.setdefault(each.learner, person.line)
        if not meant:
            absent.setdefault(one.learner, one)
        if len(meant) < 2 and person.due is not None:
            own[one.learner] = person.due
    for one in found.submissions:
        if one.learner not in lines:
            said = f"{printable(one.called, 60)} handed in and is not on the roster."
            remarks.append(Remark("roster", roster.file, said))
    everybody = sorted((*found.submissions, *absent.values()), key=lambda one: one.learner)
    made = replace(found, submissions=tuple(everybody), remarks=(*found.remarks, *remarks))
    return made, lambda one: own.get(one.learner, due)


def _absent(person: Person, system: str, common: set[str]) -> Submission:
    """Return the empty submission of somebody who handed in nothing."""
    if not system and person.id.isdigit() and len(common) == 1:
        (system,) = common
    return Submission(person.id or person.name, person.name or person.id, system or "folder")

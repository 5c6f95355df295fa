"""Read a class's roster, and match names and ids with its learners.

A roster is a file with a name or an id on each line, or CSV. Lists that a learning platform exports
can be used as they are; `platforms` knows their columns.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Generic, TypeVar

from rosbeat.errors import GradingError
from rosbeat.grading import platforms
from rosbeat.grading.deadlines import mark_late, read_due, read_extension, read_late_rule
from rosbeat.grading.files import Row, cell, printable, read_table
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.platforms import platform_named, platform_of_roster
from rosbeat.grading.platforms.base import Platform
from rosbeat.grading.remarks import Remark
from rosbeat.grading.submissions import Collection, Submission
from rosbeat.grading.teams import has_name_of, share_in_teams

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
            (learner, _forms(learner)) for learner in learners
        ]

    def find(self, text: str) -> Learner:
        """Return the learner that is meant: by id, by the id as tables show it, or by name.

        Raises:
            UnusableError: If there is no such learner, or more than one.
        """
        if not text:
            raise UnusableError("It names no learner.", _LOOK_UP)
        learners = self.by_id(text) or self.by_name(text)
        if not learners:
            raise UnusableError(f"There is no learner {printable(text, 40)!r}.", _LOOK_UP)
        if len(learners) > 1:
            problem = f"{printable(text, 40)!r} are {len(learners)} learners; write the id."
            raise UnusableError(problem, _LOOK_UP)
        return learners[0]

    def by_id(self, text: str) -> list[Learner]:
        """Return every learner with this id; of those whose id is exactly so, only these."""
        return self._in(0, {text}) or self._in(1, {_plain(text)})

    def by_name(self, text: str) -> list[Learner]:
        """Return every learner with this name, the words in any usual order."""
        return self._in(2, {_plain(text)}) or self._in(3, _orders(text))

    def _in(self, place: int, wanted: set[str]) -> list[Learner]:
        return [learner for learner, forms in self._forms if forms[place] & wanted - {""}]


def _forms(submission: Submission | Graded) -> tuple[set[str], ...]:
    """Return what a learner may be called in a table, the most certain first."""
    aliases = platform_named(submission.system).aliases(submission.learner, submission.details)
    ids = {_plain(submission.learner), *map(_plain, aliases)}
    return {submission.learner}, ids, {_plain(submission.name)}, {"".join(_words(submission.name))}


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
    return {"".join(order) for order in orders}


# The roster.

#: Columns of a file of one's own, and of lists that no platform's class knows.
_IDS = ("id", "learner", "id number", "username")
_NAMES = ("full name", "name", "student")
_FIRST, _LAST = ("first name",), ("last name", "surname")
_OWN = ("due", "extension")
#: An export of a platform may have groups that hand in one by one, so there only `team` counts.
_TEAM, _GROUP = ("team",), ("group",)
_LIST = ("id",)
_KNOWN = {*_IDS, *_NAMES, *_FIRST, *_LAST, *_OWN, *_TEAM, *_GROUP}


@dataclass(frozen=True)
class Person:
    """Hold one learner of the class.

    Attributes:
        line: The line of the file.
        id: What tells the learner from others, or empty.
        name: What the learner is called, or empty.
        due: The learner's own deadline in seconds since 1970; None if it is that of the class.
        team: The team that hands in together, or empty.
        details: All cells of the line, by column.
    """

    line: int
    id: str
    name: str
    due: float | None = None
    team: str = ""
    details: Mapping[str, str] = field(default_factory=dict, compare=False)


@dataclass(frozen=True)
class Roster:
    """Hold who is in the class.

    Attributes:
        system: The name of the platform that has exported it, or empty.
    """

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
    table = read_table(path, _LIST, {*_KNOWN, *_columns_of_platforms()})
    if table.header == _LIST and any(
        re.search(r"[,;\t].*[,;\t]", row.cells["id"]) for row in table.rows
    ):
        raise _not_known(path)
    platform = platform_of_roster(table.header)
    people = []
    for row in table.rows:
        person = _person(row, platform, due, path)
        if person.id or person.name:
            people.append(person)
    if not people:
        raise _not_known(path)
    return Roster(tuple(people), platform.name if platform else "", printable(path.name))


def _columns_of_platforms() -> Iterator[str]:
    for platform in platforms.PLATFORMS:
        yield from (*platform.roster_columns, *platform.id_columns)


def _not_known(path: Path) -> GradingError:
    return GradingError(
        f"{printable(str(path), 1000)} names no learner: no column of it is known.",
        "Who handed in nothing would be in no list, so nothing was graded.",
        "Write a name or an id on each line, or columns such as id, name, due; or give the export "
        "of your learning platform, in English.",
    )


def _person(row: Row, platform: Platform | None, due: float | None, path: Path) -> Person:
    def first(names: Iterable[str]) -> str:
        return next((row.cells[name] for name in names if row.cells.get(name)), "")

    name = first(_NAMES) or " ".join(filter(None, (first(_FIRST), first(_LAST))))
    id_ = platform.person_id(row.cells) if platform else first(_IDS)
    if platform and not id_:
        return Person(row.line, "", "")  # a row that is no learner's
    number, _, rest = id_.partition(",")
    if not name and number.isdigit() and rest:  # a list without a header: a number and a name
        id_, name = number, rest.strip()
    own = first(_OWN)
    try:
        own_due = read_extension(own, due) if own else None
    except GradingError as error:
        what = f"{printable(str(path), 1000)}, line {row.line}: {error.what}"
        raise GradingError(what, error.means, error.to_try) from error
    team = first(_TEAM if platform else (*_TEAM, *_GROUP))
    return Person(row.line, id_, name, own_due, team, row.cells)


# With what was handed in.


def with_dates(
    collected: Collection, roster: Path | None, due: str | None, late: str | None = None
) -> Collection:
    """Add the learners of a roster, and note what is late.

    Args:
        collected: What was handed in.
        roster: The file that says who is in the class, if there is one.
        due: The deadline, as it was typed.
        late: What is taken off a late page, as it was typed.

    Raises:
        GradingError: If the roster or one of the texts cannot be used.
    """
    deadline = read_due(due) if due else None
    rule = read_late_rule(late) if late else None
    if roster is None:
        everybody = replace(
            collected, remarks=(*collected.remarks, *_remarks_without_roster(collected))
        )
        return mark_late(everybody, lambda _: deadline, rule)
    everybody, due_of = with_roster(collected, read_roster(roster, deadline), deadline)
    return mark_late(everybody, due_of, rule)


def with_roster(
    collected: Collection, roster: Roster, due: float | None
) -> tuple[Collection, Callable[[Submission], float | None]]:
    """Add the learners of the class who handed in nothing, and share what teams handed in.

    Args:
        collected: What was handed in.
        roster: Who is in the class.
        due: The deadline of the class, in seconds since 1970.

    Returns:
        The class, and a function that returns the deadline of each learner. Remarks with
        `about="roster"` say which lines name several learners, or one a second time, and who
        handed in without being on the roster.
    """
    matching = _Matching(collected, roster)
    matching.match_ids()
    matching.match_names()
    own: dict[str, float] = {}
    teams: dict[str, list[str]] = {}
    learners = {submission.learner: submission for submission in collected.submissions}
    for person, learner in matching.learners:
        known = learners.get(learner) or matching.absent(person, learner)
        learners[learner] = replace(known, details={**known.details, **person.details})
        if person.due is not None:
            own[learner] = person.due
        if person.team and learner not in teams.setdefault(person.team, []):
            teams[person.team].append(learner)
    remarks = (*collected.remarks, *matching.remarks())
    everybody = sorted(learners.values(), key=lambda submission: submission.learner)
    shared = share_in_teams(
        replace(collected, submissions=tuple(everybody), remarks=remarks), teams
    )
    return shared, lambda submission: own.get(submission.learner, due)


def _remarks_without_roster(collected: Collection) -> Iterator[Remark]:
    """Yield what cannot be done because no roster was given."""
    for system in sorted({submission.system for submission in collected.submissions}):
        platform = platform_named(system)
        if not platform.roster_has_ids:
            problem = (
                f"{platform.title} finds learners by an id that its downloads do not have, so "
                f"{platform.name}.csv is not written. Give its export of the grades with --roster."
            )
            yield Remark("roster", platform.title, problem)


def with_details(book: Gradebook, collected: Collection) -> Gradebook:
    """Return a gradebook in which learners have what platform and roster say of them besides."""
    details = {submission.learner: submission.details for submission in collected.submissions}
    learners = (
        replace(graded, details=details.get(graded.learner, {})) for graded in book.learners
    )
    return replace(book, learners=tuple(learners))


class _Matching:
    """Match the lines of a roster with those who handed in: by id, and then, what is left, by name.

    Whoever is found by an id is taken, so nobody of the same name gets another's submission. A line
    that may be several learners, or several lines that may be one, decide nothing, and are told.
    """

    def __init__(self, collected: Collection, roster: Roster) -> None:
        self._collected, self._roster = collected, roster
        self._lookup = Lookup(collected.submissions)
        self._systems = {submission.system for submission in collected.submissions}
        self._lines: dict[str, int] = {}
        self._mentioned: set[str] = set()
        self._remarks: list[Remark] = []
        self._left: list[Person] = []
        #: Each line that is one learner, with the learner's id.
        self.learners: list[tuple[Person, str]] = []

    def match_ids(self) -> None:
        """Match by id; the lines that no id decides are left."""
        for person in self._roster.people:
            candidates = self._lookup.by_id(person.id)
            if len(candidates) == 1:
                self._take(person, candidates[0].learner, candidates[0].called)
            else:
                self._left.append(person)

    def match_names(self) -> None:
        """Match the lines that are left by name; nobody of them is left out of the class."""
        known = dict(self._lines)
        candidates = {person.line: self._by_name(person, known) for person in self._left}
        claims: dict[str, set[str]] = defaultdict(set)
        for person in self._left:
            for submission in candidates[person.line]:
                claims[submission.learner].add(person.id)
        for person in self._left:
            several = candidates[person.line]
            self._mentioned |= {submission.learner for submission in several}
            many = max((len(claims[submission.learner]) for submission in several), default=1)
            name = printable(person.name or person.id, 60)
            if len(several) == many == 1:
                self._take(person, several[0].learner, several[0].called)
            elif len(several) > 1:
                problem = f"{name!r} are {len(several)} learners who handed in; write the id."
                self._remark(person, problem)
            elif several:
                problem = f"{name!r} are {many} lines of the roster and 1 learner who handed in; "
                self._remark(person, f"{problem}write the id.")
            if not several or many > len(several):
                self._take(person, person.id or person.name, name)

    def _by_name(self, person: Person, known: Mapping[str, int]) -> list[Submission]:
        """Return who may be meant by a name, of those whom no id has decided.

        Args:
            person: The line.
            known: The lines of those whose ids are on the roster. If there are any, the roster has
                the ids of the platform, and whoever has another id is another person.
        """
        platform = platform_named(self._roster.system)
        if person.id and platform.roster_has_ids and self._systems == {self._roster.system}:
            return []
        named = self._lookup.by_id(person.id) or self._lookup.by_name(person.name or person.id)
        if not person.id and named and all(submission.learner in known for submission in named):
            problem = f"{printable(person.name, 60)!r} is also the name of {named[0].called}, whom "
            self._remark(person, f"{problem}line {known[named[0].learner]} names; write the id.")
        has_other_id = bool(known and person.id and person.name)
        return [
            submission
            for submission in named
            if submission.learner not in known
            and not (has_other_id and submission.name != submission.learner)
        ]

    def _take(self, person: Person, learner: str, called: str) -> None:
        if learner in self._lines:
            problem = f"Line {self._lines[learner]} names {printable(called, 60)} already."
            self._remark(person, problem)
        self._lines.setdefault(learner, person.line)
        self.learners.append((person, learner))

    def _remark(self, person: Person, text: str) -> None:
        self._remarks.append(Remark("roster", f"{self._roster.file}, line {person.line}", text))

    def absent(self, person: Person, learner: str) -> Submission:
        """Return the empty submission of somebody who handed in nothing."""
        system = self._roster.system
        if not system and person.id.isdigit() and len(self._systems) == 1:
            (system,) = self._systems
        return Submission(learner, person.name or person.id, system or "folder")

    def remarks(self) -> Iterator[Remark]:
        """Yield what is odd about lines, and who is on none."""
        yield from self._remarks
        teams = {person.team for person in self._roster.people if person.team}
        for submission in self._collected.submissions:
            is_team = any(has_name_of(team, submission) for team in teams)
            if submission.learner not in {*self._lines, *self._mentioned} and not is_team:
                problem = f"{printable(submission.called, 60)} handed in and is not on the roster."
                yield Remark("roster", self._roster.file, problem)

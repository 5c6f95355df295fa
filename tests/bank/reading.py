"""Read the bank: answers to the exercises, and what must be said of each.

A folder has a file for each exercise, such as `answers/03a.txt`. An entry is a whole cell, or it
changes another one; by default the solution that the course publishes::

    === right | what is unusual about it
    the cell, the file or the lines of a terminal

    === wrong mistake-id | what is wrong
    --- a remark for readers, on as many such lines as it takes
    a part of a line => what stands there instead
     a line that stays, to find the place
    -a line that goes
    +a line that comes

    === wrong mistake-id or another-id | what is wrong | from what is unusual about it
    a part of a line of that entry, which is a whole one => what stands there instead

    === untried | it leaves nothing behind that could be judged

What a change looks for has to be there exactly once. Lines that come end a change of lines, and so
does an empty line; without a line to find they come first. Of several mistakes, and of one that has
several names, each name is true. Behind the name, parts that are set off by ` | ` say more::

    from NAME     the entry to change, instead of the solution
    misses R1 R2  the requirements of the rubric that are not met: these, and no others
    points 2      the points that a wrong answer gets all the same
    EXPRESSION    what is handed to `check`; by default what the solution defines last, or what the
                  cell defines last if it does not define that

Lines that begin with `$ ` at the top of an entry are typed into the workspace as well. The lines
before the first entry are pieces of the answer that no hint may hold: `hidden: depth=1`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from bank.pages import solution

_HERE = Path(__file__).parent
STATUS = {"right": "passed", "wrong": "failed", "untried": "not attempted"}
_BAR, _ARROW = " | ", " => "
_CHANGE = r"(?:^[ -].*\n)*(?:^\+.*\n)+|(?:^[ -].*\n)+|^.+"
_DEFINED = r"^(?:(?:class|def) (\w+)|(\w+) = )"


@dataclass(frozen=True)
class Answer:
    """Hold one answer, and what must be said of it.

    Attributes:
        exercise: The exercise's id.
        name: What it is about; unique within the exercise.
        text: The cell, the file or the lines of a terminal.
        status: The status that it must get.
        mistakes: Ids of mistakes, each of which is a true name for what is wrong.
        subject: The expression that is handed to `check`.
        before: Lines of a shell that are typed into the workspace, too.
        misses: Ids of the requirements that are not met.
        points: The points that a wrong answer gets; None if that is not said.
    """

    exercise: str
    name: str
    text: str
    status: str = "passed"
    mistakes: tuple[str, ...] = ()
    subject: str = ""
    before: str = ""
    misses: frozenset[str] = frozenset()
    points: int | None = None

    @property
    def id(self) -> str:
        """Return its name in a test report."""
        return f"{self.exercise} {self.name}"


def parse(exercise: str, text: str, published: str) -> tuple[Answer, ...]:
    """Return the answers that are written in a text.

    Args:
        exercise: The exercise's id.
        text: The text, as this module's docstring describes it.
        published: The solution that the course publishes.

    Raises:
        ValueError: If an entry is not as it has to be: it says which one.
    """
    entries = [one.partition("\n") for one in re.split(r"^=== ", text, flags=re.MULTILINE)[1:]]
    heads = [head.split(_BAR) for head, _, _ in entries]
    if nameless := [head for head in heads if len(head) < 2]:
        raise ValueError(f"{exercise}: without a name: {nameless}")
    bodies = {
        head[1]: _typed_and_text(entry[2]) for head, entry in zip(heads, entries, strict=True)
    }
    return tuple(_answer(exercise, head, bodies, published) for head in heads)


def _answer(
    exercise: str, head: list[str], bodies: dict[str, tuple[str, str]], published: str
) -> Answer:
    """Return an answer by the head of its entry, and by the bodies of all entries."""
    verdict, name, *more = head
    word, _, mistakes = verdict.partition(" ")
    said = {}
    for part in more:
        kind, _, value = part.partition(" ")
        known = kind in ("from", "misses", "points")
        said[kind if known else "subject"] = value if known else part
    before, cell = bodies[name]
    try:
        base = bodies[said["from"]][1] if "from" in said else published
        if "from" in said and (_is_change(base) or not _is_change(cell)):
            raise ValueError("it has to change a whole entry")
        if _is_change(cell):
            cell = changed(base, cell)
        status = STATUS[word]
    except (KeyError, ValueError) as error:
        raise ValueError(f"{exercise} {name}: {error}") from error
    return Answer(
        exercise,
        name,
        cell,
        status,
        tuple(mistakes.split(" or ")) if mistakes else (),
        said.get("subject") or _subject(cell, published),
        before,
        frozenset(said.get("misses", "").split()),
        int(said["points"]) if "points" in said else None,
    )


def changed(text: str, changes: str) -> str:
    """Return a text with changes made to it, one after the other.

    Raises:
        ValueError: If what a change looks for is not there exactly once.
    """
    for change in re.findall(_CHANGE, f"{changes}\n", re.MULTILINE):
        if change[0] in " -+":
            lines = change.splitlines()
            old = "".join(f"{line[1:]}\n" for line in lines if line[0] != "+")
            new = "".join(f"{line[1:]}\n" for line in lines if line[0] != "-")
            text = _replaced(f"\n{text}", f"\n{old}", f"\n{new}")[1:] if old else new + text
        else:
            old, new = change.split(_ARROW)
            text = _replaced(text, old, new)
    return text


def _replaced(text: str, old: str, new: str) -> str:
    count = len(re.findall(f"(?={re.escape(old)})", text))
    if count != 1:
        raise ValueError(f"{count} places to change, and not one: {old!r}")
    return text.replace(old, new)


def _is_change(body: str) -> bool:
    return not body.strip() or body[0] in " -+" or _ARROW in body.partition("\n")[0]


def _typed_and_text(body: str) -> tuple[str, str]:
    """Return what is typed as well, and the entry's text without remarks."""
    lines = body.strip("\n").splitlines()
    while lines and lines[0].startswith("--- "):
        del lines[0]
    typed = [line[2:] for line in lines if line.startswith("$ ")]
    return "\n".join(typed), "\n".join([*lines[len(typed) :], ""])


def _subject(cell: str, published: str) -> str:
    mine, usual = (
        ["".join(names) for names in re.findall(_DEFINED, text, re.MULTILINE)]
        for text in (cell, published)
    )
    return next((name for name in (*usual[-1:], *mine[-1:]) if name in mine), "")


def read(folder: Path) -> tuple[Answer, ...]:
    """Return the answers of a folder of the bank, in the order of the exercises."""
    files = sorted(folder.glob("*.txt"))
    texts = ((file.stem, file.read_text(encoding="utf-8")) for file in files)
    return tuple(one for name, text in texts for one in parse(name, text, solution(name)))


def hidden(exercise: str) -> tuple[str, ...]:
    """Return pieces of an exercise's answer that no hint may hold; spaces do not count."""
    text = (_HERE / "answers" / f"{exercise}.txt").read_text(encoding="utf-8")
    return tuple(re.findall(r"^hidden: (.*)", text.partition("\n===")[0], re.MULTILINE))


@cache
def answers() -> tuple[Answer, ...]:
    """Return the answers that were written to try the judges."""
    return read(_HERE / "answers")


@cache
def held_out() -> tuple[Answer, ...]:
    """Return the answers by people who had the pages only; see `held_out/README.md`."""
    return tuple(one for folder in sorted(_HERE.glob("held_out*")) for one in read(folder))


@cache
def third_set() -> tuple[Answer, ...]:
    """Return a third set of such answers, which only a thorough run tries."""
    return read(_HERE / "third_set")

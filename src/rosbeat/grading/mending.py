"""Which cells of a page that was handed in hold the answers, whatever has happened to the page.

A cell is found by its id; else by the exercise that it says it answers; else by likeness: it
defines what the exercise's cell defines. What was done is said, sentence by sentence.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence, Set
from dataclasses import dataclass, replace
from difflib import SequenceMatcher

from rosbeat.exercises.exercise import BLANK
from rosbeat.grading.notebook import Cell

#: From which share of equal text on a cell without a name counts as the one that was filled in.
ALIKE = 0.6
#: What is said of an answer that is nowhere, and of one of which a part is.
NOT_THERE, PART_NOT_THERE = "Its cell is not on the page.", "A cell of it is not on the page."
_DEFINED = re.compile(r"^(?:class|def)\s+(\w+)", re.MULTILINE)


@dataclass(frozen=True)
class Wanted:
    """A cell of the course's own page that waits for an answer.

    Attributes:
        exercise: The exercise's id.
        id: The cell's id.
        blank: Its text, with blanks.
    """

    exercise: str
    id: str
    blank: str


@dataclass(frozen=True)
class Found:
    """The answer to one exercise as it was handed in.

    Attributes:
        exercise: The exercise's id.
        source: The text of its cell; empty if there is none.
        place: The cell's place on the page, or -1.
        repairs: What was done to find it, a sentence each; nothing if it was where it belongs.
    """

    exercise: str
    source: str = ""
    place: int = -1
    repairs: tuple[str, ...] = ()


def find_answers(wanted: Sequence[Wanted], cells: Sequence[Cell]) -> tuple[Found, ...]:
    """Find the answers on a page.

    Args:
        wanted: The cells that wait for one, in the order of the course's page.
        cells: The cells that were handed in.

    Returns:
        One for each wanted cell, in the same order.
    """
    cells = [cell for cell in cells if not cell.check]
    taken: set[int] = set()
    answers = []
    for one in wanted:
        others = {other.id for other in wanted if other is not one}
        free = [cell for cell in cells if cell.place not in taken and cell.id not in others]
        shared = any(other.exercise == one.exercise for other in wanted if other is not one)
        found = _find_part(one, free) if shared else _find(one, free)
        taken.add(found.place)
        answers.append(_joined(found, cells, taken))
    return tuple(answers)


def is_behind_the_end(
    wanted: Wanted, found: Found, cells: Sequence[Cell], behind: Set[str]
) -> bool:
    """Whether a cell has to be taken for lost, on a page of a file that breaks off.

    It is lost if neither its id nor its exercise is on the page, and nothing that comes behind it
    on the course's page either. A cell that is merely alike may be any other.

    Args:
        wanted: The cell.
        found: What was found in its place.
        cells: The cells that could be read.
        behind: The ids of the course's cells behind it.
    """
    ids = {cell.id for cell in cells if cell.id}
    if wanted.id in ids or any(cell.exercise == wanted.exercise for cell in cells):
        return False
    return not ids & behind and (found.place < 0 or bool(ids))


def _find(wanted: Wanted, cells: Sequence[Cell]) -> Found:
    by_id = [cell for cell in cells if cell.id and cell.id == wanted.id]
    by_name = [cell for cell in cells if cell.exercise == wanted.exercise]
    if by_id:
        return _chosen(wanted, _unique([*by_id, *by_name]), "")
    if by_name:
        return _chosen(wanted, by_name, "Its cell has another id than on the course's page.")
    alike = _alike(wanted, cells)
    if alike:
        said = "Its cell has lost its name and was found by what it defines."
        return _chosen(wanted, alike, said)
    return Found(wanted.exercise, repairs=(NOT_THERE,))


def _find_part(wanted: Wanted, cells: Sequence[Cell]) -> Found:
    """One of several cells of the same exercise: its name alone does not say which."""
    by_id = [cell for cell in cells if cell.id and cell.id == wanted.id]
    by_name = [cell for cell in cells if cell.exercise == wanted.exercise]
    if by_id:
        return _chosen(wanted, by_id, "")
    alike = _alike(wanted, by_name) or _alike(wanted, cells) or by_name[:1]
    if alike:
        said = "A cell of it has another id than on the course's page."
        return _chosen(wanted, alike, said)
    return Found(wanted.exercise, repairs=(PART_NOT_THERE,))


def _unique(cells: Sequence[Cell]) -> list[Cell]:
    return sorted({cell.place: cell for cell in cells}.values(), key=lambda cell: cell.place)


def _chosen(wanted: Wanted, cells: Sequence[Cell], said: str) -> Found:
    """The last cell in which something was tried, and the last one if nothing was."""
    repairs = [said] if said else []
    tried = [cell for cell in cells if BLANK not in cell.source and cell.source.strip()]
    cell = (tried or list(cells))[-1]
    if len(cells) > 1:
        repairs.append(f"Its cell is there {len(cells)} times; the last one that is filled counts.")
    if cell.sort != "code":
        repairs.append(f"Its cell was turned into a {cell.sort} cell and was read as code.")
    return Found(wanted.exercise, cell.source, cell.place, tuple(repairs))


def _alike(wanted: Wanted, cells: Sequence[Cell]) -> list[Cell]:
    names = set(_DEFINED.findall(wanted.blank))
    same = [cell for cell in cells if names and names & set(_DEFINED.findall(cell.source))]
    if same:
        return same
    near = [cell for cell in cells if _likeness(wanted.blank, cell.source) >= ALIKE]
    return sorted(near, key=lambda cell: _likeness(wanted.blank, cell.source))[-1:]


def _likeness(blank: str, source: str) -> float:
    """How much of the text that was given is still there, from 0 to 1."""
    given = [line.strip() for line in blank.splitlines() if line.strip() and BLANK not in line]
    kept = [line.strip() for line in source.splitlines() if line.strip()]
    if not given or not kept:
        return 0.0
    matcher = SequenceMatcher(None, given, kept, autojunk=False)
    return sum(block.size for block in matcher.get_matching_blocks()) / len(given)


def _joined(found: Found, cells: Sequence[Cell], taken: set[int]) -> Found:
    """A cell that was split in two is put together if only the whole is a program."""
    if not found.source or _is_program(found.source):
        return found
    after = [cell for cell in cells if cell.place > found.place][:2]
    text = found.source
    for cell in after:
        if cell.sort != "code" or cell.exercise not in ("", found.exercise):
            break
        text = f"{text}\n{cell.source}"
        if _is_program(text):
            taken.update(one.place for one in after if one.place <= cell.place)
            said = "Its cell was split; the parts were put together."
            return replace(found, source=text, repairs=(*found.repairs, said))
    return found


def _is_program(source: str) -> bool:
    if source.lstrip().startswith("%%"):
        return True
    try:
        ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return True

"""What a class handed in, as a table for a terminal and as JSON."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from io import StringIO
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from rosbeat.grading.collecting import Collection, HandedIn, Submission
from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.remarks import Remark, printable

VERSION = 1
#: Signs in the table.
_HERE, _LATE, _HALF, _MISSING = "yes", "late", "half", "-"
#: Characters of a name in the table; the JSON has all of them.
_NAME = 30


def as_text(found: Collection, pages: Sequence[CoursePage]) -> str:
    """Make a table of who handed in what, and a list of all remarks, for a terminal.

    Args:
        found: What was handed in.
        pages: The pages that are asked for.
    """
    remarks = list(_remarks(found))
    lines = [_table(found, pages), ""] if found.submissions else []
    lines += [_total(found, pages, len(remarks)), ""]
    lines += [f"{one.about}: {one.path}\n    {printable(one.text, 1000)}" for one in remarks]
    return "\n".join(lines).rstrip()


def _table(found: Collection, pages: Sequence[CoursePage]) -> str:
    table = Table(box=None, pad_edge=False, header_style="")
    for head in ("learner", "name"):
        table.add_column(head, no_wrap=True)
    for page in pages:
        table.add_column(page.number)
    table.add_column("remarks", justify="right")
    for one in found.submissions:
        table.add_row(*(Text(cell) for cell in _row(one, pages)))
    target = StringIO()
    # As wide as it needs to be, so that it can be searched and piped; without colours.
    Console(file=target, width=2_000, color_system=None, highlight=False).print(table)
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines())


def _row(one: Submission, pages: Sequence[CoursePage]) -> list[str]:
    handed = {page.page: page for page in one.pages}
    name = printable(one.name, _NAME) if one.name != one.learner else ""
    cells = [_cell(handed.get(page.lesson)) for page in pages]
    return [printable(one.learner, _NAME), name, *cells, str(len(one.remarks) or "")]


def _cell(page: HandedIn | None) -> str:
    if page is None:
        return _MISSING
    signs = [sign for sign, is_so in ((_LATE, page.late), (_HALF, page.notebook.cut)) if is_so]
    return ", ".join(signs) or _HERE


def _remarks(found: Collection) -> Iterator[Remark]:
    yield from found.remarks
    for one in found.submissions:
        yield from one.remarks


def _total(found: Collection, pages: Sequence[CoursePage], remarks: int) -> str:
    asked = {page.lesson for page in pages}
    counts = Counter(page.page for one in found.submissions for page in one.pages)
    there = sum(counts[page] for page in asked)
    nobody = sum(not one.pages for one in found.submissions)
    parts = [f"{_many(len(found.submissions), 'learner')}, {_many(there, 'page')}"]
    parts += [f"{_many(nobody, 'learner')} without any page"] if nobody else []
    others = sum(counts.values()) - there
    parts += [f"{_many(others, 'page')} that you did not ask for"] if others else []
    return f"{', '.join(parts)}, {_many(remarks, 'remark')} about files."


def _many(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def as_json(found: Collection) -> str:
    """The same as JSON, in ASCII, so that it can be printed anywhere.

    Args:
        found: What was handed in.
    """
    learners = [
        {
            **{"learner": one.learner, "name": one.name, "system": one.system},
            **{"pages": [_page(page) for page in one.pages]},
            **{"remarks": [asdict(remark) for remark in one.remarks]},
        }
        for one in found.submissions
    ]
    remarks = [asdict(remark) for remark in found.remarks]
    return json.dumps({"version": VERSION, "learners": learners, "remarks": remarks}, indent=1)


def _page(page: HandedIn) -> dict[str, Any]:
    return {
        **{"page": page.page, "path": page.path, "late": page.late, "modified": page.modified},
        **{"cells": len(page.notebook.cells), "repairs": list(page.notebook.repairs)},
    }

"""Write the learners' feedback: a page for each with all findings, and zip files to upload.

A page shows a learner's own code with the relevant lines, and the answer's behaviour beside that of
the published solution. How files in a zip are called, and which form of the feedback a platform
takes, is in `platforms`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from io import BytesIO
from itertools import groupby
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from markupsafe import Markup

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.outcome_display import RIGHT, WRONG
from rosbeat.grading.files import file_name
from rosbeat.grading.marks import (
    HELD,
    LOOKED_AT,
    MISSING,
    Gradebook,
    Graded,
    Mark,
    Solution,
    late_note,
)
from rosbeat.grading.platforms import own_path, platform_named
from rosbeat.grading.platforms.base import Feedback
from rosbeat.grading.remarks import REACHES_INSIDE
from rosbeat.grading.rendering import (
    html,
    look_of,
    most,
    name,
    page_title,
    paragraph,
    points_of,
    prose,
    render,
    so_far,
    visible,
)
from rosbeat.page_runs.traces import Picture, picture

#: The folder of all such pages.
FOLDER = "feedback"
_NAMELESS = "This is new to the course: it has no name for this mistake yet."


def feedback(graded: Graded, solutions: Iterable[Solution] = ()) -> str:
    """Return the page of one learner.

    Returns:
        A whole HTML document, the same for the same input; it needs no network and no script.
    """
    expected = {one.exercise: one.trace for one in solutions}
    return render(
        "learner.html",
        graded=graded,
        pages=[(page, list(marks)) for page, marks in groupby(graded.marks, lambda one: one.page)],
        files=[
            (name(own_path(one.path)), one.text)
            for one in graded.remarks
            if one.about != REACHES_INSIDE  # that is for the instructor only
        ],
        requirements=_requirements,
        details_of=lambda mark: list(_details(mark)),
        code_of=_code_to_show,
        late_note=late_note,
        picture_of=lambda mark: _picture_to_show(mark, expected.get(mark.exercise, "")),
        FAILED=FAILED,
        HELD=HELD,
        LOOKED_AT=LOOKED_AT,
        MISSING=MISSING,
    )


def feedback_files(book: Gradebook) -> dict[str, str]:
    """Return the file names of a class's pages, by learner."""
    return {one.learner: f"{file_name(one.learner, one.name)}.html" for one in book.learners}


def _details(mark: Mark) -> Iterator[tuple[str, str]]:
    """Yield terms and what is said of them, as HTML."""
    if mark.status == FAILED:
        known = MISTAKES.get(mark.mistake)
        yield "What it is called", paragraph(f"{known.heading}." if known else _NAMELESS)
    if mark.hint:
        yield "What to think about", paragraph(mark.hint)
    if mark.status == FAILED:
        call = '<p>Open the page and run <code>hint("{}")</code>.</p>'
        yield "More help", html(call, mark.exercise)
    for remark in mark.remarks:
        yield "Worth knowing", paragraph(remark)
    if mark.differs:
        yield "Your page and its run", paragraph(mark.differs)
    if mark.manual:
        yield "Points", "Your instructor has set the points of this exercise."
    if mark.comment.strip():
        yield "From your instructor", prose(mark.comment)


def _requirements(mark: Mark) -> list[tuple[str, ...]]:
    return [
        (
            html(
                "<strong>{}</strong> {}{}{}",
                part.id,
                part.text,
                " (optional)" if part.optional else "",
                Markup() if part.met else paragraph(part.evidence),
            ),
            f"{RIGHT} met" if part.met else f"{WRONG} not yet",
            f"{part.points} of {part.out_of}",
        )
        for part in mark.parts
    ]


# The learner's own code.

#: Lines of an answer that are shown, and letters of a line.
_LINES, _LETTERS = 400, 300
#: A line, and one that was named.
_LINE = '<span class="line">{}\n</span>'
_MARKED = '<mark class="line"><span class="hidden">(look here) </span>{}\n</mark>'
#: How a sentence names a line of an answer; see `diagnosis.exceptions.line_of`.
_NAMED_LINE = re.compile(r"\bLine (\d+): `([^`\n]+)`")


def code_of(mark: Mark) -> Markup:
    """Return an answer as HTML, its first lines; those that were named in what was seen are marked.

    A line is marked only if its text is the one that was named: an answer may have several cells,
    and numbers count from the beginning of a cell.

    Returns:
        A `pre` element; nothing if the cell is empty.
    """
    texts = mark.source.splitlines()
    said = (mark.evidence, mark.hint, *(part.evidence for part in mark.parts if not part.met))
    marked: set[int] = set()
    for number, code in (found for text in said for found in _NAMED_LINE.findall(text)):
        alike = [at for at, text in enumerate(texts, 1) if text.strip() == code.strip()]
        marked |= {int(number)} & set(alike) or set(alike if len(alike) == 1 else ())
    first = "\n".join(most(text, _LETTERS) for text in texts[:_LINES])
    lines = str(Markup.escape(visible(first))).split("\n")
    shown = "".join(
        (_MARKED if at in marked else _LINE).format(text) for at, text in enumerate(lines, 1)
    )
    return html('<pre class="code" tabindex="0">{}</pre>', Markup(shown)) if texts else Markup()


def _code_to_show(mark: Mark) -> Markup:
    return Markup() if mark.status in (MISSING, NOT_ATTEMPTED) else code_of(mark)


def _picture_to_show(mark: Mark, expected: str) -> Picture | None:
    return None if mark.status == PASSED else picture(mark.trace, expected)


# Zips to upload.

#: The date of every entry, so that the same feedback gives the same bytes.
_DATE = (1980, 1, 1, 0, 0, 0)


class FeedbackZips:
    """Fill the zips that platforms take, learner by learner."""

    def __init__(self) -> None:
        self._entries: dict[str, dict[str, str]] = {}

    def add(self, graded: Graded, page: str) -> None:
        """Add the feedback of one learner, if the platform takes it."""
        platform = platform_named(graded.system)
        feedback = Feedback(graded, page, partial(feedback_notebook, graded))
        for file, content in platform.feedback_files(feedback):
            self._entries.setdefault(platform.name, {})[file] = content

    def zip_for(self, platform: str) -> bytes:
        """Return the content of the zip for a platform; empty if there is nothing to upload."""
        return _zipped(self._entries.get(platform, {}))


def _zipped(entries: Mapping[str, str]) -> bytes:
    content = BytesIO()
    with ZipFile(content, "w", ZIP_DEFLATED) as archive:
        for name, text in entries.items():
            entry = ZipInfo(name, _DATE)
            entry.compress_type = ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, text.encode("utf-8", "backslashreplace"))
    return content.getvalue() if entries else b""


def feedback_notebook(graded: Graded, page: str) -> str:
    """Return the feedback on one page as a notebook, with the learner's answers as cells."""
    marks = [mark for mark in graded.marks if mark.page == page]
    reached, out_of = sum(mark.points for mark in marks), sum(mark.out_of for mark in marks)
    title = f"Feedback: {page_title(page)}: {points_of(reached, out_of)}{so_far(marks)}"
    cells = [_cell("markdown", "\n\n".join([html("<h1>{}</h1>", title), prose(graded.comment)]))]
    for mark in marks:
        cells.append(_cell("markdown", "\n\n".join(_in_short(mark))))
        if _code_to_show(mark):
            cells.append({**_cell("code", mark.source), "execution_count": None, "outputs": []})
    named = [{**cell, "id": f"feedback-{number}"} for number, cell in enumerate(cells)]
    about = {"language_info": {"name": "python"}}
    document = {"cells": named, "metadata": about, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(document, indent=1) + "\n"


def _cell(kind: str, source: str) -> dict[str, Any]:
    return {"cell_type": kind, "metadata": {}, "source": source}


def _in_short(mark: Mark) -> Iterator[Markup]:
    """Yield what was found as blocks of HTML, which Markdown leaves as they are."""
    reached = "" if mark.status == HELD else f", {points_of(mark.points, mark.out_of)}"
    look, head = look_of(mark.status), "<h2>{} {} {}: {}{}</h2>"
    yield html(head, look.sign, mark.exercise, mark.title, look.word, reached)
    if mark.deduction:
        yield paragraph(late_note(mark))
    if mark.status != LOOKED_AT:
        yield _block(mark.evidence or mark.cause)
    for part in mark.parts:
        word = f"{RIGHT} met" if part.met else f"{WRONG} not yet"
        yield _block(f"{part.id} {word}: {part.text} {'' if part.met else part.evidence}")
    for term, said in _details(mark):
        yield html("<p><strong>{}</strong></p>", term)
        yield said if isinstance(said, Markup) else paragraph(said)


def _block(text: str) -> Markup:
    return paragraph(text.strip("\n"))

"""Give a learner feedback: one page with everything that was found, for every exercise."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from markupsafe import Markup

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.cards import RIGHT, WRONG
from rosbeat.exercises.exercise import FAILED
from rosbeat.grading.learners import own_path
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Graded, Mark
from rosbeat.grading.mending import NOT_THERE, PART_NOT_THERE
from rosbeat.grading.rendering import html, look_of, name, paragraph, prose, render
from rosbeat.grading.writing import file_names

#: The folder of all such pages.
FOLDER = "feedback"
#: What an exercise without points waits for, by whether that is its file.
_WAITS = {False: "waits for your instructor", True: "waits for the whole file"}
_NAMELESS = "This is new to the course: it has no name for this mistake yet."


def feedback(graded: Graded) -> str:
    """Return the page of one learner.

    Args:
        graded: What was found.

    Returns:
        A whole HTML document, the same for the same input; it needs no network and no script.
    """
    return render(
        "learner.html",
        graded=graded,
        pages=[(page, list(marks)) for page, marks in groupby(graded.marks, lambda one: one.page)],
        files=[(name(own_path(one.path)), one.text) for one in graded.remarks],
        word_of=_word_of,
        requirements=_requirements,
        details_of=lambda mark: list(_details(mark)),
        HELD=HELD,
        LOOKED_AT=LOOKED_AT,
        MISSING=MISSING,
    )


def feedback_files(book: Gradebook) -> dict[str, str]:
    """Return the file names of a class's pages, by learner."""
    names = file_names((one.learner, one.name) for one in book.learners)
    return {learner: f"{file}.html" for learner, file in names.items()}


def _word_of(mark: Mark) -> str:
    return _WAITS[mark.waits_for_its_file] if mark.status == HELD else look_of(mark.status).word


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
    found = [one for one in mark.repairs if one not in (NOT_THERE, PART_NOT_THERE)]
    if found:
        yield "How your answer was found", Markup().join(map(paragraph, found))
    if PART_NOT_THERE in mark.repairs:
        yield "What is missing", paragraph(PART_NOT_THERE)
    if mark.late:
        yield "When", "The page was handed in after the deadline."
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

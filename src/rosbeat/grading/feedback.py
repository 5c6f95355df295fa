"""What a learner gets back: one page with everything that was found, for every exercise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.cards import RIGHT, WRONG
from rosbeat.exercises.exercise import FAILED
from rosbeat.exercises.registry import PAGES
from rosbeat.grading.answers import NOT_THERE, PART_NOT_THERE
from rosbeat.grading.bars import Segment, bar, labels
from rosbeat.grading.html_page import (
    document,
    listed,
    name,
    paragraph,
    prose,
    section,
    shown,
    table,
)
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Graded, Mark
from rosbeat.grading.palette import STATUSES, look_of
from rosbeat.grading.remarks import REACHES_INSIDE
from rosbeat.grading.submissions import own_path
from rosbeat.grading.writing import file_names
from rosbeat.records import Part

#: For whom an exercise without points waits: whether it is for its file.
_WAITS = {False: "waits for your instructor", True: "waits for the whole file"}
#: The folder of all such pages.
FOLDER = "feedback"
_END = (
    "<footer><p>What you read here comes from what your answers did when they ran. It does not "
    "depend on how you wrote them. If you see something differently, ask your instructor.</p>"
    "</footer>"
)
_TITLES = {one.number: f"{one.number} {one.title}".strip() for one in PAGES}
_NAMELESS = "This is new to the course: it has no name for this mistake yet."


def feedback(graded: Graded) -> str:
    """Make the page of one learner.

    Args:
        graded: What was found.

    Returns:
        A whole HTML document, the same for the same input; it needs no network and no script.
    """
    pages = [(page, list(marks)) for page, marks in groupby(graded.marks, lambda one: one.page)]
    return document(
        f"Feedback for {graded.name}",
        _head(graded),
        "<main>",
        _overview(pages),
        *(_page(number, page, marks) for number, (page, marks) in enumerate(pages)),
        section("Your files", _files(graded)),
        "</main>",
        _END,
    )


def feedback_files(book: Gradebook) -> dict[str, str]:
    """The file names of a class's pages, by learner.

    Args:
        book: The class.
    """
    names = file_names((one.learner, one.name) for one in book.learners)
    return {learner: f"{name}.html" for learner, name in names.items()}


def points_of(points: float, out_of: float) -> str:
    """Points in words, such as `1.5 of 2 points`.

    Args:
        points: What was reached.
        out_of: What there is.
    """
    return f"{points:.10g} of {out_of:.10g} point{'' if out_of == 1 else 's'}"


def page_title(page: str) -> str:
    """The title of a page with its number; without a title of the course, its name.

    Args:
        page: The lesson's name, such as `03_write_a_publisher`.
    """
    return _TITLES.get(page[:2]) or page


def _head(graded: Graded) -> str:
    every = _segments(graded.marks)
    drawn = bar(every, len(graded.marks), "Your exercises") + labels(every) if every else ""
    rows = (
        f"<h1>Feedback for {name(graded.name)}</h1>",
        f'<p class="points">{points_of(graded.points, graded.out_of)}{_so_far(graded.marks)}</p>',
        f'<div class="row">{drawn}</div>' if drawn else "<p>No exercise was graded.</p>",
        _comment(graded.comment),
    )
    return f"<header>\n{chr(10).join(row for row in rows if row)}\n</header>"


def _so_far(marks: Sequence[Mark]) -> str:
    return " so far" if any(mark.status == HELD for mark in marks) else ""


def _segments(marks: Sequence[Mark]) -> list[Segment]:
    found = [mark.status for mark in marks]
    every = (
        Segment(look.kind, found.count(status), f"{look.sign} {look.word}")
        for status, look in STATUSES.items()
    )
    return [one for one in every if one.count]


def _comment(comment: str) -> str:
    if not comment.strip():
        return ""
    return f'<div class="comment"><strong>From your instructor</strong>{prose(comment)}</div>'


def _overview(pages: Sequence[tuple[str, list[Mark]]]) -> str:
    rows = [
        (
            f'<a href="#page-{number}">{shown(page_title(page))}</a>',
            " ".join(_sign(mark) for mark in marks),
            f"{_sum(marks, 'points')} of {_sum(marks, 'out_of')}{_so_far(marks)}",
        )
        for number, (page, marks) in enumerate(pages)
    ]
    made = table("Each sign is one exercise.", ("Page", "Exercises", "Points"), rows)
    return section("Overview", made)


def _sign(mark: Mark) -> str:
    look = look_of(mark.status)
    said = shown(f"{mark.exercise} {look.word}")
    return f'<span class="sign" role="img" aria-label="{said}" title="{said}">{look.sign}</span>'


def _sum(marks: Sequence[Mark], what: str) -> str:
    return f"{sum(getattr(mark, what) for mark in marks):.10g}"


def _page(number: int, page: str, marks: Sequence[Mark]) -> str:
    heading = f'<span id="page-{number}">{shown(page_title(page))}</span>'
    if all(mark.status == MISSING for mark in marks):
        names = ", ".join(shown(mark.exercise) for mark in marks)
        said = "This page was not among the files that you handed in. It has "
        plural = "s" if len(marks) > 1 else ""
        alone = f"<p>{said}the exercise{plural} {names}.</p>"
        comments = "".join(_article(mark) for mark in marks if mark.comment or mark.manual)
        return section(heading, alone, comments)
    return section(heading, *(_article(mark) for mark in marks))


def _article(mark: Mark) -> str:
    look = look_of(mark.status)
    reached = points_of(mark.points, mark.out_of)
    word = look.word if mark.status != HELD else _WAITS[mark.waits_for_its_file]
    head = (
        f'<h3><span class="sign" aria-hidden="true">{look.sign}</span> {shown(mark.exercise)} '
        f"{shown(mark.title)}: {shown(word)}"
        f'<span class="score">, {"no points yet" if mark.status == HELD else reached}</span></h3>'
    )
    rows = "".join(f"<dt>{term}</dt><dd>{said}</dd>" for term, said in _details(mark))
    seen = "" if mark.status == LOOKED_AT else mark.evidence or mark.cause
    parts = (head, paragraph(seen), _requirements(mark.parts))
    body = "\n".join(part for part in (*parts, f"<dl>{rows}</dl>" if rows else "") if part)
    return f'<article class="{look.kind}">\n{body}\n</article>'


def _details(mark: Mark) -> Iterator[tuple[str, str]]:
    """Terms and what is said of them, as HTML."""
    if mark.status == FAILED:
        yield "What it is called", paragraph(_called(mark.mistake))
    if mark.hint:
        yield "What to think about", paragraph(mark.hint)
    if mark.status == FAILED:
        call = f'hint("{mark.exercise}")'
        yield "More help", f"<p>Open the page and run <code>{shown(call)}</code>.</p>"
    for remark in mark.remarks:
        yield "Worth knowing", paragraph(remark)
    found = [one for one in mark.repairs if one not in (NOT_THERE, PART_NOT_THERE)]
    if found:
        yield "How your answer was found", "".join(paragraph(one) for one in found)
    if PART_NOT_THERE in mark.repairs:
        yield "What is missing", paragraph(PART_NOT_THERE)
    if mark.late:
        yield "When", "<p>The page was handed in after the deadline.</p>"
    if mark.manual:
        yield "Points", "<p>Your instructor has set the points of this exercise.</p>"
    if mark.comment.strip():
        yield "From your instructor", prose(mark.comment)


def _called(mistake: str) -> str:
    known = MISTAKES.get(mistake)
    if known is None:
        return _NAMELESS
    return f"{known.heading}."


def _requirements(parts: Sequence[Part]) -> str:
    rows = [
        (
            f"<strong>{shown(part.id)}</strong> {shown(part.text)}{_why(part)}",
            f"{RIGHT} met" if part.met else f"{WRONG} not yet",
            f"{part.points} of {part.out_of}",
        )
        for part in parts
    ]
    return table("What is required", ("Requirement", "Outcome", "Points"), rows)


def _why(part: Part) -> str:
    extra = " (optional)" if part.optional else ""
    return extra if part.met else extra + paragraph(part.evidence)


def _files(graded: Graded) -> str:
    rows = [
        (name(own_path(one.path)), shown(one.text))
        for one in graded.remarks
        if one.about != REACHES_INSIDE
    ]
    return listed("What was noticed about them", ("File", "What was found"), rows)

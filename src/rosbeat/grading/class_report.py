"""What an instructor sees of a class: how each exercise went, and which mistakes to talk about."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.grading.bars import Segment, bar, labels
from rosbeat.grading.class_report_learners import (
    files_of_class,
    half_files,
    held_answers,
    learners_table,
    nameless_answers,
)
from rosbeat.grading.feedback import page_title
from rosbeat.grading.html_page import document, folded, section, shown, table
from rosbeat.grading.marks import Gradebook
from rosbeat.grading.palette import STATUSES
from rosbeat.grading.tally import (
    ExerciseTally,
    MistakeTally,
    cut_off,
    held,
    tally_exercises,
    tally_mistakes,
    tally_points,
)
from rosbeat.viz.words import count

#: Mistakes that are shown at once; the others unfold.
_FIRST = 10
#: Exercises that are named with a mistake; the table has all of them.
_PLACES = 6
#: Characters of a text of somebody's run.
_MOST = 300


def class_report(book: Gradebook) -> str:
    """Make the report of a class.

    Learners are named only where somebody has to look at their work, and in a table that unfolds.

    Args:
        book: The class.

    Returns:
        A whole HTML document, the same for the same input; it needs no network and no script.
    """
    return document(
        "The class",
        _head(book),
        "<main>",
        section("Points", _points(book)),
        section("Mistakes", _mistakes(tally_mistakes(book))),
        section("Exercises", *_exercises(tally_exercises(book))),
        section(
            "For you to look at", *held_answers(book), half_files(book), nameless_answers(book)
        ),
        section("Learners", learners_table(book)),
        section("Files", *files_of_class(book)),
        "</main>",
        "<footer><p>The whole of it, row by row, is in grades.csv and results.json.</p></footer>",
    )


def _head(book: Gradebook) -> str:
    exercises = tally_exercises(book)
    waiting, half = len(held(book)), len(cut_off(book))
    again = f"{count(half, 'file')} {'is' if half == 1 else 'are'} not whole. " if half else ""
    looks = f"{count(waiting, 'answer')} {'wait' if waiting != 1 else 'waits'} for you to look at."
    return (
        f"<header>\n<h1>The class</h1>\n<p>{count(len(book.learners), 'learner')}, "
        f"{count(len(exercises), 'exercise')}. {looks if waiting else 'No answer waits for you.'} "
        f"{again}"
        f'<span class="muted">Judged by version {shown(book.course)} of the course.</span></p>\n'
        "</header>"
    )


# Points.


def _points(book: Gradebook) -> str:
    found = tally_points(book)
    if not found.highest:
        return "<p>There are no points to count.</p>"
    rows = [_step(step, many, found.highest) for step, many in reversed(found.range)]
    said = f"<p>Median {found.median:.0f} %, mean {found.mean:.0f} % of the points.</p>"
    numbers = [(step, str(many)) for step, many in found.steps]
    return "\n".join(
        [said, *rows, _as_table("Learners by points", ("Points", "Learners"), numbers)]
    )


def _step(step: str, many: int, most: int) -> str:
    drawn = bar([Segment("held", many, "learners")], most, step) if many else ""
    return f'<div class="row"><p>{step}: {count(many, "learner")}</p>{drawn}</div>'


def _as_table(caption: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    made = table(caption, head, rows).replace("<table>", '<table class="numbers">', 1)
    return folded("The same as a table", made)


# Exercises.


def _exercises(found: Sequence[ExerciseTally]) -> list[str]:
    parts = []
    for page in dict.fromkeys(one.page for one in found):
        parts.append(f"<h3>{shown(page_title(page))}</h3>")
        parts += [_exercise(one) for one in found if one.page == page]
    return [*parts, _exercise_table(found)]


def _segments(found: ExerciseTally) -> list[Segment]:
    return [
        Segment(look.kind, found.counts.get(status, 0), f"{look.sign} {look.of_class}")
        for status, look in STATUSES.items()
    ]


def _exercise(found: ExerciseTally) -> str:
    segments, title = _segments(found), f"{found.exercise} {found.title}"
    drawn = bar(segments, found.learners, title)
    return f'<div class="row"><p>{shown(title)}</p>{drawn}{labels(segments)}</div>'


def _exercise_table(found: Sequence[ExerciseTally]) -> str:
    head = ["Exercise", *(f'<abbr title="{look.of_class}">{look.sign}</abbr>'
                          for look in STATUSES.values())]  # fmt: skip
    rows = [
        [shown(one.exercise), *(str(one.counts.get(status, 0)) for status in STATUSES)]
        for one in found
    ]
    signs = ", ".join(f"{look.sign} {look.of_class}" for look in STATUSES.values())
    return _as_table(f"Learners by outcome: {signs}", head, rows)


# Mistakes.


def _mistakes(found: Sequence[MistakeTally]) -> str:
    if not found:
        return "<p>No answer failed.</p>"
    most = found[0].count
    rows = [_mistake(one, most) for one in found]
    others = folded(f"{count(len(rows) - _FIRST, 'more mistake')}", "\n".join(rows[_FIRST:]))
    numbers = [(_title(one), str(one.count), str(one.learners), _places(one)) for one in found]
    head = ("Mistake", "Answers", "Learners", "Where")
    folded_table = folded("The same as a table", table("Mistakes by frequency", head, numbers))
    return "\n".join([*rows[:_FIRST], others, folded_table])


def _mistake(found: MistakeTally, most: int) -> str:
    drawn = bar([Segment("failed", found.count, "answers")], most, found.mistake)
    where = f"{count(found.count, 'answer')} of {count(found.learners, 'learner')}: "
    rows = [
        f"<p><strong>{_title(found)}</strong></p>{drawn}",
        f'<p class="labels">{where}{_first_places(found)}</p>',
        f"<p>Hint for the class: {shown(found.hint, _MOST)}</p>" if found.hint else "",
        f'<p class="muted">Seen, for example: {shown(found.evidence, _MOST)}</p>'
        if found.evidence
        else "",
    ]
    return f'<div class="row">{"".join(rows)}</div>'


def _title(found: MistakeTally) -> str:
    known = MISTAKES.get(found.mistake)
    if known is None:
        return "Mistakes without a name"
    return shown(known.heading)


def _places(found: MistakeTally) -> str:
    return ", ".join(f"{shown(exercise)} {many}×" for exercise, many in found.places)


def _first_places(found: MistakeTally) -> str:
    first = _places(replace(found, places=found.places[:_PLACES]))
    more = len(found.places) - _PLACES
    return f"{first} and in {count(more, 'more exercise')}" if more > 0 else first

"""The parts of a class's report that name learners: what a person has to look at, and files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from html import escape

from rosbeat.grading.answers import NOT_THERE, PART_NOT_THERE
from rosbeat.grading.cells import number
from rosbeat.grading.feedback import FOLDER, feedback_files
from rosbeat.grading.html_page import folded, listed, name, shown, table, visible
from rosbeat.grading.marks import Gradebook, Graded, Mark
from rosbeat.grading.submissions import own_path
from rosbeat.grading.tally import all_marks, cut_off, empty_handed, held, nameless
from rosbeat.viz.words import count

#: What sorts of remarks are called, as headings.
_ABOUT = {
    "late": "Handed in late",
    "duplicate": "Handed in more than once",
    "renamed": "Under another name",
    "empty": "Empty files",
    "half-uploaded": "Files that are not whole",
    "mended": "Files that were mended to be read",
    "wrong-course": "Notebooks of another course",
    "unreadable": "Files that cannot be read",
    "too-large": "Files that are too large",
    "refused": "Files that were refused",
    "left-out": "Files that were left out",
    "reaches-inside": "Answers that reach for what observes them; their marks stand",
    "manual": "Lines of manual.csv that need a look",
}
#: Characters of a text of somebody's run, and of an answer that has to be looked at.
_MOST, _MOST_OF_AN_ANSWER = 300, 10_000
#: Held answers that are shown, and of how many on they are folded up.
_MOST_HELD, _FOLDED_FROM = 200, 12


def held_answers(book: Gradebook) -> Iterator[str]:
    """Each answer that waits for a person: whose it is, why it waits, and its text.

    Args:
        book: The class.
    """
    found = held(book)
    if found:
        yield "<h3>Answers that nobody could judge</h3>"
    for learner, mark in found[:_MOST_HELD]:
        yield _held_answer(learner, mark, len(found) < _FOLDED_FROM)
    if len(found) > _MOST_HELD:
        yield f"<p>And {len(found) - _MOST_HELD} more; results.json has all of them.</p>"


def _held_answer(learner: Graded, mark: Mark, is_open: bool) -> str:
    whose = f"<strong>{name(learner.called)}</strong>, {shown(mark.exercise)} {shown(mark.title)}"
    where = f'<span class="muted">in {name(own_path(mark.file))}</span>' if mark.file else ""
    lines = count(len(mark.answer.splitlines()), "line")
    text = folded(f"The answer, {lines}", _program(mark.answer), is_open)
    why = f"<p>{shown(mark.cause, _MOST)}</p>"
    return f'<article class="held">\n<p>{whose} {where}</p>\n{why}\n{text}\n</article>'


def _program(text: str) -> str:
    """A program as HTML, whole but for what nobody would read."""
    if not text.strip():
        return ""
    more = len(text) - _MOST_OF_AN_ANSWER
    rest = f"<p>And {more} more characters; the file has all of them.</p>" if more > 0 else ""
    first = "\n".join(text[:_MOST_OF_AN_ANSWER].splitlines())
    return f'<pre class="program" tabindex="0">{escape(visible(first))}</pre>{rest}'


def half_files(book: Gradebook) -> str:
    """Exercises that have no points yet because their files break off.

    Args:
        book: The class.
    """
    rows = [
        (name(learner.called), ", ".join(map(shown, exercises)), name(own_path(file)))
        for learner, file, exercises in cut_off(book)
    ]
    caption = "Files that stop before these exercises: ask for them again"
    return listed(caption, ("Learner", "Exercises", "File"), rows)


def nameless_answers(book: Gradebook) -> str:
    """Answers that failed with a mistake that has no name.

    Args:
        book: The class.
    """
    rows = [
        (name(learner.called), shown(mark.exercise), shown(mark.evidence or mark.cause, _MOST))
        for learner, mark in nameless(book)
    ]
    head = ("Learner", "Exercise", "What was seen")
    return listed("Answers that failed in a way that has no name yet", head, rows)


def learners_table(book: Gradebook) -> str:
    """All learners by name, with their points and a link to their feedback.

    Args:
        book: The class.
    """
    files = feedback_files(book)
    ordered = sorted(book.learners, key=lambda one: (one.name.casefold(), one.learner))
    rows = [_learner(one, files[one.learner]) for one in ordered]
    head = ("Name", "Id", "Points", "Of", "Remarks")
    caption = "Points and feedback; ? after points: something is held, or a file is not whole"
    made = table(caption, head, rows, len(rows)).replace(
        "<table>", '<table class="numbers learners">', 1
    )
    return folded(f"{count(len(rows), 'learner')}: points and feedback", made)


def _learner(graded: Graded, file: str) -> tuple[str, ...]:
    waits = "" if graded.is_settled else " ?"
    return (
        f'<a href="{FOLDER}/{file}">{name(graded.name)}</a>',
        name(graded.learner),
        f"{number(graded.points)}{waits}",
        number(graded.out_of),
        str(len(graded.remarks) or ""),
    )


def files_of_class(book: Gradebook) -> Iterator[str]:
    """What is worth telling about files.

    Args:
        book: The class.
    """
    rows = [(name(one.called),) for one in empty_handed(book)]
    yield listed("Learners of whom no page was found", ("Learner",), rows)
    yield from _remarks(book)
    yield _found(book)
    yield _not_found(book)


def _remarks(book: Gradebook) -> Iterator[str]:
    """One table for each sort of remark."""
    found: dict[str, list[tuple[str, str, str]]] = defaultdict(list)
    for learner in book.learners:
        for one in learner.remarks:
            row = name(learner.name), name(own_path(one.path)), shown(one.text, _MOST)
            found[one.about].append(row)
    for one in book.remarks:
        found[one.about].append(("–", name(one.path), shown(one.text, _MOST)))
    head = ("Learner", "File", "What was found")
    for about in sorted(found):
        yield listed(_ABOUT.get(about) or shown(about), head, found[about])


def _found(book: Gradebook) -> str:
    rows = [
        (name(learner.name), shown(mark.exercise), shown(" ".join(mark.repairs), _MOST))
        for learner, mark in all_marks(book)
        if mark.repairs and not _is_not_there(mark)
    ]
    return listed("Answers that had to be searched for", ("Learner", "Exercise", "How"), rows)


def _not_found(book: Gradebook) -> str:
    rows = [
        (name(learner.name), shown(mark.exercise), shown(" ".join(mark.repairs), _MOST))
        for learner, mark in all_marks(book)
        if _is_not_there(mark)
    ]
    head = ("Learner", "Exercise", "What was found")
    return listed("Exercises whose cells are not on the page", head, rows)


def _is_not_there(mark: Mark) -> bool:
    return NOT_THERE in mark.repairs or PART_NOT_THERE in mark.repairs

"""Report a class to its instructor: the results of each exercise, and the mistakes to talk about.

Learners are named only where somebody has to look at their work, and in a collapsed table.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from statistics import mean, median

from markupsafe import Markup

from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.exercises.exercise import FAILED
from rosbeat.grading.feedback import FOLDER, feedback_files
from rosbeat.grading.files import number
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark
from rosbeat.grading.platforms import own_path
from rosbeat.grading.rendering import (
    STATUSES,
    Segment,
    html,
    most,
    name,
    render,
)
from rosbeat.viz.text_format import count

#: Exercises that are named with a mistake; the table has all of them.
_PLACES = 6
#: Characters of a text of somebody's run.
_MOST = 300
#: The headings of remarks, by what they are about.
_ABOUT = {
    "late": "Handed in late",
    "duplicate": "Handed in more than once",
    "renamed": "Under another name",
    "empty": "Empty files",
    "wrong-course": "Notebooks of another course",
    "unreadable": "Files that cannot be read",
    "left-out": "Files that were left out",
    "reaches-inside": "Pages that reach for what observes them; their marks stand",
    "manual": "Lines of manual.csv that need a look",
    "roster": "Lines of the roster that need a look",
    "team": "Handed in by a team",
}
_Rows = list[tuple[str, ...]]


def class_report(book: Gradebook) -> str:
    """Return the report of a class: a whole HTML document that needs no network and no script."""
    exercises, mistakes = tally_exercises(book), tally_mistakes(book)
    signs = ", ".join(f"{look.sign} {look.of_class}" for look in STATUSES.values())
    return render(
        "class.html",
        book=book,
        own_path=own_path,
        segment=Segment,
        reached=(median(reached), mean(reached)) if (reached := shares(book)) else (),
        mistakes=mistakes,
        exercises=exercises,
        pages=[(page, list(some)) for page, some in groupby(exercises, lambda one: one.page)],
        legend=f"Learners by outcome: {signs}",
        exercise_head=["Exercise", *map(_abbreviation, STATUSES)],
        exercise_rows=[
            (one.exercise, *(one.statuses.count(status) for status in STATUSES))
            for one in exercises
        ],
        held=[
            (
                name(one.called),
                f"{mark.exercise} {mark.title}",
                name(own_path(mark.file)),
                most(mark.differs or mark.cause, _MOST),
            )
            for one, mark in all_marks(book)
            if mark.status == HELD or mark.differs
        ],
        learners=_learners(book),
        files=[(caption, head, rows) for caption, head, rows in _files(book) if rows],
    )


def _abbreviation(status: str) -> Markup:
    look = STATUSES[status]
    return html('<abbr title="{}">{}</abbr>', look.of_class, look.sign)


def _learners(book: Gradebook) -> _Rows:
    files = feedback_files(book)
    return [
        (
            html('<a href="{}/{}">{}</a>', FOLDER, files[one.learner], name(one.name)),
            name(one.learner),
            _points(one),
            number(one.out_of),
            str(len(one.remarks) or ""),
        )
        for one in sorted(book.learners, key=lambda one: (one.name.casefold(), one.learner))
    ]


def _points(graded: Graded) -> str:
    if graded.excused:
        return "no grade"
    late = f" ({number(graded.deduction)} late)" if graded.deduction else ""
    return f"{number(graded.points)}{late}{'' if graded.is_settled else ' ?'}"


def _files(book: Gradebook) -> Iterator[tuple[str, tuple[str, ...], _Rows]]:
    """Yield tables about files: caption, headings of the columns, rows."""
    nobody: _Rows = [(name(one.called),) for one in empty_handed(book)]
    yield "Learners of whom no page was found", ("Learner",), nobody
    found: dict[str, _Rows] = defaultdict(list)
    for learner in book.learners:
        for one in learner.remarks:
            row = name(learner.name), name(own_path(one.path)), most(one.text, _MOST)
            found[one.about].append(row)
    for one in book.remarks:
        found[one.about].append(("–", name(one.path), most(one.text, _MOST)))
    for about in sorted(found):
        head = ("Learner", "File", "What was found")
        yield _ABOUT.get(about) or most(about, _MOST), head, found[about]


# Counting: pure functions of a gradebook.


@dataclass(frozen=True)
class ExerciseTally:
    """Hold how one exercise went in a class: the status of each learner."""

    exercise: str
    title: str
    page: str
    statuses: list[str]


@dataclass(frozen=True)
class MistakeTally:
    """Hold how often one mistake was made in a class.

    Attributes:
        count: In how many answers it was found.
        learners: How many learners made it.
        places: The exercises in which it was found, with how often, most frequent first.
        example: The exercise that the hint and the evidence are about.
        hint: The hint that was given for it most often.
        evidence: What was observed most often in that exercise, where this hint was given.
    """

    mistake: str
    count: int
    learners: int
    places: tuple[tuple[str, int], ...]
    example: str
    hint: str
    evidence: str

    @property
    def title(self) -> str:
        """Return what it is called."""
        known = MISTAKES.get(self.mistake)
        return known.heading if known else "Mistakes without a name"

    @property
    def first_places(self) -> str:
        """Return where it was found most often, in words."""
        first = ", ".join(f"{exercise} {many}×" for exercise, many in self.places[:_PLACES])
        more = len(self.places) - _PLACES
        return f"{first} and in {count(more, 'more exercise')}" if more > 0 else first


def all_marks(book: Gradebook) -> Iterator[tuple[Graded, Mark]]:
    """Yield every mark with its learner, learner by learner."""
    yield from ((learner, mark) for learner in book.learners for mark in learner.marks)


def tally_exercises(book: Gradebook) -> list[ExerciseTally]:
    """Gather the outcomes of each exercise, in the order of the course."""
    found: dict[str, ExerciseTally] = {}
    for _, mark in all_marks(book):
        tally = ExerciseTally(mark.exercise, mark.title, mark.page, [])
        found.setdefault(mark.exercise, tally).statuses.append(mark.status)
    return list(found.values())


def tally_mistakes(book: Gradebook) -> tuple[MistakeTally, ...]:
    """Count the mistakes, most frequent first."""
    found: dict[str, list[tuple[str, Mark]]] = defaultdict(list)
    for learner, mark in all_marks(book):
        if mark.status == FAILED:
            found[mark.mistake or UNKNOWN].append((learner.learner, mark))
    tallies = (_mistake(mistake, marks) for mistake, marks in found.items())
    return tuple(sorted(tallies, key=lambda one: (-one.count, one.mistake)))


def _mistake(mistake: str, found: Sequence[tuple[str, Mark]]) -> MistakeTally:
    marks = [mark for _, mark in found]
    hint = _first(_ranked(mark.hint for mark in marks if mark.hint))
    hinted = [mark for mark in marks if mark.hint == hint]
    example = _first(_ranked(mark.exercise for mark in hinted))
    seen = (mark.evidence for mark in hinted if mark.exercise == example and mark.evidence)
    return MistakeTally(
        mistake,
        len(marks),
        len({learner for learner, _ in found}),
        tuple(_ranked(mark.exercise for mark in marks)),
        example,
        hint,
        _first(_ranked(seen)),
    )


def _ranked(words: Iterable[str]) -> list[tuple[str, int]]:
    """Return words with their counts, most frequent first, then by name."""
    return sorted(Counter(words).items(), key=lambda one: (-one[1], one[0]))


def _first(ranked: Sequence[tuple[str, int]]) -> str:
    return ranked[0][0] if ranked else ""


def shares(book: Gradebook) -> list[float]:
    """Return the points of learners with points and a grade, in per cent of what there was."""
    counted = [one for one in book.learners if one.out_of > 0 and not one.excused]
    return [100 * one.points / one.out_of for one in counted]


def empty_handed(book: Gradebook) -> list[Graded]:
    """Return learners of whom no page was found."""
    return [one for one in book.learners if all(mark.status == MISSING for mark in one.marks)]

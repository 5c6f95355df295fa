"""Render pages from templates, so that a learner's text can never act as markup.

A page is one file. It contains no script and loads nothing from the network, and its
Content-Security-Policy enforces both; only the review, which runs on localhost, has a script of its
own. Jinja escapes everything that a template prints, and before that `readable` makes hidden
characters visible. Nothing is distinguished by colour alone: a sign and a word differ as well. The
colours are in `style.css`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from rosbeat.diagnosis.mistakes import in_html
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.outcome_display import LOOKS, clipped
from rosbeat.exercises.registry import PAGES
from rosbeat.grading.files import number, printable
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Mark
from rosbeat.viz.text_format import count

#: Characters of a text that needs no clipping, whatever it is.
_SHORT = 200
_TITLES = {one.number: f"{one.number} {one.title}".strip() for one in PAGES}


# Statuses.


@dataclass(frozen=True)
class Look:
    """Hold how a status looks and what it is called.

    Attributes:
        sign: One character.
        word: What a learner reads.
        of_class: What an instructor reads about a class.
        kind: Its name in the style sheet.
    """

    sign: str
    word: str
    of_class: str
    kind: str


#: How each status looks, in the order in which lists and bars show them.
STATUSES = {
    PASSED: Look(*LOOKS[PASSED], "passed", "passed"),
    LOOKED_AT: Look("✎", "looked at by your instructor", "looked at by you", "seen"),
    FAILED: Look(*LOOKS[FAILED], "not there yet", "failed"),
    NOT_ATTEMPTED: Look(*LOOKS[NOT_ATTEMPTED], "not attempted", "open"),
    MISSING: Look("\N{EN DASH}", "page not handed in", "page not handed in", "missing"),
    HELD: Look("?", "no points yet", "held", "held"),
}


def look_of(status: str) -> Look:
    """Return how a status looks; an unknown status is shown by its own name."""
    return STATUSES.get(status) or Look("?", status, status, "held")


@dataclass(frozen=True)
class Segment:
    """Describe a part of a bar.

    Attributes:
        kind: The name of its colour in the style sheet.
        count: How many it stands for.
        label: Its sign and word.
    """

    kind: str
    count: int
    label: str


def segments_of(statuses: Iterable[str], of_class: bool = False) -> list[Segment]:
    """Return the parts of a bar that counts statuses, without those that do not occur."""
    found = Counter(statuses)
    words = {status: look.of_class if of_class else look.word for status, look in STATUSES.items()}
    return [
        Segment(look.kind, found[status], f"{look.sign} {words[status]}")
        for status, look in STATUSES.items()
        if status in found
    ]


def in_words(segments: Sequence[Segment]) -> str:
    """Say what a bar shows, such as `3 passed, 1 not there yet`."""
    said = [f"{one.count} {one.label.split(' ', 1)[-1]}" for one in segments if one.count]
    return ", ".join(said) or "none"


# Texts.


def visible(text: str) -> str:
    r"""Return a text in which control and direction characters are written as `\u....`.

    Line breaks and tabs stay; unlike a name, a text may be long.
    """
    if text.isprintable():
        return text  # nearly always, and many times faster
    return "".join(one if one.isprintable() or one in "\n\t" else printable(one) for one in text)


def readable(value: Any) -> Any:  # noqa: ANN401 - whatever a template prints
    """Return what a template may print: HTML as it is, any other text visible and clipped."""
    if isinstance(value, Markup) or not isinstance(value, str):
        return value
    if len(value) > _SHORT or "\n" in value:
        value = clipped(value.replace("\r\n", "\n"))
    return visible(value)


def most(text: str, letters: int) -> str:
    """Return a text of at most so many letters."""
    return text if len(text) <= letters else f"{text[: letters - 1]}…"


def program(text: str, letters: int) -> Markup:
    """Return the first letters of a program as HTML, line ends as they are everywhere."""
    return Markup.escape(visible("\n".join(text[:letters].splitlines())))


def html(shape: str, *values: Any) -> Markup:  # noqa: ANN401 - whatever a template could print
    """Return HTML with values in the place of `{}`, as a template would print them."""
    return Markup(shape).format(*map(readable, values))


def name(text: str) -> Markup:
    """Return a name as HTML; one written from right to left disturbs nothing around it."""
    return html("<bdi>{}</bdi>", printable(text))


def paragraph(text: str) -> Markup:
    """Return a text as a block of HTML; several lines keep their shape."""
    if not text.strip():
        return Markup()
    shape = "<pre>{}</pre>" if "\n" in text.strip("\n") else '<p dir="auto">{}</p>'
    return html(shape, text)


def prose(text: str) -> Markup:
    """Return what a person has written as HTML; line breaks stay."""
    if not text.strip():
        return Markup()
    return html('<p class="said" dir="auto">{}</p>', text)


def with_code(text: str) -> Markup:
    """Return a sentence as HTML; what stands between backquotes is code."""
    return Markup(in_html(visible(text)))


def points_of(points: float, out_of: float) -> str:
    """Return points in words, such as `1.5 of 2 points`."""
    return f"{number(points)} of {number(out_of)} point{'' if out_of == 1 else 's'}"


def page_title(page: str) -> str:
    """Return the title of a page with its number; its name if the course has no title for it."""
    return _TITLES.get(page[:2]) or page


def so_far(marks: Iterable[Mark]) -> str:
    """Return the words that follow points which are not all known yet."""
    return " so far" if any(mark.status == HELD for mark in marks) else ""


# Templates.


@cache
def _environment() -> Environment:
    made = Environment(
        loader=PackageLoader("rosbeat.grading"),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=readable,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        auto_reload=False,
    )
    made.filters.update(most=most, program=program, name=name, paragraph=paragraph, prose=prose,
                        code=with_code, number=number)  # fmt: skip
    made.globals.update(count=count, in_words=in_words, look_of=look_of, points_of=points_of,
                        page_title=page_title, so_far=so_far, segments_of=segments_of,
                        STATUSES=STATUSES)  # fmt: skip
    return made


def render(template: str, **values: Any) -> str:  # noqa: ANN401 - whatever the template shows
    """Render a page.

    Returns:
        A whole HTML document, the same for the same values.
    """
    return _environment().get_template(template).render(values)

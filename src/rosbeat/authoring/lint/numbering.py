"""Pages are numbered once each, and build on earlier ones."""

from __future__ import annotations

from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding


def page_numbers(desk: Desk) -> Iterator[Finding]:
    """A number belongs to one page, a page needs earlier ones, and a title has no other number."""
    lesson = desk.lesson
    twins = [o.name for o in desk.lessons if o.number == lesson.number and o.name != lesson.name]
    if twins:
        what = f"the number {lesson.number} also belongs to {', '.join(twins)}."
        yield desk.finding("page-numbers", 1, what, "Rename one of them.")
    known = {other.number for other in desk.lessons}
    for number in lesson.header.needs:
        if number not in known:
            yield desk.finding("page-numbers", 1, f"needs names page {number}, which is not there.")
        elif number >= lesson.number:
            yield desk.finding("page-numbers", 1, f"needs names page {number}, which comes later.")

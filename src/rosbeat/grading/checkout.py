"""Where the course is, and which of its pages somebody means."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.remarks import printable
from rosbeat.workspace.place import course_root


def find_checkout() -> Path:
    """Find the course that this package was installed from.

    Raises:
        GradingError: If it was installed without one.
    """
    root = course_root()
    if root is None:
        raise GradingError(
            "The course's own pages are not there.",
            "This rosbeat was installed without them, and everything here begins with them.",
            "Run the command in a checkout of the course:  ./environment/course shell",
        )
    return root


def choose_pages(pages: Sequence[CoursePage], names: Iterable[str]) -> tuple[CoursePage, ...]:
    """Choose pages by their numbers or names.

    Args:
        pages: The pages of the course.
        names: Such as `03`, `3`, `03_write_a_publisher` or the name of the page's file; none means
            all pages.

    Returns:
        The pages, in the order of the course.

    Raises:
        GradingError: If a name fits no page.
    """
    wanted = {_named(pages, name).lesson for name in names}
    return tuple(page for page in pages if not wanted or page.lesson in wanted)


def _named(pages: Sequence[CoursePage], name: str) -> CoursePage:
    stem = Path(name.strip()).name.removesuffix(".ipynb")
    for page in pages:
        if stem in (page.lesson, page.number) or (
            stem.isdecimal() and stem.zfill(2) == page.number
        ):
            return page
    raise GradingError(
        f"There is no page {printable(name)!r}.",
        f"The pages are {', '.join(page.number for page in pages)}.",
        "Name them by their numbers:  --lessons 03 04",
    )

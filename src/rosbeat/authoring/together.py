"""Solution pages, run a few at a time: each in a process and a kernel of its own."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

from rosbeat.authoring import pages
from rosbeat.authoring.pages import NO_POINTS
from rosbeat.authoring.source import Lesson

#: Pages that run at once, at most. A page may measure how long things take, and more of them than
#: there are cores would disturb one another.
AT_ONCE = 2


def solution_bytes(
    lesson: Lesson, folder: Path, fresh: bool, points: Mapping[str, int] = NO_POINTS
) -> bytes:
    """Run the solution page of a lesson.

    Args:
        lesson: The lesson.
        folder: The folder in which its page is, or will be.
        fresh: Store new outputs where outputs are not compared, too.
        points: What each exercise is worth, by its id.

    Returns:
        The page as it is stored.

    Raises:
        LessonError: If the page does not run.
    """
    return pages.to_bytes(pages.solution_page(lesson, folder, fresh=fresh, points=points))


@contextmanager
def solutions(
    lessons: Sequence[Lesson], folder: Path, fresh: bool, points: Mapping[str, int] = NO_POINTS
) -> Iterator[Callable[[Lesson], bytes]]:
    """Begin to run the solution pages of lessons, in their order.

    Args:
        lessons: The lessons.
        folder: The folder of the solution pages.
        fresh: Store new outputs where outputs are not compared, too.
        points: What each exercise is worth, by its id.

    Yields:
        A function that waits for a lesson's page, and raises what its run raised.
    """
    if len(lessons) < 2:
        yield lambda lesson: solution_bytes(lesson, folder, fresh, points)
        return
    workers = min(AT_ONCE, os.cpu_count() or 1)
    # A fork would take along whatever threads this process has.
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        given = (folder, fresh, dict(points))
        runs = {one.name: pool.submit(solution_bytes, one, *given) for one in lessons}
        try:
            yield lambda lesson: runs[lesson.name].result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise

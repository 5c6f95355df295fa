"""The pages of a release: as learners get them, without an answer in them."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import BLANK
from rosbeat.grading.course_pages import CoursePage
from rosbeat.grading.notebook import read_notebook

#: A link to another page, as it stands in the file of a page.
_LINK = re.compile(r"\[([^\[\]]*)\]\((\d\d_\w+)\.ipynb(?:#[^()\s]*)?\)")


def page_bytes(
    folder: Path, pages: Iterable[CoursePage], released: Collection[str]
) -> dict[str, bytes]:
    """Read the pages, untouched by anybody, with links only to pages that are there.

    Args:
        folder: The folder `notebooks` of the course.
        pages: Those to release.
        released: Names of all lessons that the release has.

    Returns:
        The files by their names.

    Raises:
        GradingError: If somebody has worked in a page.
    """
    found = {
        f"{page.lesson}.ipynb": (folder / f"{page.lesson}.ipynb").read_bytes() for page in pages
    }
    worked = [said for name, data in found.items() for said in worked_in(name, data)]
    if worked:
        raise GradingError(
            f"Somebody has worked in the course's own pages: {'; '.join(worked)}.",
            "Learners would get these pages with answers in them, so nothing is released.",
            "Keep a copy if you need it, and make the pages anew:  rosbeat build --no-run",
        )
    return {name: without_links(data, released) for name, data in found.items()}


def worked_in(name: str, data: bytes) -> list[str]:
    """Say where somebody has worked in a page: what was filled in, or has an output.

    Args:
        name: The page's file name.
        data: The file.
    """
    said = [
        f"{name} has no blank in exercise {cell.exercise}"
        for cell in read_notebook(data).cells
        if cell.exercise and BLANK not in cell.source
    ]
    if any(
        cell.get("outputs") or cell.get("execution_count") for cell in json.loads(data)["cells"]
    ):
        said.append(f"{name} was run")
    return said


def without_links(data: bytes, released: Collection[str]) -> bytes:
    """Turn links to pages that are not released into plain text.

    Args:
        data: A page's file.
        released: Names of the lessons that are.
    """

    def kept(link: re.Match[str]) -> str:
        return link[0] if link[2] in released else link[1]

    return _LINK.sub(kept, data.decode("utf-8")).encode("utf-8")

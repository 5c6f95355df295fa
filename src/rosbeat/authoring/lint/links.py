"""Links that lead somewhere, images that say what they show."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

from rosbeat.authoring.lint.desk import Desk, Finding, headings, prose_lines
from rosbeat.authoring.source import Lesson, SourceCell

_LINK = re.compile(r"(?P<image>!?)\[(?P<text>[^\]]*)\]\((?P<target>[^)\s]*)(?:\s+\"[^\"]*\")?\)")
_IMG = re.compile(r"<img\b[^>]*>", re.IGNORECASE)
_ALT = re.compile(r"\balt=(\"[^\"]*\w[^\"]*\"|'[^']*\w[^']*')", re.IGNORECASE)
_SRC = re.compile(r"\bsrc=[\"']([^\"']*)[\"']", re.IGNORECASE)
_ELSEWHERE = ("http://", "https://", "mailto:")


def broken_link(desk: Desk) -> Iterator[Finding]:
    """A link leads to a file of the course, a page, or a heading that exists."""
    for cell in (cell for cell in desk.lesson.cells if cell.kind == "markdown"):
        for line, target in _targets(cell):
            problem = _problem(desk, target)
            if problem:
                yield desk.finding("broken-link", line, f"{target!r} leads nowhere: {problem}.")


def alt_text(desk: Desk) -> Iterator[Finding]:
    """An image has words for those who do not see it."""
    for cell in (cell for cell in desk.lesson.cells if cell.kind == "markdown"):
        for line, text in prose_lines(cell):
            named = all(m["text"].strip() for m in _LINK.finditer(text) if m["image"])
            if not named or not all(_ALT.search(tag) for tag in _IMG.findall(text)):
                what = "an image has no alternative text."
                cure = "Say in words what it shows: ![what it shows](image.svg)."
                yield desk.finding("alt-text", line, what, cure)


def local_images(desk: Desk, cell: SourceCell) -> Iterator[tuple[int, Path]]:
    """Yield the images of a markdown cell that lie in the checkout, with their source lines."""
    if cell.kind == "markdown":
        for line, target in _targets(cell):
            if not target.startswith((*_ELSEWHERE, "#")):
                yield line, _resolve(desk, target.partition("#")[0])


def _targets(cell: SourceCell) -> Iterator[tuple[int, str]]:
    for line, text in prose_lines(cell):
        plain = re.sub(r"`[^`]*`", "", text)
        for target in [m["target"] for m in _LINK.finditer(plain)] + _SRC.findall(plain):
            yield line, target


def _problem(desk: Desk, target: str) -> str:
    if target.startswith(_ELSEWHERE):
        return ""
    if target.startswith("attachment:"):
        return "pages have no attachments"
    file, _, anchor = target.partition("#")
    lesson = desk.lesson if not file else _lesson_at(desk, _resolve(desk, file))
    if lesson is None:
        return "" if _resolve(desk, file).exists() else "there is no such file"
    known = {_anchor(text) for cell in lesson.cells for text in _headings_of(cell)}
    return f"{lesson.name} has no such heading" if anchor and unquote(anchor) not in known else ""


def _resolve(desk: Desk, file: str) -> Path:
    # Both trees lie side by side, so a relative link leads to the same place from either.
    return Path(desk.course.notebooks, unquote(file))


def _lesson_at(desk: Desk, path: Path) -> Lesson | None:
    trees = (desk.course.notebooks.resolve(), desk.course.solutions.resolve())
    for lesson in desk.lessons:
        if path.name == f"{lesson.name}.ipynb" and path.resolve().parent in trees:
            return lesson
    return None


def _headings_of(cell: SourceCell) -> list[str]:
    return [text for _, _, text in headings(cell)] if cell.kind == "markdown" else []


def _anchor(heading: str) -> str:
    # What JupyterLab makes of a heading: markup gone, spaces to hyphens, letters as they are.
    return re.sub(r"[`*]", "", heading).replace(" ", "-")

"""The rule that keeps answers off the learner's page."""

from __future__ import annotations

import io
import re
import tokenize
from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding, learner_text
from rosbeat.authoring.lint.links import local_images
from rosbeat.authoring.source import SourceCell, find_blocks

# Shorter lines (`pass`, `return`, `count = 0`) are everybody's.
_SHORTEST = 12
# So is this one: an answer that is a whole class begins with it, like any class.
_EVERYBODYS = {"def__init__(self):"}


def leaked_answer(desk: Desk) -> Iterator[Finding]:
    """No line of an answer stands anywhere else on the learner's page."""
    answers = {key: line for cell in desk.code for key, line in _distinctive(cell)}
    for line, text in _page_texts(desk):
        squeezed = _squeeze(text)
        for key, answer in answers.items():
            if key in squeezed:
                yield desk.finding(
                    "leaked-answer",
                    line + _offset(text, key),
                    f"the answer {answer.strip()!r} can be read here.",
                    "Reword this place, or move the line out of the answer.",
                )


def _distinctive(cell: SourceCell) -> Iterator[tuple[str, str]]:
    for block in find_blocks(cell.source):
        for line in block.answer:
            key = _squeeze(_without_comment(line))
            if len(key) >= _SHORTEST and key not in _EVERYBODYS:
                yield key, line


def _without_comment(line: str) -> str:
    try:
        tokens = list(tokenize.generate_tokens(io.StringIO(line.strip()).readline))
    except (tokenize.TokenError, SyntaxError):
        return line
    comments = [token for token in tokens if token.type == tokenize.COMMENT]
    return line.strip()[: comments[0].start[1]] if comments else line


def _page_texts(desk: Desk) -> Iterator[tuple[int, str]]:
    for cell in desk.learner_cells:
        yield cell.line, learner_text(cell)
        for line, image in local_images(desk, cell):
            # A drawing is text too, and its labels are on the page.
            if image.suffix == ".svg" and image.is_file():
                yield line, image.read_text(encoding="utf-8").replace("\n", " ")


def _squeeze(text: str) -> str:
    return re.sub(r"[\s'\"`]+", "", text)


def _offset(text: str, key: str) -> int:
    lines = text.split("\n")
    return next((n for n, line in enumerate(lines) if key in _squeeze(line)), 0)

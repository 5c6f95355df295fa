"""The markers that hold an answer and what a learner sees in its place.

::

    # --- answer
    self.timer = self.create_timer(1.0, self.publish_temperature)
    # --- blank
    # self.timer = self.create_timer(____, ____)
    # --- end

The source stays Python that runs, with the answer in force. Markers stand on lines of their own,
at the indentation of what they enclose; the blank is commented there once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from rosbeat.errors import LessonError

BLANK = "____"
_MARKER = re.compile(r"^(?P<indent> *)# --- (?P<word>answer|blank|end)$")
# Anything that was probably meant as a marker: other case, other spacing, a word too many.
_NEARLY = re.compile(r"^\s*#\s*-{2,}\s*(answer|blank|end)\b", re.IGNORECASE)
_NEXT = {"": "answer", "answer": "blank", "blank": "end"}


@dataclass
class Block:
    """One answer and its blank.

    Attributes:
        line: The line of the cell, counted from 0, of the marker that opens the block.
        indent: The indentation of the markers.
        answer: The lines of the answer, as they stand.
        blank: The lines of the blank, uncommented, at the same indentation.
        end: The line of the marker that closes the block.
    """

    line: int
    indent: str
    answer: list[str] = field(default_factory=list)
    blank: list[str] = field(default_factory=list)
    end: int = -1


def find_blocks(source: str, where: str = "cell", first_line: int = 1) -> list[Block]:
    """Find the answer blocks of a cell.

    Args:
        source: The text of a code cell.
        where: The file, for messages.
        first_line: The line of the file on which the cell begins, for messages.

    Raises:
        LessonError: A marker is unclosed, nested, stray or misspelt, or a blank is not a blank.
    """
    blocks: list[Block] = []
    part = ""
    for number, line in enumerate(source.split("\n")):
        place = f"{where}:{first_line + number}"
        match = _MARKER.match(line)
        if match:
            part = _step(blocks, part, match, number, place)
        elif _NEARLY.match(line):
            raise LessonError(f"{place}: {line.strip()!r} is nearly a marker.", "", _SPELLING)
        elif part:
            _collect(blocks[-1], part, line, place)
    if part:
        opened = f"{where}:{first_line + blocks[-1].line}"
        raise LessonError(f"{opened}: this answer is not closed.", _EXPOSED, _SPELLING)
    return blocks


def solution(source: str) -> str:
    """The text with its answers, markers and blanks gone."""
    return _replace(source, lambda block: block.answer)


def learner(source: str) -> str:
    """The text with blanks in place of its answers."""
    return _replace(source, lambda block: block.blank)


def masked(source: str) -> str:
    """The learner's text, with lines that are gone left empty, so that line numbers still hold."""
    lines = source.split("\n")
    for block in find_blocks(source):
        start = block.end - len(block.blank)
        lines[block.line : start] = [""] * (start - block.line)
        lines[start : block.end + 1] = [*block.blank, ""]
    return "\n".join(lines)


_EXPOSED = "Without strict markers an answer could end up on the learner's page."
_SPELLING = (
    "Write '# --- answer', '# --- blank' and '# --- end', in this order, each on a line of its "
    "own at the indentation of the code."
)


def _step(blocks: list[Block], part: str, match: re.Match[str], number: int, place: str) -> str:
    word, indent = match["word"], match["indent"]
    if word != _NEXT[part]:
        found = "outside of a block" if not part else f"after '# --- {part}'"
        raise LessonError(f"{place}: '# --- {word}' stands {found}.", _EXPOSED, _SPELLING)
    if word == "answer":
        blocks.append(Block(number, indent))
        return word
    if indent != blocks[-1].indent:
        raise LessonError(f"{place}: the markers of a block differ in indentation.", "", _SPELLING)
    if word == "blank":
        return word
    blocks[-1].end = number
    _require_content(blocks[-1], place)
    return ""


def _collect(block: Block, part: str, line: str, place: str) -> None:
    if part == "answer":
        block.answer.append(line)
        return
    match = re.match(rf"{block.indent}#( |$)", line)
    if not match:
        raise LessonError(
            f"{place}: a line of a blank is not a comment at the markers' indentation.",
            "The source has to run with the answer in force.",
            f"Begin the line with {block.indent + '# '!r}.",
        )
    block.blank.append((block.indent + line[match.end() :]).rstrip())


def _require_content(block: Block, place: str) -> None:
    if not any(line.strip() for line in block.answer):
        raise LessonError(f"{place}: the block has no answer.")
    if not any(BLANK in line for line in block.blank):
        raise LessonError(
            f"{place}: the blank has no {BLANK}.",
            "A learner would not see that something is to be done here.",
            f"Put {BLANK} where the learner writes.",
        )


def _replace(source: str, part: Callable[[Block], list[str]]) -> str:
    return "\n".join(_lines(source.split("\n"), find_blocks(source), part))


def _lines(
    lines: list[str], blocks: list[Block], part: Callable[[Block], list[str]]
) -> Iterator[str]:
    position = 0
    for block in blocks:
        yield from lines[position : block.line]
        yield from part(block)
        position = block.end + 1
    yield from lines[position:]

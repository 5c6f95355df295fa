"""The marks in a terminal's output by which a page knows that a command has ended."""

from __future__ import annotations

import re
from dataclasses import dataclass

#: The shell waits for a command, or for more of one (a `done`, a closing quote); it runs one.
PROMPT, MORE, RUN = "P", "M", "R"
# An operating system command with a number that no terminal uses; terminals show none of it.
_HEAD = "\x1b]7771;"
# Longer than any path; a head without an end is not ours.
_LONGEST = 8192


@dataclass(frozen=True)
class Mark:
    """What the shell does from here on.

    Attributes:
        kind: `PROMPT`, `MORE` or `RUN`.
        code: The exit code of the last command.
        folder: The shell's folder.
    """

    kind: str
    code: int
    folder: str


class MarkScanner:
    """Separates marks from text, wherever the reads have cut.

    Args:
        token: What the marks of this terminal carry, so that no other terminal's are taken.
    """

    def __init__(self, token: str) -> None:
        self._mark = re.compile(rf"\x1b\]7771;{re.escape(token)};([PMR]);(\d*);([^\x07]*)\x07")
        self._held = ""

    def feed(self, text: str) -> list[str | Mark]:
        """Return what has come, in order; what may be the beginning of a mark waits."""
        text = self._held + text
        found: list[str | Mark] = []
        begin = 0
        for match in self._mark.finditer(text):
            found += [text[begin : match.start()], _mark(match)]
            begin = match.end()
        end = _hold_from(text, begin)
        self._held = text[end:]
        return [part for part in (*found, text[begin:end]) if part]


def _mark(match: re.Match[str]) -> Mark:
    return Mark(match[1], int(match[2] or 0), match[3])


def _hold_from(text: str, begin: int) -> int:
    """Return where an unfinished mark begins, or the text's end."""
    start = text.rfind("\x1b", begin)
    tail = text[start : start + _LONGEST + 1] if start >= 0 else ""
    ours = tail.startswith(_HEAD) or _HEAD.startswith(tail)
    if tail and ours and "\x07" not in tail and len(tail) <= _LONGEST:
        return start
    return len(text)

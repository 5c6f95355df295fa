"""The comment header that opens a lesson source."""

from __future__ import annotations

import re
from dataclasses import dataclass

from rosbeat.errors import LessonError

_FENCE = "# ---"
_KEYS = ("title", "minutes", "needs", "summary")
_EXAMPLE = (
    "Start the file with '# ---', the lines '# title:', '# minutes:', '# needs:' and "
    "'# summary:', and '# ---'."
)


@dataclass(frozen=True)
class Header:
    """What a lesson says about itself.

    Attributes:
        title: The page's title, beginning with a verb.
        minutes: How long a learner needs.
        needs: Numbers of the pages to read first, such as ``("00", "03")``.
        summary: One sentence for lists of pages.
    """

    title: str
    minutes: int
    needs: tuple[str, ...]
    summary: str


def split_header(text: str, name: str) -> tuple[Header, str, int]:
    """Take the header off a lesson's text.

    Args:
        text: The whole lesson source.
        name: The file's name, for messages.

    Returns:
        The header, the rest of the text, and how many lines were taken off.

    Raises:
        LessonError: The header is missing, incomplete, or holds something unknown.
    """
    lines = text.splitlines(keepends=True)
    if not lines or lines[0].rstrip() != _FENCE:
        raise LessonError(f"{name}:1: the lesson has no header.", "", _EXAMPLE)
    end = next((n for n, line in enumerate(lines) if n and line.rstrip() == _FENCE), 0)
    if not end:
        raise LessonError(f"{name}:1: the header is not closed.", "", _EXAMPLE)
    start = next((n for n in range(end + 1, len(lines)) if lines[n].strip()), len(lines))
    return _header(lines[1:end], name), "".join(lines[start:]), start


def _header(lines: list[str], name: str) -> Header:
    fields = dict(_field(line, number, name) for number, line in enumerate(lines, start=2))
    missing = [key for key in _KEYS if key not in fields]
    if missing or len(fields) != len(lines):
        problem = f"lacks {', '.join(missing)}" if missing else "says a thing twice"
        raise LessonError(f"{name}:1: the header {problem}.", "", _EXAMPLE)
    if not fields["minutes"].isdigit():
        raise LessonError(f"{name}:1: minutes is not a whole number: {fields['minutes']!r}.")
    return Header(
        title=fields["title"],
        minutes=int(fields["minutes"]),
        needs=_needs(fields["needs"], name),
        summary=fields["summary"],
    )


def _field(line: str, number: int, name: str) -> tuple[str, str]:
    match = re.fullmatch(r"# (\w+): *(.*?)\s*", line)
    if not match or match[1] not in _KEYS:
        what = f"{name}:{number}: the header does not know the line {line.strip()!r}."
        raise LessonError(what, "A header is read line by line, one 'key: value' each.", _EXAMPLE)
    return match[1], match[2].strip("\"'")


def _needs(value: str, name: str) -> tuple[str, ...]:
    match = re.fullmatch(r"\[(.*)\]", value)
    numbers = tuple(part.strip(" \"'") for part in match[1].split(",")) if match else ("?",)
    numbers = () if numbers == ("",) else numbers
    if all(re.fullmatch(r"\d\d", number) for number in numbers):
        return numbers
    raise LessonError(
        f"{name}:1: needs is not a list of page numbers: {value!r}.",
        "",
        'Write page numbers with two digits, as in: needs: ["00", "03"]; or [] for none.',
    )

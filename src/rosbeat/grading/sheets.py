"""A table that a person has saved from a spreadsheet or an editor, read whatever its dialect.

Commas, semicolons or tabs; UTF-8, UTF-16 or an old Windows code page; any line ends; with or
without a byte order mark; columns in any order, and more of them than are asked for.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

#: What separates cells, the likeliest first.
_SEPARATORS = ",;\t|"
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


@dataclass(frozen=True)
class Row:
    """One row.

    Attributes:
        line: The line of the file on which it begins, from 1.
        cells: Its cells by the names of their columns, without blanks around them.
    """

    line: int
    cells: dict[str, str]


@dataclass(frozen=True)
class Sheet:
    """A table.

    Attributes:
        header: The names of its columns, in small letters.
        rows: Its rows that are not empty, without the header.
        problems: What could be read in part only: the line, and a sentence.
    """

    header: tuple[str, ...]
    rows: tuple[Row, ...]
    problems: tuple[tuple[int, str], ...] = ()


def read_sheet(data: bytes, columns: Sequence[str]) -> Sheet:
    """Read a table.

    Args:
        data: The file.
        columns: The columns it should have. The header is known by the first of them; if there is
            no header, these are the columns.
    """
    text = _text(data)
    separator = _separator(text, columns)
    problems: list[tuple[int, str]] = []
    rows = _rows(text, separator, problems)
    found = [one for one in rows if any(map(str.strip, one[1]))]
    header = tuple(columns)
    if found and _is_header(found[0][1], columns):
        header = tuple(name.strip().casefold() for name in found.pop(0)[1])
    named = [Row(line, _named(header, cells, separator)) for line, cells in found]
    return Sheet(header, tuple(named), tuple(problems))


def _text(data: bytes) -> str:
    if data.startswith(_UTF_16):
        text = data.decode("utf-16", "replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:  # what Excel saves as "CSV" in western Europe and America
            text = data.decode("cp1252", "replace")
    return text.replace("\0", "").replace("\r\n", "\n").replace("\r", "\n")


def _names_separator(cells: Sequence[str]) -> bool:
    """Whether it is the line `sep=;`, which Excel writes and reads, parted at its separator."""
    return bool(cells) and cells[0].casefold() == "sep=" and not any(cells[1:])


def _separator(text: str, columns: Sequence[str]) -> str:
    """What separates cells in the first line: what gives most known columns, then most cells."""
    first = next((line for line in text.split("\n") if line.strip()), "")
    if first.casefold().startswith("sep=") and first[4:5] in set(_SEPARATORS):
        return first[4]

    def fit(separator: str) -> tuple[int, int]:
        cells = next(_parsed([first], separator, strict=False), [])
        return len({one.strip().casefold() for one in cells} & set(columns)), len(cells)

    return max(_SEPARATORS, key=fit)


def _rows(
    text: str, separator: str, problems: list[tuple[int, str]]
) -> Iterator[tuple[int, list[str]]]:
    try:
        rows = list(_numbered(io.StringIO(text, newline=""), separator))
    except csv.Error:  # most often a quotation mark that nobody closed
        rows = list(_line_by_line(text, separator, problems))
    yield from (one for one in rows if not _names_separator(one[1]))


def _numbered(lines: Iterable[str], separator: str) -> Iterator[tuple[int, list[str]]]:
    reader = csv.reader(lines, delimiter=separator, strict=True)
    begins = 1
    for cells in reader:
        yield begins, cells
        begins = reader.line_num + 1


def _line_by_line(
    text: str, separator: str, problems: list[tuple[int, str]]
) -> Iterator[tuple[int, list[str]]]:
    """Each line for itself, so that a stray quotation mark costs no other line."""
    for line, content in enumerate(text.split("\n"), 1):
        try:
            yield line, next(_parsed([content], separator, strict=False), [])
        except csv.Error as error:
            problems.append((line, f"It cannot be read ({error}), so nothing is taken from it."))
        if content.count('"') % 2:
            problems.append((line, "A quotation mark is not closed; the line is read for itself."))


def _parsed(lines: Iterable[str], separator: str, strict: bool) -> Iterator[list[str]]:
    return iter(csv.reader(lines, delimiter=separator, strict=strict))


def _is_header(cells: Sequence[str], columns: Sequence[str]) -> bool:
    return columns[0] in {one.strip().casefold() for one in cells}


def _named(header: Sequence[str], cells: Sequence[str], separator: str) -> dict[str, str]:
    """The cells by name; what is too many belongs to the last, which had a separator in it."""
    last = len(header) - 1
    whole = [*cells[:last], separator.join(cells[last:])]
    return dict(zip(header, map(str.strip, whole), strict=False))

"""Read a table that a person saved as CSV: UTF-8, with commas, semicolons or tabs."""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.remarks import printable

_SEPARATORS = ",;\t"


@dataclass(frozen=True)
class Row:
    """Hold one row.

    Attributes:
        line: The line of the file on which it begins, from 1.
        cells: Its cells by the names of their columns, without blanks around them.
    """

    line: int
    cells: dict[str, str]


@dataclass(frozen=True)
class Table:
    """Hold a table.

    Attributes:
        header: The names of its columns, in small letters.
        rows: Its rows that are not empty, without the header.
    """

    header: tuple[str, ...]
    rows: tuple[Row, ...]


def read_table(path: Path, columns: Sequence[str], known: Collection[str] = ()) -> Table:
    """Read a table.

    Args:
        path: The file.
        columns: The names of the columns, if the file has no header.
        known: A first row that has one of these is a header; by default, the first of `columns`.

    Raises:
        GradingError: If the file cannot be opened, is not UTF-8, or is not CSV.
    """
    text = _text(path)
    separator = max(_SEPARATORS, key=text.partition("\n")[0].count)
    if text[:5].casefold() in {f"sep={one}" for one in _SEPARATORS}:  # written by Excel
        separator = text[4]
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    found: list[tuple[int, list[str]]] = []
    begins = 1
    try:
        for cells in reader:
            found.append((begins, cells))
            begins = reader.line_num + 1
    except csv.Error as error:
        raise _refused(path, f"line {begins} is not CSV: {error}") from error
    found = [one for one in found if any(map(str.strip, one[1])) and one[1] != ["sep=", ""]]
    header = tuple(columns)
    names = [one.strip().casefold() for one in found[0][1]] if found else []
    if set(names) & set(known or columns[:1]):
        header = tuple(names)
        del found[0]
    return Table(
        header, tuple(Row(line, _named(header, cells, separator)) for line, cells in found)
    )


def _text(path: Path) -> str:
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise _refused(path, "it is not UTF-8") from error
    except OSError as error:
        raise _refused(path, error.strerror or str(error)) from error
    if "\0" in text:
        raise _refused(path, "it is not text")
    return text


def _refused(path: Path, why: str) -> GradingError:
    return GradingError(
        f"{printable(str(path), 1000)} cannot be read: {printable(why)}.",
        "What you wrote there would be missing in every result, so nothing was graded.",
        'Save it as "CSV UTF-8", with every quotation mark closed; then run the command again.',
    )


def _named(header: Sequence[str], cells: Sequence[str], separator: str) -> dict[str, str]:
    """Return the cells by name; surplus cells belong to the last, which had a separator in it."""
    last = len(header) - 1
    whole = [*cells[:last], separator.join(cells[last:])]
    return dict(zip(header, map(str.strip, whole), strict=False))

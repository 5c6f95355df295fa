"""Read CSV tables that a person has saved, and write tables that are safe to open in a spreadsheet.

Tables are read in UTF-8, separated by commas, semicolons or tabs. In written tables, no cell is a
formula: a spreadsheet would run a cell that begins with `=`, `+`, `-` or `@`, whatever a learner
has put into it. The rules follow OWASP, "CSV Injection", and RFC 4180 for the format.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.remarks import printable

_SEPARATORS = ",;\t"
#: Characters of one cell; Excel holds 32,767.
MOST_OF_A_CELL = 32_000
#: What makes a cell a formula; the wide forms do so in East Asian spreadsheets.
FORMULA_SIGNS = "=+-@＝＋－＠"
_FORMULA = re.compile(rf"^(?=[\s\"']*[{re.escape(FORMULA_SIGNS)}]\s*\S)(?!')")
#: Where one cell would become two in a country whose spreadsheets part cells at semicolons.
_SECOND_FORMULA = re.compile(rf"(;[\s\"]*)(?=[{re.escape(FORMULA_SIGNS)}])")
_BREAKS = re.compile(r"[\t\n\r\v\f\x85\u2028\u2029]+")
#: Digits behind the point: as many as Moodle's gradebook keeps.
_DIGITS = 5


# Reading.


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
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    found: list[tuple[int, list[str]]] = []
    begins = 1
    try:
        for cells in reader:
            found.append((begins, cells))
            begins = reader.line_num + 1
    except csv.Error as error:
        raise _refused(path, f"line {begins} is not CSV: {error}") from error
    found = [one for one in found if any(map(str.strip, one[1]))]
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


# Writing.


def cell(text: str) -> str:
    r"""Return a text that stays one cell, and a text, in every spreadsheet.

    Line ends and tabs become blanks, other control and direction characters are written as
    `\u....`, and an apostrophe stands before what would be a formula; a sign alone is none.
    """
    shown = printable(_BREAKS.sub(" ", text), MOST_OF_A_CELL)
    return _FORMULA.sub("'", _SECOND_FORMULA.sub(r"\1'", shown))


def number(value: float) -> str:
    """Return points with at most five digits behind the point, and no zeros at the end."""
    shown = f"{value:.{_DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if shown == "-0" else shown


def csv_text(rows: Iterable[Sequence[str | float]]) -> str:
    """Return a table as CSV: commas, CR LF, texts as `cell`, numbers as `number`."""
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\r\n")
    for row in rows:
        writer.writerow([cell(one) if isinstance(one, str) else number(one) for one in row])
    return file.getvalue()

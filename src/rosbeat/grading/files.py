"""Write files whole under safe names, and read and write tables that people open in a spreadsheet.

Tables are CSV. They are read in UTF-8, separated by commas, semicolons or tabs. In written tables,
no cell is a formula: a spreadsheet would run a cell that begins with `=`, `+`, `-` or `@`, whatever
a learner has put into it. The rules follow OWASP, "CSV Injection", and RFC 4180 for the format.
"""

from __future__ import annotations

import csv
import io
import os
import re
import unicodedata
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from uuid import uuid4

from rosbeat.errors import GradingError

#: Characters of a name that a report shows.
_MOST_SHOWN = 120


def printable(name: str, most: int = _MOST_SHOWN) -> str:
    r"""Return a name without characters that would change a terminal or the direction of text.

    Control, format and unassigned characters (Unicode categories C*) are written as `\u....`.
    """
    shown = name[: most + 1]
    if not shown.isprintable():  # most names are, and the rest takes its time
        shown = "".join(map(_shown, shown))
    return shown if len(shown) <= most else shown[: most - 3] + "..."


def _shown(one: str) -> str:
    return f"\\u{ord(one):04x}" if unicodedata.category(one).startswith("C") else one


# Files.

#: Characters of a learner's name and id in a file name.
_MOST_OF_A_NAME = 40
_DIGEST = 12
_PLAIN = re.compile(r"[a-z0-9]+(?:-[a-z0-9]+)*")


def write_whole(path: Path, content: str | bytes) -> bool:
    r"""Write a file in one step, so that nobody ever sees half of it.

    It is written beside its place, brought to the disk, and then put in place of what is there.

    Args:
        path: The file. Missing folders are made.
        content: All of it. Text is written as UTF-8; halves of characters (lone surrogates), which
            no file can hold, as `\udc80`.

    Returns:
        Whether the file is another one than before; one that is equal already is not touched.

    Raises:
        GradingError: If it cannot be written; then what was there is there still.
    """
    data = content if isinstance(content, bytes) else content.encode("utf-8", "backslashreplace")
    try:
        if path.is_file() and path.read_bytes() == data:
            return False
        path.parent.mkdir(parents=True, exist_ok=True)
        _replace(path, data)
    except OSError as error:
        raise GradingError(
            f"{printable(str(path))} cannot be written: {error.strerror or error}.",
            "What was there before is there still, and nothing else was harmed.",
            "Make room, or give another folder, and run the command again; it goes on from there.",
        ) from error
    return True


def _replace(path: Path, data: bytes) -> None:
    beside = path.with_name(f".{uuid4().hex}.part")
    try:
        with beside.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def file_name(learner: str, name: str = "") -> str:
    """Return a file name for a learner: small letters, digits, hyphens, underscores; no suffix.

    It depends on this learner alone, so it stays the same whoever else is in the class. Unless the
    id is such a name already, a digest of it makes the name this learner's own: `Ana`, `ana` and
    `../ana` are three.
    """
    front = _slug(name) if name != learner else ""
    if len(learner) <= _MOST_OF_A_NAME and _PLAIN.fullmatch(learner):
        return f"{front}_{learner}" if front else learner
    digest = sha256(learner.encode("utf-8", "surrogatepass")).hexdigest()[:_DIGEST]
    # Two underscores, which the name of a plain id never has.
    return f"{front or _slug(learner) or 'learner'}__{digest}"


def _slug(text: str) -> str:
    spelt = unicodedata.normalize("NFKD", text[: 10 * _MOST_OF_A_NAME])
    plain = spelt.encode("ascii", "ignore").decode("ascii").lower()
    return re.sub(r"[^a-z0-9]+", "-", plain)[:_MOST_OF_A_NAME].strip("-")


# Tables.

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

"""Write tables as CSV that is safe to open in a spreadsheet, whatever a learner has put into it.

A spreadsheet runs a cell that begins with `=`, `+`, `-` or `@` as a formula. The rules are those of
OWASP, "CSV Injection", and of RFC 4180 for the form.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence

from rosbeat.grading.remarks import printable

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


def cell(text: str) -> str:
    r"""Return a text that stays one cell, and a text, in every spreadsheet.

    Line ends and tabs become blanks, other control and direction characters are written as
    `\u....`, and an apostrophe stands before what would be a formula; a sign alone is none.

    Args:
        text: Any text.
    """
    shown = printable(_BREAKS.sub(" ", text), MOST_OF_A_CELL)
    return _FORMULA.sub("'", _SECOND_FORMULA.sub(r"\1'", shown))


def number(value: float) -> str:
    """Return points with at most five digits behind the point, and no zeros at the end.

    Args:
        value: Points.
    """
    shown = f"{value:.{_DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if shown == "-0" else shown


def csv_text(rows: Iterable[Sequence[str | float]]) -> str:
    """Return a table as CSV: commas, CR LF, texts as `cell`, numbers as `number`.

    Args:
        rows: The rows, the header first.
    """
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\r\n")
    for row in rows:
        writer.writerow([cell(one) if isinstance(one, str) else number(one) for one in row])
    return file.getvalue()

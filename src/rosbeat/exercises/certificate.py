"""Print what somebody has built on one sheet of paper: `rosbeat certificate`.

The check of the whole system keeps the run that has passed, beside the learner's progress. The
certificate draws that run. It is the learner's own statement, and says so: whoever wants to know
more runs the learner's pages again, with `rosbeat grade`.
"""

from __future__ import annotations

import unicodedata
import warnings
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import date
from functools import cache
from io import BytesIO
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from rosbeat import records_json
from rosbeat.errors import CommandError, ExerciseError, RecordError
from rosbeat.exercises.progress import outcomes, progress_file
from rosbeat.exercises.progress_list import Row
from rosbeat.exercises.registry import EXERCISES, PAGES
from rosbeat.exercises.system import ID, PACKAGE, TOPIC, SystemRun, built
from rosbeat.viz.text_format import count, listing
from rosbeat.workspace.saving import write

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

    from rosbeat.viz import Picture

# The run that is kept.

NAME = "system.json"
_FORMAT, _VERSION = "rosbeat run of the system", 1


@dataclass(frozen=True)
class KeptRun:
    """Hold a run of the whole system that has passed.

    Attributes:
        day: When it was checked.
        run: What became of the package and its programs.
    """

    day: date
    run: SystemRun


def keep_run(run: SystemRun) -> None:
    """Keep a run that has passed beside the learner's progress, where that is kept."""
    file = progress_file()
    if file.counts:
        head = {"format": _FORMAT, "version": _VERSION}
        text = records_json.to_json(KeptRun(date.today(), run), head)
        with suppress(OSError):  # that progress cannot be saved was said already
            write(_kept_file(), text.encode())


def _kept_file() -> Path:
    return progress_file().path.with_name(NAME)


def _kept_run() -> KeptRun:
    """Return the run that was kept.

    Raises:
        ExerciseError: If there is none that can be read.
    """
    try:
        text = _kept_file().read_text(encoding="utf-8")
        records_json.read_head(text, "run", _FORMAT, _VERSION)
        return records_json.from_json(KeptRun, text, "run")
    except (OSError, ValueError, RecordError):
        raise ExerciseError(
            "All exercises of the core are passed, and the run of your system is not stored here.",
            "The certificate shows the readings of that run, and the last check of page 06 keeps "
            "them when it passes.",
            f'Run that check once more, check("{ID}", workspace.folder()), and type the same '
            "command again.",
        ) from None


# What the certificate says.

#: Letters of a name: so many fit on the sheet.
LONGEST_NAME = 60
_STATEMENT = (
    "This is a learner's own statement, made with the command rosbeat certificate.",
    "An instructor can check it with rosbeat grade, which judges the learner's pages again.",
)


def certificate(name: str = "", paper: str = "a4") -> str:
    """Write the certificate as SVG and PDF beside the learner's pages.

    Args:
        name: The learner's name; asked for if it is empty.
        paper: What it is printed on: `a4` or `letter`.

    Returns:
        What it says, and where it is.

    Raises:
        ExerciseError: If exercises of the core are open, or the run was not kept.
        CommandError: If the name is none.
    """
    _require_core()
    kept = _kept_run()
    name = _checked(name or _ask())
    picture = _draw(name, kept, paper)
    folder = progress_file().path.parents[1]
    files = [folder / "certificate.svg"]
    pdf = folder / "certificate.pdf"
    with warnings.catch_warnings():
        # The text of an SVG is drawn by a browser, with fonts of its own.
        warnings.filterwarnings("ignore", "Glyph .* missing", UserWarning)
        write(files[0], picture.svg(on_paper=True).encode())
    remark = ""
    if _is_drawable(name):
        files.append(pdf)
        write(pdf, _pdf(picture, name))
    else:
        pdf.unlink(missing_ok=True)  # it would have another name on it
        remark = (
            "\nThe font of the PDF cannot write your name, so there is none. Open the SVG in a "
            "browser, and print it there: a browser also prints into a PDF."
        )
    return "\n".join([picture.description, "", *map(str, files)]) + remark


def _require_core() -> None:
    standings = progress_file().standings()
    rows = [Row(page, outcomes(page, standings)) for page in PAGES if not page.elective]
    missing = [(row.page, row.open) for row in rows if row.open]
    if missing:
        every = sum(len(row.outcomes) for row in rows)
        number = sum(len(names) for _, names in missing)
        raise ExerciseError(
            f"There is no certificate yet: {number} of {count(every, 'exercise')} in the core "
            f"{'is' if number == 1 else 'are'} still open.",
            "A certificate is for the whole core. These are missing:"
            + "".join(f"\n    {page.lesson}.ipynb: {listing(names)}" for page, names in missing),
            f"Open {missing[0][0].lesson}.ipynb, continue with exercise {missing[0][1][0]}, and "
            "type the same command when the core is passed.",
        )


def _ask() -> str:
    try:
        return input("Your name, as the certificate should have it: ")
    except EOFError:
        return ""


def _checked(name: str) -> str:
    """Return a name on one line, as it is printed.

    Raises:
        CommandError: If it is empty, too long, or has characters that nobody can read.
    """
    text = " ".join(unicodedata.normalize("NFC", name).split())
    if not text:
        what, to_try = "There is no name for the certificate.", "Type your name"
    elif len(text) > LONGEST_NAME:
        what = f"The name has {len(text)} characters."
        to_try = f"Type at most {LONGEST_NAME} of them"
    elif not all(one.isprintable() for one in text):
        what, to_try = "The name has characters that cannot be printed.", "Type it by hand"
    else:
        return text
    raise CommandError(
        what,
        "The certificate prints a name on one line. Nothing was written.",
        f'{to_try}: rosbeat certificate --name "Ada Lovelace"',
    )


def _sentences(kept: KeptRun) -> tuple[str, ...]:
    """Return what was built, and when."""
    found = built(kept.run)
    core = sum(len(page.exercises) for page in PAGES if not page.elective)
    return (
        f"has passed all {core} exercises in the core of the course rosbeat, and built a robot "
        f"system with ROS\N{NO-BREAK SPACE}2: the nodes {found.sensor} and {found.monitor}, in "
        f"the package {PACKAGE}.",
        f"On {kept.day:%B} {kept.day.day}, {kept.day.year}, each ran as a process of its own, and "
        f"{count(found.crossed, 'reading')} crossed on /{TOPIC}.",
    )


# The sheet.

#: Inches of both papers, across and down.
_PAPERS = {"a4": (11.69, 8.27), "letter": (11.0, 8.5)}
_PICTURE_WIDTH = 7.4
#: The upper end of the picture, as a part of the sheet's height.
_PICTURE_TOP = 0.67


def _draw(name: str, kept: KeptRun, paper: str) -> Picture:
    """Draw the sheet around the picture of the run, with the words of both as its description."""
    # Drawing loads matplotlib, which a check does without.
    from rosbeat.viz import Picture

    drawn: Picture | None = EXERCISES[ID].picture(kept.run)
    figure = _sheet(drawn.figure if drawn else None, paper)
    said = _sentences(kept)
    caption = drawn.description if drawn else "The nodes logged no readings, so none are drawn."
    _write(figure, 0.9, ["Certificate"], 15)
    _write(figure, 0.835, [name], _size_of(name, paper))
    _write(figure, 0.775, [line for text in said for line in wrap(text, 100)], 12)
    _write(figure, 0.165, [*wrap(caption, 115), "", *_STATEMENT], 9)
    words = " ".join(["Certificate.", name, *said, caption, *_STATEMENT])
    return Picture(figure, words, f"Certificate of {name}")


def _sheet(drawn: Figure | None, paper: str) -> Figure:
    """Return a sheet with a frame, and with what was drawn."""
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle

    sheet = drawn or Figure()
    size = _PAPERS[paper]
    across, down = sheet.get_size_inches() * _PICTURE_WIDTH / sheet.get_figwidth() / size
    sheet.set_size_inches(size)
    for axes in sheet.axes:
        axes.set_position(((1 - across) / 2, _PICTURE_TOP - down, across, down))
    for rim, width in ((0.03, 2.0), (0.037, 0.7)):
        look: dict[str, Any] = {"fill": False, "ec": "black", "lw": width}
        frame = Rectangle((rim, rim), 1 - 2 * rim, 1 - 2 * rim, transform=sheet.transFigure, **look)
        sheet.add_artist(frame)
    return sheet


def _write(figure: Figure, height: float, lines: Sequence[str], size: float) -> None:
    """Write lines in the middle of the sheet, the first one at this part of its height."""
    look: dict[str, Any] = {"ha": "center", "color": "black", "parse_math": False}
    for rank, line in enumerate(lines):
        figure.text(0.5, height - rank * size * 0.0029, line, fontsize=size, **look)


def _size_of(name: str, paper: str) -> float:
    """Return the size in points in which a name fits on the sheet."""
    from rosbeat.viz import canvas, theme

    # In another script a letter may be as wide as it is high.
    width = canvas.text_width(name) * 72 / theme.DPI if _is_drawable(name) else len(name) * 10.0
    return min(30.0, theme.TEXT * 0.8 * _PAPERS[paper][0] * 72 / width)


def _pdf(picture: Picture, name: str) -> bytes:
    from matplotlib import style

    from rosbeat.viz import theme

    said = {"Title": picture.title, "Author": name, "Subject": picture.description}
    words = {**said, "CreationDate": None}
    with style.context(["default", theme.RC, {"pdf.fonttype": 42}]), BytesIO() as target:
        picture.figure.savefig(target, format="pdf", facecolor="white", metadata=words)
        return target.getvalue()


@cache
def _is_drawable(name: str) -> bool:
    """Return whether the font of the PDF has all letters of a name, and in their order."""
    from matplotlib.font_manager import findfont
    from matplotlib.ft2font import FT2Font

    font = FT2Font(findfont("DejaVu Sans"))
    backward = {"R", "AL", "AN"}
    return all(
        font.get_char_index(ord(one)) and unicodedata.bidirectional(one) not in backward
        for one in name
    )

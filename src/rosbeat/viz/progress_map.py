"""Draw how far somebody is with the course: one row for each page, one mark for each exercise."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rosbeat.records import Outcome
from rosbeat.viz import theme
from rosbeat.viz.canvas import ROOM, Canvas, blank, text_width
from rosbeat.viz.picture import Picture
from rosbeat.viz.words import count, listing, sentence_case

#: A heading and the outcomes of its exercises.
Row = tuple[str, Sequence[Outcome]]

_ROW, _CHIP, _GAP, _WORDS_AT = 26.0, 74.0, 24.0, 23.0
_WIDEST_HEADING = 320.0
_STATES = {
    "passed": ("passed", theme.Style(theme.GREEN, "o", ""), theme.GREEN, "\N{CHECK MARK}"),
    "failed": ("not there yet", theme.Style(theme.VERMILLION, "s", ""), theme.CARD, "\N{BALLOT X}"),
    "not attempted": ("not attempted yet", theme.Style(theme.MUTED, "o", ""), theme.CARD, ""),
}


def progress_map(rows: Sequence[Row]) -> Picture:
    """Draw how far somebody is.

    Args:
        rows: For each page its heading and the best outcome of each exercise.

    Returns:
        The picture.
    """
    every = _every(rows)
    chip = max([_CHIP, *(_width(one.exercise) + _GAP / 2 for one in every)])
    lines = [line for row in rows for line in _lines(row, chip)]
    left = theme.MARGIN + _heading_width(rows) + _GAP
    head = _ROW + 8
    with blank(head + _ROW * len(lines)) as canvas:
        _draw_head(canvas, every)
        for number, (heading, found) in enumerate(lines):
            y = canvas.top - head - (number + 0.5) * _ROW
            canvas.text(theme.MARGIN, y, heading)
            for place, one in enumerate(found):
                _draw_mark(canvas, one.status, one.exercise, left + place * chip, y)
    return Picture(canvas.figure, describe(rows), "Progress over the course")


def describe(rows: Sequence[Row]) -> str:
    """Tell the same in one line of words.

    Args:
        rows: As for `progress_map`.
    """
    every = _every(rows)
    parts = [f"Your progress: {summary(every)}."]
    for status, (word, *_) in _STATES.items():
        names = [one.exercise for one in every if one.status == status]
        if names:
            shown = "all" if len(names) == len(every) else listing(names)
            parts.append(f"{sentence_case(word)}: {shown}.")
    return " ".join(parts)


def summary(every: Sequence[Outcome]) -> str:
    """Tell how many exercises are passed and how many points reached, in words.

    Args:
        every: The best outcome of each exercise.
    """
    done = sum(one.status == "passed" for one in every)
    points, out_of = sum(one.points for one in every), sum(one.out_of for one in every)
    return f"{done} of {count(len(every), 'exercise')} passed, {points} of {out_of} points"


def _every(rows: Iterable[Row]) -> list[Outcome]:
    return [one for _, found in rows for one in found]


def _lines(row: Row, chip: float) -> list[Row]:
    """Break a row so that its marks fit; the heading stands beside the first part."""
    heading, found = row
    most = max(1, int((ROOM - _WIDEST_HEADING - _GAP) // chip))
    parts = [found[at : at + most] for at in range(0, len(found), most)] or [[]]
    return [(_short(heading) if not at else "", part) for at, part in enumerate(parts)]


def _short(heading: str) -> str:
    if text_width(heading) <= _WIDEST_HEADING:
        return heading
    while text_width(f"{heading}…") > _WIDEST_HEADING:
        heading = heading[:-1].rstrip()
    return f"{heading}…"


def _heading_width(rows: Sequence[Row]) -> float:
    return min(_WIDEST_HEADING, max((text_width(heading) for heading, _ in rows), default=0.0))


def _width(words: str) -> float:
    return _WORDS_AT + text_width(words)


def _draw_head(canvas: Canvas, every: Sequence[Outcome]) -> None:
    x, y, right = float(theme.MARGIN), canvas.top - _ROW / 2, canvas.width - theme.MARGIN
    for status, (word, *_) in _STATES.items():
        _draw_mark(canvas, status, word, x, y)
        x += _width(word) + _GAP
    canvas.text(right, y, summary(every), theme.MUTED, "right")


def _draw_mark(canvas: Canvas, status: str, words: str, x: float, y: float) -> None:
    _, look, fill, sign = _STATES[status]
    middle = x + 9
    canvas.axes.plot([middle], [y], look.marker, ms=12, mfc=fill, mec=look.colour, mew=1.4)
    ink = theme.CARD if fill != theme.CARD else theme.ALERT_TEXT
    canvas.text(middle, y, sign, ink, "center", "bold")
    canvas.text(x + _WORDS_AT, y, words)

"""Bars, drawn as SVG inside of a page.

Lengths are shares of the width, so a bar fits a phone and a wall, and its text does not shrink with
it. Colours come from the page's style sheet, by the name of what is drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.grading.html_page import shown

#: Height of a bar in CSS pixels, and the share of the width from which on a number fits into it.
_HEIGHT, _FITS = 22, 8.0


@dataclass(frozen=True)
class Segment:
    """A part of a bar.

    Attributes:
        kind: The name of its colour, one of those in `palette`.
        count: How many it stands for.
        label: Its sign and word.
    """

    kind: str
    count: int
    label: str


def bar(segments: Sequence[Segment], out_of: int, what: str) -> str:
    """Draw a bar of one or several parts.

    Args:
        segments: Its parts, from left to right; those that stand for nothing are left out.
        out_of: What the whole width stands for.
        what: What it shows, for those who do not see it.

    Returns:
        SVG.
    """
    drawn, at = [], 0.0
    for one in segments:
        if one.count <= 0 or out_of <= 0:
            continue
        width = 100 * one.count / out_of
        drawn.append(_segment(one, at, width))
        at += width
    said = shown(f"{what}: {in_words(segments) or 'none'}")
    return (
        f'<svg width="100%" height="{_HEIGHT}" role="img" aria-label="{said}">'
        f"{''.join(drawn)}</svg>"
    )


def _segment(one: Segment, at: float, width: float) -> str:
    place = f'x="{at:.3f}%" y="1" width="{width:.3f}%" height="{_HEIGHT - 2}"'
    drawn = f'<rect class="{one.kind}" {place}/>'
    if width >= _FITS:
        middle = f'x="{at + width / 2:.3f}%" y="{_HEIGHT - 6}"'
        drawn += f'<text class="{one.kind}" {middle} aria-hidden="true">{one.count}</text>'
    return drawn


def in_words(segments: Sequence[Segment]) -> str:
    """The same in words: `3 passed, 1 not there yet`.

    Args:
        segments: The parts of a bar.
    """
    return ", ".join(f"{one.count} {one.label.split(' ', 1)[-1]}" for one in segments if one.count)


def labels(segments: Sequence[Segment]) -> str:
    """The line of labels below a bar, with sign, word and number of each part.

    Args:
        segments: The parts of a bar.
    """
    parts = [f"<span>{shown(one.label)} {one.count}</span>" for one in segments if one.count]
    return f'<p class="labels">{" ".join(parts)}</p>' if parts else ""

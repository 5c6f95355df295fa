"""Arrows of pictures: a smooth or cornered line and a solid head, in CSS pixels."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot

from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path

from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas

Point = tuple[float, float]

_HEAD, _HALF = 9.0, 4.0
_RADIUS = 9.0


@dataclass(frozen=True)
class Stroke:
    """How an arrow looks.

    Attributes:
        colour: Of line and head.
        dash: Matplotlib line style.
        width: Line width in points.
    """

    colour: str = theme.INK
    dash: str | tuple[float, tuple[float, ...]] = "-"
    width: float = 1.4


#: Nothing passes here: another colour and another dash.
BROKEN = Stroke(theme.ALERT, "--", 1.6)
PLAIN = Stroke()


def curve(points: Sequence[Point], downward: bool = False) -> Path:
    """A smooth line through the points, running along the flow at each of them.

    Args:
        points: At least two.
        downward: Whether the flow runs down instead of to the right.
    """
    vertices, codes = [points[0]], [Path.MOVETO]
    for (x0, y0), (x1, y1) in itertools.pairwise(points):
        if downward:
            middle = (y0 + y1) / 2
            vertices += [(x0, middle), (x1, middle), (x1, y1)]
        else:
            middle = (x0 + x1) / 2
            vertices += [(middle, y0), (middle, y1), (x1, y1)]
        codes += [Path.CURVE4] * 3
    return Path(vertices, codes)


def cornered(points: Sequence[Point]) -> Path:
    """A line through the points with rounded corners."""
    vertices, codes = [points[0]], [Path.MOVETO]
    for before, corner, after in zip(points, points[1:], points[2:], strict=False):
        vertices += [_toward(corner, before, _RADIUS), corner, _toward(corner, after, _RADIUS)]
        codes += [Path.LINETO, Path.CURVE3, Path.CURVE3]
    return Path([*vertices, points[-1]], [*codes, Path.LINETO])


def draw(canvas: Canvas, path: Path, stroke: Stroke = PLAIN, head: bool = True) -> None:
    """Draw a path, usually with a head at its end."""
    (x0, y0), (x1, y1) = (tuple(map(float, vertex)) for vertex in path.vertices[-2:])
    length = hypot(x1 - x0, y1 - y0) or 1.0
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    # The line ends inside the head; otherwise its blunt end would show beside the tip.
    inside = 5 if head else 0
    shown = Path([*path.vertices[:-1], (x1 - ux * inside, y1 - uy * inside)], path.codes)
    look = {"color": stroke.colour, "ls": stroke.dash, "lw": stroke.width}
    canvas.axes.add_patch(PathPatch(shown, fill=False, zorder=2, **look))
    if not head:
        return
    back = (x1 - ux * _HEAD, y1 - uy * _HEAD)
    wings = [(back[0] - uy * side, back[1] + ux * side) for side in (_HALF, -_HALF)]
    canvas.axes.add_patch(Polygon([(x1, y1), *wings], fc=stroke.colour, ec="none", zorder=2.5))


def _toward(start: Point, end: Point, distance: float) -> Point:
    """The point `distance` from start toward end, at most half way."""
    length = hypot(end[0] - start[0], end[1] - start[1]) or 1.0
    part = min(distance / length, 0.5)
    return start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part

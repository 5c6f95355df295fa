"""
Describe the greenhouse: its walls and beds, its heater, the path around the beds.

Lengths are in meters. The origin is the lower left corner, x runs to the right and y up, and
angles are in radians, counterclockwise from the x axis, as ROS has them (REP 103).
"""

import math
from typing import NamedTuple


class Pose(NamedTuple):
    """Hold where something stands, and which way it looks."""

    x: float
    y: float
    theta: float


class Rectangle(NamedTuple):
    """Hold a rectangle whose sides are parallel to the axes."""

    left: float
    bottom: float
    right: float
    top: float

    def distance(self, x, y):
        """Return how far a place outside is away; 0 inside."""
        return math.hypot(
            max(self.left - x, 0.0, x - self.right), max(self.bottom - y, 0.0, y - self.top))


ROOM = Rectangle(0.0, 0.0, 6.0, 4.0)
BEDS = (
    Rectangle(1.0, 1.4, 2.0, 2.6), Rectangle(2.6, 1.4, 3.6, 2.6), Rectangle(4.2, 1.4, 5.2, 2.6))
START = Pose(0.5, 0.7, 0.0)
#: The path around the beds, counterclockwise.
PATH = ((0.5, 0.7), (5.6, 0.7), (5.6, 3.3), (0.5, 3.3))
#: Where a bed is looked after: on the path, first in front of the beds, then behind them.
STOPS = ((1.5, 0.7), (3.1, 0.7), (4.7, 0.7), (4.7, 3.3), (3.1, 3.3), (1.5, 3.3))
HEATER = (5.5, 3.7)
_COLD, _HEAT, _REACH = 17.0, 10.0, 1.8


def is_free(x, y, radius):
    """Return whether a round robot of this radius fits in at a place."""
    inside = (
        ROOM.left + radius <= x <= ROOM.right - radius
        and ROOM.bottom + radius <= y <= ROOM.top - radius)
    return inside and all(bed.distance(x, y) >= radius for bed in BEDS)


def temperature(x, y):
    """Return how warm it is at a place, in degrees Celsius: the closer to the heater, the more."""
    distance = math.hypot(x - HEATER[0], y - HEATER[1])
    return _COLD + _HEAT * math.exp(-(distance / _REACH) ** 2 / 2.0)


def range_to_wall(x, y, angle, longest):
    """
    Return how far a ray runs from a place until it meets a wall or a bed.

    :param longest: what it returns for a ray that meets nothing before.
    """
    dx, dy = math.cos(angle), math.sin(angle)
    nearest = min(
        _leaving(x, dx, ROOM.left, ROOM.right), _leaving(y, dy, ROOM.bottom, ROOM.top), longest)
    for bed in BEDS:
        nearest = min(nearest, _entering(bed, x, y, dx, dy))
    return max(nearest, 0.0)


def _leaving(at, step, low, high):
    """Return how far a ray runs in the room along one axis."""
    if abs(step) < 1e-9:
        return math.inf
    return ((high if step > 0.0 else low) - at) / step


def _entering(bed, x, y, dx, dy):
    """Return how far a ray runs until it meets a bed; infinity if it passes."""
    enters, leaves = 0.0, math.inf
    for at, step, low, high in ((x, dx, bed.left, bed.right), (y, dy, bed.bottom, bed.top)):
        if abs(step) < 1e-9:
            if not low <= at <= high:
                return math.inf
            continue
        near, far = sorted(((low - at) / step, (high - at) / step))
        enters, leaves = max(enters, near), min(leaves, far)
    return enters if enters <= leaves else math.inf


def occupancy(resolution):
    """
    Return the map, row by row from the lower left: 100 where a bed or a wall is, 0 where none is.

    :param resolution: the length of a cell's side.
    :returns: the map, its width and its height in cells.
    """
    width, height = (round(side / resolution) for side in (ROOM.right, ROOM.top))
    cells = []
    for row in range(height):
        for column in range(width):
            x, y = (column + 0.5) * resolution, (row + 0.5) * resolution
            is_wall = row in (0, height - 1) or column in (0, width - 1)
            is_bed = any(bed.distance(x, y) == 0.0 for bed in BEDS)
            cells.append(100 if is_wall or is_bed else 0)
    return cells, width, height


def route(start, stop):
    """
    Return the corners on the way from a place to a stop: to the path, along it, to the stop.

    :param start: a place, as x and y.
    :param stop: a place on the path.
    :returns: places, the last of which is the stop.
    """
    here, there = _along(*start), _along(*stop)
    length = _LENGTHS[-1]
    forward = (there - here) % length
    corners = [_place(here)]
    ahead = sorted(((end - here) % length, corner) for end, corner in zip(_LENGTHS, _CORNERS))
    if forward <= length / 2.0:
        corners += [corner for at, corner in ahead if 0.0 < at < forward]
    else:
        corners += [corner for at, corner in reversed(ahead) if at > forward]
    return [*corners, stop]


#: Each corner of the path but the first, which comes last, and how long the path is up to it.
_CORNERS = (*PATH[1:], PATH[0])
_LENGTHS = []
for _start, _end in zip(PATH, _CORNERS):
    _LENGTHS.append((_LENGTHS[-1] if _LENGTHS else 0.0) + math.dist(_start, _end))


def _along(x, y):
    """Return how long the path is from its beginning to the point of it next to a place."""
    nearest, found = math.inf, 0.0
    begin = 0.0
    for start, end, length in zip(PATH, _CORNERS, _LENGTHS):
        side = length - begin
        dx, dy = (end[0] - start[0]) / side, (end[1] - start[1]) / side
        at = min(max((x - start[0]) * dx + (y - start[1]) * dy, 0.0), side)
        away = math.hypot(x - start[0] - at * dx, y - start[1] - at * dy)
        if away < nearest:
            nearest, found = away, begin + at
        begin = length
    return found


def _place(along):
    """Return the point of the path that is so far from its beginning."""
    begin = 0.0
    for start, end, length in zip(PATH, _CORNERS, _LENGTHS):
        if along <= length:
            part = (along - begin) / (length - begin)
            return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])
        begin = length
    return PATH[0]

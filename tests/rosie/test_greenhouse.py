"""The place where Rosie works: what is free, how far the walls are, the way around the beds."""

import math
from itertools import pairwise

import pytest

from rosie import greenhouse


@pytest.mark.parametrize(
    ("place", "is_free"),
    [
        (greenhouse.START[:2], True),
        ((0.1, 0.7), False),  # its side would be in the wall
        ((1.5, 2.0), False),  # in a bed
        ((2.3, 2.0), True),  # between two beds
        ((2.15, 2.0), False),
        ((5.83, 3.83), True),  # in the corner, touching both walls
        ((-1.0, 2.0), False),
    ],
)
def test_what_is_free(place, is_free):
    assert greenhouse.is_free(*place, 0.17) is is_free


@pytest.mark.parametrize(
    ("place", "angle", "expected"),
    [
        ((0.5, 0.7), 0.0, 5.0),  # along the path: the wall is farther than the scanner sees
        ((3.0, 0.7), 0.0, 3.0),
        ((0.5, 0.7), math.pi, 0.5),
        ((0.5, 0.7), -math.pi / 2, 0.7),
        ((1.5, 0.7), math.pi / 2, 0.7),  # the bed
        ((0.5, 2.0), 0.0, 0.5),
        ((0.5, 0.7), math.pi / 4, math.hypot(0.7, 0.7)),  # a corner side of the first bed
        ((2.3, 3.0), -math.pi / 2, 3.0),  # between two beds, to the wall
    ],
)
def test_how_far_a_ray_runs(place, angle, expected):
    assert greenhouse.range_to_wall(*place, angle, 5.0) == pytest.approx(expected)


def test_it_is_warmest_at_the_heater():
    warmth = [greenhouse.temperature(*place) for place in greenhouse.STOPS]
    assert max(warmth) == warmth[3]
    assert greenhouse.temperature(*greenhouse.HEATER) > 26.0
    assert 16.0 < greenhouse.temperature(*greenhouse.START[:2]) < 20.0


@pytest.mark.parametrize("stop", greenhouse.STOPS)
@pytest.mark.parametrize(
    "start", [greenhouse.START[:2], (5.6, 3.3), (2.3, 2.0), (3.9, 1.6), (0.3, 3.8), (5.0, 0.4)]
)
def test_every_way_to_a_stop_is_free_and_no_longer_than_half_the_path(start, stop):
    corners = [start, *greenhouse.route(start, stop)]
    assert corners[-1] == stop
    for begin, end in pairwise(corners):
        for part in range(21):
            x, y = (a + part / 20 * (b - a) for a, b in zip(begin, end, strict=True))
            assert greenhouse.is_free(x, y, 0.17)
    half = sum(math.dist(*ends) for ends in pairwise(greenhouse.PATH))
    along = sum(math.dist(*ends) for ends in pairwise(corners[1:]))
    assert along <= half


def test_the_map_holds_what_is_free():
    cells, width, height = greenhouse.occupancy(0.1)
    assert (width, height, len(cells)) == (60, 40, 2400)
    rows = [cells[row * width : (row + 1) * width] for row in range(height)]
    assert set(rows[0]) == {100}
    assert rows[7][5] == 0
    assert rows[20][15] == 100
    assert sum(cell == 100 for cell in cells) == 3 * 120 + 2 * 60 + 2 * 38

from __future__ import annotations

from itertools import pairwise

import pytest

from rosbeat.records import Outcome
from rosbeat.viz import theme
from rosbeat.viz.canvas import text_width
from rosbeat.viz.progress_map import describe, progress_map, summary

ROWS = [
    ("00 Hear the heartbeat", [Outcome("00a", "passed", points=1), Outcome("00b", "failed")]),
    ("03 Write a publisher", [Outcome("03a", "not attempted", out_of=2)]),
]


def texts(picture):
    return [text for text in picture.figure.axes[0].texts if text.get_text()]


def words(picture):
    return [text.get_text() for text in texts(picture)]


def test_it_says_in_one_line_what_it_shows():
    assert progress_map(ROWS).description == describe(ROWS) == (
        "Your progress: 1 of 3 exercises passed, 1 of 4 points. Passed: 00a. Not there yet: 00b. "
        "Not attempted yet: 03a."
    )  # fmt: skip
    assert describe(ROWS[1:]).endswith("Not attempted yet: all.")


def test_every_page_and_exercise_is_drawn_with_a_sign():
    drawn = words(progress_map(ROWS))
    assert {"00 Hear the heartbeat", "03 Write a publisher", "00a", "00b", "03a"} <= set(drawn)
    # Once in the key, once beside the exercise.
    assert (drawn.count("✓"), drawn.count("✗")) == (2, 2)
    assert summary([one for _, found in ROWS for one in found]) in drawn


def test_a_state_differs_in_shape_or_fill_as_well_as_in_colour():
    lines = progress_map(ROWS).figure.axes[0].lines
    looks = {(line.get_marker(), line.get_markerfacecolor()) for line in lines}
    assert len(looks) == 3
    assert len(lines) == 6


def test_the_same_bytes_every_time():
    one, other = progress_map(ROWS), progress_map(ROWS)
    assert one.svg() == other.svg()
    assert one.svg() == other.svg()
    assert f'aria-label="{one.description}"' in one.svg()


def test_long_headings_and_many_exercises_stay_inside_and_apart():
    long = "A heading " * 20
    many = [Outcome(f"exercise_{number}", "passed") for number in range(20)]
    picture = progress_map([(long, many), ("00 Short", many[:2])])
    drawn = words(picture)
    assert drawn.count("exercise_19") == 1
    assert next(text for text in drawn if text.startswith("A heading")).endswith("…")
    boxes = sorted(
        (text.get_position()[1], text.get_position()[0], text) for text in texts(picture)
    )
    for (low, x, text), (high, follower, _) in pairwise(boxes):
        width = text_width(text.get_text())
        if text.get_ha() == "left":
            assert x + width <= theme.WIDTH
            assert low != high or x + width < follower + 9


@pytest.mark.parametrize("rows", [[], [("00 Hear the heartbeat", [])]])
def test_a_course_without_exercises_is_drawn_all_the_same(rows):
    assert "0 of no exercises passed" in progress_map(rows).description
    assert progress_map(rows).svg()

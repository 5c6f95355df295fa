"""How a class was graded the last time."""

import os

import pytest

from rosbeat.grading.last_run import FILE, changes, note_options

TYPED = {"due": "2026-11-30 18:00", "points": "my points.csv"}


def test_the_first_time_there_is_nothing_to_compare(tmp_path):
    assert changes(tmp_path, TYPED) == ""
    assert not list(tmp_path.iterdir())


def test_what_is_the_same_needs_no_word(tmp_path):
    note_options(tmp_path / "new", TYPED)
    assert changes(tmp_path / "new", dict(reversed(TYPED.items()))) == ""


@pytest.mark.parametrize(
    ("now", "said"),
    [
        ({}, "Last time: --due '2026-11-30 18:00', --points 'my points.csv'; now without. "),
        ({"due": TYPED["due"]}, "Last time: --points 'my points.csv'; now without. "),
        (TYPED | {"lessons": "03 04"}, "Last time: without them; now --lessons 03 04. "),
        (
            TYPED | {"due": "2026-12-01"},
            "Last time: --due '2026-11-30 18:00'; now --due 2026-12-01.",
        ),
    ],
)
def test_what_differs_is_said_in_one_line(tmp_path, now, said):
    note_options(tmp_path, TYPED)
    line = changes(tmp_path, now)
    assert said in line
    assert "\n" not in line


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", "7", '{"format": 2, "options": {}}', '{"options": {}}',
     '{"format": 1, "options": []}', "[" * 100_000, "\udcff"],
)  # fmt: skip
def test_a_file_that_is_none_of_ours_stops_nothing(tmp_path, text):
    (tmp_path / FILE).write_text(text, errors="surrogateescape")
    said = changes(tmp_path, TYPED)
    assert f"{FILE} cannot be read" in said
    assert (tmp_path / FILE).read_text(errors="surrogateescape") == text


def test_a_folder_in_its_place_stops_nothing(tmp_path):
    (tmp_path / FILE).mkdir()
    assert "cannot be read" in changes(tmp_path, TYPED)


def test_what_somebody_has_put_into_the_file_cannot_reach_the_terminal(tmp_path):
    note_options(tmp_path, {"due": "\x1b[31m", "\x1b[32m": "x"})
    assert "\x1b" not in changes(tmp_path, {})


def test_an_equal_file_is_not_touched(tmp_path):
    note_options(tmp_path, TYPED)
    before = os.stat(tmp_path / FILE).st_mtime_ns
    note_options(tmp_path, TYPED)
    assert os.stat(tmp_path / FILE).st_mtime_ns == before

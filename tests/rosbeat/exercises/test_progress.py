from __future__ import annotations

import pytest

from rosbeat import progress
from rosbeat.exercises.exercise import failed, passed
from rosbeat.exercises.progress import heading, outcomes, progress_file
from rosbeat.exercises.registry import EXERCISES, PAGES, Page


@pytest.fixture(autouse=True)
def _home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))


def test_an_untouched_course_is_all_open():
    words = progress().description
    assert words.startswith(f"Your progress: 0 of {len(EXERCISES)} exercises passed, 0 of ")
    assert words.endswith(" Not attempted yet: all.")


def test_what_was_checked_is_in_the_picture():
    progress_file().change("00a", lambda before: before.after(passed("")))
    progress_file().change("00b", lambda before: before.after(failed("00b", "", "")))
    words = progress().description
    assert f"1 of {len(EXERCISES)} exercises passed" in words
    assert "Passed: 00a. Not there yet: 00b." in words
    assert "\n" not in words


def test_the_picture_is_the_same_every_time():
    assert progress().html() == progress().html()


def test_exercises_of_no_page_have_a_heading_too():
    assert heading(PAGES[3]) == "03 Write a publisher"
    assert heading(Page("", "The whole system", ())) == "The whole system"
    assert outcomes(Page("", "The whole system", ()), {}) == []

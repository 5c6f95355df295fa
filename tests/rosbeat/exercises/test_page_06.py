"""Page 06: what the bank of answers cannot show of workspaces."""

import pytest

from rosbeat.exercises.page_06 import EXERCISES


@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda one: one.id)
def test_nothing_there_is_nothing_tried(exercise, tmp_path):
    assert exercise.judged(exercise.scenario(tmp_path)).status == "not attempted"

"""Scenarios are found by the ids of their exercises."""

import pytest

from rosbeat.errors import ExerciseError
from rosbeat.exercises.registry import EXERCISES, scenario


@pytest.mark.parametrize("name", EXERCISES)
def test_a_check_runs_the_same_scenario(name):
    assert EXERCISES[name].scenario is scenario(name)


@pytest.mark.parametrize("name", ["", "03", "03z", "99a", "page_03", "registry", "../03a"])
def test_what_is_no_exercise_has_none(name, says):
    with pytest.raises(ExerciseError) as caught:
        scenario(name)
    says(caught.value, repr(name), "03a", "system")

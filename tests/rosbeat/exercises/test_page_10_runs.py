"""What is seen of diagnoses needs no ward."""

import subprocess
import sys

import pytest

from rosbeat.exercises.page_10_scenarios import SCENARIOS

CODE = """
import sys
from rosbeat.exercises.registry import scenario
seen = scenario("10a")(lambda: {1: ("not-spun", "/a"), "ward": 8})
assert seen.value == {"1": ["not-spun", "/a"], "ward": 8}
sys.exit(any(name.startswith("rosbeat.clinic") for name in sys.modules))
"""


@pytest.mark.parametrize("name", SCENARIOS)
def test_what_is_written_down_is_what_was_given_back(name):
    assert SCENARIOS[name](lambda: {1: ("a", "b")}).value == {"1": ["a", "b"]}


@pytest.mark.ros
def test_the_clinic_is_not_loaded_for_it():
    assert subprocess.run([sys.executable, "-c", CODE], check=False).returncode == 0

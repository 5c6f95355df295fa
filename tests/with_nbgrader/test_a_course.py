"""The pages in nbgrader itself: what it validates, which points it gives, what learners read."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from bank.class_of_learners import POINTS, answers_of
from bank.running import outcome_of

pytestmark = [pytest.mark.ros, pytest.mark.timeout(600)]

EXERCISES = [name for name in POINTS if name[:2] in ("03", "04")]


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """The folder of a course in which three learners were graded."""
    folder = tmp_path_factory.mktemp("course")
    home = tmp_path_factory.mktemp("home")
    programs = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    own = {"PATH": programs, "HOME": str(home), "ROSBEAT_WORKSPACE_IN": str(home)}
    own["ROSBEAT_PROGRESS_IN"] = str(home)
    environ = {
        name: value
        for name, value in os.environ.items()
        if name not in ("PYTEST_CURRENT_TEST", "ROSBEAT_STEADY_HOME", "NBGRADER_EXECUTION")
    }
    script = Path(__file__).with_name("a_course.py")
    done = subprocess.run(
        [sys.executable, script, folder], capture_output=True, text=True, env={**environ, **own}
    )
    assert done.returncode == 0, done.stderr[-4000:]
    assert not list(home.glob(".rosbeat")), "progress was noted"
    return folder


@pytest.fixture(scope="module")
def seen(course):
    return json.loads((course / "seen.json").read_text())


def points(marks, page="03"):
    """The points of each exercise of a page; nothing is left for a person to look at."""
    assert not any(by_hand for _, _, by_hand in marks.values())
    return {name: marks[f"{name}-check"][0] for name in EXERCISES if name[:2] == page}


def test_the_points_that_there_are_are_those_of_the_exercises(seen):
    assert {name: seen["marks"]["ada"][f"{name}-check"][1] for name in EXERCISES} == {
        name: POINTS[name] for name in EXERCISES
    }


def test_right_answers_get_all_points(seen):
    assert points(seen["marks"]["ada"]) == {
        name: POINTS[name] for name in EXERCISES if name[:2] == "03"
    }


def test_wrong_and_right_answers_get_the_points_that_check_gives(seen):
    expected = {
        name: outcome_of(name, one.text, one.subject).points
        for name, one in answers_of(1).items()
        if name[:2] == "03"
    }
    assert 0 < sum(expected.values()) < sum(POINTS[name] for name in expected)
    assert points(seen["marks"]["bob"]) == expected


def test_an_untouched_page_and_a_missing_one_get_none(seen):
    assert set(points(seen["marks"]["bob"], "04").values()) == {0}
    assert set(points(seen["marks"]["ada"], "04").values()) == {0}


def test_some_points_are_some_points(seen):
    assert seen["marks"]["ada"]["some-points"] == [13, 20, False]


def test_what_goes_to_stderr_costs_nothing(seen):
    assert seen["marks"]["ada"]["stderr"] == [20, 20, False]


def test_a_page_has_a_home_of_its_own_which_is_gone(seen):
    assert Path(seen["home"]).name == "ROS2_and_RL_Tutorials"
    assert not Path(seen["home"]).parent.exists()


def test_a_whole_page_with_right_answers_is_valid(seen):
    assert seen["validated"][0].startswith("Success!")


def test_what_is_wrong_is_said_in_words_and_without_a_stack(seen):
    said = seen["validated"][1]
    failed = [name for name, one in answers_of(1).items() if one.status == "failed"][:2]
    assert said.startswith("VALIDATION FAILED ON 2 CELL(S)!")
    assert re.findall(r"Exercise (\w+): not there yet", said) == failed
    assert said.count("Hint: ") == 2
    assert "Traceback" not in said
    assert "...\n" not in said  # where nbgrader cuts a line off
    assert len(said) < 2500


def test_the_feedback_says_the_mistake_and_the_points(course):
    page = (course / "feedback/bob/ps1/03_write_a_publisher.html").read_text()
    assert "Score: 2.0 / 8.0" in " ".join(page.split())
    assert "Hint:" in page
    assert "Exercise 03a: 0 of 2 points." in page
    untouched = (course / "feedback/bob/ps1/04_write_a_subscriber.html").read_text()
    assert untouched.count("No response.") == 5

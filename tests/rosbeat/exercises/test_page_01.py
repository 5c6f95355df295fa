"""Page 01: right, differently right and wrong; each judge is a pure function of what was seen."""

import pytest
from rosbeat.exercises.scenarios import TypedIn, Workspace

from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.page_01 import EXERCISES

FOLDERS = ("docs", "resources", "resources/images", "scripts", "src")
folder_01a, way_01b = EXERCISES


def judged_folders(*more):
    return folder_01a.judged(Workspace(tuple(sorted((*FOLDERS, *more))), {}))


def judged_way(folder, *typed):
    place = "ROS2_and_RL_Tutorials/resources/images"
    commands = tuple((place, command) for command in typed)
    return way_01b.judged(TypedIn(folder, commands, 0, ""))


@pytest.mark.parametrize("more", [(), ("resources/sounds",), ("src/other", "resources/sounds")])
def test_the_folder_is_there_however_it_was_made(more):
    assert judged_folders("resources/sounds/alarm", *more).status == PASSED


def test_nothing_of_the_folder_is_nothing_tried():
    assert judged_folders().status == NOT_ATTEMPTED


@pytest.mark.parametrize(
    ("made", "hint"),
    [
        ("resources/sounds", "outer/inner"),
        ("sounds/alarm", "pwd"),
        ("alarm", "begins where the terminal is"),
        ("resources/Sounds/Alarm", "capital"),
        ("src/resources/sounds/alarm", "pwd"),
    ],
)
def test_a_folder_near_by_says_what_is_missing(made, hint):
    outcome = judged_folders(made)
    assert outcome.status == FAILED
    assert made in outcome.evidence
    assert hint in outcome.hint


def test_a_better_try_counts_more_than_what_is_left_of_an_old_one():
    outcome = judged_folders("resourcessoundsalarm", "resources/sounds")
    assert outcome.mistake == "levels-miscounted"
    assert "There is resources/sounds," in outcome.evidence
    assert "need resourcessoundsalarm: `rmdir`" in outcome.hint


@pytest.mark.parametrize(
    ("made", "left"),
    [
        ("resources/Sounds/alarm", "Sounds in resources"),
        ("src/resources/sounds/alarm", "resources in src"),
        ("resources/sounds/alarms", "alarms in resources/sounds"),
        ("ressources/sounds", "ressources"),
    ],
)
def test_what_to_remove_is_only_what_is_not_of_the_page(made, left):
    assert f"You do not need {left}:" in judged_folders(made).hint


def test_what_is_on_the_way_stays():
    assert "rm" not in judged_folders("resources/sounds").hint.split()
    assert "`rmdir`" not in judged_folders("resources/sounds").hint


@pytest.mark.parametrize(
    "typed", ["cd ../../src", "cd ../..//src", "cd ../../src/", "pushd ../../src"]
)
def test_the_way_is_relative(typed):
    assert judged_way("src", typed).status == PASSED


@pytest.mark.parametrize(
    "typed",
    [
        "cd ~/ROS2_and_RL_Tutorials/src",
        "cd /home/you/ROS2_and_RL_Tutorials/src",
        'cd "/a b/ROS2_and_RL_Tutorials/src"',
        'cd "$ROS2_WORKSPACE/src"',
    ],
)
def test_an_absolute_path_is_not_what_was_asked(typed):
    outcome = judged_way("src", typed)
    assert outcome.status == FAILED
    assert "absolute" in outcome.evidence


def test_who_has_not_moved_has_not_tried():
    assert judged_way("resources/images").status == NOT_ATTEMPTED
    assert judged_way("resources/images", "pwd").status == NOT_ATTEMPTED


@pytest.mark.parametrize("folder", [".", "docs", "resources/images"])
def test_nothing_typed_is_nothing_tried(folder):
    outcome = way_01b.judged(TypedIn(folder, (), None, ""))
    assert (outcome.status, outcome.mistake) == (NOT_ATTEMPTED, "")


@pytest.mark.parametrize(
    ("folder", "typed"),
    [
        ("resources/images", "cd src"),
        ("resources", "cd .."),
        ("/", "cd /"),
        ("docs", "cd ../../docs"),
    ],
)
def test_another_place_is_named(folder, typed):
    outcome = judged_way(folder, typed)
    assert outcome.status == FAILED
    assert folder in outcome.evidence

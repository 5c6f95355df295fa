"""Page 01: what the bank of answers cannot show, as plain evidence."""

import pytest

from rosbeat.exercises.page_01 import EXERCISES, FolderMaking
from rosbeat.exercises.scenarios import CommandMeaning, TypedIn, Workspace
from rosbeat.workspace.prerequisites import FOLDERS

folder_01a, way_01b = EXERCISES
PLACE = "ROS2_and_RL_Tutorials"


def made(*folders, **more):
    there = tuple(sorted((*FOLDERS, "resources", *folders)))
    return folder_01a.judged(FolderMaking(Workspace(there, {}), **more))


@pytest.mark.parametrize(
    ("line", "status"),
    [
        ("mkdir -p resources/sounds/alarm", "passed"),
        ("mkdir -p 'resources/sounds/alarm'", "passed"),
        ("mkdir -p resources/sounds", "failed"),
        ("mkdir -p $HOME/sounds/alarm", "passed"),  # only a shell could tell
    ],
)
def test_of_a_folder_from_before_what_was_typed_now_counts(line, status):
    folders = ("resources/sounds", "resources/sounds/alarm")
    assert made(*folders, is_older=True, tried=((PLACE, line),)).status == status
    assert made(*folders, tried=((PLACE, line),)).status == "passed"


@pytest.mark.parametrize("obstacle", ["a link", "a file", "behind a link"])
def test_what_is_in_the_way_is_named(obstacle):
    outcome = made(obstacle=obstacle, tried=((PLACE, "mkdir resources/sounds/alarm"),))
    assert outcome.mistake == "not-a-folder"
    assert f"resources/sounds/alarm is {obstacle}," in outcome.evidence


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("mkdir -p resources/sounds/alarm", "is not there any more"),
        ("mkdir $HOME/sounds/alarm", "`mkdir $HOME/sounds/alarm`"),
    ],
)
def test_a_try_that_nothing_explains_is_unknown_and_shown(line, said):
    outcome = made(tried=((PLACE, line),))
    assert (outcome.status, outcome.mistake) == ("failed", "new-to-me")
    assert said in outcome.evidence


@pytest.mark.parametrize(("name", "known"), [("parents-missing", True), ("passed", False)])
def test_evidence_cannot_invent_a_mistake(name, known):
    meaning = CommandMeaning(name, "evidence", "hint")
    outcome = made(tried=((PLACE, "mkdir a/alarm"),), meaning=meaning)
    assert outcome.mistake == (name if known else "new-to-me")


@pytest.mark.parametrize(
    ("folder", "typed", "status"),
    [
        ("src", "cd ../..//src", "passed"),
        ("src", 'cd "/a b/ROS2_and_RL_Tutorials/src"', "failed"),
        ("resources/images", "cd 'src", "failed"),
        ("/", "cd /", "failed"),
        ("resources/images", "pwd", "not attempted"),
    ],
)
def test_a_way_is_judged_by_where_it_leads_and_how(folder, typed, status):
    commands = ((f"{PLACE}/resources/images", typed),)
    outcome = way_01b.judged(TypedIn(folder, commands, 0, ""))
    assert outcome.status == status
    assert folder in outcome.evidence

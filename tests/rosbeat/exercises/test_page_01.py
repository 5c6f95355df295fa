"""Page 01: what the bank of answers cannot show, as plain evidence; and the suspects of 01a."""

import pytest

from rosbeat.exercises.page_01 import _SUSPECTS, EXERCISES, FolderMaking
from rosbeat.exercises.scenarios import CommandMeaning, TypedIn, Workspace
from rosbeat.workspace.catching_up import FOLDERS

folder_01a, way_01b = EXERCISES
PLACE = "ROS2_and_RL_Tutorials"


def made(*folders, **more):
    there = tuple(sorted((*FOLDERS, "resources", *folders)))
    return folder_01a.judged(FolderMaking(Workspace(there, {}), **more))


def test_a_better_try_counts_more_than_what_is_left_of_an_old_one():
    outcome = made("resourcessoundsalarm", "resources/sounds")
    assert outcome.mistake == "levels-miscounted"
    assert "There is resources/sounds," in outcome.evidence
    assert "need resourcessoundsalarm: `rmdir`" in outcome.hint


@pytest.mark.parametrize(
    ("line", "status"),
    [
        ("mkdir -p resources/sounds/alarm", "passed"),
        ("mkdir -p 'resources/sounds/alarm'", "passed"),
        ("mkdir -p resources/sounds", "failed"),
        ('mkdir -p "resources/sounds"', "failed"),
        ("mkdir -p $HOME/sounds/alarm", "passed"),  # only a shell could tell
    ],
)
def test_of_a_folder_from_before_what_was_typed_now_counts(line, status):
    folders = ("resources/sounds", "resources/sounds/alarm")
    assert made(*folders, is_older=True, tried=((PLACE, line),)).status == status
    assert made(*folders, tried=((PLACE, line),)).status == "passed"


@pytest.mark.parametrize(
    ("folder", "left"),
    [
        ("resources/Sounds/alarm", "Sounds in resources"),
        ("src/resources/sounds/alarm", "resources in src"),
        ("ressources/sounds", "ressources"),
        ("resources/sounds", ""),
    ],
)
def test_what_to_remove_is_only_what_is_not_of_the_page(folder, left):
    assert (f"You do not need {left}:" in made(folder).hint) == bool(left)


@pytest.mark.parametrize(
    ("standing", "way"),
    [
        ("ressources", "cd .."),
        ("ressources/sounds", "cd ../.."),
        (".", ""),
        ("ressources_2", ""),
        ("/home/you", ""),
    ],
)
def test_a_folder_that_a_terminal_is_in_is_left_before_it_is_removed(standing, way):
    hint = made("ressources", "ressources/sounds", standing=("src", standing)).hint
    leave = f"A terminal is in ressources: leave the folder first, with `{way}`. You do not need"
    assert (leave in hint) == bool(way)
    assert ("A terminal is in" in hint) == bool(way)


def test_nothing_typed_and_nothing_made_is_nothing_tried():
    assert made().status == "not attempted"


@pytest.mark.parametrize(
    ("line", "mistake"),
    [
        ("mkdir resources/sounds/alarm", "parents-missing"),
        ("mkdir -p resources/sounds/alarm", "new-to-me"),
        ("mkdir --parents resources/sounds/alarm", "new-to-me"),
    ],
)
def test_a_try_outside_of_a_terminal_is_a_try(line, mistake):
    outcome = made(outside=line)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert f"You typed `{line}` in a cell that no terminal runs." in outcome.evidence
    assert "%%terminal one" in outcome.hint


@pytest.mark.parametrize("obstacle", ["a link", "a file", "behind a link"])
def test_what_is_in_the_way_is_named(obstacle):
    outcome = made(obstacle=obstacle, tried=((PLACE, "mkdir resources/sounds/alarm"),))
    assert outcome.mistake == "not-a-folder"
    assert f"resources/sounds/alarm is {obstacle}," in outcome.evidence


def test_what_was_made_and_removed_again_is_not_misspelled():
    outcome = made(tried=((PLACE, "mkdir -p resources/sounds/alarm"),))
    assert outcome.mistake == "new-to-me"
    assert "is not there any more" in outcome.evidence


def test_a_try_that_nothing_explains_is_unknown_and_shown():
    outcome = made(tried=((PLACE, "mkdir $HOME/sounds/alarm"),))
    assert (outcome.status, outcome.mistake) == ("failed", "new-to-me")
    assert "`mkdir $HOME/sounds/alarm`" in outcome.evidence


@pytest.mark.parametrize(("name", "known"), [("parents-missing", True), ("passed", False)])
def test_evidence_cannot_invent_a_mistake(name, known):
    meaning = CommandMeaning(name, "evidence", "hint")
    outcome = made(tried=((PLACE, "mkdir a/alarm"),), meaning=meaning)
    assert outcome.mistake == (name if known else "new-to-me")


@pytest.mark.parametrize("suspect", _SUSPECTS, ids=lambda one: "+".join(one.model(None)))
def test_each_suspect_is_named_by_what_it_makes(suspect):
    paths = suspect.model(None)
    outcome = made(*paths)
    assert (outcome.status, outcome.mistake) == ("failed", suspect.mistake)
    assert outcome.hint.startswith(suspect.hint)
    assert not [one for one in _SUSPECTS if one is not suspect and one.model(None) == paths]


def way(folder, *typed):
    commands = tuple((f"{PLACE}/resources/images", command) for command in typed)
    return way_01b.judged(TypedIn(folder, commands, 0, ""))


@pytest.mark.parametrize("folder", [".", "docs", "resources/images"])
def test_nothing_typed_is_nothing_tried(folder):
    assert way_01b.judged(TypedIn(folder, (), None, "")).status == "not attempted"


@pytest.mark.parametrize(
    ("folder", "typed", "status"),
    [
        ("src", "cd ../..//src", "passed"),
        ("src", 'cd "/a b/ROS2_and_RL_Tutorials/src"', "failed"),
        ("resources/images", "cd 'src", "failed"),
        ("/", "cd /", "failed"),
        ("docs", "cd ../../docs", "failed"),
        ("resources/images", "pwd", "not attempted"),
    ],
)
def test_a_way_is_judged_by_where_it_leads_and_how(folder, typed, status):
    outcome = way(folder, typed)
    assert outcome.status == status
    assert folder in outcome.evidence

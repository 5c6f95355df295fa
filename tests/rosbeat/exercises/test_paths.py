import pytest

from rosbeat.exercises.paths import (
    alike,
    closeness,
    commands,
    is_absolute,
    led_to,
    misspelled,
    moves,
)


@pytest.mark.parametrize(("one", "other"), [("src", "scr"), ("Src", "src"), ("sounds", "sound")])
def test_names_that_are_alike(one, other):
    assert alike(one, other)
    assert misspelled(f"a/{one}", f"a/{other}")
    assert not misspelled(f"a/b/{one}", f"a/{other}")


def test_names_that_are_not():
    assert not alike("src", "docs")
    assert not misspelled("a/src", "a/src")


def test_how_close_a_path_is():
    made = ("a\\room\\lamp", "room", "house/rooms", "garden/house/room/lamp")
    assert [closeness(one, "house/room/lamp") for one in made] == [0, 1, 2, 3]


def test_where_a_path_leads():
    assert led_to("resources/images", "../../src") == "src"
    assert led_to("resources/images", "../..") == "."
    assert led_to("resources/images", "..//src/") == "resources/src"


def test_commands_of_lines():
    assert commands(["cd a && ls; pwd # why", "echo 'a b'"]) == [
        ["cd", "a"],
        ["ls"],
        ["pwd"],
        ["echo", "a b"],
    ]
    assert commands([r"cd ..\src", "echo 'open"]) == [["cd", r"..\src"], ["echo", "'open"]]
    assert moves(["cd a && ls", "pushd b"]) == [["a"], ["b"]]


@pytest.mark.parametrize("words", [[], ["/a"], ["~"], ["$X/a"], ["-P", "/a"]])
def test_absolute_paths(words):
    assert is_absolute(words)
    assert not is_absolute(["a", *words])

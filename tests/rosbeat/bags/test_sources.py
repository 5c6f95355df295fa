"""What a caller may give."""

from pathlib import Path

import pytest

from rosbeat.bags.sources import full_name, observed, place, types_of
from rosbeat.errors import BagError


def test_a_home_folder_is_understood(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path))
    assert place("~/run") == tmp_path / "run"
    assert place(Path("run")) == Path("run")


@pytest.mark.parametrize("folder", ["", "  ", None, 3, b"run", "a\0b"])
def test_what_names_no_folder_gets_three_parts(says, folder):
    with pytest.raises(BagError) as caught:
        place(folder)
    says(caught.value, "not the name of a folder")


def test_a_slash_may_be_left_out():
    assert full_name("a/b") == full_name("/a/b") == "/a/b"


def test_an_observer_is_asked(make):
    class Watcher:
        def observation(self):
            return make.run([1.0])

    assert observed(Watcher()) == make.run([1.0])
    with pytest.raises(BagError):
        observed(Watcher)


def test_a_topic_is_known_by_its_publisher_or_its_messages(make):
    assert types_of(make.run([])) == {"/temperature": "std_msgs/msg/Float32"}
    assert types_of(make.run([1.0]), ["temperature", "/temperature"]) == types_of(make.run([]))

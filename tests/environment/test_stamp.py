import shutil

import pytest

from course_tool import stamp, underlay
from course_tool.layout import Layout


def test_a_fresh_stamp_satisfies(made):
    stamp.write(made, "course")
    assert stamp.satisfied(made, "course")


def test_no_stamp_is_a_half_made_environment(made):
    assert stamp.read(made) is None
    assert not stamp.satisfied(made, "course")


@pytest.mark.parametrize("text", ["", "{", "[]", '{"level": "gold", "fingerprint": "x"}'])
def test_a_stamp_that_cannot_be_read_is_none(made, text):
    made.stamp.write_text(text)
    assert stamp.read(made) is None


@pytest.mark.parametrize(
    "name",
    [
        "environment/course.lock",
        "environment/build.lock",
        "pyproject.toml",
        "src/ros2_command/pyproject.toml",
    ],
)
def test_whatever_it_was_made_from_makes_it_stale(made, name):
    stamp.write(made, "course")
    (made.root / name).write_text("another version\n")
    assert not stamp.satisfied(made, "course")


def test_another_underlay_makes_it_stale(made, tmp_path, monkeypatch):
    stamp.write(made, "course")
    (tmp_path / "local_setup.sh").write_text("another version\n")
    monkeypatch.setattr(underlay, "templates", lambda: [tmp_path / "local_setup.sh"])
    assert not stamp.satisfied(made, "course")


def test_another_python_makes_it_stale(made, monkeypatch):
    stamp.write(made, "course")
    monkeypatch.setattr("sys.version_info", (3, 99, 0, "final", 0))
    assert not stamp.satisfied(made, "course")


def test_moving_makes_it_stale(made, tmp_path):
    stamp.write(made, "course")
    there = tmp_path / "elsewhere"
    shutil.move(made.root, there)
    assert not stamp.satisfied(Layout(there), "course")


def test_a_python_that_is_gone_makes_it_stale(made):
    stamp.write(made, "course")
    made.python.unlink()
    assert not stamp.satisfied(made, "course")


def test_an_environment_for_tests_serves_learners_too(made):
    stamp.write(made, "test")
    made.lock("course").write_text("learners' lock alone says little here\n")
    assert stamp.satisfied(made, "course")
    assert stamp.satisfied(made, "test")


def test_an_environment_for_learners_does_not_serve_tests(made):
    stamp.write(made, "course")
    assert not stamp.satisfied(made, "test")


@pytest.mark.parametrize(
    ("there", "wanted", "made_for"),
    [("test", "course", "test"), ("course", "test", "test"), ("course", "course", "course")],
)
def test_nobody_loses_tools(made, there, wanted, made_for):
    stamp.write(made, there)
    assert stamp.at_least(made, wanted) == made_for


def test_a_stamp_can_be_taken_away_twice(made):
    stamp.write(made, "course")
    stamp.remove(made)
    stamp.remove(made)
    assert stamp.at_least(made, "course") == "course"

import os
import shutil
import sys

import pytest

from course_tool import making, running, stamp
from course_tool.layout import Layout
from course_tool.messages import Problem

ENV = {"PATH": os.defpath}


@pytest.fixture
def finished(made):
    stamp.write(made, "course")
    return made


@pytest.fixture
def commands(monkeypatch):
    """What would be run to make an environment."""
    seen = []

    def make(layout, environ):
        seen.append("make")

    monkeypatch.setattr(making, "make", make)
    return seen


def answers(layout, text):
    layout.python.write_text(f"#!/bin/sh\n{text}\n")


def test_a_finished_one_is_kept(finished, commands):
    making.make_or_keep(finished, ENV)
    assert commands == []
    assert finished.venv.is_dir()


def test_none_is_made(layout, commands, capsys):
    making.make_or_keep(layout, ENV)
    assert commands == ["make"]
    assert "again" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("harm", "reason"),
    [
        (lambda layout: stamp.remove(layout), "is not finished"),
        (lambda layout: layout.python.unlink(), "is not finished"),
        (lambda layout: answers(layout, "exit 1"), "has a Python that does not run"),
        (lambda layout: answers(layout, "echo 3.9 /usr"), "belongs to another Python (3.9, /usr)"),
        (
            lambda layout: answers(layout, "echo {}.{} /elsewhere".format(*sys.version_info[:2])),
            "belongs to another Python",
        ),
    ],
    ids=["no stamp", "no python", "broken python", "other version", "other place of Python"],
)
def test_an_unusable_one_is_made_again(finished, commands, capsys, harm, reason):
    harm(finished)
    making.make_or_keep(finished, ENV)
    assert commands == ["make"]
    assert f".venv {reason}" in capsys.readouterr().out
    assert not finished.venv.exists()


def test_a_moved_one_is_made_again(finished, tmp_path, commands, capsys):
    there = Layout(tmp_path / "elsewhere")
    shutil.move(finished.root, there.root)
    making.make_or_keep(there, ENV)
    assert commands == ["make"]
    assert "was made in another place" in capsys.readouterr().out


def test_of_a_link_only_the_link_is_removed(layout, tmp_path):
    (tmp_path / "precious").mkdir()
    layout.venv.symlink_to(tmp_path / "precious")
    making.remove(layout)
    assert (tmp_path / "precious").is_dir()
    assert not os.path.lexists(layout.venv)


def test_one_that_cannot_be_removed(made, monkeypatch):
    def refuse(folder):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(shutil, "rmtree", refuse)
    with pytest.raises(Problem, match="Nothing can be written"):
        making.remove(made)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("The virtual environment was not created: ensurepip is not available.", "venv module"),
        ("Error: [Errno 28] No space left on device", "not enough room"),
        ("something else", "does not know the reason"),
    ],
)
def test_what_pythons_own_module_says_is_understood(layout, monkeypatch, text, words):
    monkeypatch.setattr(running, "quiet", lambda command, env: running.Result(1, text))
    with pytest.raises(Problem, match=words):
        making.make(layout, ENV)

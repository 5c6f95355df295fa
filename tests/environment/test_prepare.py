"""`.venv`: what must hold before, how it is made and kept, its stamp, and a first ROS message."""

import importlib.util
import os
import shutil
import subprocess
import sys
from contextlib import nullcontext
from types import SimpleNamespace

import pytest

from course_tool import installing, prepare, running
from course_tool.layout import Layout
from course_tool.problems import Problem, Untouched


@pytest.fixture
def work(made, monkeypatch):
    """What preparing does, as a list of words, without doing it."""
    done = []
    monkeypatch.setattr(prepare, "check_space", lambda folder, needed: done.append("check"))
    monkeypatch.setattr(prepare, "make_or_keep", lambda layout, environ: done.append("venv"))
    monkeypatch.setattr(installing, "fill", lambda layout, level, environ: done.append(level))

    def ask_ros(layout, environ):
        done.append("listen")
        return {"milliseconds": 200.0, "rclpy": "7.1.6"}

    monkeypatch.setattr(prepare, "ask_ros", ask_ros)
    return done


def fails(problem):
    def fill(layout, level, environ):
        raise problem

    return fill


def test_everything_is_done_in_order_and_the_stamp_comes_last(made, work):
    environ = prepare.ready(made, "course")
    assert work == ["check", "venv", "course", "listen"]
    assert prepare.is_satisfied(made, "course")
    assert not prepare.is_satisfied(made, "test")
    assert environ["VIRTUAL_ENV"] == str(made.venv)


def test_nothing_is_done_twice(made, work):
    prepare.ready(made, "course")
    del work[:]
    prepare.ready(made, "course")
    assert work == []


def test_a_refresh_keeps_the_tools_for_tests(made, work):
    prepare.ready(made, "test")
    del work[:]
    made.lock("test").write_text("newer\n")
    prepare.ready(made, "course")
    assert work == ["check", "venv", "test", "listen"]


def test_what_another_command_has_just_done_is_not_done_again(made, work, monkeypatch):
    def meanwhile(folder):
        prepare.write_stamp(made, "course")
        return nullcontext()

    monkeypatch.setattr(prepare, "exclusive", meanwhile)
    prepare.ready(made, "course")
    assert work == ["check"]


def test_an_interrupted_one_has_no_stamp(made, work, monkeypatch):
    prepare.write_stamp(made, "course")
    made.lock("course").write_text("newer\n")
    monkeypatch.setattr(installing, "fill", fails(KeyboardInterrupt()))
    with pytest.raises(KeyboardInterrupt):
        prepare.ready(made, "course")
    assert not made.stamp.exists()


def test_offline_the_old_environment_is_not_lost(made, work, monkeypatch):
    prepare.write_stamp(made, "course")
    before = made.stamp.read_text()
    made.lock("course").write_text("newer\n")
    monkeypatch.setattr(installing, "fill", fails(Untouched("network", "", "")))
    with pytest.raises(Untouched):
        prepare.ready(made, "course")
    assert made.stamp.read_text() == before
    assert not prepare.is_satisfied(made, "course")


def test_the_first_time_is_announced(layout, made, work, capsys):
    prepare.ready(made, "course")
    assert "Completing .venv" in capsys.readouterr().out
    made.lock("course").write_text("newer\n")
    prepare.ready(made, "course")
    assert "Something changed" in capsys.readouterr().out


# What must hold before.

HERE = "{}.{}".format(*sys.version_info[:2])


@pytest.mark.parametrize("missing", ["venv", "ensurepip"])
def test_an_incomplete_python_gets_the_right_apt_line(layout, monkeypatch, missing):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == missing else find(name)
    )
    with pytest.raises(Problem) as caught:
        prepare.make_or_keep(layout, ENV)
    assert f"sudo apt install python{HERE}-venv" in caught.value.cure


def test_a_full_disk_is_said_before_it_is_filled(monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: SimpleNamespace(free=400_000_000))
    with pytest.raises(Problem) as caught:
        prepare.check_space(tmp_path, prepare.FIRST_TIME)
    assert "0.4 GB free, 1.5 needed" in caught.value.happened


# One command at a time.

HOLD = """
import fcntl, os, sys
descriptor = os.open(sys.argv[1], os.O_RDONLY)
fcntl.flock(descriptor, fcntl.LOCK_EX)
print("held", flush=True)
sys.stdin.readline()
"""


def test_a_second_command_waits_and_says_so(tmp_path, monkeypatch):
    said = []
    with subprocess.Popen(
        [sys.executable, "-I", "-S", "-c", HOLD, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as other:
        assert other.stdout.readline() == "held\n"

        def say(text):
            said.append(text)
            other.stdin.write("\n")
            other.stdin.flush()

        monkeypatch.setattr("course_tool.prepare.say", say)
        with prepare.exclusive(tmp_path):
            pass
    assert "waiting" in said[0]


# The virtual environment.

ENV = {"PATH": os.defpath}


@pytest.fixture
def finished(made):
    prepare.write_stamp(made, "course")
    return made


@pytest.fixture
def runs(monkeypatch):
    """How often Python's venv module was run, which is not really done."""
    seen, quiet = [], running.quiet

    def run(command, env, timeout=None):
        if "venv" not in command:
            return quiet(command, env, timeout)
        seen.append("make")
        return running.Result(0, "")

    monkeypatch.setattr(running, "quiet", run)
    return seen


def answers(layout, text):
    layout.python.write_text(f"#!/bin/sh\n{text}\n")


def test_none_is_made(layout, runs, capsys):
    prepare.make_or_keep(layout, ENV)
    assert runs == ["make"]
    assert "again" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("harm", "reason"),
    [
        (lambda layout: layout.stamp.unlink(), "is not finished"),
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
def test_an_unusable_one_is_made_again(finished, runs, capsys, harm, reason):
    harm(finished)
    prepare.make_or_keep(finished, ENV)
    assert runs == ["make"]
    assert f".venv {reason}" in capsys.readouterr().out
    assert not finished.venv.exists()


def test_a_moved_one_is_made_again(finished, tmp_path, runs, capsys):
    there = Layout(tmp_path / "elsewhere")
    shutil.move(finished.root, there.root)
    prepare.make_or_keep(there, ENV)
    assert runs == ["make"]
    assert "was made in another place" in capsys.readouterr().out


def test_of_a_link_only_the_link_is_removed(layout, tmp_path, runs):
    (tmp_path / "precious").mkdir()
    layout.venv.symlink_to(tmp_path / "precious")
    prepare.make_or_keep(layout, ENV)
    assert (tmp_path / "precious").is_dir()
    assert not os.path.lexists(layout.venv)


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
        prepare.make_or_keep(layout, ENV)


# The stamp.


@pytest.mark.parametrize("text", ["", "{", "[]", '{"level": "gold", "fingerprint": "x"}'])
def test_a_stamp_that_cannot_be_read_is_none(made, text):
    made.stamp.write_text(text)
    assert prepare.stamped_level(made) is None


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
    prepare.write_stamp(made, "course")
    (made.root / name).write_text("another version\n")
    assert not prepare.is_satisfied(made, "course")


def test_an_environment_for_tests_serves_learners_too(made):
    prepare.write_stamp(made, "test")
    made.lock("course").write_text("learners' lock alone says little here\n")
    assert prepare.is_satisfied(made, "course")
    assert prepare.is_satisfied(made, "test")


# A first message.


def answer(layout, monkeypatch, code, text):
    monkeypatch.setattr(running, "quiet", lambda command, env, timeout: running.Result(code, text))
    return prepare.ask_ros(layout, {})


@pytest.mark.parametrize(
    ("code", "text"),
    [
        (1, "Traceback\nImportError: librcl.so"),
        (124, "It did not end within 60 s."),
        (0, ""),
        (0, "3"),
    ],
)
def test_a_ros_that_does_not_start(layout, monkeypatch, code, text):
    with pytest.raises(Problem, match="does not start") as caught:
        answer(layout, monkeypatch, code, text)
    assert caught.value.details == text


def test_a_wrong_middleware_is_named(layout, monkeypatch):
    with pytest.raises(Problem) as caught:
        answer(layout, monkeypatch, 102, "")
    assert "RMW_IMPLEMENTATION" in caught.value.cure


def test_a_message_that_never_comes(layout, monkeypatch):
    with pytest.raises(Problem, match="hears nothing"):
        answer(layout, monkeypatch, 0, '{"milliseconds": null}')

"""`.venv`: what must hold before, how it is made and kept, its stamp, and a first ROS message."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from contextlib import nullcontext
from dataclasses import replace
from types import SimpleNamespace

import pytest

from course_tool import installing, prepare, running
from course_tool.layout import Layout
from course_tool.problems import Problem


@pytest.fixture
def work(made, monkeypatch):
    """What preparing does, as a list of words, without doing it."""
    done = []
    monkeypatch.setattr(prepare, "check_space", lambda folder, needed: done.append("check"))
    monkeypatch.setattr(prepare, "make", lambda layout, environ: done.append("venv"))
    monkeypatch.setattr(installing, "fill", lambda layout, level, environ: done.append(level))

    def ask_ros(layout, environ):
        done.append("listen")
        return {"milliseconds": 200.0, "rclpy": "7.1.6"}

    monkeypatch.setattr(prepare, "ask_ros", ask_ros)
    return done


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
    assert work == ["check", "test", "listen"]


def test_what_another_command_has_just_done_is_not_done_again(made, work, monkeypatch):
    def meanwhile(folder):
        prepare.write_stamp(made, "course")
        return nullcontext()

    monkeypatch.setattr(prepare, "exclusive", meanwhile)
    prepare.ready(made, "course")
    assert work == ["check"]


@pytest.mark.parametrize("was_complete", [True, False])
def test_an_interruption_is_made_good_next_time(made, work, monkeypatch, was_complete):
    """Whoever is offline keeps an environment that works; one that never did is made again."""
    if was_complete:
        prepare.write_stamp(made, "course")
        made.lock("course").write_text("newer\n")

    def stop(layout, level, environ):
        raise KeyboardInterrupt

    fill = installing.fill
    monkeypatch.setattr(installing, "fill", stop)
    with pytest.raises(KeyboardInterrupt):
        prepare.ready(made, "course")
    monkeypatch.setattr(installing, "fill", fill)
    assert prepare.is_usable(made) == was_complete
    assert not prepare.is_satisfied(made, "course")
    del work[:]
    prepare.ready(made, "course")
    assert work == ["check", *(["venv"] if not was_complete else []), "course", "listen"]


def test_the_first_time_is_announced(made, work, capsys):
    prepare.ready(made, "course")
    assert "Preparing .venv" in capsys.readouterr().out
    made.lock("course").write_text("newer\n")
    prepare.ready(made, "course")
    assert "Something changed" in capsys.readouterr().out


def test_another_distribution_has_an_environment_of_its_own(made, work, capsys):
    prepare.ready(made, "test")
    del work[:]
    kilted = replace(made, ros="kilted")
    kilted.python.parent.mkdir(parents=True)
    kilted.python.symlink_to(made.python)
    environ = prepare.ready(kilted, "kilted")
    assert environ["VIRTUAL_ENV"] == str(made.root / ".venv-kilted")
    assert work == ["check", "venv", "kilted", "listen"]
    assert "Preparing .venv-kilted" in capsys.readouterr().out
    made.lock("kilted").write_text("newer\n")
    assert not prepare.is_satisfied(kilted, "kilted")
    assert prepare.is_satisfied(made, "test")


# What must hold before.

HERE = "{}.{}".format(*sys.version_info[:2])


@pytest.mark.parametrize("missing", ["venv", "ensurepip"])
def test_an_incomplete_python_gets_the_right_apt_line(layout, monkeypatch, missing):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == missing else find(name)
    )
    with pytest.raises(Problem) as caught:
        prepare.make(layout, os.environ)
    assert f"sudo apt install python{HERE}-venv" in caught.value.cure


def test_a_full_disk_is_said_before_it_is_filled(monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: SimpleNamespace(free=400_000_000))
    with pytest.raises(Problem) as caught:
        prepare.check_space(tmp_path, prepare.FIRST_TIME)
    assert "0.4 GB free, 1.5 needed" in caught.value.happened


@pytest.mark.parametrize("place", ["checkout", "ROSBEAT_MY_COURSE", "ROSBEAT_WORKSPACE_IN"])
@pytest.mark.parametrize("name", ["a:b", "dol$lar", "back`tick", 'quo"te'])
def test_a_path_in_which_colcon_cannot_build_is_refused_before_anything_is_made(
    made, work, monkeypatch, tmp_path, place, name
):
    layout = Layout(tmp_path / name) if place == "checkout" else made
    if place != "checkout":
        monkeypatch.setenv(place, str(tmp_path / name))
    with pytest.raises(Problem, match=re.escape(f"in the path {tmp_path / name}")) as caught:
        prepare.ready(layout, "course")
    assert caught.value.means.endswith("Nothing was installed or changed.")
    assert "Rename the folder" in caught.value.cure
    assert work == []
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize("name", ["my ws", "größe 工作", "quo'te", "per%cent", "ha#sh", "a=b,c"])
def test_other_paths_are_fine(tmp_path, name):
    prepare.check_place(tmp_path / name)


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


@pytest.mark.parametrize("code", [0, 1])
def test_a_new_one_takes_the_place_of_the_old(layout, monkeypatch, code):
    ran = []

    def run(command, env, check):
        ran.append(command)
        return subprocess.CompletedProcess(command, code)

    monkeypatch.setattr(prepare.subprocess, "run", run)
    with nullcontext() if code == 0 else pytest.raises(Problem, match=r"made no \.venv"):
        prepare.make(layout, os.environ)
    assert ran == [[sys.executable, "-I", "-m", "venv", "--clear", str(layout.venv)]]


@pytest.mark.parametrize(
    "harm",
    [
        lambda layout, monkeypatch: layout.stamp.unlink(),
        lambda layout, monkeypatch: layout.stamp.write_text("{"),
        lambda layout, monkeypatch: layout.python.unlink(),
        lambda layout, monkeypatch: monkeypatch.setattr(sys, "version_info", (3, 9, 0)),
        lambda layout, monkeypatch: monkeypatch.setattr(sys, "base_prefix", "/elsewhere"),
    ],
    ids=["no stamp", "torn stamp", "no python", "other version", "other place of Python"],
)
def test_one_that_cannot_be_used(made, monkeypatch, harm):
    prepare.write_stamp(made, "course")
    assert prepare.is_usable(made)
    harm(made, monkeypatch)
    assert not prepare.is_usable(made)
    assert not prepare.is_satisfied(made, "course")


def test_a_moved_one_cannot_be_used(made, tmp_path):
    prepare.write_stamp(made, "course")
    there = Layout(tmp_path / "elsewhere")
    shutil.move(made.root, there.root)
    assert not prepare.is_usable(there)


# The stamp.


@pytest.mark.parametrize(
    "name",
    [
        "environment/course.lock",
        "environment/build.lock",
        "environment/bootstrap.lock",
        "pyproject.toml",
        "src/ros2_command/pyproject.toml",
        "src/rosie/pyproject.toml",
    ],
)
def test_whatever_it_was_made_from_makes_it_stale(made, name):
    prepare.write_stamp(made, "course")
    (made.root / name).write_text("another version\n")
    assert not prepare.is_satisfied(made, "course")


def test_what_jupyterlab_and_the_kernel_begin_with_makes_it_stale(made, tmp_path, monkeypatch):
    prepare.write_stamp(made, "course")
    assert prepare.is_satisfied(made, "course")
    shutil.copytree(installing._LAB_FILES, tmp_path / "lab_files")
    monkeypatch.setattr(installing, "_LAB_FILES", tmp_path / "lab_files")
    assert prepare.is_satisfied(made, "course")
    (tmp_path / "lab_files" / installing.KERNEL_CONFIG).write_text("{}")
    assert not prepare.is_satisfied(made, "course")


def test_an_environment_for_tests_serves_learners_too(made):
    prepare.write_stamp(made, "test")
    made.lock("course").write_text("learners' lock alone says little here\n")
    assert prepare.is_satisfied(made, "course")
    assert prepare.is_satisfied(made, "test")


# A first message.


def answer(layout, monkeypatch, ok, text):
    monkeypatch.setattr(running, "quiet", lambda command, env, timeout: running.Result(ok, text))
    return prepare.ask_ros(layout, {})


def test_a_ros_that_does_not_start(layout, monkeypatch):
    with pytest.raises(Problem, match="does not start") as caught:
        answer(layout, monkeypatch, False, "Traceback\nImportError: librcl.so")
    assert caught.value.details == "Traceback\nImportError: librcl.so"


def test_a_message_that_never_comes(layout, monkeypatch):
    with pytest.raises(Problem, match="hears nothing"):
        answer(layout, monkeypatch, True, '{"milliseconds": null}')

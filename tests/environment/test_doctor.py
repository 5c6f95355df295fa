"""`course doctor`: what it finds in checkouts, on machines and in what ROS says of itself."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from course_tool import doctor, prepare
from course_tool.layout import WORKSPACE, Layout
from course_tool.problems import Problem
from course_tool.running import Environment
from rosbeat.workspace import location

CLEAN = Environment({"PATH": "/usr/bin:/bin"}, (), ())
PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
SEEN = {
    "ROS_DOMAIN_ID": "12",
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    PROFILE: __file__,
}
FACTS = {
    "rclpy": "7.1.6",
    "rclpy_file": "/c/.venv/lib/python3.11/site-packages/rclpy/__init__.py",
    "rmw": "rmw_fastrtps_cpp",
    "environ": SEEN,
    "milliseconds": 210.4,
}
OTHER_ROS = Environment({}, ("/opt/ros/humble",), ())
WSL_2 = "5.15.167.4-microsoft-standard-WSL2"


def program(path, body):
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)


def by_subject(findings):
    return {finding.subject: finding for finding in findings}


def test_before_anything_is_installed(layout, capsys, monkeypatch):
    monkeypatch.chdir(layout.root)
    assert doctor.doctor(layout, []) == 1
    out = capsys.readouterr().out
    assert "problem  .venv              is not there yet\n" in out
    assert "-> ./environment/course lab  makes it\n" in out
    assert "One thing needs a cure" in out
    assert not layout.venv.exists()


def test_a_finished_environment(made, monkeypatch, capsys):
    prepare.write_stamp(made, "test")
    monkeypatch.setattr(prepare, "ask_ros", lambda layout, environ: FACTS)
    for name in ("ros2", "colcon", "rosbeat"):
        program(made.venv / "bin" / name, "exit 0")
    assert doctor.doctor(made, []) == 1  # rclpy of these facts is elsewhere
    out = capsys.readouterr().out
    assert f"ok       .venv              {made.venv} is what environment/test.lock lists\n" in out
    assert "problem  rclpy              comes from /c/.venv/lib" in out
    monkeypatch.setattr(doctor, "judge", lambda *given: [])
    assert doctor.doctor(made, []) == 0
    program(made.venv / "bin" / "colcon", "echo no such module; exit 1")
    assert doctor.doctor(made, []) == 1
    out = capsys.readouterr().out
    assert "problem  colcon             does not start (no such module)" in out


def test_an_environment_that_cannot_be_used_as_it_is(made, tmp_path):
    assert "makes it again" in doctor.venv(made).cure
    prepare.write_stamp(made, "course")
    made.lock("course").write_text("newer\n")
    assert "refreshes it" in doctor.venv(made).cure
    moved = Layout(tmp_path / "elsewhere")
    shutil.move(made.root, moved.root)
    assert "made in another place" in doctor.venv(moved).text


def domain(environ):
    return by_subject(doctor.judge(FACTS, environ, "/c/.venv"))["domain id"]


@pytest.mark.parametrize(
    ("finding", "state", "words"),
    [
        (doctor.disk(2 * 10**9, installed=False), "ok", "2.0 GB free"),
        (doctor.disk(10**9, installed=False), "problem", "1.5 GB are needed"),
        (doctor.disk(10**9, installed=True), "ok", ""),
        (doctor.another_ros(OTHER_ROS), "note", "/opt/ros/humble"),
        (domain({}), "ok", "the course's choice"),
        (domain({"ROS_DOMAIN_ID": "12"}), "ok", "ROS_DOMAIN_ID in your environment"),
        (domain({"ROS_DOMAIN_ID": "12", "ROSBEAT_DOMAIN_ID": "12"}), "ok", "the course's choice"),
        (doctor.wsl(WSL_2, Path("/home/ada"))[-1], "ok", "version 2"),
        (
            doctor.wsl(WSL_2, Path("/mnt/c/Ada L/course"))[-1],
            "note",
            "cp -r '/mnt/c/Ada L/course' ~",
        ),
        (doctor.wsl("4.4.0-22621-Microsoft", Path("/home"))[-1], "problem", "--set-version"),
    ],
)
def test_what_is_said_of_a_machine(finding, state, words):
    assert finding.state == state
    assert words in str(finding)
    assert bool(finding.cure) == (state == "problem") or state == "note"


def test_another_machine_is_no_wsl():
    assert doctor.wsl("6.8.0-45-generic", Path("/mnt/c/course")) == []


def test_shared_memory(tmp_path, monkeypatch):
    assert doctor.shared_memory(tmp_path).state == "ok"
    assert doctor.shared_memory(tmp_path / "gone").state == "problem"
    monkeypatch.setattr(doctor, "_ENOUGH_SHARED_MEMORY", 10**18)
    assert "fastrtps_*" in doctor.shared_memory(tmp_path).cure


@pytest.mark.parametrize(
    ("facts", "subject", "state"),
    [
        ({"rclpy_file": "/opt/ros/jazzy/rclpy/__init__.py"}, "rclpy", "problem"),
        ({"environ": {}}, "domain id", "problem"),
        ({"environ": {}}, "discovery range", "note"),
        ({"environ": {}}, "discovery profile", "note"),
        ({"environ": SEEN | {PROFILE: "/nowhere.xml"}}, "discovery profile", "problem"),
    ],
)
def test_what_ros_says_of_itself(facts, subject, state):
    usual = by_subject(doctor.judge(FACTS, {}, "/c/.venv"))
    assert {one.state for one in usual.values()} == {"ok"}
    assert by_subject(doctor.judge({**FACTS, **facts}, {}, "/c/.venv"))[subject].state == state


def test_a_ros_that_cannot_be_asked(made, monkeypatch):
    def ask_ros(layout, environ):
        raise Problem("A subscriber hears nothing.", "", "Look.\nAgain.", "last\nwords")

    monkeypatch.setattr(prepare, "ask_ros", ask_ros)
    (found,) = doctor.ros(made, CLEAN, {})
    assert (found.state, found.text) == ("problem", "A subscriber hears nothing. (words)")


def git(layout, *arguments):
    own = ["-c", "user.name=ada", "-c", "user.email=ada@example.org", "-C", str(layout.root)]
    subprocess.run(["git", *own, *arguments], check=True, capture_output=True)


@pytest.fixture
def whole(made):
    """A course of two files besides its locks, in git."""
    assert doctor.course_files(made, os.environ).state == "note"  # nobody knows what it was
    for name in ("src/rosbeat.py", "notebooks/00_hear.ipynb"):
        path = made.root / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("as shipped")
    git(made, "init", "--quiet")
    git(made, "add", "--all", "src", "notebooks", "environment")
    git(made, "commit", "--quiet", "--message", "All of it")
    assert doctor.course_files(made, os.environ).state == "ok"
    return made


def test_missing_files_come_back_and_nothing_else_changes(whole):
    page = whole.root / "notebooks" / "00_hear.ipynb"
    page.write_text("mine")
    shutil.rmtree(whole.environment)
    found = doctor.course_files(whole, os.environ)
    assert (found.state, found.text) == (
        "problem",
        "missing: environment/bootstrap.lock, environment/build.lock, environment/course.lock "
        "and 2 more",
    )
    subprocess.run(["bash", "-c", found.cure], check=True, capture_output=True)
    found = doctor.course_files(whole, os.environ)
    assert (found.state, found.text) == ("note", "changed: notebooks/00_hear.ipynb")
    assert found.cure.startswith("copy what is yours")
    assert page.read_text() == "mine"


def test_in_a_release_the_pages_are_the_learners_to_change_and_to_remove(whole):
    (whole.root / ".rosbeat-release.json").touch()
    page = whole.root / "notebooks" / "00_hear.ipynb"
    page.write_text("mine")
    assert doctor.course_files(whole, os.environ).state == "ok"
    page.unlink()
    assert doctor.course_files(whole, os.environ).state == "ok"


def test_the_learners_pages(layout):
    assert doctor.pages(layout).state == "note"
    layout.notes.mkdir(parents=True)
    layout.shipped.mkdir()
    for path in (layout.shipped / "03_write.ipynb", layout.learner / "03_write.ipynb"):
        path.touch()
    (layout.learner / "03_write-kept-1.ipynb").touch()
    assert doctor.pages(layout).text == f"1 in {layout.learner}"


def test_where_the_workspace_lies(layout, tmp_path):
    found = doctor.workspace(layout, {})
    assert found.text == f"{layout.learner}/{WORKSPACE} (page 01 makes it)"
    (tmp_path / WORKSPACE).mkdir()
    found = doctor.workspace(layout, {location.SETTING: str(tmp_path)})
    assert found.text == f"{tmp_path}/{location.NAME}, by ROSBEAT_WORKSPACE_IN"
    found = doctor.workspace(layout, {location.SETTING: str(tmp_path / "not there")})
    assert found.state == "problem"


def test_which_sandbox_works_or_why_none_does(made):
    bwrap = made.venv / "bin" / "bwrap"
    program(bwrap, "echo bubblewrap 0.8.0")
    program(made.venv / "bin" / "python", f"echo {bwrap}")
    works = doctor.sandbox(made, CLEAN.environ)
    assert works.state == "ok"
    assert f"bubblewrap 0.8.0, {bwrap}" in works.text
    program(made.venv / "bin" / "python", "printf 'It is not installed.\\nInstall it.\\n'; exit 1")
    none = doctor.sandbox(made, CLEAN.environ)
    assert (none.state, none.cure) == ("note", "Install it.")
    assert "It is not installed." in none.text

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

from course_tool import doctor, prepare
from course_tool.doctor import Finding
from course_tool.layout import WORKSPACE, Layout
from course_tool.problems import Problem
from course_tool.surroundings import Surroundings
from rosbeat.workspace import place

CLEAN = Surroundings({"PATH": "/usr/bin:/bin"}, (), ())
FACTS = {
    "rclpy": "7.1.6",
    "rclpy_file": "/c/.venv/lib/python3.11/site-packages/rclpy/__init__.py",
    "rmw": "rmw_fastrtps_cpp",
    "environ": {
        "ROS_DOMAIN_ID": "12",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "FASTRTPS_DEFAULT_PROFILES_FILE": __file__,
    },
    "field_checks": True,
    "milliseconds": 210.4,
}


def program(path, body):
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)


def by_subject(findings):
    return {finding.subject: finding for finding in findings}


@pytest.mark.parametrize(
    ("findings", "code"),
    [
        ([Finding("ok", "a", "b"), Finding("note", "c", "d")], 0),
        ([Finding("problem", "a", "b", "c")], 1),
    ],
)
def test_the_exit_code_says_whether_something_needs_a_cure(layout, monkeypatch, findings, code):
    monkeypatch.setattr(doctor, "look", lambda layout, clean: findings)
    assert doctor.doctor(layout, []) == code


def test_before_anything_is_installed(layout, monkeypatch, capsys):
    assert doctor.doctor(layout, []) == 1
    out = capsys.readouterr().out
    assert "is not there yet" in out
    assert "./environment/course lab  makes it" in out
    assert not layout.venv.exists()


def test_a_finished_environment(made):
    prepare.write_stamp(made, "test")
    assert doctor.venv(made, CLEAN).state == "ok"
    assert doctor.versions(made) == Finding(
        "ok", "versions", ".venv is what environment/test.lock lists"
    )


def test_a_half_made_environment(made):
    assert doctor.venv(made, CLEAN).state == "problem"
    assert "completes it" in doctor.versions(made).cure


def test_an_environment_that_the_course_has_left_behind(made):
    prepare.write_stamp(made, "course")
    made.lock("course").write_text("newer\n")
    assert "refreshes it" in doctor.versions(made).cure


DOMAIN = {"ROS_DOMAIN_ID": "12"}
OTHER_ROS = Surroundings({}, ("/opt/ros/humble",), ())
WSL_2 = "5.15.167.4-microsoft-standard-WSL2"


def judged(environ):
    return by_subject(doctor.judge(FACTS, environ, "/c/.venv"))["domain id"]


@pytest.mark.parametrize(
    ("finding", "state", "words"),
    [
        (doctor.disk(2 * 10**9, installed=False), "ok", "2.0 GB free"),
        (doctor.disk(10**9, installed=False), "problem", "1.5 GB are needed"),
        (doctor.disk(10**9, installed=True), "ok", ""),
        (doctor.clock(0.0), "problem", "1970-01-01"),
        (doctor.clock(1.8e9), "ok", ""),
        (doctor.another_ros(OTHER_ROS), "note", "/opt/ros/humble"),
        (doctor.sandbox(False), "note", ""),
        (doctor.sandbox(True), "ok", ""),
        (doctor.place(Layout(Path("/home/my courses/one"))), "note", "ros2 run"),
        (doctor.place(Layout(Path("/home/ada/course"))), "ok", ""),
        (judged({}), "ok", "the course's choice"),
        (judged(DOMAIN), "ok", "ROS_DOMAIN_ID in your environment"),
        (judged({**DOMAIN, "ROSBEAT_DOMAIN_ID": "12"}), "ok", "the course's choice"),
        (doctor.wsl(WSL_2, Path("/home/ada"))[-1], "ok", "version 2"),
        (
            doctor.wsl(WSL_2, Path("/mnt/c/Ada L/course"))[-1],
            "note",
            "cp -r '/mnt/c/Ada L/course' ~",
        ),
        (doctor.wsl("4.4.0-22621-Microsoft", Path("/home"))[-1], "problem", "--set-version"),
    ],
)
def test_one_look_at_the_machine(finding, state, words):
    assert finding.state == state
    first, *cure = str(finding).splitlines()
    assert words in f"{first} {cure}"
    assert bool(cure) == bool(finding.cure)


def test_elsewhere_wsl_is_not_mentioned():
    assert doctor.wsl("6.8.0-45-generic", Path("/mnt/c/course")) == []


def test_shared_memory(tmp_path, monkeypatch):
    assert doctor.shared_memory(tmp_path).state == "ok"
    assert doctor.shared_memory(tmp_path / "gone").state == "problem"
    monkeypatch.setattr(doctor, "_ENOUGH_SHARED_MEMORY", 10**18)
    assert "fastrtps_*" in doctor.shared_memory(tmp_path).cure


@pytest.mark.parametrize(
    ("argv", "state"),
    [
        *((["python"], "ok"), (["{venv}/bin/python"], "ok"), (["/usr/bin/python3"], "problem")),
        ([], "problem"),
    ],
)
def test_kernels(made, argv, state):
    spec = made.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    spec.parent.mkdir(parents=True)
    spec.write_text(json.dumps({"argv": [part.format(venv=made.venv) for part in argv]}))
    assert doctor.kernel(made).state == state


@pytest.mark.parametrize(
    ("change", "environ", "subject", "state"),
    [
        ({}, {}, "middleware", "ok"),
        ({"rclpy_file": "/opt/ros/jazzy/rclpy/__init__.py"}, {}, "rclpy", "problem"),
        ({"environ": {}}, {}, "domain id", "problem"),
        ({"environ": {}}, {}, "discovery range", "note"),
        ({"field_checks": False}, {}, "field checks", "problem"),
        ({"field_checks": False}, {"ROS_PYTHON_CHECK_FIELDS": "0"}, "field checks", "note"),
    ],
)
def test_what_is_not_as_it_should_be(change, environ, subject, state):
    findings = by_subject(doctor.judge({**FACTS, **change}, environ, "/c/.venv"))
    assert findings[subject].state == state
    others = {one.state for one in findings.values() if change or one.subject != subject}
    assert change or others == {"ok"}


def test_a_ros_that_cannot_be_asked(made, monkeypatch):
    def ask_ros(layout, environ):
        raise Problem("A subscriber hears nothing.", "", "Look.\nAgain.", "last\nwords")

    monkeypatch.setattr(prepare, "ask_ros", ask_ros)
    (found,) = doctor.ros(made, CLEAN, {})
    assert (found.state, found.text) == ("problem", "A subscriber hears nothing. (words)")


def test_without_an_environment_nothing_in_it_is_judged(layout):
    found = by_subject(doctor.look(layout, CLEAN))
    assert "makes it" in found[".venv"].cure
    assert not {"versions", "Jupyter kernel", "rclpy", "ros2", "underlay"} & set(found)


def test_a_moved_checkout_is_told_once(made, tmp_path):
    prepare.write_stamp(made, "course")
    moved = Layout(tmp_path / "elsewhere")
    shutil.move(made.root, moved.root)
    lines = [str(finding) for finding in doctor.look(moved, CLEAN)]
    assert sum("was made in another place" in line for line in lines) == 1
    assert not any(str(made.root) in line for line in lines)


PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"


@pytest.mark.parametrize(
    ("seen", "environ", "state", "words"),
    [
        ({}, {}, "note", "3 s"),
        ({PROFILE: __file__}, {}, "ok", "the course's"),
        ({PROFILE: __file__}, {PROFILE: __file__}, "note", "your environment"),
        ({PROFILE: "/nowhere.xml"}, {PROFILE: "/nowhere.xml"}, "problem", "no file"),
        ({"FASTDDS_DEFAULT_PROFILES_FILE": "/nowhere.xml"}, {}, "problem", "no file"),
    ],
)
def test_the_discovery_profile(seen, environ, state, words):
    found = doctor.profile(seen, environ)
    assert found.state == state
    assert words in found.text


def test_commands_that_start_and_that_do_not(made):
    program(made.venv / "bin" / "ros2", "exit 0")
    program(made.venv / "bin" / "colcon", "echo no such module; exit 1")
    assert doctor.command(made, "ros2", {}).state == "ok"
    found = doctor.command(made, "colcon", {})
    assert found.state == "problem"
    assert "no such module" in found.text


@pytest.mark.parametrize(
    ("text", "state"),
    [
        ("AMENT_PREFIX_PATH='/other:VENV'\n", "ok"),
        *((text, "problem") for text in (None, "return 1\n", "AMENT_PREFIX_PATH=/other\n")),
    ],
)
def test_an_underlay(made, text, state):
    if text is not None:
        (made.venv / "setup.bash").write_text(text.replace("VENV", str(made.venv)))
    found = doctor.underlay(made, CLEAN)
    assert found.state == state
    assert ("repairs .venv" in found.cure) == (state == "problem")


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


def test_a_file_that_is_missing_and_how_it_comes_back(whole):
    (whole.root / "src" / "rosbeat.py").unlink()
    found = doctor.course_files(whole, os.environ)
    assert (found.state, found.text) == ("problem", "missing: src/rosbeat.py")
    assert found.cure.endswith("git checkout HEAD -- src/rosbeat.py")


def test_a_removed_folder_comes_back_and_nothing_else_changes(whole):
    (whole.root / "notebooks" / "00_hear.ipynb").write_text("mine")
    shutil.rmtree(whole.environment)
    found = doctor.course_files(whole, os.environ)
    assert found.text == (
        "missing: environment/bootstrap.lock, environment/build.lock, environment/course.lock "
        "and 1 more"
    )
    subprocess.run(["bash", "-c", found.cure.partition(": ")[2]], cwd=whole.root, check=True)
    assert doctor.course_files(whole, os.environ).text == "changed: notebooks/00_hear.ipynb"
    assert (whole.root / "notebooks" / "00_hear.ipynb").read_text() == "mine"


def test_a_changed_file_harms_nothing(whole):
    (whole.root / "notebooks" / "00_hear.ipynb").write_text("mine")
    found = doctor.course_files(whole, os.environ)
    assert (found.state, found.text) == ("note", "changed: notebooks/00_hear.ipynb")
    assert found.cure.startswith("copy what is yours")
    assert found.cure.endswith(" notebooks/00_hear.ipynb")


def test_in_a_release_the_pages_are_the_learners_to_change_and_to_remove(whole):
    (whole.root / ".rosbeat-release.json").touch()
    page = whole.root / "notebooks" / "00_hear.ipynb"
    page.write_text("mine")
    assert doctor.course_files(whole, os.environ).state == "ok"
    page.unlink()
    assert doctor.course_files(whole, os.environ).state == "ok"
    (whole.root / "src" / "rosbeat.py").unlink()
    assert doctor.course_files(whole, os.environ).text == "missing: src/rosbeat.py"


def test_the_learners_pages(layout):
    assert doctor.pages(layout).state == "note"
    layout.notes.mkdir(parents=True)
    layout.shipped.mkdir()
    (layout.shipped / "03_write.ipynb").touch()
    (layout.learner / "03_write.ipynb").touch()
    (layout.learner / "03_write-kept-1.ipynb").touch()
    assert doctor.pages(layout).text == f"1 in {layout.learner}"


def test_where_the_workspace_lies(layout, tmp_path):
    found = doctor.workspace(layout, {})
    assert found.text == f"{layout.root}/ROS2_and_RL_Tutorials (page 01 makes it)"
    (tmp_path / "ROS2_and_RL_Tutorials").mkdir()
    found = doctor.workspace(layout, {"ROSBEAT_WORKSPACE_IN": str(tmp_path)})
    assert found.text == f"{tmp_path}/ROS2_and_RL_Tutorials, by ROSBEAT_WORKSPACE_IN"


def test_a_workspace_that_cannot_be(layout, tmp_path):
    found = doctor.workspace(layout, {"ROSBEAT_WORKSPACE_IN": str(tmp_path / "not there")})
    assert (found.state, found.cure) == ("problem", f"mkdir -p '{tmp_path / 'not there'}'")


def test_the_name_of_the_workspace_is_the_packages():
    assert WORKSPACE == place.NAME
    assert doctor.SETTING == place.SETTING


def test_a_middleware_that_was_replaced_is_told(made, monkeypatch):
    monkeypatch.setattr(prepare, "ask_ros", lambda layout, environ: FACTS)
    clean = Surroundings({}, (), ("RMW_IMPLEMENTATION=x is not part of this ROS",))
    *_, found = doctor.ros(made, clean, {})
    assert (found.state, found.subject, found.text) == ("note", "middleware", clean.notes[0])

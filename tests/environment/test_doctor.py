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


def test_a_finding_is_a_line_and_a_cure_another():
    assert str(Finding("ok", "clock", "now")) == "ok       clock              now"
    assert (
        str(Finding("problem", "disk", "full", "empty it")).splitlines()[1].endswith("-> empty it")
    )


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


def test_disk():
    assert doctor.disk(2 * 10**9, installed=False).state == "ok"
    assert doctor.disk(10**9, installed=False).state == "problem"
    assert doctor.disk(10**9, installed=True).state == "ok"


def test_shared_memory(tmp_path, monkeypatch):
    assert doctor.shared_memory(tmp_path).state == "ok"
    assert doctor.shared_memory(tmp_path / "gone").state == "problem"
    monkeypatch.setattr(doctor, "_ENOUGH_SHARED_MEMORY", 10**18)
    assert "fastrtps_*" in doctor.shared_memory(tmp_path).cure


def test_a_clock_that_fell_back():
    assert doctor.clock(0.0).state == "problem"
    assert doctor.clock(1.8e9).state == "ok"


@pytest.mark.parametrize(
    ("argv", "state"),
    [(["python"], "ok"), (["{venv}/bin/python"], "ok"), (["/usr/bin/python3"], "problem")],
)
def test_kernels(made, argv, state):
    spec = made.venv / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    spec.parent.mkdir(parents=True)
    spec.write_text(json.dumps({"argv": [part.format(venv=made.venv) for part in argv]}))
    assert doctor.kernel(made).state == state


def test_no_kernel(made):
    assert doctor.kernel(made).state == "problem"


def test_another_ros_is_noted_and_stops_nothing():
    found = doctor.another_ros(Surroundings({}, ("/opt/ros/humble",), ()))
    assert found.state == "note"
    assert "/opt/ros/humble" in found.text


def test_a_sandbox_is_optional():
    assert doctor.sandbox(False).state == "note"
    assert doctor.sandbox(True).state == "ok"


@pytest.mark.parametrize("release", ["6.8.0-45-generic", "24.1.0"])
def test_wsl_is_not_mentioned_elsewhere(release):
    assert doctor.wsl(release, Path("/mnt/c/course")) == []


def test_wsl_2_is_fine_except_on_a_drive_of_windows():
    release = "5.15.167.4-microsoft-standard-WSL2"
    (home,) = doctor.wsl(release, Path("/home/ada/course"))
    assert home.state == "ok"
    ok, slow = doctor.wsl(release, Path("/mnt/c/Users/Ada Lovelace/course"))
    assert (ok.state, slow.state) == ("ok", "note")
    assert slow.cure.endswith("cp -r '/mnt/c/Users/Ada Lovelace/course' ~")


def test_wsl_1_is_to_be_converted(monkeypatch):
    monkeypatch.setenv("WSL_DISTRO_NAME", "Debian")
    (found,) = doctor.wsl("4.4.0-22621-Microsoft", Path("/home/ada/course"))
    assert found.state == "problem"
    assert found.cure.endswith("wsl --set-version Debian 2")


def test_a_ros_that_is_as_it_should_be():
    assert {finding.state for finding in doctor.judge(FACTS, {}, "/c/.venv")} == {"ok"}


def test_who_chose_the_domain():
    ours = by_subject(doctor.judge(FACTS, {}, "/c/.venv"))["domain id"]
    yours = by_subject(doctor.judge(FACTS, {"ROS_DOMAIN_ID": "12"}, "/c/.venv"))["domain id"]
    terminal = {"ROS_DOMAIN_ID": "12", "ROSBEAT_DOMAIN_ID": "12"}
    assert by_subject(doctor.judge(FACTS, terminal, "/c/.venv"))["domain id"] == ours
    assert "the course's choice" in ours.text
    assert "ROS_DOMAIN_ID in your environment" in yours.text


@pytest.mark.parametrize(
    ("change", "environ", "subject", "state"),
    [
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


def test_a_place_with_a_space_is_told(layout):
    assert doctor.place(layout).state == "note"
    assert doctor.place(Layout(Path("/home/ada/course"))).state == "ok"


def test_an_underlay_that_works(made):
    (made.venv / "setup.bash").write_text(f"AMENT_PREFIX_PATH='/other:{made.venv}'\n")
    assert doctor.underlay(made, CLEAN).state == "ok"


@pytest.mark.parametrize("text", [None, "return 1\n", "AMENT_PREFIX_PATH=/other\n"])
def test_an_underlay_that_does_not(made, text):
    if text is not None:
        (made.venv / "setup.bash").write_text(text)
    found = doctor.underlay(made, CLEAN)
    assert found.state == "problem"
    assert "repairs .venv" in found.cure


def git(layout, *arguments):
    own = ["-c", "user.name=ada", "-c", "user.email=ada@example.org", "-C", str(layout.root)]
    subprocess.run(["git", *own, *arguments], check=True, capture_output=True)


@pytest.fixture(params=["git", "no git"])
def whole(request, made):
    """A course of two files besides its locks, as it was when it was installed."""
    for name in ("src/rosbeat.py", "notebooks/00_hear.ipynb"):
        path = made.root / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("as shipped")
    if request.param == "git":
        git(made, "init", "--quiet")
        git(made, "add", "--all", "src", "notebooks", "environment")
        git(made, "commit", "--quiet", "--message", "All of it")
    else:
        prepare.write_stamp(made, "course")
    return made


def test_a_whole_course(whole):
    assert doctor.course_files(whole, os.environ).state == "ok"


def test_a_file_that_is_missing_and_how_it_comes_back(whole):
    (whole.root / "src" / "rosbeat.py").unlink()
    found = doctor.course_files(whole, os.environ)
    assert (found.state, found.text) == ("problem", "missing: src/rosbeat.py")
    way = "git checkout HEAD --" if (whole.root / ".git").exists() else "copy from there:"
    assert found.cure.endswith(f"{way} src/rosbeat.py")


def test_a_removed_folder_comes_back_and_nothing_else_changes(whole):
    (whole.root / "notebooks" / "00_hear.ipynb").write_text("mine")
    shutil.rmtree(whole.environment)
    found = doctor.course_files(whole, os.environ)
    assert found.text == (
        "missing: environment/bootstrap.lock, environment/build.lock, environment/course.lock "
        "and 1 more"
    )
    if (whole.root / ".git").exists():
        line = found.cure.partition(": ")[2]
        subprocess.run(["bash", "-c", line], cwd=whole.root, check=True)
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


def test_a_course_that_nobody_has_installed_and_no_git_knows(made):
    assert doctor.course_files(made, os.environ).state == "note"


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
    found = doctor.workspace(layout, {"ROSBEAT_WORKSPACE_IN": str(tmp_path / "gone")})
    assert (found.state, found.cure) == ("problem", f"mkdir -p {tmp_path / 'gone'}")


def test_a_command_to_type_is_quoted(layout, tmp_path):
    found = doctor.workspace(layout, {"ROSBEAT_WORKSPACE_IN": str(tmp_path / "not there")})
    assert found.cure == f"mkdir -p '{tmp_path / 'not there'}'"


def test_the_name_of_the_workspace_is_the_packages():
    assert WORKSPACE == place.NAME
    assert doctor.SETTING == place.SETTING


def test_a_middleware_that_was_replaced_is_told(made, monkeypatch):
    monkeypatch.setattr(prepare, "ask_ros", lambda layout, environ: FACTS)
    clean = Surroundings({}, (), ("RMW_IMPLEMENTATION=x is not part of this ROS",))
    *_, found = doctor.ros(made, clean, {})
    assert (found.state, found.subject, found.text) == ("note", "middleware", clean.notes[0])

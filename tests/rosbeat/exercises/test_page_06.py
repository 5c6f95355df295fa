"""Page 06: what a terminal shows, and how a package is installed."""

import pytest
from rosbeat.exercises.scenarios import TypedIn

from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.page_06 import EXERCISES

monitor_06a, links_06b = EXERCISES
PLACE = "ROS2_and_RL_Tutorials"
RUN = "ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=second_monitor"


def judged(*typed, text=""):
    commands = tuple((PLACE, command) for command in typed)
    shown = "".join(f"{PLACE}$ {command}\n" for command in typed)
    return monitor_06a.judged(TypedIn("", commands, None, shown + text))


@pytest.mark.parametrize(
    "run",
    [
        RUN,
        RUN.replace("-r ", "--remap "),
        RUN + " -r temperature:=/temperature",
        f"source install/setup.bash && {RUN}",
    ],
)
def test_the_second_monitor_hears(run):
    text = "[INFO] [second_monitor]: Temperature: 22.10C - Status:Normal\n"
    assert judged(run, text=text).status == PASSED


def test_nothing_run_is_nothing_tried():
    assert judged("cd x", "source install/setup.bash").status == NOT_ATTEMPTED


@pytest.mark.parametrize(
    ("text", "evidence"),
    [
        ("No executable found", "No node"),
        ("[INFO] [temperature_monitor]: Temperature: 22.00C", "temperature_monitor"),
        ("[INFO] [1732212345.123] [temperature_monitor]: Temperature: 2", "temperature_monitor"),
        ("[INFO] [second_monitor]: Temperature Monitor Node Started", "nothing"),
        ("[INFO] [second_monitor]: Publishing: 22.00C", "nothing"),
    ],
)
def test_what_else_runs_is_named(text, evidence):
    outcome = judged(RUN, text=text)
    assert outcome.status == FAILED
    assert evidence in outcome.evidence
    assert outcome.hint


def test_another_name_is_no_wrong_option():
    run = RUN.replace("second_monitor", "secondmonitor")
    outcome = judged(run, text="[INFO] [secondmonitor]: Temperature: 22.00C\n")
    assert outcome.mistake == "wrong-node-name"
    assert "is secondmonitor, and second_monitor was" in outcome.hint


def test_only_the_last_run_counts():
    right = "[INFO] [second_monitor]: Temperature: 22.10C - Status:Normal\n"
    again = RUN.replace("__node", "_node")
    outcome = judged(RUN, again, text="[INFO] [temperature_monitor]: Temperature: 22.00C\n")
    assert outcome.status == FAILED
    assert judged(again, RUN, text=right).status == PASSED


@pytest.fixture
def workspace(tmp_path):
    package = tmp_path / "src" / "sensor_simulator"
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>sensor_simulator</name></package>")
    (package / "setup.py").write_text("from setuptools import setup\nsetup()\n")
    return tmp_path


def judged_links(workspace):
    return links_06b.judged(links_06b.scenario(workspace))


def install(workspace):
    library = workspace / "install" / "sensor_simulator" / "lib" / "python3.11" / "site-packages"
    library.mkdir(parents=True)
    share = workspace / "install" / "sensor_simulator" / "share" / "sensor_simulator"
    share.mkdir(parents=True)
    (share / "package.xml").write_text("<package/>")
    return library


def test_a_link_passes_and_a_copy_does_not(workspace):
    assert judged_links(workspace).status == NOT_ATTEMPTED
    library = install(workspace)
    copied = judged_links(workspace)
    assert (copied.status, "copy" in copied.evidence) == (NOT_ATTEMPTED, True)
    (library / "sensor-simulator.egg-link").write_text("x")
    assert judged_links(workspace).status == PASSED

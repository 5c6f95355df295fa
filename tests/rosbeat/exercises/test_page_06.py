"""Page 06: what the bank of answers cannot show of terminals."""

import pytest

from rosbeat.exercises.page_06 import EXERCISES
from rosbeat.exercises.scenarios import TypedIn

monitor_06a, links_06b = EXERCISES
PLACE = "ROS2_and_RL_Tutorials"
RUN = "ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=second_monitor"
HEARS = "[INFO] [second_monitor]: Temperature: 22.10C - Status:Normal\n"
FIRST = "[INFO] [temperature_monitor]: Temperature: 22.00C\n"


def judged(*typed, text=""):
    commands = tuple((PLACE, command) for command in typed)
    shown = "".join(f"{PLACE}$ {command}\n" for command in typed)
    return monitor_06a.judged(TypedIn("", commands, None, shown + text))


def test_only_the_last_run_counts():
    again = RUN.replace("__node", "_node")
    assert judged(RUN, again, text=FIRST).status == "failed"
    assert judged(again, RUN, text=HEARS).status == "passed"


@pytest.mark.parametrize(
    ("text", "evidence"),
    [
        ("No executable found", "No node has started"),
        ("[INFO] [1732212345.123] [temperature_monitor]: It is 2", "called temperature_monitor"),
        ("[INFO] [second_monitor]: Temperature Monitor Node Started", "heard nothing"),
    ],
)
def test_what_else_runs_is_named(text, evidence):
    outcome = judged(RUN, text=text)
    assert (outcome.status, evidence in outcome.evidence) == ("failed", True)


@pytest.mark.parametrize(
    ("old", "new", "mistake"),
    [
        ("second_m", "secondm", "wrong-node-name"),
        ("__node:=second_monitor", "__node:=", "wrong-node-name"),
        ("-r __node", "__node", "option-missing"),
        ("--ros-args -r ", "", "option-missing"),
        ("-r __node", "-r _node", "option-misspelled"),
        ("-r __node", "-r monitor:__node", "option-misspelled"),
        ("--ros-args -r __node:=second_monitor", "", "not-renamed"),
        ("--ros-args", "__node:=x --ros-args -p a:=1", "option-misspelled"),
    ],
)
def test_a_command_that_does_not_rename_its_node(old, new, mistake):
    outcome = judged(RUN.replace(old, new), text=FIRST)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)


def test_nothing_built_is_nothing_tried(tmp_path):
    assert links_06b.judged(links_06b.scenario(tmp_path)).status == "not attempted"

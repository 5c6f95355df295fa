"""Page 02: manifests and second packages, right, differently right and wrong."""

import pytest

from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.exercises.page_02 import EXERCISES

manifest_02a, second_02b = EXERCISES
XML = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>{description}</description>
  <maintainer email="a@example.com">a</maintainer>
  <license>{license}</license>
  {depends}
  <export><build_type>{kind}</build_type></export>
</package>
"""
GOOD = {
    "name": "sensor_simulator",
    "description": "A sensor.",
    "license": "MIT",
    "depends": "<depend>rclpy</depend><depend>std_msgs</depend>",
    "kind": "ament_python",
}
SECOND = {
    **GOOD,
    "name": "room_display",
    "depends": "<depend>rclpy</depend><depend>sensor_msgs</depend>",
}


@pytest.fixture
def judge(tmp_path):
    """Write manifests into a workspace, look at it, and judge."""

    def run(exercise, **texts):
        (tmp_path / "src").mkdir(exist_ok=True)
        for place, text in texts.items():
            folder = tmp_path.joinpath(*place.split("__"))
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "package.xml").write_text(text)
            name = folder.name
            for file in ("setup.py", f"resource/{name}", f"{name}/__init__.py"):
                (folder / file).parent.mkdir(exist_ok=True)
                (folder / file).write_text("from setuptools import setup\nsetup()\n")
        return exercise.judged(exercise.scenario(tmp_path))

    return run


def xml(good, **changes):
    return XML.format(**{**good, **changes})


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"license": "Apache-2.0"},
        {"description": "Mesure la température &amp; la publie."},
        {"depends": "<exec_depend>rclpy</exec_depend><depend>std_msgs</depend>"},
        {"depends": "<depend>std_msgs</depend><depend>rclpy</depend><depend>a</depend>"},
    ],
)
def test_a_manifest_that_is_filled_in(judge, changes):
    assert judge(manifest_02a, src__sensor_simulator=xml(GOOD, **changes)).status == PASSED


def test_a_backup_of_the_package_is_not_the_package(judge):
    untouched = xml(GOOD, description="TODO", license="TODO")
    packages = {"src__sensor_simulator": xml(GOOD), "src__sensor_simulator_backup": untouched}
    assert judge(manifest_02a, **packages).status == PASSED


@pytest.mark.parametrize("todo", ["TODO: Package description", "____", ""])
def test_both_open_is_nothing_tried(judge, todo):
    text = xml(GOOD, description=todo, license="TODO: License declaration")
    assert judge(manifest_02a, src__sensor_simulator=text).status == NOT_ATTEMPTED


def test_no_package_is_nothing_tried(judge):
    assert judge(manifest_02a).status == NOT_ATTEMPTED
    assert judge(second_02b).status == NOT_ATTEMPTED


@pytest.mark.parametrize(
    ("text", "evidence"),
    [
        (xml(GOOD, license="TODO: License declaration"), "licence"),
        (xml(GOOD, description="____"), "description"),
        (xml(GOOD, name="sensor"), "sensor"),
        (xml(GOOD, depends="<depend>rclpy</depend>"), "std_msgs"),
        (xml(GOOD, kind=""), "build type"),
        (xml(GOOD, description="a < b"), "cannot be read"),
        (xml(GOOD).replace("</license>", ""), "cannot be read"),
    ],
)
def test_a_wrong_manifest_says_what_is_wrong(judge, text, evidence):
    outcome = judge(manifest_02a, src__sensor_simulator=text)
    assert outcome.status == FAILED
    assert evidence in outcome.evidence
    assert outcome.hint


@pytest.mark.parametrize(
    "changes", [{}, {"description": "TODO"}, {"depends": SECOND["depends"] + "<depend>a</depend>"}]
)
def test_a_second_package(judge, changes):
    assert judge(second_02b, src__room_display=xml(SECOND, **changes)).status == PASSED


@pytest.mark.parametrize(
    ("place", "changes", "evidence"),
    [
        ("room_display", {}, "the workspace itself"),
        ("docs__room_display", {}, "docs"),
        ("src__room_display", {"kind": "ament_cmake"}, "ament_cmake"),
        ("src__room_display", {"depends": ""}, "rclpy and sensor_msgs"),
        ("src__room_display", {"depends": "<depend>rclpy</depend>"}, "sensor_msgs"),
    ],
)
def test_a_wrong_second_package_says_what_is_wrong(judge, place, changes, evidence):
    outcome = judge(second_02b, **{place: xml(SECOND, **changes)})
    assert outcome.status == FAILED
    assert evidence in outcome.evidence
    assert outcome.hint

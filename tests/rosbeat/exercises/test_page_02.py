"""Page 02: what the bank of answers cannot show of manifests and packages."""

import re

import pytest
from catkin_pkg.package import InvalidPackage, parse_package_string

from rosbeat.exercises.page_02 import EXERCISES, PackageMaking
from rosbeat.exercises.scenarios import Workspace
from rosbeat.workspace.packages import read_package
from rosbeat.workspace.prerequisites import finished

manifest_02a, second_02b = EXERCISES
XML = finished("package.xml")


@pytest.fixture
def judged(tmp_path):
    """Write a manifest into a workspace, and judge it."""

    def judge(text, place="sensor_simulator"):
        folder = tmp_path / "src" / place
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "package.xml").write_text(text)
        return manifest_02a.judged(manifest_02a.scenario(tmp_path))

    return judge


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("MIT OR Apache-2.0", ""),
        ("apache-2.0", ""),
        ("mine", "licence mine. spdx"),
        ("MIT</license><license>Apache-2", "licence Apache-2. spdx"),
    ],
)
def test_a_licence_that_programs_do_not_know_gets_a_remark(judged, text, said):
    outcome = judged(XML.replace("Apache-2.0", text))
    assert outcome.status == "passed"
    assert len(outcome.remarks) == bool(said)
    assert said in "".join(outcome.remarks)


@pytest.mark.parametrize(
    "text",
    [
        XML,
        *(re.sub('format=".*?"', f'format="{one}"', XML) for one in ("2", "4", "9", "x")),
        *(XML.replace("0.0.0", one) for one in ("1.2.3", "10.0.1", "1.0", "abc", "", "1.0.0.0")),
        *(XML.replace("you@example.com", one) for one in ("a.b@c.org", "you", "a@b", "a@b.c", "")),
    ],
)
def test_colcon_s_reader_agrees(judged, text):
    try:
        parse_package_string(text)
        accepted = True
    except (InvalidPackage, AssertionError, ValueError):
        accepted = False
    outcome = judged(text)
    assert (outcome.status == "passed") == accepted
    assert accepted or outcome.mistake == "manifest-value"


def test_a_package_by_its_folder_alone(tmp_path):
    (tmp_path / "room_display").mkdir()
    package = read_package(tmp_path / "room_display", tmp_path)
    seen = Workspace((), {"room_display": package})
    assert second_02b.judged(PackageMaking(seen)).status == "failed"

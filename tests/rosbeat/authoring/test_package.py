"""The finished package is derived: from `ros2 pkg create`, from saved cells, and from hand."""

from __future__ import annotations

import pytest

from rosbeat.authoring import package
from rosbeat.authoring.package import package_files, saved_files, stale_files
from rosbeat.errors import LessonError

SAVES = """
    # %% save="src/sensor_simulator/sensor_simulator/node.py"
    print("the first version")

    # %% save="src/sensor_simulator/sensor_simulator/node.py" exercise="00a"
    def main():
        # --- answer
        print("the answer")
        # --- blank
        # ____
        # --- end

    # %% check="00a"
    check("00a")

    # %% save="src/other/file.txt"
    # not of this package
"""
NODE = "sensor_simulator/node.py"


def test_the_last_cell_that_saves_a_file_wins_with_its_answer(checkout):
    saved = saved_files([checkout.lesson(SAVES)])
    assert saved == {NODE: b'def main():\n    print("the answer")\n'}


def test_the_package_begins_with_what_the_command_makes(checkout):
    by_hand = checkout.course.sources / "sensor_simulator" / "test" / "test_it.py"
    by_hand.parent.mkdir(parents=True)
    by_hand.write_text("def test_it():\n    pass\n")
    course = checkout.course
    files = package_files(course, [checkout.lesson(SAVES)])
    home = course.solutions / "sensor_simulator"
    assert b"Apache-2.0" in files[home / "package.xml"]
    assert files[home / "resource/sensor_simulator"] == b""
    assert files[home / "test/test_it.py"] == by_hand.read_bytes()
    assert files[home / NODE] == files[course.root / "src/rosbeat/workspace/finished" / NODE]
    assert home / "test/test_copyright.py" not in files
    assert files == package_files(course, [checkout.lesson(SAVES)])


def test_a_course_that_saves_nothing_has_no_package(checkout):
    assert package_files(checkout.course, [checkout.lesson("# %%\nx = 1")]) == {}


def test_files_that_nothing_makes_any_more_are_found(checkout):
    home = checkout.course.solutions / "sensor_simulator"
    (home / "__pycache__").mkdir(parents=True)
    for name in ("kept.py", "gone.py", "__pycache__/kept.pyc"):
        (home / name).write_text("")
    assert stale_files(checkout.course, [home / "kept.py"]) == [home / "gone.py"]


@pytest.mark.parametrize("executable", ["/nowhere/bin/python", "/bin/python"])
def test_without_the_command_the_builder_says_so(checkout, monkeypatch, executable):
    monkeypatch.setattr(package.sys, "executable", executable)
    with pytest.raises(LessonError, match="ros2 pkg create failed"):
        package_files(checkout.course, [checkout.lesson(SAVES)])

"""The real course as learners get it: it works, and gives nothing away."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rosbeat.exercises.hint import answer_to
from rosbeat.grading.course_pages import course_pages
from rosbeat.grading.release import release
from rosbeat.grading.release_files import FIRST_TO_CATCH_UP, catches_up, readme, release_files
from rosbeat.grading.weights import Points
from small_course import small_course

ROOT = Path(__file__).resolve().parents[3]
#: Lines of an answer that are shorter are everybody's.
LONG = 20


@pytest.fixture(scope="module")
def pages():
    return course_pages(ROOT / "notebooks")


@pytest.fixture(scope="module")
def files(pages):
    return release_files(ROOT, pages)


def numbered(pages, *numbers):
    return [page for page in pages if page.number in numbers]


def answer_lines(pages):
    """Every line of an answer that its page does not give, with its exercise."""
    for page in pages:
        for name in {one.exercise for one in page.wanted}:
            given = "".join(one.blank for one in page.wanted if one.exercise == name)
            for line in answer_to(name).splitlines():
                if len(line.strip()) >= LONG and line.strip() not in given:
                    yield name, line.strip()


def test_no_line_of_an_answer_is_in_it(pages, files):
    texts = {
        name: file.content.decode("utf-8", "replace")
        for name, file in files.items()
        if not name.startswith("notebooks/")  # `rosbeat lint` looks at these: leaked-answer
    }
    lines = list(answer_lines(pages))
    assert len(lines) > 150
    found = {(one, name) for one, line in lines for name in texts if line in texts[name]}
    assert found == {("02a", "src/rosbeat/workspace/finished/package.xml")}


def test_a_release_of_the_first_pages_gives_away_nothing_at_all(pages):
    first = [page for page in pages if page.number < FIRST_TO_CATCH_UP]
    assert not catches_up(first)
    assert not any("/finished/" in name for name in release_files(ROOT, first))


def test_pages_that_begin_where_others_end_are_known(pages):
    """Whoever calls catch_up for more than folders needs the finished package."""
    for page in pages:
        text = (ROOT / "notebooks" / f"{page.lesson}.ipynb").read_text()
        calls = [one[2:4] for one in text.split("workspace.catch_up(")[1:]]
        if any(number > "02" for number in calls):
            assert catches_up([page]), page.lesson


@pytest.mark.parametrize(
    "part",
    ["solutions/", "src/lessons/", "tests/", ".git/", ".venv/", "/solved/", "__pycache__", "kept/"],
)
def test_what_must_not_be_in_it(files, part):
    assert not [name for name in files if part in f"/{name}" or name.startswith(part)]


@pytest.mark.parametrize(
    "name",
    [
        "README.md",
        "LICENSE",
        "pyproject.toml",
        "environment/course",
        "environment/course.lock",
        "environment/course_tool/__main__.py",
        "src/rosbeat/cli.py",
        "src/rosbeat/grading/templates/style.css",
        "src/rosbeat/panel/panel.js",
        "src/ros2_command/pyproject.toml",
        "notebooks/13_build_your_own.ipynb",
    ],
)
def test_what_must_be_in_it(files, name):
    assert files[name].content == (ROOT / name).read_bytes() or name == "README.md"
    assert files[name].is_program == (name == "environment/course")


def test_links_of_the_readme_lead_somewhere(pages, files):
    text = readme(pages, Points())
    links = [part.split(")")[0] for part in text.split("](")[1:]]
    assert len(links) > len(pages)
    assert set(links) <= set(files)


def test_other_points_are_said(pages):
    assert "These points count" not in readme(pages, Points())
    text = readme(pages, Points({"03a": 2.5, "03b": 0.0, "13a": 5.21739}))
    assert "03a: 2.5, 03b: not graded" in text
    assert "13a: 5.22" in text
    assert "These points count" in text


def test_a_small_course_gives_away_nothing(tmp_path):
    root = small_course(tmp_path)
    files = release_files(root, course_pages(root / "notebooks"))
    assert b"SECRET" not in b"".join(file.content for file in files.values())


PROGRAM = """
import json, rosbeat
from rosbeat import check, hint, workspace
from rosbeat.errors import WorkspaceError
from rclpy.node import Node
class Blank(Node):
    def __init__(self):
        super().__init__("humidity_sensor")
        ____
hints = [str(hint("03a")) for _ in range(9)]
made = workspace.catch_up("05")
print(json.dumps([rosbeat.__file__, str(check("03a", Blank)), hints[-1], str(made)]))
"""


@pytest.mark.ros
def test_a_release_works(tmp_path):
    target = tmp_path / "released"
    release(ROOT, target)
    environ = os.environ | {
        "PYTHONPATH": str(target / "src"),
        "ROSBEAT_STEADY_HOME": str(tmp_path / "home"),
    }
    (tmp_path / "home").mkdir()
    command = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(command, env=environ, cwd=tmp_path, capture_output=True, timeout=100)
    assert done.returncode == 0, done.stderr.decode()
    place, checked, last, made = json.loads(done.stdout.decode().splitlines()[-1])
    assert place == str(target / "src/rosbeat/__init__.py")
    assert "not attempted yet" in checked
    assert "This was the last one" in last
    assert "temperature_publisher.py (page 03)" in " ".join(made.split())

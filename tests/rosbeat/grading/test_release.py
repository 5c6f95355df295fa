"""What learners get is made whole, gives nothing away, and an earlier release loses nothing."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from grading_files import DONE, cell, notebook
from grading_files import page as page_text
from rosbeat.errors import GradingError
from rosbeat.exercises.hint import answer_to
from rosbeat.grading import release as module
from rosbeat.grading.release import (
    FIRST_TO_CATCH_UP,
    WORKFLOW,
    catches_up,
    release,
    release_files,
)
from rosbeat.grading.submissions import MARKER
from rosbeat.page_runs.notebook import course_pages
from rosbeat.workspace.prerequisites import NEEDS
from small_course import small_course, tree

ROOT = Path(__file__).resolve().parents[3]
PAGE = "notebooks/03_write.ipynb"
HOME = "notebooks/home.ipynb"


@pytest.fixture
def root(tmp_path):
    return small_course(tmp_path / "course")


@pytest.fixture
def target(tmp_path):
    return tmp_path / "released" / "to learners"


def some(root, *numbers):
    return [page for page in course_pages(root / "notebooks") if page.number in numbers]


def test_a_release_has_what_learners_need(root, target):
    (root / HOME).write_text((ROOT / HOME).read_text())
    target.mkdir(parents=True)
    done = release(root, target)
    found = tree(target)
    assert [page.number for page in done.pages] == ["03", "04", "06"]
    assert set(done.written) == set(found)
    assert {PAGE, HOME, "README.md", "environment/course", "src/rosbeat/__init__.py"} <= set(found)
    assert "SECRET" not in "".join(found.values())
    assert WORKFLOW not in found
    given = json.loads(found[PAGE])["cells"]
    assert given[1:] == json.loads((root / PAGE).read_text())["cells"][1:]
    assert os.access(target / "environment/course", os.X_OK)


def test_what_nobody_has_changed_is_brought_up_to_date(root, target):
    release(root, target)
    (root / "LICENSE").write_text("another\n")
    (root / "src/rosbeat/new.py").write_text("new\n")
    (root / "docs/troubleshooting.md").unlink()
    (target / "pyproject.toml").unlink()
    done = release(root, target)
    assert done.written == ("LICENSE", "pyproject.toml", "src/rosbeat/new.py")
    assert done.removed == ("docs/troubleshooting.md",)
    assert not (target / "docs").exists()


def test_what_somebody_has_changed_stays(root, target):
    release(root, target)
    (target / PAGE).write_text("my answers")
    (target / "my notes.txt").write_text("mine")
    (target / "environment/README.md").write_text("mine")
    (target / "src/rosbeat/new.py").write_text("mine")
    (root / "src/rosbeat/new.py").write_text("new\n")
    (target / "LICENSE").unlink()
    (target / "LICENSE/mine").mkdir(parents=True)
    (target / "docs/troubleshooting.md").unlink()
    (target / "docs").rmdir()
    (target / "docs").write_text("mine")
    (root / PAGE).write_text((root / PAGE).read_text().replace("Page 03", "Page 3"))
    (root / "environment/README.md").unlink()
    done = release(root, target)
    assert done.kept == ("LICENSE", "docs/troubleshooting.md", PAGE, "src/rosbeat/new.py")
    assert done.removed == ()
    assert (target / PAGE).read_text() == "my answers"
    for name in ("my notes.txt", "environment/README.md", "src/rosbeat/new.py", "docs"):
        assert (target / name).read_text() == "mine"


@pytest.mark.parametrize("name", ["LICENSE", "environment/README.md"])
def test_nothing_is_written_through_links(root, target, tmp_path, name):
    release(root, target)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    place = target / name.split("/")[0]
    if place.is_dir():
        place.rename(target / "away")
        place.symlink_to(elsewhere)
    else:
        place.unlink()
        place.symlink_to(elsewhere / "file")
    (root / name).write_text("another\n")
    assert name in release(root, target).kept
    assert list(elsewhere.iterdir()) == []


def test_pages_may_come_one_after_the_other(root, target):
    release(root, target, some(root, "03"))
    assert not (target / "notebooks/04_listen.ipynb").exists()
    assert "[page 04]" not in (target / PAGE).read_text()
    done = release(root, target, some(root, "04"))
    assert [page.number for page in done.pages] == ["03", "04"]
    assert "[page 04](04_listen.ipynb#a)" in (target / PAGE).read_text()


def test_points_come_along_and_stay(root, target, tmp_path):
    points = tmp_path / "mine.csv"
    points.write_text("exercise,points\n03a,7\n04a,0\n")
    release(root, target)
    assert "These points count" not in (target / "README.md").read_text()
    release(root, target, points=points)
    assert (target / "points.csv").read_text() == points.read_text()
    assert "03a: 7 " in (target / "README.md").read_text()
    points.unlink()
    assert release(root, target).written == ()
    text = (target / "README.md").read_text()
    assert "04a: not graded" in text
    assert "These points count" in text


def test_other_folders_and_points_are_refused(root, target, tmp_path, says):
    points = tmp_path / "mine.csv"
    points.write_text("exercise,points\n03a,many\n")
    with pytest.raises(GradingError, match="line 2"):
        release(root, target, points=points)
    assert not target.exists()
    with pytest.raises(GradingError) as caught:
        release(root, Path("/proc/no/such/place"))
    says(caught.value, "/proc/no/such/place cannot be made", "where you may write")
    target.mkdir(parents=True)
    (target / "thesis.txt").write_text("mine")
    file = tmp_path / "file"
    file.write_text("x")
    for place in (target, root, root / "sub", root / "notebooks", tmp_path, file):
        with pytest.raises(GradingError) as caught:
            release(root, place)
        says(caught.value, "nothing was written")
    assert tree(target) == {"thesis.txt": "mine"}


def test_a_marker_leads_to_no_other_place(root, target, tmp_path):
    victim = tmp_path / "victim"
    victim.write_text("")
    release(root, target)
    marker = json.loads((target / MARKER).read_text())
    empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"
    marker["files"] |= {"../../victim": [empty], str(victim): [empty]}
    (target / MARKER).write_text(json.dumps(marker))
    assert release(root, target).removed == ()
    assert victim.exists()


def test_a_release_that_broke_off_goes_on(root, target, monkeypatch):
    calls = []

    def breaks(path, content, write=module.write_whole):
        calls.append(path)
        if len(calls) == 5:
            raise KeyboardInterrupt
        return write(path, content)

    monkeypatch.setattr(module, "write_whole", breaks)
    with pytest.raises(KeyboardInterrupt):
        release(root, target)
    monkeypatch.undo()
    done = release(root, target)
    assert done.kept == ()
    assert 0 < done.same < len(tree(target))
    assert set(done.written) < set(tree(target))


# The workflow.


def test_a_workflow_checks_each_page_in_a_step_of_its_own(root, target):
    assert WORKFLOW in release(root, target, some(root, "03"), github=True).written
    text = (target / WORKFLOW).read_text()
    assert text.count("rosbeat check") == 1
    done = release(root, target, some(root, "04"))
    assert WORKFLOW in done.written
    found = yaml.safe_load((target / WORKFLOW).read_text())
    assert found["permissions"] == {"contents": "read"}
    *_, first, second = found["jobs"]["check"]["steps"]
    assert first["name"] == "03 Page 03"
    assert first["run"] == (
        './environment/course shell -c "rosbeat check notebooks/03_write.ipynb"'
    )
    assert second["run"].endswith('notebooks/04_listen.ipynb"')
    assert "!cancelled()" in second["if"]
    (target / WORKFLOW).write_text("mine")
    assert release(root, target, some(root, "06")).kept == (WORKFLOW,)


# The real course.

#: Lines of an answer that are shorter are everybody's.
LONG = 20


@pytest.fixture(scope="module")
def real_pages():
    return course_pages(ROOT / "notebooks")


@pytest.fixture(scope="module")
def files(real_pages):
    return release_files(ROOT, real_pages)


def answer_lines(pages):
    """Every line of an answer that its page does not give, with its exercise."""
    for page in pages:
        for name in {one.exercise for one in page.wanted}:
            given = "".join(one.blank for one in page.wanted if one.exercise == name)
            for line in answer_to(name).splitlines():
                if len(line.strip()) >= LONG and line.strip() not in given:
                    yield name, line.strip()


def test_no_line_of_an_answer_is_in_it(real_pages, files):
    texts = {
        name: file.content.decode("utf-8", "replace")
        for name, file in files.items()
        if not name.startswith("notebooks/")  # `rosbeat lint` looks at these: leaked-answer
    }
    lines = list(answer_lines(real_pages))
    assert len(lines) > 150
    found = {(one, name) for one, line in lines for name in texts if line in texts[name]}
    # Every package names what it is for, who maintains it, and the packages that it needs.
    manifests = (
        "src/rosbeat/workspace/finished/package.xml",
        *(f"src/rosie/{name}/package.xml" for name in ("rosie", "rosie_interfaces")),
    )
    assert found == {("02a", name) for name in manifests}


#: What must not be in it anywhere, and what must.
NOT_THERE = ("solutions/", "/lessons/", "tests/", ".git/", ".venv/", "/solved/", "__pycache__")
THERE = (
    *("README.md", "LICENSE", "pyproject.toml", "environment/course", "environment/course.lock"),
    *("environment/course_tool/__main__.py", "src/rosbeat/cli.py", "src/rosbeat/panel/panel.js"),
    *("src/rosbeat/grading/templates/style.css", "src/ros2_command/pyproject.toml"),
    "notebooks/13_build_your_own.ipynb",
)


def test_what_must_be_in_it_and_what_must_not(files):
    assert [name for name in files if any(part in f"/{name}" for part in NOT_THERE)] == []
    for name in THERE:
        assert files[name].content == (ROOT / name).read_bytes() or name == "README.md"
        assert files[name].is_program == (name == "environment/course")


def test_only_pages_that_begin_where_others_end_bring_the_finished_package(real_pages):
    first = [page for page in real_pages if page.number < FIRST_TO_CATCH_UP]
    assert not catches_up(first)
    assert not any("/finished/" in name for name in release_files(ROOT, first))
    needing = [page for page in real_pages if NEEDS.get(page.number, "") > "02"]
    assert all(catches_up([page]) for page in needing)


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
    assert "still open" in checked
    assert "This was the last hint" in last
    assert "temperature_publisher.py (page 03)" in " ".join(made.split())


# Pages.


FILLED = page_text(source=DONE)
RUN = cell("1 + 1", id="a") | {"outputs": [{"output_type": "stream"}], "execution_count": 1}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (FILLED, "03_write.ipynb has no blank in exercise 03a"),
        (notebook(RUN), "03_write.ipynb was run"),
    ],
    ids=["filled in", "run"],
)
def test_pages_in_which_somebody_has_worked_are_not_released(root, target, text, said, says):
    (root / PAGE).write_text(text)
    with pytest.raises(GradingError) as caught:
        release(root, target)
    says(caught.value, said, "rosbeat build --no-run")
    assert not target.exists()

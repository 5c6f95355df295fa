"""What learners get is made whole, and an earlier release loses nothing of theirs."""

import json
import os
from pathlib import Path

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading import release as module
from rosbeat.grading.course_pages import course_pages
from rosbeat.grading.release import MARKER, is_inside, release
from small_course import small_course, tree

PAGE = "notebooks/03_write.ipynb"


@pytest.fixture
def root(tmp_path):
    return small_course(tmp_path / "course")


@pytest.fixture
def target(tmp_path):
    return tmp_path / "released" / "to learners"


def some(root, *numbers):
    return [page for page in course_pages(root / "notebooks") if page.number in numbers]


def test_a_release_has_what_learners_need(root, target):
    done = release(root, target)
    found = tree(target)
    assert [page.number for page in done.pages] == ["03", "04", "06"]
    assert set(done.written) == set(found)
    assert {PAGE, "README.md", "environment/course", "src/rosbeat/__init__.py"} <= set(found)
    assert "SECRET" not in "".join(found.values())
    assert os.access(target / "environment/course", os.X_OK)


def test_an_empty_folder_will_do(root, target):
    target.mkdir(parents=True)
    assert release(root, target).written


def test_a_second_time_nothing_is_to_do(root, target):
    first = release(root, target)
    before = {path: path.stat().st_mtime_ns for path in target.rglob("*") if path.is_file()}
    second = release(root, target)
    assert (second.written, second.removed, second.kept) == ((), (), ())
    assert second.same == len(first.written)
    assert before == {path: path.stat().st_mtime_ns for path in target.rglob("*") if path.is_file()}


def test_what_nobody_has_changed_is_brought_up_to_date(root, target):
    release(root, target)
    (root / "LICENSE").write_text("another\n")
    (root / "src/rosbeat/new.py").write_text("new\n")
    (root / "environment/README.md").unlink()
    done = release(root, target)
    assert done.written == ("LICENSE", "src/rosbeat/new.py")
    assert done.removed == ("environment/README.md",)
    assert not (target / "environment/README.md").exists()


def test_folders_that_are_empty_afterwards_go_too(root, target):
    release(root, target)
    (root / "src/ros2_command/pyproject.toml").unlink()
    release(root, target)
    assert not (target / "src/ros2_command").exists()
    assert (target / "src").exists()


def test_what_somebody_has_changed_stays(root, target):
    release(root, target)
    (target / PAGE).write_text("my answers")
    (target / "my notes.txt").write_text("mine")
    (target / "environment/README.md").write_text("mine")
    (root / PAGE).write_text((root / PAGE).read_text().replace("Page 03", "Page 3"))
    (root / "environment/README.md").unlink()
    done = release(root, target)
    assert done.kept == (PAGE,)
    assert done.removed == ()
    assert (target / PAGE).read_text() == "my answers"
    assert (target / "my notes.txt").read_text() == "mine"
    assert (target / "environment/README.md").read_text() == "mine"


def test_what_was_changed_back_is_brought_up_to_date_again(root, target):
    release(root, target)
    given = (target / PAGE).read_text()
    (target / PAGE).write_text("my answers")
    (root / PAGE).write_text((root / PAGE).read_text().replace("Page 03", "Page 3"))
    release(root, target)
    (target / PAGE).write_text(given)
    assert release(root, target).written == (PAGE,)


def test_what_somebody_has_deleted_comes_back(root, target):
    release(root, target)
    (target / "LICENSE").unlink()
    assert release(root, target).written == ("LICENSE",)


def test_a_file_of_somebodys_own_is_not_written_over(root, target):
    release(root, target)
    (target / "src/rosbeat/new.py").write_text("mine")
    (root / "src/rosbeat/new.py").write_text("new\n")
    assert release(root, target).kept == ("src/rosbeat/new.py",)
    assert (target / "src/rosbeat/new.py").read_text() == "mine"


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


def test_a_folder_in_the_place_of_a_file_stays(root, target):
    release(root, target)
    (target / "LICENSE").unlink()
    (target / "LICENSE/mine").mkdir(parents=True)
    assert release(root, target).kept == ("LICENSE",)


def test_a_file_in_the_place_of_a_folder_stays(root, target):
    release(root, target)
    (target / "docs/troubleshooting.md").unlink()
    (target / "docs").rmdir()
    (target / "docs").write_text("mine")
    assert release(root, target).kept == ("docs/troubleshooting.md",)
    assert (target / "docs").read_text() == "mine"


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
    release(root, target, points=points)
    assert (target / "points.csv").read_text() == points.read_text()
    assert "03a: 7 " in (target / "README.md").read_text()
    points.unlink()
    assert release(root, target).written == ()
    assert "04a: not graded" in (target / "README.md").read_text()


def test_points_that_cannot_be_read_release_nothing(root, target, tmp_path):
    points = tmp_path / "mine.csv"
    points.write_text("exercise,points\n03a,many\n")
    with pytest.raises(GradingError, match="line 2"):
        release(root, target, points=points)
    assert not target.exists()


def test_other_folders_are_refused(root, target, tmp_path, says):
    target.mkdir(parents=True)
    (target / "thesis.txt").write_text("mine")
    file = tmp_path / "file"
    file.write_text("x")
    for place in (target, root, root / "sub", root / "notebooks", tmp_path, file):
        with pytest.raises(GradingError) as caught:
            release(root, place)
        says(caught.value, "nothing was written")
    assert tree(target) == {"thesis.txt": "mine"}


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{", '{"format": 99, "files": {}}', '{"format": 1}', '{"format": 1, "files": []}',
     '{"format": 1, "files": {"a": 1}}', "\xff"],
)  # fmt: skip
def test_a_marker_that_is_none_is_refused(root, target, text):
    target.mkdir(parents=True)
    (target / MARKER).write_text(text, encoding="latin-1")
    with pytest.raises(GradingError):
        release(root, target)


def test_a_folder_that_cannot_be_made_is_told(root, says):
    with pytest.raises(GradingError) as caught:
        release(root, Path("/proc/no/such/place"))
    says(caught.value, "/proc/no/such/place cannot be made", "where you may write")


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


@pytest.mark.parametrize("name", ["", "/etc/passwd", "a/../../b", "..", "a\0b"])
def test_paths_that_lead_away(name):
    assert not is_inside(name)


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

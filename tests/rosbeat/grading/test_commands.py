"""`rosbeat release` and `rosbeat collect`, as they are typed."""

import argparse
import json
import subprocess
import sys

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading import checkout, commands
from small_course import PAGES, small_course


@pytest.fixture(autouse=True)
def _course(tmp_path, monkeypatch):
    root = small_course(tmp_path / "course")
    monkeypatch.setattr(checkout, "course_root", lambda: root)


@pytest.fixture
def typed(capsys):
    """Run a command as it is typed, and return what it has printed."""

    def run(name, *words):
        parser = argparse.ArgumentParser()
        getattr(commands, f"{name}_arguments")(parser)
        assert getattr(commands, f"run_{name}")(parser.parse_args(list(map(str, words)))) == 0
        return capsys.readouterr().out

    return run


def test_a_release_says_what_it_has_done(typed, tmp_path):
    said = typed("release", tmp_path / "out", "--lessons", "3", "04")
    assert "has the pages 03, 04, without answers" in said
    assert "exercise 02a" not in said
    assert said.endswith("environment/course lab\n")
    assert (tmp_path / "out/notebooks/03_write.ipynb").is_file()


def test_a_release_says_what_it_gives_away(typed, tmp_path):
    assert "they show one answer to exercise 02a" in typed("release", tmp_path / "out")


def test_a_release_names_what_it_has_kept(typed, tmp_path):
    typed("release", tmp_path / "out")
    (tmp_path / "out/LICENSE").write_text("mine")
    said = typed("release", tmp_path / "out")
    assert "stay as they are:\n    LICENSE\n" in said
    assert "0 files" not in said


def test_pages_and_points_that_are_not_there_are_refused(typed, tmp_path):
    for words in (["--lessons", "99"], ["--points", tmp_path / "no.csv"]):
        with pytest.raises(GradingError):
            typed("release", tmp_path / "out", *words)
    assert not (tmp_path / "out").exists()


@pytest.fixture
def submissions(tmp_path):
    for learner, lessons in (("ana", ("03_write", "04_listen")), ("ben", ("03_write",))):
        folder = tmp_path / "in" / learner
        folder.mkdir(parents=True)
        for lesson in lessons:
            (folder / f"{lesson}.ipynb").write_text(PAGES[lesson])
    return tmp_path / "in"


def test_a_class_is_collected(typed, submissions):
    said = typed("collect", submissions)
    assert said.splitlines()[0].split() == ["learner", "name", "03", "04", "remarks"]
    assert "2 learners, 3 pages, 0 remarks" in said


def test_only_some_pages_are_collected(typed, submissions):
    said = typed("collect", submissions, "--lessons", "04", "06")
    assert said.splitlines()[0].split() == ["learner", "name", "04", "06", "remarks"]
    assert "2 pages that you did not ask for" in said


def test_a_deadline_counts(typed, submissions):
    assert " late" in typed("collect", submissions, "--due", "2001-01-01")
    assert " late" not in typed("collect", submissions, "--due", "2999-01-01")
    with pytest.raises(GradingError):
        typed("collect", submissions, "--due", "soon")


def test_a_class_is_collected_for_programs(typed, submissions):
    found = json.loads(typed("collect", submissions, "--json"))
    assert [one["learner"] for one in found["learners"]] == ["ana", "ben"]


def test_declaring_the_arguments_loads_nothing_heavy():
    code = "import sys, rosbeat.grading.commands; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"rich", "rclpy", "rosbeat.exercises.registry"} & set(done.stdout.split())

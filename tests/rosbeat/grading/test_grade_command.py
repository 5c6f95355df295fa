"""`rosbeat grade`, as it is typed."""

import argparse
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from bank.class_of_learners import hand_in
from rosbeat.errors import CommandError, GradingError, StoppedError
from rosbeat.grading import checkout, grade_command
from rosbeat.grading.grade_options import arguments
from rosbeat.grading.jobs import Observed
from rosbeat.grading.ledger import FILE
from rosbeat.grading.review import ReviewServer
from small_course import small_course

ROOT = Path(__file__).resolve().parents[3]


class Workers:
    """Takes the place of the pool: every answer raises the same, and each job is counted."""

    def __init__(self, *options):
        self.options = options

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def observe(self, jobs):
        for key, job in jobs:
            self.jobs.append(job)
            yield key, Observed("ended", raised="ZeroDivisionError", text="division by zero")


@pytest.fixture
def workers(monkeypatch):
    made = type("Made", (Workers,), {"jobs": []})
    monkeypatch.setattr(grade_command, "Pool", made)
    return made


@pytest.fixture
def typed(tmp_path, capsys):
    """Type the command, and return what it has printed."""

    def run(*words):
        parser = argparse.ArgumentParser()
        arguments(parser)
        words = (tmp_path / "class", "--out", tmp_path / "out", "--sample", "0", *words)
        assert grade_command.run(parser.parse_args([str(word) for word in words])) == 0
        return capsys.readouterr()

    return run


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A very small course, and two learners of it."""
    root = small_course(tmp_path / "course")
    monkeypatch.setattr(checkout, "course_root", lambda: root)
    for name in ("ana", "ben"):
        (tmp_path / "class" / name).mkdir(parents=True)
        text = (root / "notebooks/03_write.ipynb").read_text().replace("____", f"x = '{name}'")
        (tmp_path / "class" / name / "03_write.ipynb").write_text(text)


def results(tmp_path):
    return json.loads((tmp_path / "out/results.json").read_text())


def files_of(folder):
    return {
        path.relative_to(folder).as_posix(): path.stat().st_mtime_ns
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_all_results_are_written(course, workers, typed, tmp_path):
    said = typed().out
    found = {name.split("/")[0] for name in files_of(tmp_path / "out")}
    assert found >= {"results.json", "grades.csv", "class.html", "feedback", "manual.csv", FILE}
    assert len(list((tmp_path / "out/feedback").glob("*.html"))) == 2
    assert "2" in said
    assert len(workers.jobs) == 2


def test_pages_that_nobody_handed_in_do_not_count_unless_they_are_named(
    course, workers, typed, tmp_path
):
    typed()
    assert "04a" not in (tmp_path / "out/results.json").read_text()
    typed("--lessons", "03", "04")
    assert "04a" in (tmp_path / "out/results.json").read_text()


def test_another_page_is_not_taken_for_the_one_that_is_named(course, workers, typed, tmp_path):
    for folder in (tmp_path / "course/notebooks", tmp_path / "class/ana"):
        path = folder / "04_listen.ipynb"
        made = json.loads((tmp_path / "course/notebooks/04_listen.ipynb").read_text())
        made["cells"][0]["id"] = "shared"
        path.write_text(json.dumps(made))
    path = tmp_path / "class/ana/03_write.ipynb"
    path.write_text(path.read_text().replace("03a-title", "shared"))
    typed("--lessons", "04")
    (ana, ben) = results(tmp_path)["learners"]
    assert [one["about"] for one in (*ana["remarks"], *ben["remarks"])] == []
    assert [one["marks"][0]["status"] for one in (ana, ben)] == ["not attempted", "missing"]


def test_unchanged_submissions_are_not_graded_twice_and_no_file_is_touched(
    course, workers, typed, tmp_path
):
    typed()
    before = files_of(tmp_path / "out")
    typed()
    assert len(workers.jobs) == 2
    assert files_of(tmp_path / "out") == before


def test_what_a_person_has_set_survives(course, workers, typed, tmp_path):
    typed()
    path = tmp_path / "out/manual.csv"
    path.write_text("learner,exercise,points,comment\nana,03a,1.5,Well tried\n")
    typed()
    assert "Well tried" in (tmp_path / "out/results.json").read_text()
    assert "Well tried" in path.read_text()
    assert len(workers.jobs) == 2


def test_a_warning_stands_where_there_is_no_sandbox(course, workers, typed):
    assert "strangers' programs" in typed("--unsafe-no-sandbox").err
    assert "strangers' programs" not in typed().err


@pytest.mark.parametrize(
    "words",
    [["--lessons", "99"], ["--points", "/no/such.csv"], ["--due", "soon"],
     ["--scheduler", "tcp://127.0.0.1:1", "--unsafe-no-sandbox"]],
    ids=range(4),
)  # fmt: skip
def test_what_cannot_be_used_is_refused_before_anything_is_judged(course, workers, typed, words):
    with pytest.raises((GradingError, CommandError)):
        typed(*words)
    assert workers.jobs == []


def test_a_manual_table_that_cannot_be_read_stops_before_anything_is_lost(
    course, workers, typed, tmp_path
):
    typed()
    path = tmp_path / "out/manual.csv"
    path.unlink()
    path.mkdir()
    before = files_of(tmp_path / "out")
    with pytest.raises(GradingError):
        typed()
    assert files_of(tmp_path / "out") == before


def test_a_class_can_be_reviewed_when_it_is_graded(course, workers, typed, monkeypatch):
    served = []

    def serve(server):
        served.append(server.review.groups)
        raise KeyboardInterrupt

    monkeypatch.setattr(ReviewServer, "serve_forever", serve)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    said = typed("--review").out
    assert "begin with class.html" in said
    assert re.search(r"http://127\.0\.0\.1:\d+/[\w-]{43}/\n", said)
    ((group, *_),) = served
    assert "x = " in group.first.source


# How it was done the last time.


def test_an_option_that_was_left_out_is_noticed(course, workers, typed, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("exercise,points\n03a,7\n")
    with_options = ("--due", "2001-01-01", "--points", points)
    assert "Other options" not in typed(*with_options).err
    assert "Other options" not in typed(*with_options).err
    (line,) = [one for one in typed().err.splitlines() if "Other options" in one]
    assert f"Last time: --due 2001-01-01, --points {points}; now without" in line
    assert "now --lessons 03." in typed("--lessons", "3").err
    assert "Other options" not in typed("--lessons", "03").err


def test_a_run_that_is_refused_does_not_count_as_the_last_one(course, workers, typed, tmp_path):
    typed("--due", "2001-01-01")
    with pytest.raises(GradingError):
        typed("--points", "/no/such.csv")
    assert "Other options" not in typed("--due", "2001-01-01").err


# What is no class, and no folder.


@pytest.mark.parametrize("make", ["empty", "results", "file"])
def test_what_is_no_class_is_refused_and_nothing_is_written(
    course, workers, typed, tmp_path, make, says
):
    typed()
    (tmp_path / "class").rename(tmp_path / "real")
    (tmp_path / "class").mkdir()
    if make == "results":
        (tmp_path / "class").rmdir()
        (tmp_path / "out").rename(tmp_path / "class")
    if make == "file":
        (tmp_path / "class/notes.txt").write_text("milk")
    before = files_of(tmp_path)
    with pytest.raises(GradingError) as caught:
        typed()
    says(caught.value, "has no submission in it", "Moodle", "docs/instructors.md")
    assert files_of(tmp_path) == before
    assert (tmp_path / "out").exists() == (make != "results")


def test_a_file_is_no_folder_for_results(course, workers, typed, tmp_path, says):
    (tmp_path / "file").write_text("mine")
    for place in (tmp_path / "file", tmp_path / "file/more"):
        with pytest.raises(GradingError) as caught:
            typed("--out", place)
        says(caught.value, "is a file, not a folder")
    assert (tmp_path / "file").read_text() == "mine"


def test_points_of_a_page_that_is_not_graded_are_told(course, workers, typed, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("exercise,points\n05a,4\n03a,3\n")
    assert "The points for page 05 change nothing" in typed("--points", points).err


def test_whoever_stops_it_hears_what_is_kept(course, workers, typed, tmp_path, monkeypatch, says):
    class Stopped(workers):
        def observe(self, jobs):
            yield next(super().observe(jobs))
            raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(grade_command, "Pool", Stopped)
        with pytest.raises(StoppedError) as caught:
            typed()
    says(caught.value, "1 of 2 answers are judged and kept", "the same options")
    said = typed().err
    assert "2 different answers, 1 of them judged already" in said
    assert len(workers.jobs) == 2


def test_a_class_of_120_is_not_observed_twice(course, workers, typed, tmp_path):
    text = (tmp_path / "class/ana/03_write.ipynb").read_text()
    for number in range(118):
        (tmp_path / f"class/{number}").mkdir()
        (tmp_path / f"class/{number}/03.ipynb").write_text(text.replace("ana", f"{number}"))
    typed()
    assert len(workers.jobs) == len(results(tmp_path)["learners"]) == 120
    before = files_of(tmp_path / "out")
    typed()
    assert len(workers.jobs) == 120
    assert files_of(tmp_path / "out") == before


# For real.


def start(folder, out):
    return subprocess.Popen(
        [sys.executable, "-m", "rosbeat", "grade", str(folder), "--out", str(out),
         "--lessons", "04", "--sample", "0", "--workers", "2"],
        cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip


def keys(out):
    """Keys of the answers that have been judged, in order."""
    try:
        lines = (out / FILE).read_bytes().split(b"\n")[:-1]
    except FileNotFoundError:
        return []
    return [json.loads(line)["key"] for line in lines]


@pytest.mark.ros
def test_a_class_goes_on_where_it_was_killed(tmp_path, eventually):
    hand_in(tmp_path / "class", 12)
    killed, plain = tmp_path / "killed", tmp_path / "plain"
    first = start(tmp_path / "class", killed)
    eventually(lambda: len(keys(killed)) >= 6, 60)
    workers = psutil.Process(first.pid).children(recursive=True)
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    before = keys(killed)
    assert not (killed / "results.json").exists()
    eventually(lambda: not any(is_alive(one) for one in workers))
    assert start(tmp_path / "class", killed).wait(100) == 0
    assert start(tmp_path / "class", plain).wait(100) == 0
    after = keys(killed)
    assert after[: len(before)] == before
    assert len(before) < len(after) == len(set(after))
    assert sorted(after) == sorted(keys(plain))
    for name in ("results.json", "grades.csv", "class.html"):
        assert (killed / name).read_bytes() == (plain / name).read_bytes()
    found = {one["status"] for learner in results_of(plain) for one in learner["marks"]}
    assert found >= {"passed", "failed"}


def is_alive(process):
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def results_of(out):
    return json.loads((out / "results.json").read_text())["learners"]

import os
from argparse import Namespace

import pytest

from rosbeat.grading.unchanged import FILE, last_summary, remember


@pytest.fixture
def options(tmp_path):
    learner = tmp_path / "class" / "ana"
    learner.mkdir(parents=True)
    (learner / "03.ipynb").write_text("{}")
    out = tmp_path / "grades"
    out.mkdir()
    (out / "results.json").write_text("[]")
    (tmp_path / "points.csv").write_text("exercise,points\n03a,4\n")
    return Namespace(
        submissions=tmp_path / "class", out=out, points=tmp_path / "points.csv", sample=2, due=None
    )


@pytest.fixture
def done(options):
    remember(options, "All is well.")
    return options


def test_nothing_is_known_before_the_first_run(options):
    assert last_summary(options) is None


def test_who_changes_nothing_hears_the_same_again(done):
    assert last_summary(done) == "All is well."


def change_answer(options):
    (options.submissions / "ana" / "03.ipynb").write_text("[]")


def add_learner(options):
    (options.submissions / "bob").mkdir()
    (options.submissions / "bob" / "03.ipynb").write_text("{}")


def edit_points(options):
    options.points.write_text("exercise,points\n03a,5\n")


def give_points_by_hand(options):
    (options.out / "manual.csv").write_text("learner,exercise,points,comment\nana,03a,1,\n")


def lose_a_result(options):
    (options.out / "results.json").unlink()


def ask_for_more(options):
    options.sample = 3


def come_later(options):
    path = options.submissions / "ana" / "03.ipynb"
    os.utime(path, ns=(0, path.stat().st_mtime_ns + 1))


@pytest.mark.parametrize(
    "change",
    [
        *(change_answer, add_learner, edit_points, give_points_by_hand, lose_a_result),
        *(ask_for_more, come_later),
    ],
)
def test_any_change_counts(done, change):
    change(done)
    assert last_summary(done) is None


def test_another_course_counts(done, monkeypatch):
    monkeypatch.setattr("rosbeat.grading.unchanged.course_version", lambda: "another")
    assert last_summary(done) is None


def test_an_edited_rubric_counts(done, monkeypatch, tmp_path):
    rubric = tmp_path / "rubric.json"
    rubric.write_text("{}")
    monkeypatch.setenv("ROSBEAT_RUBRIC", str(rubric))
    assert last_summary(done) is None
    remember(done, "With the rubric.")
    assert last_summary(done) == "With the rubric."
    rubric.write_text("[]")
    assert last_summary(done) is None


@pytest.mark.parametrize("content", ["", "[]", '{"digest": 5}', "null", "\ud800"])
def test_a_broken_note_is_no_note(done, content):
    (done.out / FILE).write_bytes(content.encode("utf-8", "surrogatepass"))
    assert last_summary(done) is None


def test_nobody_waits_at_a_pipe(options):
    os.mkfifo(options.submissions / "ana" / "pipe")
    remember(options, "All is well.")
    assert last_summary(options) == "All is well."


def test_a_zip_file_counts_as_it_is(options, tmp_path):
    options.submissions = tmp_path / "class.zip"
    options.submissions.write_bytes(b"one")
    remember(options, "All is well.")
    assert last_summary(options) == "All is well."
    options.submissions.write_bytes(b"two")
    assert last_summary(options) is None

"""`rosbeat release`, `rosbeat collect` and `rosbeat grade`, as they are typed."""

import argparse
import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import zipfile
from pathlib import Path

import pytest

from grading_files import BLANK, cell, notebook
from parsed_html import Parsed
from rosbeat import cli
from rosbeat.errors import GradingError, StoppedError
from rosbeat.exercises.exercise import FAILED
from rosbeat.grading import commands
from rosbeat.grading import run as run_module
from rosbeat.grading.commands import (
    LAST_RUN,
    WAITS,
    choose_pages,
    find_checkout,
)
from rosbeat.grading.ledger import FILE
from rosbeat.grading.lock import alone_in
from rosbeat.grading.review import ReviewServer
from rosbeat.records import Outcome
from small_course import PAGES

ROOT = Path(__file__).resolve().parents[3]


# Pages by their names.


def test_a_package_without_its_course_says_so(monkeypatch, says):
    monkeypatch.setattr(commands, "course_root", lambda: None)
    with pytest.raises(GradingError) as caught:
        find_checkout()
    says(caught.value, "./environment/course shell")


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        ([], ["03", "04"]),
        (["04"], ["04"]),
        (["4", "3"], ["03", "04"]),
        (["03_write"], ["03"]),
        (["notebooks/03_write.ipynb", " 03 "], ["03"]),
    ],
)
def test_pages_go_by_many_names(pages, names, numbers, says):
    assert [page.number for page in choose_pages(pages, names)] == numbers
    for name in ("05", "", "write", "³", "\x1b[31m"):
        with pytest.raises(GradingError) as caught:
            choose_pages(pages, [*names, name])
        says(caught.value, "--lessons 03 04")
        assert "\x1b" not in str(caught.value)


@pytest.fixture
def told(run):
    """Type a command that goes well, and return what it has printed."""

    def told(name, *words):
        said, code = run(name, *words)
        assert code == 0
        return said.out

    return told


# `rosbeat release`.


def test_a_release_says_what_it_has_done_and_kept_and_what_it_gives_away(told, tmp_path):
    said = told("release", tmp_path / "out", "--lessons", "3", "04")
    assert "has the pages 03, 04, without answers" in said
    assert "exercise 02a" not in said
    assert said.endswith("environment/course lab\n")
    assert (tmp_path / "out/notebooks/03_write.ipynb").is_file()
    (tmp_path / "out/LICENSE").write_text("mine")
    said = told("release", tmp_path / "out", "--lessons", "06")
    assert "stay as they are:\n    LICENSE\n" in said
    assert "0 files" not in said
    assert "they show one answer to exercise 02a" in said


@pytest.fixture
def submissions(tmp_path):
    for learner, lessons in (("ana", ("03_write", "04_listen")), ("ben", ("03_write",))):
        folder = tmp_path / "in" / learner
        folder.mkdir(parents=True)
        for lesson in lessons:
            (folder / f"{lesson}.ipynb").write_text(PAGES[lesson])
    return tmp_path / "in"


def test_a_class_is_collected(told, submissions):
    said = told("collect", submissions)
    assert said.splitlines()[0].split() == ["learner", "name", "03", "04", "remarks"]
    assert "2 learners, 3 pages, no remarks." in said
    said = told("collect", submissions, "--lessons", "04", "06", "--due", "2001-01-01")
    assert said.splitlines()[0].split() == ["learner", "name", "04", "06", "remarks"]
    assert "2 pages that you did not ask for" in said
    assert " late" in said
    found = json.loads(told("collect", submissions, "--json", "--due", "2999-01-01"))
    assert [one["learner"] for one in found["learners"]] == ["ana", "ben"]
    assert not found["learners"][0]["pages"][0]["late"]


def test_who_handed_in_nothing_is_told_with_a_roster(told, submissions, tmp_path):
    (tmp_path / "roster.txt").write_text("ben\nana\nzoe\n")
    said = told("collect", submissions, "--roster", tmp_path / "roster.txt")
    assert said.splitlines()[3].split() == ["zoe", "-", "-"]
    assert "3 learners, 3 pages, 1 learner without any page, no remarks." in said


def test_what_is_half_or_cannot_be_read_is_told(told, submissions):
    page = submissions / "ana/03_write.ipynb"
    page.write_text(page.read_text()[:400])
    (submissions / "ben/03_write.ipynb").write_text("")
    (submissions / "\x1b[31m").mkdir()
    said = told("collect", submissions)
    assert "\x1b" not in said
    rows = [line.split() for line in said.splitlines()]
    assert ["ana", "unreadable", "yes", "1"] in rows
    assert ["ben", "unreadable", "-", "1"] in rows
    assert "empty: ben/03_write.ipynb" in said
    assert "    The file is empty." in said


# `rosbeat grade`.


def results(tmp_path):
    return json.loads((tmp_path / "out/results.json").read_text())


def files_of(folder):
    return {
        path.relative_to(folder).as_posix(): path.stat().st_mtime_ns
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_all_results_are_written(workers, typed, tmp_path):
    printed = typed("--unsafe-no-sandbox")
    said = printed.out
    assert "strangers' programs" in printed.err
    found = {name.split("/")[0] for name in files_of(tmp_path / "out")}
    assert found >= {"results.json", "grades.csv", "class.html", "feedback", "manual.csv", FILE}
    assert len(list((tmp_path / "out/feedback").glob("*.html"))) == 2
    assert "2" in said
    assert len(workers.jobs) == 2


def test_pages_that_nobody_handed_in_do_not_count_unless_they_are_named(typed, tmp_path):
    def marked():
        return {
            mark["exercise"]
            for learner in results(tmp_path)["learners"]
            for mark in learner["marks"]
        }

    typed()
    assert marked()
    assert "04a" not in marked()
    typed("--lessons", "03", "04")
    assert "04a" in marked()


def test_unchanged_submissions_are_not_graded_twice_and_no_file_is_touched(
    workers, typed, tmp_path
):
    typed()
    before = files_of(tmp_path / "out")
    assert "strangers' programs" not in typed().err
    assert len(workers.jobs) == 2
    assert files_of(tmp_path / "out") == before


def test_what_a_person_has_set_survives(workers, typed, tmp_path):
    typed()
    path = tmp_path / "out/manual.csv"
    path.write_text("learner,exercise,points,comment\nana,03a,1.5,Well tried\n")
    typed()
    assert "Well tried" in (tmp_path / "out/results.json").read_text()
    assert "Well tried" in path.read_text()
    assert len(workers.jobs) == 2


def test_a_class_can_be_reviewed_when_it_is_graded(typed, monkeypatch):
    served = []

    def serve(server):
        served.append(server.review.groups)
        raise KeyboardInterrupt

    monkeypatch.setattr(ReviewServer, "serve_forever", serve)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    said = typed("--review", "--json")
    assert json.loads(said.out)["learners"] == 2
    assert re.search(r"http://127\.0\.0\.1:\d+/[\w-]{43}/\n", said.err)
    ((group, *_),) = served
    assert "x = " in group.first.source


# How it was done the last time.


def test_an_option_that_was_left_out_is_noticed(typed, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("exercise,points\n03a,7\n05a,4\n")
    with_options = ("--due", "2001-01-01 18:00", "--points", points)
    typed(*with_options)
    assert "Other options" not in typed(*with_options).err
    (line,) = [one for one in typed().err.splitlines() if "Other options" in one]
    assert f"Last time: --due '2001-01-01 18:00', --points {points}; now without" in line
    assert "now --lessons 03." in typed("--lessons", "3").err
    assert "Other options" not in typed("--lessons", "03").err
    with pytest.raises(GradingError):
        typed("--points", "/no/such.csv")  # what is refused is not the last run
    assert "Other options" not in typed("--lessons", "03").err


def test_options_of_the_last_time_are_shown_safely_or_not_at_all(typed, tmp_path):
    typed()
    path = tmp_path / "out" / LAST_RUN
    made = json.loads(path.read_text())
    path.write_text("[]")
    assert "Other options" not in typed().err
    path.write_text(json.dumps(made | {"options": {"due": "\x1b[31m", "\x1b[32m": "x"}}))
    said = typed().err
    assert "Other options than last time! Last time: --" in said
    assert "\x1b" not in said


# What is no class, and no folder.


def test_what_is_no_class_is_refused_and_nothing_is_written(typed, tmp_path, says):
    typed()
    (tmp_path / "class").rename(tmp_path / "real")
    (tmp_path / "out").rename(tmp_path / "class")
    before = files_of(tmp_path)
    with pytest.raises(GradingError) as caught:
        typed()
    says(caught.value, "has no submission in it", "Moodle", "docs/instructors.md")
    assert files_of(tmp_path) == before
    assert not (tmp_path / "out").exists()


def test_whoever_stops_it_hears_what_is_kept(workers, typed, tmp_path, monkeypatch, says):
    class Stopped(workers):
        def observe(self, submissions):
            yield next(super().observe(submissions))
            raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(commands, "Pool", Stopped)
        with pytest.raises(StoppedError) as caught:
            typed()
    says(caught.value, "1 of 2 answers are judged and kept", "the same options")
    assert not (tmp_path / "out/results.json").exists()
    said = typed().err
    assert "2 different answers, 1 of them judged already" in said
    assert len(workers.jobs) == 2


# Exit codes, and what waits for a person.


def rows(tmp_path, name="grades.csv"):
    text = (tmp_path / "out" / name).read_text("utf-8-sig")
    return list(csv.DictReader(io.StringIO(text)))


def test_3_means_that_an_answer_waits(typed, tmp_path):
    (tmp_path / "class/ben/03_write.ipynb").write_text("")
    said = typed(code=WAITS)
    assert "Held for you to look at: 1 exercise" in said.out
    (mark,) = results(tmp_path)["learners"][1]["marks"]
    assert (mark["status"], mark["points"]) == ("held", 0)
    assert "The file is empty" in mark["cause"]
    (tmp_path / "out/manual.csv").write_text("learner,exercise,points\nben,03a,1\n")
    typed(code=0)


def test_3_means_that_a_line_was_not_used(typed, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out/manual.csv").write_text("learner,exercise,points\nnobody,03a,1\n")
    assert "no learner 'nobody'" in typed(code=WAITS).out
    (tmp_path / "out/manual.csv").unlink()
    (tmp_path / "roster.csv").write_text("ana\n")
    typed("--roster", tmp_path / "roster.csv", code=WAITS)


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["--lessons", "99"], cli.FAILED),
        (["--points", "/no/such.csv"], cli.FAILED),
        (["--due", "soon"], cli.FAILED),
        (["--out", "/proc/version/grades"], cli.FAILED),
        (["--late", "10%/day"], cli.MISUSED),
        (["--missing", "maybe"], cli.MISUSED),
        (["--workers", "0"], cli.MISUSED),
        (["--scheduler", "tcp://127.0.0.1:1", "--unsafe-no-sandbox"], cli.MISUSED),
    ],
)
def test_1_means_that_nothing_was_done_and_2_that_nothing_could_be_meant(
    course, workers, tmp_path, words, code
):
    given = ["grade", str(tmp_path / "class"), "--out", str(tmp_path / "out"), *words]
    assert cli.main(given) == code
    assert not (tmp_path / "out").exists()
    assert workers.jobs == []


def test_130_means_that_somebody_stopped_it(course, workers, tmp_path, monkeypatch, capsys):
    def observe(self, jobs):
        os.kill(os.getpid(), signal.SIGTERM)
        yield from super(workers, self).observe(jobs)

    monkeypatch.setattr(workers, "observe", observe)
    given = ["grade", str(tmp_path / "class"), "--out", str(tmp_path / "out")]
    assert cli.main(given) == cli.INTERRUPTED
    assert "None of 2 answers are judged and kept" in capsys.readouterr().err


def test_a_summary_for_programs(typed, tmp_path):
    (tmp_path / "class/cy").mkdir()
    (tmp_path / "class/cy/03_write.ipynb").write_text("")
    (tmp_path / "roster.csv").write_text("ana\nben\ncy\ndan\n")
    said = typed("--json", "--roster", tmp_path / "roster.csv", "--missing", "empty", code=WAITS)
    assert said.out.isascii()
    found = json.loads(said.out)
    assert (found["exit"], found["learners"], found["graded"]) == (3, 4, 2)
    assert found["marks"] == {"failed": 2, "held": 1, "missing": 1}
    (held,) = found["held"]
    assert (held["learner"], held["exercise"], held["file"]) == ("cy", "03a", "cy/03_write.ipynb")
    assert (found["lines"], found["files"]) == ([], {"empty": 1})
    said = typed("--roster", tmp_path / "roster.csv", "--missing", "empty", code=WAITS).out
    average = f"On average {found['average']:g} of {found['out_of']:g} points"
    assert f"{average}, without 1 learner" in said


# The roster, and lateness.


@pytest.mark.parametrize(("missing", "points"), [("zero", "0"), ("empty", "")])
def test_who_handed_in_nothing_is_in_every_list(typed, tmp_path, missing, points):
    for name in ("ana", "ben"):
        folder = tmp_path / "class" / name
        folder.rename(folder.with_name(f"{name} X_{len(name + missing)}{ord(name[0])}_"
                                       "assignsubmission_file_"))  # fmt: skip
    (tmp_path / "class/Dan Y_77_assignsubmission_file_").mkdir()
    (tmp_path / "roster.csv").write_text(
        'Identifier,"Full name"\n"Participant 4711","Cy Z"\n"Participant 77","Dan Y"\n'
    )
    words = ("--roster", tmp_path / "roster.csv", "--missing", missing)
    typed(*words, code=WAITS)  # ana and ben are not on the roster
    found = {one["learner"]: one for one in rows(tmp_path)}
    assert len(found) == 4
    for learner in ("4711", "77"):
        assert (found[learner]["status"], found[learner]["points"]) == ("missing", points)
    worksheet = {one["Identifier"]: one["Grade"] for one in rows(tmp_path, "moodle.csv")}
    assert worksheet["Participant 4711"] == worksheet["Participant 77"] == points
    assert len(worksheet) == 4
    assert len(list((tmp_path / "out/feedback").glob("*.html"))) == 4
    assert "Cy Z" in (tmp_path / "out/class.html").read_text()


def test_a_late_page_loses_points_unless_its_learner_has_an_extension(typed, tmp_path):
    due = 1_000_000
    for name in ("ana", "ben"):
        os.utime(tmp_path / "class" / name / "03_write.ipynb", (due + 100_000, due + 100_000))
    (tmp_path / "roster.csv").write_text("id,extension\nana,\nben,2 days\n")
    (tmp_path / "points.csv").write_text("03a,10\n")
    words = ("--due", "1970-01-12T13:46:40Z", "--late", "10%/day", "--points",
             tmp_path / "points.csv", "--roster", tmp_path / "roster.csv")  # fmt: skip
    typed(*words)
    (ana, ben) = results(tmp_path)["learners"]
    assert (ana["marks"][0]["late"], ben["marks"][0]["late"]) == (True, False)
    assert [one["about"] for one in ana["remarks"]] == ["late"]
    assert "20% of the points of this page are taken off" in ana["remarks"][0]["text"]
    assert ben["remarks"] == []


def text_of(path):
    return " ".join(Parsed(path.read_text("utf-8")).text.split())


def test_a_deduction_says_late_wherever_points_are(all_right, typed, tmp_path):
    """Fault 4 of a review: 1.8 of 2 points, "It does what is asked", and not a word of why."""
    due = 1_000_000
    names = {"ana": "Ana_11_assignsubmission_file_", "ben": "Ben_12_assignsubmission_file_"}
    for name, moment in (("ana", due + 1), ("ben", due)):
        folder = tmp_path / "class" / name
        folder = folder.rename(folder.with_name(names[name]))
        os.utime(folder / "03_write.ipynb", (moment, moment))
    (tmp_path / "points.csv").write_text("03a,2\n")
    words = ("--due", "1970-01-12T13:46:40Z", "--late", "10%/day", "--points",
             tmp_path / "points.csv")  # fmt: skip
    typed(*words)
    ana, ben = rows(tmp_path)
    assert (ana["points"], ana["judged"], ana["late"], ana["deducted"]) == (
        "1.8", "2", "yes", "0.2"
    )  # fmt: skip
    assert (ben["points"], ben["late"], ben["deducted"]) == ("2", "", "")
    of_ana, of_ben = (one["Feedback comments"] for one in rows(tmp_path, "moodle.csv"))
    late = "Late: 0.2 of 2 points were deducted."
    assert f"1.8 of 2. {late}" in of_ana
    pages = sorted((tmp_path / "out/feedback").iterdir())
    page_of_ana, page_of_ben = map(text_of, pages)
    assert late in page_of_ana
    assert "Late: 0.2 of the points that you reached were deducted." in page_of_ana
    assert "1.8 (0.2 late)" in text_of(tmp_path / "out/class.html")
    assert "late" not in (of_ben + page_of_ben).casefold()
    # Points by hand are final, so nothing of them was deducted.
    (tmp_path / "out/manual.csv").write_text("learner,exercise,points,comment\n11,03a,1.5,\n")
    typed(*words)
    assert "Late: " not in rows(tmp_path, "moodle.csv")[0]["Feedback comments"]
    assert rows(tmp_path)[0]["deducted"] == ""


# Canvas gets a notebook, which is a page, too.


def test_the_notebook_for_canvas_says_late_as_well(all_right, typed, tmp_path):
    page = tmp_path / "class/ana/03_write.ipynb"
    (tmp_path / "class/b_LATE_1_9_03_write.ipynb").write_text(page.read_text())
    for name in ("ana", "ben"):
        (tmp_path / "class" / name / "03_write.ipynb").unlink()
        (tmp_path / "class" / name).rmdir()
    typed("--due", "2001-01-01", "--late", "20%")
    with zipfile.ZipFile(tmp_path / "out/canvas_feedback.zip") as archive:
        assert "Late: 0." in archive.read("b_LATE_1_9_03_write.ipynb").decode()


def test_a_rejected_line_publishes_nothing_of_itself(typed, tmp_path):
    (tmp_path / "out").mkdir()
    lines = "learner,exercise,points,comment\nana,03a,-1,SECRET\nben,99z,1,SECRET\n,,,SECRET\n"
    (tmp_path / "out/manual.csv").write_text(lines)
    assert typed(code=WAITS).out.count("Nothing is taken from this line.") == 3
    for path in (tmp_path / "out").rglob("*"):
        if path.is_file() and path.name != "manual.csv":
            assert b"SECRET" not in path.read_bytes(), path


# Judging again.


@pytest.fixture
def judge(monkeypatch):
    """Have the judge say something else from now on; the version of the course is another, too."""

    def judge(text):
        def say(exercise, *_):
            return Outcome(exercise.id, FAILED, evidence=text, out_of=exercise.points), ""

        monkeypatch.setattr(run_module, "judge_and_trace", say)
        monkeypatch.setattr(commands, "course_version", lambda: f"version of {text}")

    return judge


@pytest.fixture
def evidence(typed, tmp_path):
    """Type `rosbeat grade`, and return the evidence of each answer."""

    def evidence(*words):
        typed(*words)
        return {
            f"{one['learner']} {mark['exercise']}": mark["evidence"]
            for one in results(tmp_path)["learners"]
            for mark in one["marks"]
        }

    return evidence


@pytest.fixture
def two_pages(course, tmp_path):
    """Let ana hand in page 04, too."""
    page = PAGES["04_listen"].replace("____", "self.listens = True")
    (tmp_path / "class/ana/04_listen.ipynb").write_text(page)


@pytest.mark.parametrize(
    ("only", "again"),
    [
        (["ana"], {"ana 03a", "ana 04a"}),
        ([" ANA"], {"ana 03a", "ana 04a"}),
        (["03a"], {"ana 03a", "ben 03a"}),
        (["03"], {"ana 03a", "ben 03a"}),
        (["03_write"], {"ana 03a", "ben 03a"}),
        (["ben", "04a"], {"ben 03a", "ana 04a"}),
        (["ana", "ben"], {"ana 03a", "ana 04a", "ben 03a"}),
    ],
)
def test_only_what_is_named_is_judged_again(two_pages, workers, judge, evidence, only, again):
    judge("first")
    first = evidence("--lessons", "03", "04")
    jobs = len(workers.jobs)
    judge("second")
    words = [word for name in only for word in ("--only", name)]
    second = evidence("--lessons", "03", "04", *words)
    assert second.keys() == first.keys()
    assert {key for key, text in second.items() if text == "second"} == again
    assert len(workers.jobs) - jobs == len(again)
    judge("third")  # what stands, stands again, whichever version has judged it
    third = evidence("--lessons", "03", "04", "--only", "04a")
    assert third == second | {"ana 04a": "third"}
    judge("fourth")  # without the option, this version of the course judges everything
    fourth = evidence("--lessons", "03", "04")
    assert set(fourth.values()) == {"fourth", ""}  # ben has no page 04


def test_of_a_page_only_the_exercise_that_is_named_is_judged_again(
    course, workers, judge, evidence, tmp_path
):
    (tmp_path / "course/notebooks/03_write.ipynb").write_text(
        notebook(
            cell(BLANK, id="a", exercise="03a"),
            cell(BLANK, id="b", exercise="03b"),
            lesson="03_write",
        )
    )
    judge("first")
    assert set(evidence().values()) == {"first"}
    judge("second")
    found = evidence("--only", "03b")
    assert found == {
        "ana 03a": "first",
        "ana 03b": "second",
        "ben 03a": "first",
        "ben 03b": "second",
    }


def test_what_was_handed_in_since_is_judged_as_well(judge, evidence, tmp_path):
    judge("first")
    evidence()
    page = tmp_path / "class/ben/03_write.ipynb"
    page.write_text(page.read_text().replace("'ben'", "'Ben'"))
    judge("second")
    (tmp_path / "class/cy").mkdir()
    (tmp_path / "class/cy/03_write.ipynb").write_text(page.read_text().replace("Ben", "cy"))
    assert evidence("--only", "03a", "--only", "ana") == dict.fromkeys(
        ("ana 03a", "ben 03a", "cy 03a"), "second"
    )
    judge("third")
    assert evidence("--only", "cy")["ana 03a"] == "second"


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("anna", ("neither a learner nor an exercise 'anna'", "Did you mean ana?")),
        ("03b", ("exercise '03b'", "Did you mean", "03a")),
        ("04a", ("exercise '04a'", "Did you mean 03a")),  # nobody handed it in
        ("\x1b[31m", ("u001b[31m'", "`grades.csv` has the ids")),
        ("", ("exercise ''",)),
        ("Kim", ("'Kim' is the name of several learners", "20008, 20028")),
    ],
)
def test_a_name_of_nobody_or_of_several_is_refused(typed, tmp_path, says, name, parts):
    for number in ("20008", "20028"):
        folder = tmp_path / "class" / f"Kim_{number}_assignsubmission_file_"
        folder.mkdir()
        (folder / "03_write.ipynb").write_text(PAGES["03_write"])
    (tmp_path / "class/ana").rename(tmp_path / "class/ana_1_assignsubmission_file_")
    (tmp_path / "class/ben").rename(tmp_path / "class/ben_2_assignsubmission_file_")
    typed()
    before = files_of(tmp_path / "out")
    with pytest.raises(GradingError) as caught:
        typed("--only", "ben", "--only", name)
    says(caught.value, *parts, "all results are as they were")
    assert "\x1b" not in str(caught.value)
    assert files_of(tmp_path / "out") == before
    typed("--only", "ana", "--only", "20028")


def test_a_class_without_results_is_graded_whole_first(workers, typed, tmp_path, says):
    with pytest.raises(GradingError) as caught:
        typed("--only", "ana")
    says(caught.value, "has no results yet", "without `--only`")
    assert not (tmp_path / "out").exists()
    assert workers.jobs == []


# Two at once.


def test_a_second_grader_waits_and_says_for_whom(typed, tmp_path):
    typed()
    before = files_of(tmp_path / "out")
    inside, done = threading.Event(), threading.Event()
    told = []

    def grade():
        with alone_in(tmp_path / "out", told.append):
            inside.set()
            done.wait(20)

    first = threading.Thread(target=grade)
    first.start()
    assert inside.wait(20)
    threading.Timer(0.3, done.set).start()
    began = time.monotonic()
    said = typed().err
    first.join(20)
    assert time.monotonic() - began > 0.25
    (line,) = [one for one in said.splitlines() if "is grading into" in one]
    assert f"(process {os.getpid()}, since 20" in line
    assert f"{tmp_path / 'out'}; this one goes on when it is done." in line
    assert told == []
    assert files_of(tmp_path / "out") == before  # and nothing of the lock stays
    assert "is grading into" not in typed().err


def test_a_grader_that_was_killed_keeps_nobody(typed, tmp_path):
    typed()
    program = (
        "import os, sys; from pathlib import Path; from rosbeat.grading.lock import alone_in\n"
        "with alone_in(Path(sys.argv[1]), print):\n    os.kill(os.getpid(), 9)\n"
    )
    subprocess.run([sys.executable, "-c", program, tmp_path / "out"], timeout=60)
    assert (tmp_path / "out/.grading").exists()
    assert "is grading into" not in typed().err
    assert not (tmp_path / "out/.grading").exists()


# What is typed.


def test_every_option_and_exit_code_is_documented():
    text = (ROOT / "docs/instructors.md").read_text("utf-8")
    for declare in (cli._release_arguments, cli._collect_arguments, cli._grade_arguments):
        parser = argparse.ArgumentParser()
        declare(parser)
        for action in parser._actions:
            for option in action.option_strings[-1:]:
                assert option == "--help" or f"`{option}" in text or f" {option} " in text, option
    for code in ("0", "1", "2", "3", "130"):
        assert f"| {code} |" in text

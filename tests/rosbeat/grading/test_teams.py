"""Several learners, one submission: each has the mark, and deadlines of their own."""

import json
import os
from datetime import datetime

import pytest

from rosbeat.grading.commands import WAITS
from small_course import PAGES

DUE = datetime(2026, 11, 30, 18).timestamp()
DAY = 86_400
ROSTER = """\
id,name,team,extension
ana,Ana,Red,
ben,Ben,Red,2 days
cem,Cem,,
di,Di,Blue,
eve,Eve,Blue,
"""


@pytest.fixture
def graded(all_right, run, tmp_path):
    """Grade folders with a page each; the learners' results, and the exit code."""

    def graded(folders, roster=ROSTER):
        for name, date in folders.items():
            path = tmp_path / "in" / name / "03_write.ipynb"
            path.parent.mkdir(parents=True)
            path.write_text(PAGES["03_write"].replace("____", f"x = '{name}'"))
            os.utime(path, (date, date))
        (tmp_path / "roster.csv").write_text(roster)
        (tmp_path / "points.csv").write_text("03a,10\n")
        _, code = run(
            "grade", tmp_path / "in", "--out", tmp_path / "out", "--roster",
            tmp_path / "roster.csv", "--due", "2026-11-30 18:00", "--late", "10%/day",
            "--points", tmp_path / "points.csv",
        )  # fmt: skip
        text = (tmp_path / "out/results.json").read_bytes()
        learners = json.loads(text)["learners"]
        return {one["learner"]: one for one in learners}, code

    return graded


def points(found):
    return {
        learner: (one["marks"][0]["status"], one["marks"][0]["points"])
        for learner, one in found.items()
    }


def test_each_member_gets_the_mark_and_their_own_late_days(graded, tmp_path):
    found, code = graded({"ana": DUE + 1.5 * DAY, "cem": DUE})
    assert points(found) == {
        "ana": ("passed", 8.0),  # two days have begun
        "ben": ("passed", 10.0),  # has an extension of two
        "cem": ("passed", 10.0),
        "di": ("missing", 0.0),
        "eve": ("missing", 0.0),
    }
    assert code == 0
    assert [one["about"] for one in found["ana"]["remarks"]] == ["late"]
    assert [one["about"] for one in found["ben"]["remarks"]] == ["team"]
    assert "Handed in by a team" in (tmp_path / "out/class.html").read_text()


def test_of_what_several_members_handed_in_the_newest_counts(graded):
    found, _ = graded({"ana": DUE - DAY, "ben": DUE - 9 * DAY, "cem": DUE, "di": DUE, "eve": DUE})
    assert "counts for all its members" in found["ben"]["remarks"][0]["text"]
    assert found["ben"]["remarks"][0]["path"] == "ana/03_write.ipynb"
    assert found["ana"]["remarks"] == []


def test_a_folder_of_the_team_is_no_learner(graded):
    found, code = graded({"red": DUE, "cem": DUE, "Blue": DUE + 1})
    assert points(found) == {
        "ana": ("passed", 10.0),
        "ben": ("passed", 10.0),
        "cem": ("passed", 10.0),
        "di": ("passed", 9.0),
        "eve": ("passed", 9.0),
    }
    assert code == 0  # nobody is told not to be on the roster


def test_a_page_of_a_team_that_cannot_be_read_waits_for_all_of_it(graded, tmp_path):
    (tmp_path / "in/ana").mkdir(parents=True)
    (tmp_path / "in/ana/03_write.ipynb").write_text("")
    found, code = graded({"cem": DUE})
    assert points(found)["ana"] == points(found)["ben"] == ("held", 0.0)
    assert code == WAITS


SHARED, ALONE = ("passed", 10.0), ("missing", 0.0)


@pytest.mark.parametrize(
    ("roster", "of_ben"),
    [
        ("id,name,team\nana,Ana,A\nben,Ben,A\n", SHARED),
        ("id,name,group\nana,Ana,A\nben,Ben,A\n", SHARED),
        ("id,name,group\nana,Ana,A\nben,Ben,B\n", ALONE),
        ("id,name,group\nana,Ana,\nben,Ben,\n", ALONE),
        # Groups of a class are no teams: not in an export, and not under another name.
        ("Identifier,Full name,Group\nParticipant ana,Ana,A\nParticipant ben,Ben,A\n", ALONE),
        ("id,name,groups\nana,Ana,A\nben,Ben,A\n", ALONE),
        ("id,name,section\nana,Ana,A\nben,Ben,A\n", ALONE),
    ],
)
def test_only_a_team_shares_its_pages(graded, roster, of_ben):
    found, _ = graded({"ana": DUE}, roster)
    assert points(found) == {"ana": ("passed", 10.0), "ben": of_ben}

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from rosbeat import cli
from rosbeat.exercises.exercise import failed, passed
from rosbeat.exercises.progress import progress_file
from rosbeat.exercises.registry import EXERCISES, PAGES


@pytest.fixture(autouse=True)
def _home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    file = progress_file()
    right = replace(passed(""), points=1)
    file.change("00a", lambda before: before.after(right))
    file.change("00b", lambda before: before.after(failed("00b", "", "", "wrong-rate")))
    file.change("00b", lambda before: replace(before, hints=2, answer=True))


def row(text, exercise):
    return next(line.split() for line in text.splitlines() if f" {exercise} " in line)


def test_the_table_has_every_page_every_exercise_and_the_total(capsys):
    assert cli.main(["progress"]) == 0
    text = capsys.readouterr().out
    assert all(f"\n{page.number} {page.title}\n".lstrip() in text for page in PAGES)
    assert {one for one in EXERCISES if f" {one} " in text} == set(EXERCISES)
    assert row(text, "00a")[0] == "✓"
    assert row(text, "00a")[-5:] == ["1", "of", "1", "1", "0"]
    assert row(text, "00b")[0] == "✗"
    assert "not there yet" in " ".join(row(text, "00b"))
    assert text.count("2 and the answer") == 1
    assert row(text, "01a")[0] == "○"
    assert text.splitlines()[-1].startswith(f"1 of {len(EXERCISES)} exercises passed, 1 of ")


def test_the_same_as_json(capsys):
    assert cli.main(["progress", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert (data["version"], data["passed"], data["points"]) == (1, 1, 1)
    assert [one["exercise"] for one in data["exercises"]] == list(EXERCISES)
    assert data["out_of"] == sum(one.points for one in EXERCISES.values())
    second = data["exercises"][1]
    assert (second["status"], second["mistake"], second["hints"]) == ("failed", "wrong-rate", 2)
    assert (second["page"], second["title"]) == ("00", EXERCISES["00b"].title)


def test_a_file_that_cannot_be_read_is_an_empty_one(capsys):
    progress_file().path.write_text("{")
    assert cli.main(["progress"]) == 0
    assert f"0 of {len(EXERCISES)} exercises passed" in capsys.readouterr().out

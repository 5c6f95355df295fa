"""A rubric is read, filled in, and refused with all that is wrong."""

import json
from importlib.resources import files

import pytest

from rosbeat.errors import ExerciseError
from rosbeat.exercises.greenhouse.days import USUAL
from rosbeat.exercises.greenhouse.rubric import KNOWN, NUMBERS, SETTING, TOTAL, parsed, the_rubric
from rosbeat.exercises.registry import EXERCISES

OWN = files("rosbeat.exercises").joinpath("rubrics/greenhouse.json").read_text(encoding="utf-8")


def changed(edit):
    data = json.loads(OWN)
    edit(data)
    return json.dumps(data)


def number(name, value):
    return changed(lambda data: data["numbers"].update({name: value}))


def row(**values):
    return changed(lambda data: data["requirements"][0].update(values))


def test_the_courses_own_rubric_holds_everything(monkeypatch):
    monkeypatch.delenv(SETTING, raising=False)
    rubric = the_rubric()
    assert [one.id for one in rubric.requirements] == list(KNOWN)
    assert sum(one.points for one in rubric.requirements) == TOTAL == EXERCISES["13b"].points
    assert set(rubric.numbers) == set(NUMBERS)
    assert rubric.numbers == USUAL  # what the trials are made of if nobody names others
    assert not any("{" in one.text for one in rubric.requirements)
    assert "above 28 " in rubric.requirements[0].text


def test_another_one_may_be_named(monkeypatch, tmp_path):
    path = tmp_path / "mine.json"
    path.write_text(number("open_above", 31.5))
    monkeypatch.setenv(SETTING, str(path))
    assert "above 31.5 " in the_rubric().requirements[0].text


def test_one_that_is_not_there_is_refused(monkeypatch, tmp_path, says):
    monkeypatch.setenv(SETTING, str(tmp_path / "none.json"))
    with pytest.raises(ExerciseError) as caught:
        the_rubric()
    says(caught.value, "none.json", SETTING)


def test_a_requirement_may_be_left_out_if_the_points_are_given_to_others():
    def edit(data):
        data["requirements"].pop()
        data["requirements"][0]["points"] += 1

    assert len(parsed(changed(edit), "x").requirements) == len(KNOWN) - 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "not JSON"),
        ("[]", "`numbers` and `requirements`"),
        ('{"numbers": [], "requirements": {}}', "an object"),
        (changed(lambda data: data["numbers"].pop("open_above")), "`open_above` is missing"),
        (number("hue", 3), "no number `hue`"),
        (number("open_above", "28"), "should be a number"),
        (number("open_above", True), "should be a number"),
        (number("pump_seconds", 5.5), "whole number"),
        (number("rest_seconds", 1000), "from 1 to 120"),
        (number("close_below", 28.0), "at least 1 below"),
        (number("open_above", 55.0), "at least 10 above"),
        (number("temperature_min", 20.0), "at least 10 below"),
        (number("dry_below", 5.0), "from 20 to 70"),
        (number("pump_seconds", 4), "above `react_seconds`"),
        (number("silent_seconds", 4), "above `react_seconds`"),
        (number("rest_seconds", 6), "above `react_seconds`"),
        (number("report_seconds", 60), "from 5 to 30"),
        (row(points=4), "add up to 21"),
        (row(points=-1), "none below 0"),
        (row(points="3"), "points (a whole number)"),
        (row(id="R99"), "may stand there once"),
        (row(id="R2"), "may stand there once"),
        (row(text="above {hue}"), "the text of R1"),
        (row(text="above {"), "the text of R1"),
        (changed(lambda data: [r.update(required=False) for r in data["requirements"]]),
         "nothing is required"),
        (changed(lambda data: data.update(requirements=[])), "add up to 0"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(text, said, says):
    with pytest.raises(ExerciseError) as caught:
        parsed(text, "mine.json")
    says(caught.value, "mine.json", said)


def test_all_that_is_wrong_is_said_at_once(says):
    text = changed(lambda data: data["numbers"].update(open_above="x", dry_below=None))
    with pytest.raises(ExerciseError) as caught:
        parsed(text, "mine.json")
    says(caught.value, "`open_above`", "`dry_below`")

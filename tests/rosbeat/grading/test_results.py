"""A gradebook as `results.json`, and back."""

import json
import typing
from dataclasses import fields, replace
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from graded_classes import HOSTILE, a_class, hostile_learner, mark, one_of_each
from rosbeat.errors import RecordError
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Graded, Mark
from rosbeat.grading.remarks import Remark
from rosbeat.grading.results import FORMAT, UNSTEADY, VERSION, from_results, to_results
from rosbeat.records import Part

SCHEMA = json.loads(
    (Path(__file__).resolve().parents[3] / "docs" / "results.schema.json").read_text("utf-8")
)
KINDS = {"learner": Graded, "mark": Mark, "part": Part, "remark": Remark}
TYPES = {str: "string", bool: "boolean", float: "number", int: "integer"}


def complaints(text):
    return [one.message for one in Draft202012Validator(SCHEMA).iter_errors(json.loads(text))]


@pytest.fixture
def one():
    return Gradebook("0.1.0", (one_of_each(),), (Remark("left-out", "a", "b"),))


@pytest.mark.parametrize("size", [0, 1, 30])
def test_what_is_written_is_read_back_and_follows_the_schema(size):
    made = a_class(size)
    assert from_results(to_results(made)) == made
    assert complaints(to_results(made)) == []


def test_every_field_comes_back_but_the_time_that_it_took(one):
    timed = replace(one.learners[0].marks[0], seconds=1.5)
    slower = replace(one, learners=(replace(one.learners[0], marks=(timed,)),))
    back = from_results(to_results(slower)).learners[0].marks[0]
    assert back == replace(timed, seconds=0.0)
    assert "seconds" not in to_results(slower)
    assert complaints(to_results(one)) == []
    assert from_results(to_results(one)) == one


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_comes_back_as_it_was_and_is_ascii_meanwhile(text):
    book = Gradebook("0.1.0", (hostile_learner(text),), (Remark(text, text, text),))
    written = to_results(book)
    assert written.isascii()
    assert not any(one < " " and one != "\n" for one in written)
    assert from_results(written) == book


def test_learners_are_sorted_whatever_came_first(one):
    other = replace(one.learners[0], learner="0815")
    forward = replace(one, learners=(other, one.learners[0]))
    backward = replace(one, learners=(one.learners[0], other))
    assert to_results(forward) == to_results(backward)


def test_equal_points_give_equal_bytes(one):
    def written(points):
        marks = (mark(points=points, judged=points, out_of=2),)
        return to_results(replace(one, learners=(replace(one.learners[0], marks=marks),)))

    assert written(2) == written(2.0)
    assert written(0) == written(-0.0)
    assert written(0.3) == written(0.1 + 0.2)
    assert written(1) != written(2)


def test_another_program_may_write_whole_numbers_without_a_point(one):
    text = to_results(one)
    assert from_results(text.replace(": 1.0", ": 1")) == from_results(text)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (FORMAT, "other", "file of results"),
        (f'"version": {VERSION}', '"version": 99', "version 99"),
        ('"points": 1.0', '"points": "all"', "points"),
        ('"points": 1.0', '"points": true', "points"),
        ('"points": 1.0,', "", "marks"),
        ('"points": 1.0', '"points": 1e999', "endless"),
        ('"points": 1.0', f'"points": {10**400}', "too large"),
        ('"late": false', '"late": 0', "late"),
        ('"manual": false,', '"manual": false, "bonus": 1,', "bonus"),
        ('"learners": [', '"learners": [7, ', "marks"),
        ('"marks": [', '"marks": [[], ', "marks"),
        ('"learners"', '"pupils"', "marks"),
        ("{", "", "JSON"),
    ],
)
def test_what_is_something_else_is_refused(one, old, new, said):
    text = to_results(one)
    assert old in text
    with pytest.raises(RecordError) as caught:
        from_results(text.replace(old, new, 1))
    assert said in str(caught.value)
    assert caught.value.means
    assert caught.value.to_try


@pytest.mark.parametrize("text", ["", "null", "[]", "[" * 100_000, "\ud800", '{"format": NaN}'])
def test_what_is_no_json_of_ours_is_refused(text):
    with pytest.raises(RecordError):
        from_results(text)


# The schema and the records say the same.


@pytest.mark.parametrize("name", KINDS)
def test_the_schema_has_the_fields_of_the_record(name):
    wanted = [one.name for one in fields(KINDS[name]) if one.name not in UNSTEADY]
    assert list(SCHEMA["$defs"][name]["properties"]) == wanted


def test_the_schema_has_the_fields_of_the_gradebook():
    wanted = ["format", "version", *(one.name for one in fields(Gradebook))]
    assert list(SCHEMA["properties"]) == wanted
    assert SCHEMA["properties"]["format"]["const"] == FORMAT
    assert SCHEMA["properties"]["version"]["const"] == VERSION


def test_every_field_is_required_described_and_of_the_record_s_type():
    for name, kind in KINDS.items():
        part = SCHEMA["$defs"][name]
        assert part["required"] == list(part["properties"])
        assert part["additionalProperties"] is False
        hints = typing.get_type_hints(kind)
        for field, said in part["properties"].items():
            assert said["type"] == TYPES.get(hints[field], "array")
            assert len(said["description"]) > 10


def test_the_schema_knows_each_status():
    said = SCHEMA["$defs"]["mark"]["properties"]["status"]["enum"]
    assert set(said) == {PASSED, FAILED, NOT_ATTEMPTED, MISSING, HELD, LOOKED_AT}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"passed"', '"perfect"'),
        ('"points": 1.0', '"points": -1'),
        ('"learner": "4711",', ""),
        ('"late": false', '"seconds": 1.5, "late": false'),
        (f'"version": {VERSION}', '"version": 1'),
    ],
)
def test_the_schema_refuses_what_is_wrong(one, old, new):
    text = to_results(one)
    assert old in text
    assert complaints(text.replace(old, new, 1)) != []


def test_the_schema_is_one():
    Draft202012Validator.check_schema(SCHEMA)

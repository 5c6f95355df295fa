"""The folder of results: `results.json` and back, and what a terminal is told."""

import json
import typing
from dataclasses import fields, replace
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from graded_classes import HOSTILE, a_class, hostile_learner, mark, one_of_each
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Graded, Mark
from rosbeat.grading.platforms import PLATFORMS
from rosbeat.grading.remarks import Remark
from rosbeat.grading.results import (
    FORMAT,
    LEFT_OUT,
    VERSION,
    summary,
    to_results,
)
from rosbeat.records import Part
from rosbeat.records_json import from_json

SCHEMA = json.loads(
    (Path(__file__).resolve().parents[3] / "docs" / "results.schema.json").read_text("utf-8")
)
KINDS = {"learner": Graded, "mark": Mark, "part": Part, "remark": Remark}
TYPES = {str: "string", bool: "boolean", float: "number", int: "integer"}


def complaints(text):
    return [one.message for one in Draft202012Validator(SCHEMA).iter_errors(json.loads(text))]


def read(text):
    return from_json(Gradebook, text, "results")


@pytest.fixture
def one():
    return Gradebook("0.1.0", (one_of_each(),), (Remark("left-out", "a", "b"),))


@pytest.mark.parametrize("size", [0, 1, 30])
def test_what_is_written_is_read_back_and_follows_the_schema(size):
    made = a_class(size)
    assert read(to_results(made)) == made
    assert complaints(to_results(made)) == []


@pytest.mark.parametrize("system", [*(platform.name for platform in PLATFORMS), "seventh"])
def test_the_schema_takes_learners_of_every_platform(one, system):
    learners = tuple(replace(graded, system=system) for graded in one.learners)
    assert complaints(to_results(replace(one, learners=learners))) == []


def test_the_guide_for_instructors_has_every_platform():
    text = (Path(__file__).resolve().parents[3] / "docs/instructors.md").read_text("utf-8")
    for platform in PLATFORMS:
        if not platform.has_free_names:
            assert f"- **{platform.title}:** " in text
            assert f"`{platform.name}.csv`" in text


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_comes_back_as_it_was_and_is_ascii_meanwhile(text):
    graded = hostile_learner(text)
    book = Gradebook("0.1.0", (graded,), (Remark(text, text, text),))
    written = to_results(book)
    assert written.isascii()
    assert not any(one < " " and one != "\n" for one in written)
    marks = tuple(replace(one, source="", trace="") for one in graded.marks)
    assert read(written) == replace(book, learners=(replace(graded, marks=marks),))


def test_equal_classes_give_equal_bytes(one):
    ana = one.learners[0]
    other = replace(ana, learner="0815")
    both = [to_results(replace(one, learners=some)) for some in ((other, ana), (ana, other))]
    assert both[0] == both[1]

    def written(points):
        marks = (mark(points=points, judged=points, out_of=2),)
        return to_results(replace(one, learners=(replace(ana, marks=marks),)))

    assert written(2) == written(2.0) != written(1)
    assert written(0) == written(-0.0)
    assert written(0.3) == written(0.1 + 0.2)


# The schema and the records say the same.


def written(name, kind):
    """The fields of a record that are in results.json."""
    return [one.name for one in fields(kind) if one.name not in LEFT_OUT.get(name, ())]


def test_the_schema_has_the_fields_of_the_records_and_their_types():
    Draft202012Validator.check_schema(SCHEMA)
    assert list(SCHEMA["properties"]) == ["format", "version", *written("class", Gradebook)]
    assert SCHEMA["properties"]["format"]["const"] == FORMAT
    assert SCHEMA["properties"]["version"]["const"] == VERSION
    for name, kind in KINDS.items():
        part = SCHEMA["$defs"][name]
        assert list(part["properties"]) == part["required"] == written(name, kind)
        assert part["additionalProperties"] is False
        hints = typing.get_type_hints(kind)
        for field, said in part["properties"].items():
            assert said["type"] == TYPES.get(hints[field], "array")
            assert len(said["description"]) > 10
    said = SCHEMA["$defs"]["mark"]["properties"]["status"]["enum"]
    assert set(said) == {PASSED, FAILED, NOT_ATTEMPTED, MISSING, HELD, LOOKED_AT}


# What a terminal is told.

OUT = Path("GRADES")


def book(*marks, remarks=(), own=()):
    return Gradebook("0.1.0", (Graded("ana", "Ana", "folder", marks, own),), remarks)


def test_learners_exercises_and_outcomes_are_counted():
    marks = (mark(), mark("03b", "failed"), mark("03c", "failed"), mark("04a", "not attempted"),
             mark("04b", "missing"))  # fmt: skip
    lines = summary(book(*marks), OUT).splitlines()
    assert lines[0] == (
        "1 learner, 5 exercises: 1 right, 2 wrong, 1 not attempted, 1 not handed in."
    )
    assert lines[1] == "On average 1 of 5 points."
    assert "GRADES" in lines[-1]
    assert len(lines) == 3
    told = summary(book(mark(), mark("03b", "looked at")), OUT)
    assert "1 right, 1 looked at by you." in told
    assert summary(Gradebook("0.1.0", ()), OUT).startswith("No learners, no exercises: nothing")
    assert len(summary(a_class(300), OUT).splitlines()) <= 8


def test_whoever_has_no_grade_or_waits_for_a_person_is_not_in_the_average():
    ana = book(mark(points=2.0, out_of=2.0)).learners[0]
    absent = replace(ana, learner="cy", marks=(mark("03a", "missing", points=0.0),), excused=True)
    told = summary(replace(book(), learners=(ana, absent)), OUT)
    assert "2 learners" in told
    assert "On average 2 of 2 points." in told
    held = mark(status="held", points=0.0, out_of=2.0, answer="import os", file="x")
    ben = replace(ana, learner="ben", marks=(held,))
    told = summary(replace(book(), learners=(ana, ben)), OUT)
    assert "On average 2 of 2 points, without 1 learner of whom something is held." in told
    assert "On average" not in summary(replace(book(), learners=(ben,)), OUT)


def test_remarks_about_files_are_counted_and_lines_by_hand_are_shown():
    late = Remark("late", "a", "b")
    by_hand = Remark("manual", "manual.csv, line 7", "There is no learner 'x'.")
    line = Remark("roster", "roster.csv, line 2", "Nobody is called so.")
    told = summary(replace(book(mark()), remarks=(line,)), OUT)
    assert "roster.csv, line 2: Nobody is called so." in told
    assert "about files" not in told
    told = summary(
        book(mark(), remarks=(by_hand, Remark("left-out", "a", "b")), own=(late,) * 2), OUT
    )
    assert "3 remarks about files: 2 late, 1 left-out." in told
    assert "manual.csv, line 7: There is no learner 'x'." in told
    assert "and 15 more" in summary(book(remarks=(by_hand,) * 20), OUT)


@pytest.mark.parametrize("text", [*HOSTILE, "x\x1b]0;title\x07", "\u009b31m"])
def test_no_text_reaches_the_terminal_as_it_is(text):
    remarks = tuple(Remark(about, text, text) for about in ("manual", text))
    told = summary(Gradebook("0.1.0", (hostile_learner(text),), remarks), Path(text or "out"))
    assert all(line.isprintable() for line in told.split("\n"))
    assert len(told) < 6_000
    assert len(told.splitlines()) <= 12

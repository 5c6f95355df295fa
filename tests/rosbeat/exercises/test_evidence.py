"""Evidence as text: what a judge says does not depend on whether it was written down."""

import json
import shutil
from pathlib import Path

import pytest
from answers import HUMIDITY, made  # the folder is put on the path by conftest.py

from bank.pages import solution
from rosbeat.errors import RecordError
from rosbeat.exercises.check import EXERCISES
from rosbeat.exercises.evidence import KINDS, VERSION, from_json, to_json
from rosbeat.exercises.scenarios import TypedIn
from rosbeat.records import Outcome, ProgramRun

pytestmark = pytest.mark.ros

FINISHED = Path(__file__).parents[3] / "solutions" / "sensor_simulator"
TYPED = TypedIn("src", (("resources/images", "cd ../../src"), ("src", "pwd")), None, "$ ...\n")
SWAPPED, BLANK = ('Float32, "humidity"', '"humidity", Float32'), ('"humidity"', "____")
NODES = (
    made("04a", solution("04a")),
    made("03a", HUMIDITY, SWAPPED),
    made("03a", HUMIDITY, BLANK),
    None,
)


def looked_at(exercise, place):
    """What the scenario of each exercise sees of something."""
    if exercise.id[:2] in ("00", "03", "04"):
        return [exercise.observed(node) for node in NODES]
    kind = exercise.scenario.__name__
    if kind in ("call", "_call"):
        return [exercise.observed(one) for one in (lambda *words: "=".join(words), None)]
    if exercise.id == "01b":
        return [TYPED]
    empty = place / "empty"
    empty.mkdir(exist_ok=True)
    shutil.copytree(FINISHED, place / "src" / "sensor_simulator", dirs_exist_ok=True)
    return [
        exercise.observed(one) for one in ((empty,) if exercise.id == "system" else (place, empty))
    ]


@pytest.mark.parametrize("name", EXERCISES)
def test_a_judge_says_the_same_of_what_was_written_and_read(name, tmp_path):
    exercise = EXERCISES[name]
    for seen in looked_at(exercise, tmp_path):
        text = to_json(seen)
        again = from_json(text)
        assert again == seen
        assert to_json(again) == text
        assert exercise.judged(again) == exercise.judged(seen)
        assert json.loads(text)["kind"] == type(seen).__name__


def text_with(**changes):
    return json.dumps({**json.loads(to_json(ProgramRun("a", "b", 0))), **changes})


@pytest.mark.parametrize(
    "text",
    [
        "", "[]", "{}", text_with(format="x"), text_with(version=VERSION + 1),
        text_with(version=True), text_with(kind="Secret"), text_with(kind=None),
        text_with(kind=["ProgramRun"]), text_with(kind="Workspace"), text_with(exit_code="0"),
        text_with(exit_code=1.5), text_with(ended_early=0), text_with(output=None),
    ],
    ids=range(14),
)  # fmt: skip
def test_anything_else_is_refused(text, says):
    with pytest.raises(RecordError) as caught:
        from_json(text)
    says(caught.value)


def test_only_evidence_is_written(says):
    with pytest.raises(RecordError) as caught:
        to_json(Outcome("03a", "passed"))
    says(caught.value, "Outcome", *KINDS)

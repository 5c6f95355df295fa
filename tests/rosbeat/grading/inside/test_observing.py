"""A cell is run as on its page, and what it hands over is what its check would get."""

import json
import os

import pytest

from rosbeat.errors import ExerciseError
from rosbeat.grading.inside.observing import CELL, fault_of, subject_of, writer
from rosbeat.grading.jobs import Job

IMPORTS = "import rclpy\nfrom rclpy.node import Node\nfrom rosbeat import check, Session"


def subject(answer, expression="Beat", **more):
    return subject_of(Job("03a", expression, answer, imports=IMPORTS, **more))


def fault(answer, expression="Beat", **more):
    try:
        found = subject(answer, expression, **more)
    except BaseException as error:
        return fault_of(error, answer)
    raise AssertionError(f"the cell has handed over {found!r}")


def test_what_the_check_hands_over_is_found():
    assert subject("class Beat(Node):\n    pass").__name__ == "Beat"
    assert subject("x = 3", "x + 1") == 4


def test_parts_run_before_the_answer():
    assert subject("Beat = (A, B)", parts=("A = 1", "B = A + 1")) == (1, 2)


def test_other_cells_define_what_is_missing():
    assert subject("Beat = LIMIT", earlier=("LIMIT = 5\nprint(1 / 0)",)) == 5


def test_what_was_there_before_a_cell_failed_counts_as_on_a_page():
    assert subject("Beat = 1\n1 / 0") == 1
    assert subject("Beat = 1\nimport sys\nsys.exit()") == 1
    assert subject("Beat = 1\nraise SystemExit(3)\nBeat = 2") == 1
    assert subject("Beat = 2", parts=("1 / 0",)) == 2


@pytest.mark.parametrize(
    ("answer", "raised", "line", "code"),
    [
        ("x = 1\n1 / 0\nBeat = 1", "ZeroDivisionError", 2, "1 / 0"),
        ("class Beat(Node:\n    pass", "SyntaxError", 1, "class Beat(Node:"),
        ("exit()", "SystemExit", 1, "exit()"),
        ("def f():\n    boom\nf()", "NameError", 2, "boom"),
        ("x = 1", "NameError", 0, ""),
        ("raise KeyboardInterrupt", "KeyboardInterrupt", 1, "raise KeyboardInterrupt"),
        ("import json\njson.loads('')", "JSONDecodeError", 2, "json.loads('')"),
        ("x = '\0'", "SyntaxError", 0, ""),
    ],
)
def test_a_cell_that_cannot_be_run_says_where(answer, raised, line, code):
    found = fault(answer)
    assert found["raised"] in (raised, "ValueError")  # a zero byte is a ValueError up to 3.11
    assert (found["line"], found["code"]) == (line, code)
    assert isinstance(found["text"], str)


def test_a_message_that_cannot_be_had_is_left_out():
    answer = "class E(Exception):\n    def __str__(self):\n        1 / 0\nraise E"
    assert fault(answer)["text"] == ""


def test_a_long_message_is_cut():
    assert len(fault("raise ValueError('x' * 100_000)")["text"]) == 1_000


def test_the_cell_has_a_name_of_its_own():
    assert fault(f"raise ValueError('{CELL}')")["line"] == 1


def test_what_is_written_bears_the_seal():
    reading, writing = os.pipe()
    writer("seal", writing)({"evidence": "é\ud800"})
    with os.fdopen(reading, encoding="utf-8") as file:
        text = file.read()
    assert text.startswith("seal{")
    assert json.loads(text.removeprefix("seal")) == {"evidence": "é\ud800"}


def test_an_exercise_that_is_none_is_refused():
    from rosbeat.grading.inside.observing import observe_job

    with pytest.raises(ExerciseError):
        observe_job(Job("99z", "x", "x = 1"), (), "seal", -1)

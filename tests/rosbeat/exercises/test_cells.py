"""A check knows what it judges: real kernels, with what JupyterLab sends beside a cell's code."""

from __future__ import annotations

import re

import pytest
from answers import HUMIDITY, edited  # the folder is put on the path by conftest.py

from torture.kernel import Kernel

pytestmark = pytest.mark.ros

IMPORTS = """
from rclpy.node import Node
from std_msgs.msg import Float32
from rosbeat import check, hint, predict, workspace
def told(*given):
    outcome = check(*given).outcome
    print(outcome.status, outcome.evidence)
"""
RIGHT = edited(HUMIDITY).strip("\n") + "\n"
OTHER_NAME = RIGHT.replace("HumiditySensor", "HumiditySensr")
BROKEN = RIGHT.replace("def publish_humidity(self):", "def publish_humidity(self)")
RAISES = f"{RIGHT}\n\nraise ValueError('too late')\n"
RAISES_FIRST = f"raise ValueError('too early')\n\n{RIGHT}"
BLANK = RIGHT.replace("class HumiditySensor(Node):", "class HumiditySensor(Node):\n    rate = ____")
ASK = 'one = check("03a", HumiditySensor).outcome\nprint(one.status, one.evidence)'
EXERCISE, SCRATCH, CHECK = "exercise", "scratch", "check"


@pytest.fixture(scope="module")
def shared():
    with Kernel() as kernel:
        assert kernel.run(IMPORTS).error == ""
        yield kernel


@pytest.fixture
def page(shared, tmp_path):
    """Run cells as JupyterLab does: `(id, source)`; the id `exercise` is that of exercise 03a."""
    shared.run(
        f"import os; os.environ['ROSBEAT_STEADY_HOME'] = {str(tmp_path)!r}\n"
        "for name in ('HumiditySensor', 'HumiditySensr'): globals().pop(name, None)\n"
        "from rosbeat.exercises import cells\n"
        "cells.cells_of().__init__(get_ipython()); cells.cells_of().begin("
        "type('Info', (), {'raw_cell': ''}))"
    )

    def run(*cells, **sent):
        for cell, source in cells:
            marks = {"rosbeat": {"exercise": "03a"}} if cell.startswith(EXERCISE) else {}
            reply = shared.run(source, {"cellId": cell, **marks, **sent} if cell else None)
        return reply

    return run


def refused(reply):
    return reply.error == "ExerciseError"


# What is stopped.


@pytest.mark.parametrize(
    ("later", "said"),
    [
        (BROKEN, "(line 7: SyntaxError: expected ':')"),
        (RAISES_FIRST, "(line 1: ValueError: too early)"),
    ],
)
def test_a_cell_that_failed_gets_no_verdict_for_what_was_there_before(page, later, said):
    reply = page((EXERCISE, RIGHT), (EXERCISE, later), (CHECK, ASK))
    assert refused(reply)
    assert f"The cell above did not run {said}." in reply.trace
    assert "What it means:" in reply.trace
    assert "What to try:" in reply.trace
    counted = (
        "from rosbeat.exercises.progress import progress_file as f\nprint(dict(f().standings()))"
    )
    assert page(("", counted)).text == "{}\n"


def test_another_name_is_told(page):
    reply = page((EXERCISE, RIGHT), (EXERCISE, OTHER_NAME), (CHECK, ASK))
    assert refused(reply)
    assert "You checked `HumiditySensor`, which an earlier run of the cell defined" in reply.trace
    assert "the last run of the cell defined `HumiditySensr`" in reply.trace


def test_a_blank_is_named_and_nothing_from_before_is_judged(page):
    reply = page((EXERCISE, RIGHT), (EXERCISE, BLANK), (CHECK, ASK))
    assert reply.text.startswith("not attempted There is still a blank, ____,")


# What is not stopped.

SUBCLASS = "class Quick(HumiditySensor):\n    pass\n"
FINE = {
    "once": [(EXERCISE, RIGHT)],
    "twice": [(EXERCISE, RIGHT), (EXERCISE, RIGHT)],
    "defined, and something raised below it": [(EXERCISE, RAISES)],
    "defined elsewhere after the cell failed": [(EXERCISE, BROKEN), (SCRATCH, RIGHT)],
    "moved to another cell, with a helper class that fails": [
        (EXERCISE, "class Helper(Node)\n    pass"), (SCRATCH, RIGHT)],
    "a helper class elsewhere": [(EXERCISE, RIGHT), (SCRATCH, SUBCLASS)],
    "a helper class elsewhere that fails": [(EXERCISE, RIGHT), (SCRATCH, "class A(Node)\n  pass")],
    "moved to another cell": [(EXERCISE, RIGHT), (SCRATCH, RIGHT), (EXERCISE, SUBCLASS)],
    "a helper class beside it": [(EXERCISE, RIGHT), (EXERCISE, RIGHT + SUBCLASS)],
    "an emptied cell": [(SCRATCH, RIGHT), (EXERCISE, "# moved")],
    "a cell of one's own used for this and that": [(SCRATCH, RIGHT), (SCRATCH, "1 / 0")],
    "a cell of one's own with another class": [(SCRATCH, RIGHT), (SCRATCH, OTHER_NAME)],
    "a front end that sends no ids": [("", RIGHT), ("", BROKEN)],
    "a cell that runs another one": [(EXERCISE, f"get_ipython().run_cell('1 / 0')\n{RIGHT}")],
}  # fmt: skip


@pytest.mark.parametrize("cells", FINE.values(), ids=FINE)
def test_other_ways_to_work_are_not_stopped(page, cells):
    reply = page(*cells, (CHECK, ASK))
    assert reply.text.startswith("passed"), reply


# Files of the workspace.

SAVE = "%%save src/sensor_simulator/sensor_simulator/helper.py\n"
LOOK = 'told("02b", workspace.folder())'


def test_a_file_that_was_not_saved_gets_no_verdict(page):
    marks = {"rosbeat": {"exercise": "02b"}}
    page((SCRATCH, SAVE + "x = 1\n"), **marks)
    assert not refused(page((CHECK, LOOK)))
    page((SCRATCH, SAVE + "%matplotlib inline\nx = 2\n"), **marks)
    reply = page((CHECK, LOOK))
    assert refused(reply)
    assert "The cell above did not save helper.py (Nothing was saved:" in reply.trace
    page((SCRATCH, SAVE + "x = ____\n"), **marks)
    assert page((CHECK, LOOK)).text.startswith("not attempted There is still a blank")


def test_a_file_that_was_changed_by_hand_later_is_judged(page, tmp_path):
    marks = {"rosbeat": {"exercise": "02b"}}
    page((SCRATCH, SAVE + "x = 1\n"), (SCRATCH, SAVE + "x = ____\n"), **marks)
    (file,) = tmp_path.rglob("helper.py")
    file.write_text("x = 3\n")
    file.touch()
    assert "still a blank" not in page((CHECK, LOOK)).text


# The buttons below a card, as the browser presses them.

PRESS = """
from rosbeat.exercises.cells import cells_of
def press(what):
    (buttons,) = cells_of().widgets["check"]
    buttons._hear({"do": what})
    print(buttons.done, buttons.passed, buttons.said)
"""
SHALLOW = RIGHT.replace('"humidity", 5', '"humidity", 6')
CARD = 'check("03a", HumiditySensor)'


def test_buttons_below_a_card_help_and_judge_anew(page):
    page((EXERCISE, SHALLOW), (CHECK, CARD), ("", PRESS))
    assert "Hint 1 of" in page(("", "press('hint')")).text
    assert "Hint 2 of" in page(("", "press('hint')")).text
    assert "The answer to" not in page(("", "for _ in range(5): press('hint')")).text
    answer = page(("", "press('answer')")).text
    assert "The answer to exercise 03a" in answer
    assert "class HumiditySensor" in re.sub("<[^>]*>", "", answer)  # its code is in colour
    page((EXERCISE, BROKEN))
    said = page(("", "press('again')")).text
    assert "False" in said
    assert "The cell above did not run (line 7: SyntaxError" in said
    page((EXERCISE, RIGHT))
    said = page(("", "press('again')")).text
    assert said.startswith("10 True Checked the cell above as it last ran: passed.")


def test_a_button_says_what_went_wrong(page):
    page((EXERCISE, SHALLOW), (CHECK, CARD), ("", PRESS), ("", "del HumiditySensor"))
    said = page(("", "press('again')")).text
    assert "NameError: name " in said
    assert "is not defined" in said
    assert page(("", "press('something else')")).error == ""


def test_a_cell_that_runs_again_or_is_deleted_closes_its_buttons(page):
    page((EXERCISE, SHALLOW), (CHECK, CARD), ("", PRESS), ("", "old = cells_of().widgets['check']"))
    page((CHECK, CARD))
    new = "new = cells_of().widgets['check']; print(old[0].comm, new[0].comm is None)"
    assert page(("", new)).text == "None False\n"
    page((SCRATCH, "1"), deletedCells=[CHECK])
    assert page(("", "print(new[0].comm)")).text == "None\n"


CHOOSE = """
(buttons,) = cells_of().widgets["quiz"]
buttons._hear({"do": "choose", "question": 0, "choice": 1})
print([one["chosen"] for one in buttons.questions], buttons.questions[0])
"""


def test_a_choice_of_a_quiz_is_answered_as_html(page):
    page(("quiz", "from rosbeat import quiz\nquiz('04')"), ("", PRESS))
    said = page(("", CHOOSE)).text
    assert said.startswith("[1, None, None] {'id': '04.1', 'sign': ")
    assert "'reason': ''" not in said
    assert "`" not in said


INTERRUPTS = """
import signal
before = signal.getsignal(signal.SIGINT)
(buttons,) = cells_of().widgets["check"]
buttons._actions["again"] = lambda sent: signal.raise_signal(signal.SIGINT)
press("again")
print(signal.getsignal(signal.SIGINT) is before)
"""


def test_interrupt_ends_what_a_button_does(page):
    page((EXERCISE, SHALLOW), (CHECK, CARD), ("", PRESS))
    said = page(("", INTERRUPTS)).text
    assert "You stopped it." in said
    assert said.endswith("\nTrue\n")


# Nothing said means what was worked on last.


def test_nothing_said_means_the_exercise_whose_cell_ran_last(page):
    assert page((SCRATCH, "told()")).error == "ExerciseError"
    page((EXERCISE, RIGHT))
    assert page((SCRATCH, "told()")).text.startswith("passed")
    assert "for exercise 03a" in page((SCRATCH, "print(hint())")).text


def test_nothing_said_means_what_was_checked_last_as_it_is_now(page):
    shallow = RIGHT.replace('"humidity", 5', '"humidity", 6')
    assert page(("", shallow), ("", ASK)).error == ""
    assert page(("", "told()")).text.startswith("failed")
    assert page(("", RIGHT), ("", "told()")).text.startswith("passed")
    assert page(("", 'told("03a")')).text.startswith("passed")


def test_an_unknown_exercise_is_answered_with_those_of_the_page_that_was_worked_on(page):
    page((EXERCISE, RIGHT))
    reply = page((SCRATCH, 'hint("03z")'))
    assert refused(reply)
    assert "The exercises on this page are: 03a (" in reply.trace


# A prediction and its first outcome.

COUNT = "count = 0\ndef step():\n    global count\n    count += 1\n    return count"
ASKS = 'print(predict("____", step()))'
GUESSES = "print(predict('{}', step()))"


@pytest.mark.parametrize("between", [
    (),
    (("below", "count = 10"),),
    (("prediction", ASKS),) * 3,
    (("above", COUNT),),  # the same beginning again
    ((EXERCISE, "____"), (EXERCISE, "a = 1"), (CHECK, "a")),
])  # fmt: skip
def test_the_first_outcome_of_a_prediction_stays(page, between):
    asked = page(("above", COUNT), (EXERCISE, "a = 0"), ("other", ASKS), ("prediction", ASKS))
    assert "It was 2." in asked.text
    guess = GUESSES.format(2)
    told = page(*between, ("other", GUESSES.format(7)), ("prediction", guess)).text
    assert "✓ You predicted 2, and it was 2." in told
    assert "✗ You predicted 3, and it was 2." in page(("prediction", GUESSES.format(3))).text


@pytest.mark.parametrize(("cell", "text"), [
    ("above", COUNT.replace("+= 1", "+= 5")),
    ("prediction", "print(predict('____', step() + 4))"),
])  # fmt: skip
def test_a_learner_who_changes_the_cell_or_one_above_begins_anew(page, cell, text):
    page(("above", COUNT), ("prediction", ASKS), (cell, text))
    last = ASKS if cell == "above" else text
    assert "It was 1." not in page(("prediction", last)).text


def test_where_cells_have_no_ids_a_prediction_has_the_present_outcome(page):
    page(("", COUNT), ("", ASKS))
    assert "it was 2." in page(("", GUESSES.format(2))).text

"""Page 04: what a learner reads of a mistake, and whether its models can be told apart.

Which answers pass, and what each mistake is called, is in the bank of answers.
"""

import pytest
from suspects import assert_told_apart  # the folder is put on the path by conftest.py

from bank.answer import edited
from bank.nodes import alarm_right, fridge_right, hysteresis_right
from bank.running import outcome_of
from rosbeat.exercises import page_04

MODELS = {
    "04a": (page_04.FRIDGE, page_04._each(page_04._state), page_04.FRIDGE_SUSPECTS),
    "04b": (page_04.ROOM, page_04._alerts(), page_04.ROOM_SUSPECTS),
    "04c mean": (page_04.HYSTERESIS, page_04._means(), page_04.MEAN_SUSPECTS),
    "04c status": (page_04.HYSTERESIS, page_04._statuses(), page_04.STATUS_SUSPECTS),
}


@pytest.mark.parametrize("name", MODELS)
def test_each_suspect_differs_from_the_right_model_and_from_other_mistakes(name):
    assert_told_apart(*MODELS[name])


BASES = {"04a": fridge_right.BASE, "04b": alarm_right.BASE, "04c": hysteresis_right.BASE}
TOLD = [
    ("04a", ("temp > 8.0", "temp >= 8.0"), "For a reading of 8 the node said Warm. Exactly 8"),
    ("04a", ("{status}", "Warm or Frost"), "For a reading of 5 the node said Warm and Frost."),
    ("04a", ("self.get_logger", "print if True else self.get_logger"), "nothing was logged"),
    ("04a", ("{status}", "{status.upper()}"), "capitals count"),
    ("04a", ("temp = msg.data", "temp = int(msg.data)"), "Whole degrees are too coarse"),
    ("04b", ("> 26.0", ">= 26.0"), "for a reading of 26. Publish only"),
    ("04b", (" or msg.data < 20.0", ""), "No alert for a reading of 19.9844. Low readings"),
    ("04b", (alarm_right._SEND, f"[{alarm_right._SEND} for _ in 'ab']"), "14 alerts for 7"),
    ("04b", ('"alert"', '"alerts"'), "The node publishes on /alerts"),
    ("04c", ("[-5:]", "[-4:]"), "of the last five it is 24.003. The last readings were 22, 25.5"),
    ("04c", ("[-5:]", "[-4:]"), "It is the mean of the last 4 readings."),
    ("04c", ("self.status = new\n", "pass\n"), "Normal was published, and High was due"),
    ("04c", ("value < 25.0", "value < 24.0"), "far enough back"),
    ("04a", ("{status}", "None"), "A function that ends without return gives None."),
    ("04a", ("{status}", "{[status]}"), "A list with a word in it is not the word."),
    ("04b", (alarm_right._SEND, f"{alarm_right._SEND}\n            return\n        self.alerts."
             "publish(String(data='OK'))"), "'OK' was published on /alert for a reading of 22."),
    ("04b", ("msg.data < 20.0", "20.0"), "each side of `or` needs a comparison of its own"),
]  # fmt: skip


@pytest.mark.ros
@pytest.mark.parametrize(("exercise", "edit", "said"), TOLD)
def test_a_mistake_shows_where_right_and_done_part(exercise, edit, said):
    text = edited(BASES[exercise], edit)
    outcome = outcome_of(exercise, text, text.split("class ")[1].split("(")[0])
    assert outcome.status == "failed"
    assert said in f"{outcome.evidence} {outcome.hint}", outcome

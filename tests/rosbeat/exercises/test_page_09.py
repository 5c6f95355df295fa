"""Page 09: what a learner reads of a mistake, and whether its models can be told apart.

Which answers pass, and what each mistake is called, is in the bank of answers.
"""

import threading
from dataclasses import replace

import pytest
from suspects import assert_told_apart  # the folder is put on the path by conftest.py

from bank.answer import edited
from bank.beyond import anywhere_right, silence_right, worker_wrong
from bank.running import namespace_of, outcome_of
from rosbeat.exercises import page_09
from rosbeat.exercises.check import check
from rosbeat.exercises.page_09 import GREENHOUSE, HOME, PORCH, READINGS, WORK


def test_each_suspect_of_a_silence_can_be_told_apart():
    assert_told_apart(READINGS, page_09._watch(), page_09.SILENCE_SUSPECTS)


@pytest.mark.parametrize("work", [WORK, 3.5])
def test_each_suspect_of_a_worker_can_be_told_apart(work):
    assert_told_apart(work, page_09._worker(), page_09.WORK_SUSPECTS)


@pytest.mark.parametrize("suspect", [page_09.TOO_SHORT, page_09.TOO_LONG])
def test_work_of_another_length_is_not_right(suspect):
    assert suspect.model(WORK + 1) != suspect.model(WORK)


def test_each_suspect_of_a_place_can_be_told_apart():
    # Elsewhere, limits that stay at their defaults are right, or cannot be told from each other.
    assert_told_apart(GREENHOUSE, page_09._words(), page_09.PLACE_SUSPECTS)


@pytest.mark.parametrize("place", [HOME, PORCH])
def test_limits_that_no_parameter_changes_are_right_where_they_are_the_defaults(place):
    fixed = [one for one in page_09.PLACE_SUSPECTS if one.mistake == "limits-fixed"]
    at_default = replace(place, low=20.0, high=26.0)
    assert all(one.model(at_default) == page_09._words()(at_default) for one in fixed)


BASES = {"09a": silence_right.BASE, "09b": worker_wrong.TIMED, "09c": anywhere_right.BASE}
TOLD = [
    ("09a", (">= 3.0", ">= 5.0"), "Lost was due, and the node said lost at 17 s."),
    ("09a", (">= 3.0", ">= 2.0"), "Nothing was due, and the node said lost at 9.5 s."),
    ("09a", ('self.statuses.publish(String(data="back"))', "pass"),
     "Back was due, and the node said nothing."),
    ("09b", ("create_timer(3.0", "create_timer(3.4"), "order 7 was done at 5.9 s"),
    ("09b", ("create_timer(3.0", "create_timer(2.9"), "The work itself takes 3 s."),
    ("09b", ("self.waiting.append(msg.data)", "self.waiting = self.waiting[:2] + [msg.data]"),
     "has to wait somewhere"),
    ("09b", ("self.waiting.append(msg.data)", "self.waiting = self.waiting or [msg.data]"),
     "No order could wait. An order that comes while another one is worked on has to wait "
     "somewhere. Or: When one order was done, all others were gone."),
    ("09b", ("self.waiting.pop(0)", "self.waiting.pop()"), "The newest came first."),
    ("09c", ("{word}", "{word.upper()}"), "Capitals count."),
    ("09c", (".1f} {", ".1f}{"), "with a space between them"),
    ("09c", ('f"{word}', '"{word}'), "The braces are still there"),
    ("09c", (".1f", ".0f"), "Of 27.5 it said 'High 28 C'."),
    ("09c", ('self.value_of("high")', "26.0"), "The parameter high changed nothing."),
]  # fmt: skip


@pytest.mark.ros
@pytest.mark.parametrize(("exercise", "edit", "said"), TOLD)
def test_a_mistake_shows_where_right_and_done_part(exercise, edit, said):
    text = edited(BASES[exercise], edit)
    outcome = outcome_of(exercise, text, text.split("class ")[1].split("(")[0])
    assert outcome.status == "failed"
    assert said in f"{outcome.evidence} {outcome.hint}", outcome


@pytest.mark.ros
def test_what_is_taken_out_of_an_empty_list_is_told_so():
    stop = "        if not self.waiting:\n            self.oven.cancel()"
    text = edited(worker_wrong.TIMED, (stop, "        pass"))
    outcome = outcome_of("09b", text, "Worker")
    assert (outcome.mistake, "The list is empty" in outcome.evidence) == ("index-error", True)


@pytest.mark.ros
def test_the_parameter_that_is_missing_is_named():
    text = edited(anywhere_right.BASE, ('"unit"', '"units"'), ("'unit'", "'units'"))
    assert "no parameter unit." in outcome_of("09c", text, "AnyMonitor").evidence


@pytest.mark.ros
def test_a_thread_that_raises_after_the_check_prints_nothing(capsys):
    space = namespace_of("09b", edited(worker_wrong._THREAD, ("0.2", "GATE.wait()")), "<thread>")
    space["time"] = type("Time", (), {"sleep": staticmethod(lambda _: None)})
    space["GATE"] = gate = threading.Event()
    before = set(threading.enumerate())
    check("09b", space["Worker"])
    left = set(threading.enumerate()) - before
    gate.set()
    for thread in left:
        thread.join(5)
    assert left
    assert "Traceback" not in capsys.readouterr().err

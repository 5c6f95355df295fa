"""How an outcome is told where nbgrader runs the page, judged by the rules that nbgrader has."""

import pytest
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from rosbeat.exercises.cards import MIME, Shown
from rosbeat.exercises.check import NotPassedError, for_nbgrader
from rosbeat.records import Outcome, Part

RIGHT = Outcome("03a", "passed", "Ten readings.", points=2, out_of=2)
PARTS = (Part("R1", "It opens.", True, "", 12), Part("R2", "It shuts.", False, "It stays open.", 8))
HALF = Outcome("13b", "failed", "One of two.", "Look.", points=12, out_of=20, parts=PARTS)
WRONG = Outcome("03a", "failed", "Five readings.", "Halve it.", "wrong-rate", 0, 2)
BLANK = Outcome("03a", "not attempted", "There is still a blank.", out_of=2)


@pytest.fixture(autouse=True)
def shell():
    """An IPython of the test's own."""
    yield InteractiveShell.instance()
    InteractiveShell.clear_instance()


def bundle(shown, shell):
    """What Jupyter makes of a cell's last value; empty if the value shows itself."""
    return shell.display_formatter.format(shown)[0]


@pytest.mark.parametrize("execution", ["autograde", "validate"])
def test_all_points_are_shown_and_leave_no_result(execution, shell):
    with capture_output() as seen:
        assert bundle(for_nbgrader(RIGHT, execution), shell) == {}
    (output,) = seen.outputs
    assert output.data["text/plain"] == str(Shown(RIGHT))
    assert output.data[MIME]["points"] == 2


def test_some_points_are_a_number_and_words_beside_it(shell):
    made = bundle(for_nbgrader(HALF, "autograde"), shell)
    assert float(made["text/plain"]) == 12
    assert made["text/html"] == Shown(HALF).html()


@pytest.mark.parametrize("outcome", [WRONG, BLANK])
def test_no_points_are_an_error_and_the_words_above_it(outcome):
    with capture_output() as seen, pytest.raises(NotPassedError) as caught:
        for_nbgrader(outcome, "autograde")
    assert [output.data["text/html"] for output in seen.outputs] == [Shown(outcome).html()]
    assert caught.value._render_traceback_() == ["Exercise 03a: 0 of 2 points."]


@pytest.mark.parametrize("outcome", [WRONG, BLANK, HALF])
def test_a_learner_who_validates_reads_everything_in_lines_that_are_not_cut(outcome):
    with capture_output() as seen, pytest.raises(NotPassedError) as caught:
        for_nbgrader(outcome, "validate")
    lines = caught.value._render_traceback_()
    assert not seen.outputs
    assert max(map(len, lines)) <= 80
    assert " ".join(" ".join(lines).split()) == " ".join(str(Shown(outcome)).split())


def test_long_lines_are_wrapped_and_set_in():
    long = Outcome("03a", "failed", "word " * 40, "hint " * 40, "wrong-rate", 0, 2)
    with pytest.raises(NotPassedError) as caught:
        for_nbgrader(long, "validate")
    lines = caught.value._render_traceback_()
    assert max(map(len, lines)) <= 80
    assert lines[0].startswith("✗ Exercise 03a")
    assert all(line.startswith("  ") for line in lines[1:])

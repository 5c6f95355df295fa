"""Check an answer: what is refused, remembered, judged, and told to nbgrader."""

import pytest
from answers import HUMIDITY, made  # the folder is put on the path by conftest.py
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from bank.pages import solution
from rosbeat import Session, check
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.errors import ExerciseError
from rosbeat.exercises.check import NotPassedError, for_nbgrader
from rosbeat.exercises.exercise import (
    Exercise,
    before_judging,
    passed,
)
from rosbeat.exercises.outcome_display import Shown
from rosbeat.exercises.progress import Standing, progress_file
from rosbeat.records import Fault, Observation, Outcome, Part


def test_an_unknown_exercise_is_refused_with_the_nearest_one():
    with pytest.raises(ExerciseError, match="no exercise '3a'") as caught:
        check("3a", object)
    assert 'check("03a"' in caught.value.to_try


@pytest.mark.ros
def test_every_check_is_remembered_with_its_points_and_its_mistake(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    untouched = made("03a", HUMIDITY, ('"humidity"', "____"))
    shallow = made("03a", HUMIDITY, ("5)", "10)"))
    check("03a", untouched)
    assert progress_file().standings()["03a"] == Standing()
    failed = check("03a", shallow).outcome
    passed = check(" 03A ", made("03a", HUMIDITY)).outcome
    check("03a", shallow)
    check("03a", untouched)
    assert progress_file().standings()["03a"] == Standing(
        "not attempted", True, passed.points, attempts=3, mistake=failed.mistake
    )


def test_a_check_answers_though_nothing_can_be_remembered(tmp_path, monkeypatch, capsys):
    (tmp_path / ".rosbeat").write_text("mine")
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    (tmp_path / "resources/sounds/alarm").mkdir(parents=True)
    assert [check("01a", tmp_path).outcome.status for _ in range(3)] == ["passed"] * 3
    assert capsys.readouterr().out.count("cannot be saved") == 1


@pytest.mark.ros
def test_a_check_leaves_the_learners_session_alone(capsys):
    room = made("03b", solution("03b"))
    with Session(seed=1) as ros:
        ros.add(room)
        ros.run(3)
        before = ros.observation()
        check("03b", room)
        assert ros.observation() == before
        ros.run(1)
    with Session(seed=1) as ros:
        ros.add(room)
        ros.run(4)
        assert [s.value for s in ros.messages("temperature")][:3] == [
            s.value for s in before.samples
        ]
    assert capsys.readouterr().err == ""


@pytest.mark.ros
@pytest.mark.parametrize(
    ("answer", "said"),
    [("WeatherReader", "'WeatherReader' is not a node"), (int, "int is a class, but not a node.")],
)
def test_what_is_no_node_is_named(answer, said):
    assert said in check("00a", answer).outcome.evidence


# Points: all or nothing, or for each requirement.


MET, MISSED = Part("R1", "It opens.", True, "", 3), Part("R2", "It closes.", False, "No.", 2)
EXTRA = Part("R3", "It is calm.", False, "No.", 1, optional=True)


def judged(outcome):
    found = Exercise("13b", lambda answer: answer, lambda seen: outcome, points=6).judged(None)
    return found.points, found.out_of


@pytest.mark.parametrize(
    ("outcome", "points"),
    [
        (passed("Good."), 6),
        (Diagnosis("new-to-me", "No.", "Look."), 0),
        (Outcome("13b", "failed", "No.", parts=(MET, MISSED, EXTRA)), 3),
        (Outcome("13b", "passed", "Good.", parts=(MET, EXTRA)), 3),
    ],
)
def test_points_are_given_once_or_for_each_requirement(outcome, points):
    assert judged(outcome) == (points, 6)


# Blanks and exceptions.


def fault(kind="ValueError", text="too small", callback="tick", line=4, code="f(x)"):
    return Fault(0, "/sensor", callback, kind, text, line, code)


def test_an_exception_is_told_with_the_learners_line():
    outcome = before_judging(Observation(0, 0, faults=(fault(),)))
    assert "tick raised ValueError: too small." in outcome.evidence
    assert "Line 4" in outcome.evidence
    assert "`f(x)`" in outcome.evidence
    assert outcome.hint


# Outcomes where nbgrader runs the page, by the rules that nbgrader has.


RIGHT = Outcome("03a", "passed", "Ten readings.", points=2, out_of=2)
PARTS = (Part("R1", "It opens.", True, "", 12), Part("R2", "It shuts.", False, "It stays open.", 8))
HALF = Outcome("13b", "failed", "One of two.", "Look.", points=12, out_of=20, parts=PARTS)
WRONG = Outcome("03a", "failed", "Five readings.", "Halve it.", "wrong-rate", 0, 2)
BLANK = Outcome("03a", "not attempted", "There is still a blank.", out_of=2)


@pytest.fixture
def shell():
    """An IPython of the test's own."""
    yield InteractiveShell.instance()
    InteractiveShell.clear_instance()


def bundle(shown, shell):
    """What Jupyter makes of a cell's last value; empty if the value shows itself."""
    return shell.display_formatter.format(shown)[0]


def test_some_points_are_a_number_and_words_beside_it(shell):
    made = bundle(for_nbgrader(HALF, "autograde"), shell)
    assert float(made["text/plain"]) == 12
    assert made["text/html"] == Shown(HALF).html()


@pytest.mark.parametrize("outcome", [WRONG, BLANK])
def test_no_points_are_an_error_and_the_words_above_it(outcome, shell):
    with capture_output() as seen, pytest.raises(NotPassedError) as caught:
        for_nbgrader(outcome, "autograde")
    assert [output.data["text/html"] for output in seen.outputs] == [Shown(outcome).html()]
    assert caught.value._render_traceback_() == ["Exercise 03a: 0 of 2 points."]


@pytest.mark.parametrize("outcome", [WRONG, BLANK, HALF])
def test_a_learner_who_validates_reads_everything_in_lines_that_are_not_cut(outcome, shell):
    with capture_output() as seen, pytest.raises(NotPassedError) as caught:
        for_nbgrader(outcome, "validate")
    lines = caught.value._render_traceback_()
    assert not seen.outputs
    assert max(map(len, lines)) <= 80
    assert " ".join(" ".join(lines).split()) == " ".join(str(Shown(outcome)).split())

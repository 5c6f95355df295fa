"""Exercises about nodes: nothing, right, differently right and wrong, and what they are told.

What each is called is in the bank of answers, tests/bank; here it is what a learner reads.
Exercises about files and terminals have a module of their own for each page.
"""

import answers as a  # the folder is put on the path by conftest.py
import pytest

from rosbeat.exercises.check import check

pytestmark = pytest.mark.ros

RIGHT = {
    "00a": [a.WeatherReader, a.LambdaReader, lambda: a.WeatherReader()],
    "00b": [a.SportsReporter, a.CountingReporter],
    "03a": [a.HumiditySensor, a.ParameterHumiditySensor],
    "03b": [a.RoomSensor, a.RoomSensorWithIfs],
}

WRONG = [
    ("00a", a.ReaderOfAnotherTopic, "for messages on /sports"),
    ("00a", a.ReaderWithALetterWrong, "The node listens on /wether"),
    ("00a", a.GreedyReader, "/politics, /weather"),
    ("00a", a.ReaderWithoutSubscription, "The node has no subscription"),
    ("00a", "WeatherReader", "'WeatherReader' is not a node"),
    ("00a", int, "int is a class, but not a node."),
    ("00b", a.HastyReporter, "9 came"),
    ("00b", a.ReporterOnAnotherTopic, "The node publishes on /sport,"),
    ("00b", a.SilentReporter, "and it was never used"),
    ("03a", a.SlowHumiditySensor, "10 readings were due, and 5 came"),
    ("03a", a.ShallowHumiditySensor, "queue depth is 10"),
    ("03a", a.DoubleHumiditySensor, "std_msgs/msg/Float64"),
    ("03a", a.TemperatureInsteadOfHumidity, "publishes on /temperature, and not"),
    ("03a", a.HumidityWithoutTimer, "nothing that ever calls a method"),
    ("03a", a.HumidityThatForgetsToPublish, "Does it get as far as publishing"),
    ("03a", a.HumidityWithSwappedArguments, "__init__ raised"),
    ("03a", a.HumidityThatCallsItsCallback, "without brackets"),
    ("03a", a.HumidityWithoutQuotes, "A text needs quotes"),
    ("03b", a.RoomWithTheTutorialsSlip, "cuts it off at 10.2"),
    ("03b", a.RoomWithoutUpperLimit, "cuts it off at 99"),
    ("03b", a.NarrowRoom, "cuts it off at"),
    ("03b", a.JumpyRoom, "too wide"),
    ("03b", a.LazyRoom, "The steps are small."),
    ("03b", a.ConstantRoom, "It never changes."),
    ("03b", a.SwappedRoom, "min and max changed places"),
    ("03b", a.RisingRoom, "It goes one way only."),
    ("03b", a.WholeRoom, "18 is an int"),
]


@pytest.mark.parametrize(
    ("exercise", "answer"), [(key, answer) for key, all_ in RIGHT.items() for answer in all_]
)
def test_right_answers_pass(exercise, answer):
    outcome = check(exercise, answer).outcome
    assert outcome.status == "passed", outcome
    assert not outcome.hint


@pytest.mark.parametrize(("exercise", "answer", "said"), WRONG)
def test_wrong_answers_fail_and_are_told_why(exercise, answer, said):
    outcome = check(exercise, answer).outcome
    assert outcome.status == "failed", outcome
    assert said in f"{outcome.evidence} {outcome.hint}"
    assert outcome.hint


@pytest.mark.parametrize("exercise", RIGHT)
def test_a_blank_is_not_attempted(exercise):
    assert check(exercise, a.UntouchedReader).outcome.status == "not attempted"

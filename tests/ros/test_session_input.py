"""What a session is asked for wrongly, and what it answers."""

from functools import partial

import pytest

from nodes import Doer, Listener, Talker
from rosbeat import Session
from rosbeat.errors import DurationError, SessionError, UnknownTopicError


def names(session):
    return [node.get_name() for node in session.nodes]


@pytest.mark.parametrize("seconds", [-1, -1e-9, float("nan"), float("inf"), "5", None, 1e12, True])
def test_durations_are_checked(ros, says, seconds):
    with pytest.raises(DurationError) as caught:
        ros.run(seconds)
    says(caught.value, "run(seconds=...)")
    assert ros.time == 0


def test_a_duration_beyond_all_numbers(ros, says):
    with pytest.raises(DurationError) as caught:
        ros.run(10**400)
    says(caught.value)


def test_time_ends_after_292_years(ros, says):
    for _ in range(9):
        ros.run(1e9)
    with pytest.raises(DurationError) as caught:
        ros.run(1e9)
    says(caught.value, "292 years")


@pytest.mark.parametrize(
    "options",
    [{"seed": -1}, {"seed": 1.5}, {"seed": "7"}, {"seed": True}, {"domain_id": 102},
     {"domain_id": -1}, {"domain_id": "5"}],
)  # fmt: skip
def test_options_are_checked(options, says):
    with pytest.raises(SessionError) as caught:
        Session(**options)
    says(caught.value, next(iter(options)))


def test_an_unknown_topic_and_its_nearest(ros, says):
    ros.add(partial(Talker, topic="temperature"))
    ros.add(partial(Listener, topic="temprature"))
    ros.run(1)
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("temprature")
    says(caught.value, "/listener subscribes to it", "Did you mean /temperature? If not, add")
    ros.add(partial(Listener, topic="temperature"), name="other")
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("temprature")
    says(caught.value, "Add the publishing node first")  # /temperature has both sides
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("zebra")
    says(caught.value, "Published topics: /temperature")
    assert [sample.value for sample in ros.messages("/temperature")] == [1]
    with pytest.raises(UnknownTopicError, match="No messages were published"):
        ros.messages("parameter_events")


def test_an_unknown_node_and_its_nearest(ros, says):
    ros.add(Talker)
    with pytest.raises(SessionError) as caught:
        ros.pause("talkr")
    says(caught.value, "Did you mean /talker?")


@pytest.mark.parametrize("call", ["messages", "logs"])
def test_names_are_texts(ros, says, call):
    with pytest.raises(SessionError) as caught:
        getattr(ros, call)(5)
    says(caught.value, "quotation marks")


def test_run_in_a_callback_is_refused(ros, capsys):
    ros.add(partial(Doer, lambda _: ros.run(1)))
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.kind == "SessionError"
    assert "`ros.run` was called from inside a callback" in fault.text
    capsys.readouterr()


@pytest.mark.parametrize("call", ["start", "stop", "wait"])
def test_live_calls_in_a_callback_are_refused(ros, call, capsys):
    ros.add(partial(Doer, lambda _: getattr(ros, call)()))
    ros.run(1)
    assert [fault.kind for fault in ros.observation().faults] == ["SessionError"]
    capsys.readouterr()


def test_adding_in_a_callback_is_refused(ros, capsys):
    ros.add(partial(Doer, lambda _: ros.add(Talker)))
    ros.run(1)
    assert [fault.kind for fault in ros.observation().faults] == ["SessionError"]
    assert names(ros) == ["doer"]
    capsys.readouterr()

import pytest

from rosbeat.errors import PictureError
from rosbeat.records import NANOSECONDS, Fault, LogRecord, Observation
from rosbeat.viz.happenings import MOST_EVENTS, happenings, node_of

TOPIC = ("/temperature",)


def test_a_message_goes_to_the_callbacks_of_its_own_instant(make):
    shown = happenings(make.pair(3), TOPIC, None)
    assert [(one.time, one.source, one.targets) for one in shown.messages] == [
        (at, "/sensor", ("/monitor",)) for at in (1.0, 2.0, 3.0)
    ]
    assert shown.lanes == ("/sensor", "/monitor")
    assert shown.skipped == 0


def test_a_message_that_nobody_takes_has_no_target(make):
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 2.0),), callbacks=(make.heard(2),))
    assert happenings(seen, TOPIC, None).messages[0].targets == ()


def test_a_burst_is_one_message_with_a_number(make):
    seen = Observation(NANOSECONDS, 7, tuple(make.sample(1, k) for k in range(20)))
    (message,) = happenings(seen, TOPIC, None).messages
    assert message.number == 20


def test_too_much_is_cut_between_two_instants(make):
    shown = happenings(make.pair(600), TOPIC, None)
    assert len(shown.callbacks) + len(shown.messages) == MOST_EVENTS
    assert shown.end == MOST_EVENTS / 3
    assert shown.skipped == 3 * 600 - MOST_EVENTS


def test_an_instant_is_never_cut_in_two(make):
    seen = Observation(NANOSECONDS, 7, tuple(make.sample(1, k) for k in range(100)))
    shown = happenings(seen, TOPIC, None)
    assert shown.messages[0].number == 100
    assert shown.skipped == 0


def test_until_ends_the_axis(make):
    shown = happenings(make.pair(10), TOPIC, 4 * NANOSECONDS)
    assert shown.end == 4.0
    assert len(shown.messages) == 4
    assert shown.skipped == 18


def test_the_axis_reaches_the_end_of_the_session(make):
    seen = Observation(9 * NANOSECONDS, 7, (make.sample(1, 2.0),))
    assert happenings(seen, TOPIC, None).end == 9.0


def test_only_the_lanes_of_the_topic(make):
    seen = make.pair(2)
    more = (*seen.callbacks, make.heard(1, "/other", "/alert"))
    seen = Observation(seen.time_ns, 7, seen.samples, callbacks=more, graph=seen.graph)
    assert "/other" not in happenings(seen, TOPIC, None).lanes


def test_nodes_without_the_topic_have_a_lane_if_everyone_has(make):
    calls = (make.timer(1, "/clockwork"),)
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=calls)
    assert happenings(seen, TOPIC, None).lanes == ("/sensor",)
    assert happenings(seen, TOPIC, None, everyone=True).lanes == ("/clockwork", "/sensor")


def test_hidden_nodes_have_no_lane(make):
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=(make.heard(1, "/_spy"),))
    assert happenings(seen, TOPIC, None).lanes == ("/sensor",)


def test_logs_and_faults_of_the_lanes(make):
    log = LogRecord(NANOSECONDS, "INFO", "building.sensor", "hello", "f", 1)
    fault = Fault(NANOSECONDS, "/building/sensor", "f", "ValueError", "", 1, "")
    sample = make.sample(1, 1.0, node="/building/sensor")
    seen = Observation(NANOSECONDS, 7, (sample,), (log,), faults=(fault,))
    shown = happenings(seen, TOPIC, None)
    assert node_of(log) == "/building/sensor"
    assert (shown.logs, shown.faults) == ((log,), (fault,))


def test_nothing_gets_three_parts():
    with pytest.raises(PictureError, match="nothing to put on a timeline") as caught:
        happenings(Observation(0, 7), (), None)
    assert caught.value.to_try

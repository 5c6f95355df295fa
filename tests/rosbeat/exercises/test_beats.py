"""A beat, from made-up observations."""

import pytest

from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.model import diagnose_beat
from rosbeat.records import NANOSECONDS, Observation, Sample

TYPE = "std_msgs/msg/Float32"
WIRE = Wire("/humidity", TYPE)


def seen(*seconds, until=4):
    at = [round(second * NANOSECONDS) for second in seconds]
    samples = [Sample(time, WIRE.topic, TYPE, "/node", {"data": 1.0}) for time in at]
    return Observation(until * NANOSECONDS, 0, tuple(samples))


@pytest.mark.parametrize(
    ("period", "seconds"),
    [(1.0, (1, 2, 3, 4)), (2.0, (2, 4)), (0.5, tuple(n / 2 for n in range(1, 9)))],
)
def test_a_beat_that_is_right_has_no_name(period, seconds):
    assert diagnose_beat(seen(*seconds), WIRE, period) is None


@pytest.mark.parametrize(
    ("seconds", "mistake", "words"),
    [
        ((0, 0), "no-timer", "while the node was made"),
        ((1, 1, 2), "wrong-rate", "At 1 s, 2 readings"),
        ((0, 1, 2, 3), "wrong-rate", "first one at 0 s"),
        ((2, 4), "wrong-rate", "at these seconds: 2, 4."),
        ((1, 2, 3), "wrong-rate", "3 readings appeared"),
        ((1, 2, 3, 4, 4.5), "wrong-rate", "5 readings appeared"),
    ],
)
def test_what_is_wrong_with_a_beat_is_said(seconds, mistake, words):
    found = diagnose_beat(seen(*seconds), WIRE, 1.0)
    assert found.mistake == mistake
    assert words in found.evidence


@pytest.mark.parametrize(
    ("period", "words"),
    [(2.0, "One every 2 seconds"), (1.0, "One a second"), (0.25, "Four a second"), (0.1, "10 a")],
)
def test_a_wanted_rate_is_said_in_words(period, words):
    assert words in diagnose_beat(seen(0.3, 0.7), WIRE, period, "articles").hint
    assert "articles" in diagnose_beat(seen(0.3, 0.7), WIRE, period, "articles").evidence

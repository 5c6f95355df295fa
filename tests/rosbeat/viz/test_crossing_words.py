import pytest

from rosbeat.records import LogRecord
from rosbeat.viz.crossing_words import describe, left_out, name_of
from rosbeat.viz.pairs import Line, Pairs


def line(at, partner=None):
    return Line(at, str(at), partner)


CASES = {
    "all": (
        Pairs((line(1, 0), line(2, 1)), (line(1, 0), line(2, 1))),
        "sensor sent 2 messages: all arrived at monitor and none was lost.",
    ),
    "lost": (
        Pairs((line(1), line(2, 0)), (line(2, 1),)),
        "sensor sent 2 messages: 1 arrived at monitor and 1 was lost. The first one was sent "
        "before anything arrived.",
    ),
    "between": (
        Pairs((line(1, 0), line(2), line(3, 1)), (line(1, 0), line(3, 2))),
        "sensor sent 3 messages: 2 arrived at monitor and 1 was lost.",
    ),
    "late": (
        Pairs((line(1, 0), line(2), line(3)), (line(1, 0),)),
        "sensor sent 3 messages: 1 arrived at monitor, none was lost and 2 were sent after its "
        "last line.",
    ),
    "nobody": (
        Pairs((line(1), line(2)), ()),
        "sensor sent 2 messages: none arrived at monitor and 2 were lost.",
    ),
    "strange": (
        Pairs((line(1, 0),), (line(1, 0), line(2))),
        "sensor sent 1 message: 1 arrived at monitor and none was lost. 1 line of monitor has a "
        "number that sensor did not log.",
    ),
    "skipped": (
        Pairs((line(1, 0),), (line(1, 0),), 1),
        "sensor sent 1 message: 1 arrived at monitor and none was lost. 1 later message is not "
        "shown.",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_crossing_in_words(case):
    shown, words = CASES[case]
    assert describe(shown, "sensor", "monitor") == words


def test_nothing_is_left_out_of_a_short_one():
    assert left_out(CASES["all"][0]) == ""


def test_a_side_is_named_by_who_logged():
    def log(name):
        return LogRecord(0, "INFO", name, "", "", 0)

    assert name_of([log("sensor"), log("sensor")]) == "sensor"
    assert name_of([log("sensor"), log("helper")]) == "sensor and helper"
    assert name_of([]) == "the receiver"

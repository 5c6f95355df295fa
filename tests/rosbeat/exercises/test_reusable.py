"""The judge of a monitor for any place, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.reusable import Place, judge_reusable
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
HOME = Place("", "/reading", "/status", 20.0, 26.0, "C", (22.0, 26.0, 27.5, 19.5))
AWAY = Place("/a/one", "/a/humidity", "/a/status", 40.0, 70.0, "%", (55.0, 70.0, 22.5, 30.0, 71.0))
NODE, SECOND = "/monitor", 10**9


def word(value, place):
    return "High" if value > place.high else "Low" if value < place.low else "Normal"


def text(value, place):
    return f"{word(value, place)} {value:.1f} {place.unit}"


def outcome(home=text, away=text, names=("/a/humidity", "/a/status"), kind=STRING):
    ends = [
        Endpoint(NODE, HOME.listens, FLOAT, "subscription", QoS()),
        Endpoint(NODE, HOME.speaks, kind, "publisher", QoS()),
        Endpoint(AWAY.node, names[0], FLOAT, "subscription", QoS()),
        Endpoint(AWAY.node, names[1], STRING, "publisher", QoS()),
    ]
    said = []
    for node, place, rule in ((NODE, HOME, home), (AWAY.node, AWAY, away)):
        said += [
            Sample(second * SECOND, place.speaks, kind, node, {"data": rule(value, place)})
            for second, value in enumerate(place.readings, 1)
            if rule(value, place) is not None
        ]
    calls = (CallbackRecord(SECOND, NODE, "subscription", "hear", HOME.listens),)
    graph = GraphSnapshot((AWAY.node, NODE), tuple(ends))
    seen = Observation(6 * SECOND, 0, tuple(said), (), calls, (), graph, NODE)
    return judge_reusable("09c", seen, (HOME, AWAY))


@pytest.mark.parametrize(
    "rule",
    [
        text,
        lambda value, place: f"{value:.3f}{place.unit} - Status:{word(value, place).lower()}",
        lambda value, place: f"it is {round(value, 1)} °{place.unit}, {word(value, place)}!",
    ],
)
def test_the_form_of_the_text_is_free(rule):
    found = outcome(rule, rule)
    assert found.status == "passed", found
    assert "9 readings" in found.evidence


def fixed(low, high):
    return lambda value, place: (
        f"{'High' if value > high else 'Low' if value < low else 'Normal'} {value:.1f} {place.unit}"
    )


def defaults(value, place):
    return fixed(18.0, 26.0)(value, place) if place is HOME else text(value, place)


WRONG = {
    "listens above": ({"names": ("/humidity", "/a/status")}, "absolute-name", "/humidity"),
    "speaks above": ({"names": ("/a/humidity", "/status")}, "absolute-name", "speaks on /status"),
    "another name": ({"names": ("/a/wet", "/a/status")}, "wrong-topic", "listens to /a/wet"),
    "both limits": ({"away": fixed(20.0, 26.0)}, "limits-fixed", "low and high changed nothing"),
    "low": ({"away": fixed(20.0, 70.0)}, "limits-fixed", "parameter low changed nothing"),
    "high": ({"away": fixed(40.0, 26.0)}, "limits-fixed", "parameter high changed nothing"),
    "a default": ({"home": fixed(18.0, 26.0)}, "other-default", "it kept them"),
    "no unit": ({"home": lambda v, p: text(v, p)[:-1]}, "wrong-unit", "Of 22 it said"),
    "unit": ({"away": lambda v, p: text(v, p).replace("%", "C")}, "unit-fixed", "'%'"),
    "no number": ({"away": lambda v, p: f"{word(v, p)} {p.unit}"}, "wrong-values", "'Normal %'"),
    "no word": ({"away": lambda v, p: f"{v:.1f} {p.unit}"}, "wrong-word", "55.0 %"),
    "two words": ({"away": lambda v, p: f"High Low {v:.1f} %"}, "wrong-word", "High Low"),
    "at the limit": ({"away": fixed(40.0, 69.9)}, "boundary", "a reading of 70"),
    "too few": ({"away": lambda v, p: text(v, p) if v > 30 else None}, "wrong-rate", "3 texts"),
    "no text": ({"home": lambda v, p: None}, "never-published", "/status"),
    "numbers": ({"kind": FLOAT}, "type-mismatch", "Float32"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_mistake_has_its_name(case):
    what, mistake, evidence = WRONG[case]
    found = outcome(**what)
    assert (found.status, found.mistake) == ("failed", mistake), found
    assert evidence in found.evidence, found
    assert found.hint

"""What a chart shows, and what it shows against a diagnosis: charts made up, and of a ward."""

from dataclasses import replace
from functools import cache

import pytest

from rosbeat.clinic import signs
from rosbeat.clinic.charts import Chart, Hearing, Member, Talk
from rosbeat.clinic.names import KNOWN, names
from rosbeat.clinic.plans import FLOAT, STRING, Orders, Wiring
from rosbeat.clinic.ward import Ward
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.records import Endpoint, Fault, QoS

READINGS = tuple(16.0 + half / 2 for half in range(21))
WORDS = tuple(f"{v:.1f} {'High' if v > 24 else 'Low' if v < 18 else 'Normal'}" for v in READINGS)
ORDERS = Orders(
    "/temperature",
    18.0,
    24.0,
    16.0,
    26.0,
    wiring=(
        Wiring("/sensor", "publisher", "/temperature"),
        Wiring("/guard", "subscription", "/temperature"),
        Wiring("/guard", "publisher", "/status"),
        Wiring("/lamp", "subscription", "/status"),
    ),
)
ENDS = (
    Endpoint("/sensor", "/temperature", FLOAT, "publisher", QoS()),
    Endpoint("/guard", "/temperature", FLOAT, "subscription", QoS()),
    Endpoint("/guard", "/status", STRING, "publisher", QoS()),
    Endpoint("/lamp", "/status", STRING, "subscription", QoS()),
)
MEMBERS = (
    Member("/sensor", 0.0, 60, 60, 60),
    Member("/guard", 0.0, 60, 0, 0),
    Member("/lamp", 0.0, 60, 0, 0),
)
TALKS = (
    Talk("/sensor", "/temperature", 60, 1.0, 60.0, 1.0, READINGS),
    Talk("/guard", "/status", 60, 1.0, 60.0, 1.0, (), WORDS),
)
HEARINGS = (
    Hearing("/guard", "/temperature", 60, 60, 0, 60.0),
    Hearing("/lamp", "/status", 60, 60, 0, 60.0),
)
HEALTHY = Chart(1, 60.0, ORDERS, MEMBERS, ENDS, TALKS, HEARINGS)


def having(which, at, **changes):
    """The healthy chart with one of its records changed."""
    records = list(getattr(HEALTHY, which))
    records[at] = replace(records[at], **changes)
    return replace(HEALTHY, **{which: tuple(records)})


def with_second(name):
    return replace(
        HEALTHY,
        ends=(*ENDS, replace(ENDS[0], node=name)),
        talks=(*TALKS, replace(TALKS[0], node=name)),
        members=(*MEMBERS, replace(MEMBERS[0], node=name)),
    )


FAULT = Fault(10**9, "/guard", "judge", "KeyError", "'High'", 0, "")
SHOWN = {
    "topic-misspelled": having("ends", 3, name="/statuss"),
    "wrong-namespace": having("ends", 3, name="/north/status"),
    "wrong-topic": having("ends", 3, name="/temperature", type_name=FLOAT),
    "type-mismatch": having("ends", 3, type_name=FLOAT),
    "qos-mismatch": having("ends", 3, qos=QoS(durability="TRANSIENT_LOCAL")),
    "depth-too-small": replace(
        having("ends", 1, qos=QoS(depth=2)),
        orders=replace(ORDERS, burst=5),
        hearings=(replace(HEARINGS[0], count=24), HEARINGS[1]),
    ),
    "first-messages-lost": having("hearings", 1, count=0, sent=0, before=60, last=-1.0),
    "not-spun": having("members", 2, spun=False, callbacks=0),
    "node-ended": replace(HEALTHY, faults=(FAULT,)),
    "never-published": having("talks", 1, count=0, first=-1.0, last=-1.0, gap=0.0, texts=()),
    "gone-quiet": having("talks", 1, count=20, last=20.0),
    "run-twice": replace(HEALTHY, members=(*MEMBERS, MEMBERS[2])),
    "two-sources": with_second("/old_sensor"),
    "wrong-rate": having("talks", 0, gap=0.5, count=120),
    "wrong-unit": having("talks", 0, values=(60.8, 78.8)),
    "never-changes": having("talks", 0, values=(20.5,)),
    "no-clamp": having("talks", 0, values=(*READINGS, 28.5)),
    "clamped-too-early": having("talks", 0, values=(*READINGS, 26.5)),
    "boundary": having("talks", 1, texts=(*WORDS, "24.0 High")),
}


def test_a_healthy_chart_shows_nothing():
    assert signs.found(HEALTHY) == ()


@pytest.mark.parametrize("name", SHOWN)
def test_a_chart_shows_its_fault_and_no_other(name):
    assert {one.mistake for one in signs.found(SHOWN[name])} == {name}


def test_every_known_diagnosis_has_a_sign_and_a_title():
    # A callback that never returns would hold up the session, so that there is nothing to show.
    assert set(SHOWN) == set(KNOWN) - {"callback-blocks"}
    assert names() == {name: MISTAKES[name].title for name in KNOWN}


def test_more_is_known_than_occurs():
    drawn = {
        truth.mistake
        for seed in range(50)
        for number in range(1, 12)
        for truth in Ward(seed)._at(number).truths
    }
    assert drawn < set(KNOWN)
    assert 15 <= len(KNOWN) <= 20


#: A guard that has heard nothing more has nothing more to say, and one that hears nothing is not
#: mute.
SYMPTOMS = {
    "node-ended": replace(
        HEALTHY,
        talks=tuple(replace(one, count=20, last=20.0) for one in TALKS),
        hearings=tuple(replace(one, count=20, sent=20, last=20.0) for one in HEARINGS),
        faults=(replace(FAULT, node="/sensor"),),
    ),
    "topic-misspelled": replace(
        HEALTHY,
        ends=(ENDS[0], replace(ENDS[1], name="/temprature"), *ENDS[2:]),
        members=(MEMBERS[0], *(replace(one, callbacks=0) for one in MEMBERS[1:])),
        talks=(TALKS[0], Talk("/guard", "/status", 0)),
        hearings=(Hearing("/guard", "/temprature", 0, 0, 0), Hearing("/lamp", "/status", 0, 0, 0)),
    ),
}


@pytest.mark.parametrize("cause", SYMPTOMS)
def test_a_symptom_is_not_a_cause(cause):
    assert [one.mistake for one in signs.found(SYMPTOMS[cause])] == [cause]


@cache
def ward_charts():
    return tuple(Ward(7).chart(number) for number in range(1, 12))


@pytest.mark.ros
@pytest.mark.parametrize("name", KNOWN)
def test_something_speaks_against_every_other_diagnosis(name):
    for chart in ward_charts():
        true = {place for one in chart.truths if one.mistake == name for place in one.places}
        for place in {*chart.nodes, *chart.topics} - true:
            said = signs.against(chart, name, place)
            assert len(said) > 15, (name, place)
            assert not said[0].isupper(), said
            assert not said.endswith("."), said
            # What is right is never given away.
            assert not any(one.mistake in said for one in chart.truths), said


@pytest.mark.ros
@pytest.mark.parametrize(
    ("number", "name", "place", "said"),
    [
        (2, "gone-quiet", "/cellar_rules", "at 1 s, and the orders require only one"),
        (2, "gone-quiet", "/cellar_rule", "and the orders require only one"),
        (5, "no-clamp", "/leaf_sensor", "they span 10 degrees, as ordered"),
        (5, "clamped-too-early", "/leaf_sensor", "they span 10 degrees, as ordered"),
        (8, "clamped-too-early", "/pool_sensor", "2.5 outside, but a clamp before the step"),
        (8, "wrong-unit", "/pool_sensor", "in another unit all of them would be"),
        (1, "wrong-topic", "/hall_notebook", "only /hall_notebook uses /hall_Temperature"),
        (10, "wrong-topic", "/stall_logger", "only /stall_logger uses /stall_tep"),
        (1, "wrong-namespace", "/hall_notebook", "is in the namespace that the orders require"),
    ],
)
def test_the_evidence_refutes_and_does_not_agree(number, name, place, said):
    assert said in signs.against(ward_charts()[number - 1], name, place)


@pytest.mark.parametrize(
    ("shown", "name", "place", "said"),
    [
        ("wrong-unit", "no-clamp", "/sensor", "more than 5 degrees outside"),
        ("clamped-too-early", "no-clamp", "/sensor", "unclamped readings would go farther"),
        ("wrong-namespace", "topic-misspelled", "/lamp", "is spelled as ordered"),
        ("wrong-namespace", "wrong-topic", "/lamp", "only /lamp uses /north/status"),
    ],
)
def test_the_evidence_refutes_in_other_wards_too(shown, name, place, said):
    assert said in signs.against(SHOWN[shown], name, place)


@pytest.mark.parametrize("name", KNOWN)
def test_what_speaks_against_is_a_sentence_in_any_chart(name):
    for chart in (HEALTHY, *SHOWN.values()):
        for place in (*chart.nodes, *chart.topics):
            assert len(signs.against(chart, name, place)) > 15

"""What speaks against a diagnosis: true, a part of a sentence, and never what is right."""

from functools import cache

import pytest

from rosbeat import clinic
from rosbeat.clinic.diagnoses import KNOWN, contradiction
from rosbeat.clinic.patients import Ward
from rosbeat.diagnosis.mistakes import MISTAKES

pytestmark = pytest.mark.ros


@cache
def chart(number, seed=7):
    return Ward(seed).chart(number)


LEAF = "/leaf_sensor published numbers from 289.15 to 299.15 on /leaf_temperature, while the " \
    "orders say 16 to 26"  # fmt: skip
POOL = "/pool_sensor published numbers from 20.5 to 33.5 on /pool_temperature, while the orders " \
    "say 23 to 31"  # fmt: skip


@pytest.mark.parametrize(
    ("number", "name", "place", "said"),
    [
        (1, "topic-misspelled", "/hall_monitor",
         "the names used there are spelled as ordered: /hall_status and /hall_temperature"),
        (1, "wrong-namespace", "/hall_notebook",
         "/hall_Temperature is in the namespace that the orders require"),
        (1, "wrong-topic", "/hall_notebook", "only /hall_notebook uses /hall_Temperature, so it "
         "is not another topic of this system"),
        (1, "qos-mismatch", "/hall_Temperature",
         "/hall_Temperature has no endpoint that /hall_notebook could be incompatible with"),
        (6, "type-mismatch", "/water_guard", "all endpoints there use the same type: "
         "/water_humidity has Float32 and /water_status has String"),
        (1, "depth-too-small", "/hall_notebook",
         "the queue of /hall_notebook on /hall_Temperature holds 10, and one message arrives at "
         "once"),
        (1, "first-messages-lost", "/hall_notebook",
         "no message was published on /hall_Temperature before /hall_notebook subscribed"),
        (1, "not-spun", "/hall_notebook",
         "/hall_notebook is spun, but no message or timer has triggered a callback"),
        (1, "not-spun", "/hall_Temperature",
         "this diagnosis is about a node, but /hall_Temperature is a topic"),
        (1, "callback-blocks", "/hall_notebook",
         "no callback of /hall_notebook has started, so none can block the node"),
        (1, "node-ended", "/hall_monitor",
         "no callback of /hall_monitor raised an exception in 60 s"),
        (1, "never-published", "/hall_monitor",
         "/hall_monitor has published 120 messages on /hall_status, the last at 60 s, and "
         "received its last message at 60 s"),
        (2, "gone-quiet", "/cellar_rule", "/cellar_rules has published its message on "
         "/cellar_rule at 1 s, and the orders require only one"),
        (3, "gone-quiet", "/shelf_sensor", "/shelf_sensor has published 33 messages on "
         "/shelf_temperature, the last at 16.5 s and then ended"),
        (1, "run-twice", "/hall_sensor", "the 4 nodes of this patient have 4 different names"),
        (7, "two-sources", "/milk_thermometer",
         "the orders require /milk_thermometer to publish on /milk_temperature"),
        (1, "wrong-rate", "/hall_sensor", "/hall_sensor publishes every 0.5 s, as ordered"),
        (1, "wrong-rate", "/hall_monitor",
         "/hall_monitor publishes when it receives a message, not with a timer"),
        (6, "wrong-rate", "/water_humidity", "the orders give no rate for /water_humidity"),
        (5, "clamped-too-early", "/leaf_sensor", f"{LEAF}; they span 10 degrees, as ordered"),
        (8, "clamped-too-early", "/pool_sensor", f"{POOL}; they are 2.5 outside, but a clamp "
         "before the step allows one step at most"),
        (8, "wrong-unit", "/pool_sensor", f"{POOL}; they are at most 2.5 outside, but in another "
         "unit all of them would be"),
        (1, "boundary", "/hall_monitor", "/hall_monitor says '19.0 Normal', but a reading at a "
         "limit is Normal and /hall_monitor says '21.0 Normal', but a reading at a limit is "
         "Normal"),
        (1, "boundary", "/hall_sensor",
         "no node there has judged a reading that is exactly at a limit"),
    ],
)  # fmt: skip
def test_the_evidence_is_what_the_instruments_show(number, name, place, said):
    assert contradiction(chart(number), name, place) == said


@pytest.mark.parametrize(
    ("seed", "number", "name", "place", "said"),
    [
        (1, 10, "gone-quiet", "/shelf_guard", "/shelf_guard has never published on /shelf_status"),
        (1, 7, "no-clamp", "/milk_sensor", "0.5 outside, but unclamped readings would go farther"),
        (4, 8, "no-clamp", "/leaf_probe", "they are more than 5 degrees outside, as no Celsius"),
        (12, 4, "topic-misspelled", "/milk_panel", "the last part of /north/milk_status is "
         "spelled as ordered"),
    ],
)  # fmt: skip
def test_the_evidence_of_other_wards(seed, number, name, place, said):
    assert said in contradiction(chart(number, seed), name, place)


@pytest.mark.parametrize("name", KNOWN)
def test_something_speaks_against_every_other_diagnosis(name):
    for one in map(chart, range(1, 12)):
        true = {place for truth in one.truths if truth.mistake == name for place in truth.places}
        for place in {*one.nodes, *one.topics} - true:
            said = contradiction(one, name, place)
            assert len(said) > 15, (name, place)
            assert not said[0].isupper(), said
            assert not said.endswith("."), said
            # What is right is never given away.
            assert not any(truth.mistake in said for truth in one.truths), said


def test_every_diagnosis_has_a_title():
    assert clinic.names() == {name: MISTAKES[name].title for name in KNOWN}
    assert 15 <= len(KNOWN) <= 20

"""A diagnosis is right if its kind and its place are; everything else is contradicted."""

from functools import cache

import pytest

from rosbeat.clinic.names import KNOWN
from rosbeat.clinic.ward import Ward
from rosbeat.exercises.claims import Claim
from rosbeat.exercises.weighing import weighed

pytestmark = pytest.mark.ros


@cache
def chart(number):
    return Ward(7).chart(number)


@pytest.mark.parametrize("number", range(1, 12))
def test_nothing_but_the_truth_is_accepted(number):
    patient = chart(number)
    right = {"half-a-diagnosis"} if len(patient.truths) == 2 else {None}
    for name in KNOWN:
        for place in (*patient.nodes, *patient.topics):
            found = weighed(patient, [Claim(name, place)])
            true = any(name == one.mistake and place in one.places for one in patient.truths)
            assert ((found.mistake if found else None) in right) == true, (name, place, found)


@pytest.mark.parametrize("number", range(9, 12))
def test_two_faults_want_two_diagnoses_in_any_order(number):
    claims = [Claim(one.mistake, one.places[0]) for one in chart(number).truths]
    assert weighed(chart(number), claims) is None
    assert weighed(chart(number), claims[::-1]) is None
    assert weighed(chart(number), [claims[0], claims[0]]).mistake == "half-a-diagnosis"
    third = Claim("run-twice", claims[0].place)
    assert weighed(chart(number), [*claims, third]).mistake == "contradicted"


def test_what_speaks_against_it_is_told_and_what_is_right_is_not():
    found = weighed(chart(1), [Claim("qos-mismatch", "/hall_monitor")])
    assert found.evidence == (
        "you say qos-mismatch at /hall_monitor; yet /hall_monitor is matched with 1 of 1 "
        "subscription on /hall_status and /hall_monitor is matched with 1 of 1 publisher on "
        "/hall_temperature."
    )
    assert "misspelled" not in found.evidence + found.hint


def test_a_place_may_be_written_without_its_slash_or_its_namespace():
    ward = Ward(12)
    (truth,) = ward._at(4).truths
    patient = ward.chart(4)
    assert truth.mistake == "wrong-namespace"
    for place in (*truth.places, *(one.lstrip("/") for one in truth.places)):
        assert weighed(patient, [Claim(truth.mistake, place)]) is None


@pytest.mark.parametrize(
    ("claim", "mistake", "said"),
    [
        (Claim("nonsense", "/hall_sensor"), "no-such-diagnosis", "no diagnosis 'nonsense'"),
        (Claim("/hall_sensor", "not-spun"), "arguments-swapped", "'/hall_sensor' stands first"),
        (Claim("not-spun", "/hall_senso"), "no-such-place", "'/hall_senso'"),
        (Claim("not-spun", "/"), "no-such-place", "'/'"),
        (Claim("topic-misspelled", "/hall_panel"), "other-place", "spelt as it was ordered"),
    ],
)
def test_other_mistakes_have_their_own_names(claim, mistake, said):
    found = weighed(chart(1), [claim])
    assert found.mistake == mistake
    assert said in found.evidence
    assert found.hint


def test_no_diagnosis_is_no_mistake_of_the_instruments():
    assert weighed(chart(1), []).mistake == "no-diagnosis-yet"

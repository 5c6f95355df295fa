"""Each patient is a real system that shows its fault, and no other one."""

from random import Random

import pytest

from rosbeat.clinic import signs
from rosbeat.clinic.cases import CASES, HEARD, PAIR, Ill
from rosbeat.clinic.houses import PLACES, house, with_humidity, with_teacher
from rosbeat.clinic.patients import Patient, examined
from rosbeat.clinic.ward import Ward

pytestmark = pytest.mark.ros

SEEDS = (1, 2)


def ill(case, seed):
    rng = Random(f"{case.name} {seed}")
    return case.drawn(rng, rng.choice(PLACES))


def sorted_truths(truths):
    return sorted((one.mistake, tuple(sorted(one.places))) for one in truths)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_patient_shows_its_fault_and_no_other(case):
    for seed in SEEDS:
        one = ill(case, seed)
        chart = examined(one, seed)
        assert sorted_truths(signs.found(chart)) == sorted_truths(one.truths), one
        assert len(one.truths) == (2 if case.level == PAIR else 1)
        places = {place for truth in one.truths for place in truth.places}
        assert places <= {*chart.nodes, *chart.topics}


@pytest.mark.parametrize(
    "make",
    [
        house,
        lambda rng, place: house(rng, place, burst=5),
        lambda rng, place: with_humidity(house(rng, place)),
        lambda rng, place: with_teacher(house(rng, place)),
    ],
    ids=["plain", "bursts", "humidity", "teacher"],
)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_healthy_house_shows_nothing(make, seed):
    rng = Random(seed)
    plan = make(rng, rng.choice(PLACES))
    well = Ill("healthy", plan, (), "")
    chart = examined(well, seed)
    assert signs.found(chart) == ()
    assert 4 <= len(chart.nodes) <= 6
    assert all(one.count == one.sent > 0 for one in chart.hearings)
    with Patient(1, well, seed).ros as ros:
        verdicts = {topic: ros.explain(topic).verdict for topic in ros.graph().topics()}
    # Nobody has asked for the humidity yet.
    humid = [topic for topic in verdicts if topic.endswith("humidity")]
    assert {verdicts.pop(topic) for topic in humid} <= {"no-subscription"}
    assert set(verdicts.values()) == {"all-is-well"}


@pytest.mark.parametrize("case", [c for c in CASES if c.level == HEARD], ids=lambda case: case.name)
def test_where_nothing_is_silent_all_is_well_on_every_topic(case):
    for seed in SEEDS:
        with Patient(1, ill(case, seed), seed).ros as ros:
            assert all(ros.explain(topic).is_well for topic in ros.graph().topics())


@pytest.mark.parametrize(
    "name", ["misspelled", "namespaced", "unfit", "ended", "mute", "unspun", "quiet", "late"]
)
def test_explain_speaks_up_where_something_is_silent(name):
    case = next(one for one in CASES if one.name == name)
    one = ill(case, 1)
    with Patient(1, one, 1).ros as ros:
        verdicts = {ros.explain(topic).verdict for topic in ros.graph().topics()}
    # Of two names that differ it may only ask whether they are meant to be one.
    named = {truth.mistake for truth in one.truths} | {"no-publisher", "topic-misspelled"}
    assert verdicts & named


def test_a_patient_is_the_same_each_time():
    ward = Ward(7)
    for number in (3, 7, 10):
        assert ward.chart(number) == Ward(7).chart(number)
        with ward.patient(number).ros as one, ward.patient(number).ros as other:
            assert one.observation() == other.observation()


def test_a_patient_runs_on_in_an_ordinary_session(capsys):
    with Ward(7).patient(8).ros as ros:
        assert ros.time == 60.0
        before = len(ros.messages("pool_temperature"))
        ros.run(seconds=10, quiet=True)
        assert len(ros.messages("pool_temperature")) == before + 10


def test_which_node_has_ended_is_not_printed(capsys):
    with Ward(7).patient(3).ros as ros:
        assert [fault.node for fault in ros.observation().faults] == ["/shelf_sensor"]
        ros.run(seconds=1)
    printed = capsys.readouterr()
    assert "stopped" not in printed.out + printed.err


def test_a_session_opens_when_it_is_asked_for_and_once():
    patient = Ward(7).patient(1)
    assert "ros" not in vars(patient)
    assert patient.ros is patient.ros
    patient.ros.close()


@pytest.mark.parametrize(
    ("number", "row"),
    [
        (6, "water_probe -> /water_temperature -> water_guard, water_diary"),
        (6, "water_hygrometer -> /water_humidity -> (no node)"),
        (6, "Low below 23, High above 26, and Normal otherwise"),
        (2, "cellar_rules (once, soon after its start) -> /cellar_rule -> cellar_plate"),
    ],
)
def test_the_order_says_who_speaks_to_whom(number, row):
    assert row in Ward(7).patient(number).orders.splitlines()


@pytest.mark.parametrize(("burst", "readings"), [(1, "a reading every"), (5, "5 readings at once")])
def test_the_order_says_how_many_readings_come(burst, readings):
    plan = house(Random(1), PLACES[0], burst=burst)
    rows = Patient(1, Ill("healthy", plan, (), ""), 1).orders.splitlines()
    assert any(row.startswith(readings) for row in rows)

"""A seed draws a ward; each patient is a real system that shows its fault, and no other one."""

import subprocess
import sys
from itertools import product
from random import Random

import pytest

from rosbeat import clinic
from rosbeat.clinic import systems
from rosbeat.clinic.charts import chart_of
from rosbeat.clinic.faults import CASES, HEARD, PAIR, SILENT, BrokenSystem
from rosbeat.clinic.patients import Patient, Ward
from rosbeat.clinic.systems import OVERSHOOT, PLACES, STEP
from rosbeat.diagnosis.findings import NODE
from rosbeat.diagnosis.qos import incompatible
from rosbeat.errors import ExerciseError

SEEDS = (1, 2)
WARDS = [Ward(seed) for seed in range(50)]


def drawn(ward):
    return [ward._at(number) for number in range(1, len(ward) + 1)]


# What a system shows, found without a look at what was broken.


def shown_faults(chart, ros):
    """The faults that show, each with its places."""
    spec = chart.spec
    heard = {(one.node, one.topic): 0 for one in chart.received}
    for one in ros.observation().callbacks:
        if one.kind == "subscription" and (one.node, one.source) in heard:
            heard[one.node, one.source] += 1
    explained = [ros.explain(topic) for topic in chart.topics]
    unspun = {
        mark.subject
        for one in explained
        if any(found.mistake == "not-spun" for found in one.diagnoses)
        for mark in one.marks
        if mark.kind == NODE and mark.subject not in chart.ended
    }
    yield from (("node-ended", node) for node in chart.ended)
    yield from (("not-spun", node) for node in unspun)
    yield from names_and_qos(chart)
    for one in chart.received:
        count = heard[one.node, one.topic]
        ends = [end for end in chart.at(one.node) if (end.name, end.kind) ==
                (one.topic, "subscription")]  # fmt: skip
        if 0 < count < one.sent and ends[0].qos.depth < spec.burst and one.node not in chart.ended:
            yield "depth-too-small", one.node, one.topic
        if one.before and not one.sent and not count:
            yield (
                "first-messages-lost",
                one.topic,
                one.node,
                *(other.node for other in chart.published_at(one.topic)),
            )
    for one in chart.published:
        runs = one.node not in (*chart.ended, *unspun)
        yield from ((name, one.node, one.topic) for name in wrong_publisher(chart, one, runs))


def names_and_qos(chart):
    for order in chart.spec.wiring:
        mine = [end for end in chart.at(order.node) if end.kind == order.kind]
        if mine and all(end.name != order.topic for end in mine):
            name = mine[0].name
            if name.rpartition("/")[2] == order.topic.rpartition("/")[2]:
                yield "wrong-namespace", name, order.node
            elif len({end.kind for end in chart.at(name)}) == 2:
                yield "wrong-topic", name, order.node
            else:
                yield "topic-misspelled", name, order.node
    for topic in chart.topics:
        ends = chart.at(topic)
        unfit = [(one, other) for one, other in product(ends, ends)
                 if (one.kind, other.kind) == ("publisher", "subscription")
                 and incompatible(one.qos, other.qos)]  # fmt: skip
        if unfit:
            yield "qos-mismatch", topic, *{end.node for pair in unfit for end in pair}


def wrong_publisher(chart, one, runs):
    spec = chart.spec
    last_cause = max((other.last for other in chart.received_at(one.node)), default=chart.seconds)
    if runs and not one.count and chart.callbacks[one.node]:
        yield "never-published"
    if runs and one.period and last_cause - one.last > 3 * one.period:
        yield "gone-quiet"
    if {f"{spec.high:.1f} High", f"{spec.low:.1f} Low"} & set(one.values):
        yield "boundary"
    if one.topic != spec.topic or not one.count:
        return
    if all(one.node != order.node for order in spec.wiring):
        yield "two-sources"
    if one.period not in (0.0, spec.period):
        yield "wrong-rate"
    if len(one.values) == 1:
        yield "never-changes"
    over = max(spec.least - one.values[0], one.values[-1] - spec.most)
    if over > 0:
        unclamped = "wrong-unit" if over > 2 * OVERSHOOT else "no-clamp"
        yield "clamped-too-early" if over <= STEP else unclamped


def examined(broken, seed):
    """The session of a patient, its chart, and the faults that it shows."""
    with Patient(1, broken, seed).ros as ros:
        chart = chart_of(ros.observation(), broken)
        found = sorted((name, *sorted(places)) for name, *places in shown_faults(chart, ros))
        return chart, found, {topic: ros.explain(topic) for topic in ros.graph().topics()}


@pytest.mark.ros
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_patient_shows_its_fault_and_no_other(case, seed):
    rng = Random(f"{case.name} {seed}")
    broken = case.draw(rng, rng.choice(PLACES))
    chart, found, explained = examined(broken, seed)
    assert found == sorted((one.mistake, *sorted(one.places)) for one in broken.truths)
    assert len(broken.truths) == len(case.faults)
    places = {place for one in broken.truths for place in one.places}
    assert places <= {*chart.nodes, *chart.topics}
    if case.level == HEARD:
        assert all(one.is_well for one in explained.values())
    if case.level == SILENT:
        # Of two names that differ it may only ask whether they are meant to be one.
        named = {broken.truths[0].mistake, "no-publisher", "topic-misspelled"}
        assert named & {one.verdict for one in explained.values()}


@pytest.mark.ros
@pytest.mark.parametrize(
    "draw",
    [systems.healthy, systems.in_bursts, systems.with_humidity, systems.with_announcer],
)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_healthy_system_shows_nothing(draw, seed):
    rng = Random(seed)
    system = draw(rng, rng.choice(PLACES))
    chart, found, explained = examined(BrokenSystem("healthy", system, (), ""), seed)
    assert found == []
    assert 4 <= len(chart.nodes) <= 6
    assert all(one.sent and not one.before for one in chart.received)
    # Nobody has asked for the humidity yet.
    verdicts = {one.verdict for topic, one in explained.items() if not topic.endswith("humidity")}
    assert verdicts == {"all-is-well"}


# A patient.


@pytest.mark.ros
def test_a_patient_is_the_same_each_time():
    ward = Ward(7)
    for number in (3, 7, 10):
        assert ward.chart(number) == Ward(7).chart(number)
        with ward.patient(number).ros as one, ward.patient(number).ros as other:
            assert one.observation() == other.observation()


@pytest.mark.ros
def test_a_patient_runs_on_in_an_ordinary_session_that_opens_once():
    patient = Ward(7).patient(2)
    assert "ros" not in vars(patient)
    with patient.ros as ros:
        assert patient.ros is ros
        assert ros.time == 60.0
        before = len(ros.messages("cellar_temperature"))
        ros.run(seconds=10, quiet=True)
        assert len(ros.messages("cellar_temperature")) == before + 10


@pytest.mark.ros
def test_which_node_has_ended_is_not_printed(capsys):
    with Ward(7).patient(3).ros as ros:
        assert [fault.node for fault in ros.observation().faults] == ["/shelf_sensor"]
        ros.run(seconds=1)
    printed = capsys.readouterr()
    assert "stopped" not in printed.out + printed.err


def test_a_patient_shows_what_its_owner_says_and_ordered():
    # The page's outputs show the others.
    assert repr(Ward(7).patient(2)) == (
        "Patient 2: the wine cellar\n"
        '  "The plate should show the rule, but it stays empty. Everything else is fine."\n'
        "  Ordered: cellar_sensor -> /cellar_temperature -> cellar_monitor, cellar_diary\n"
        "           cellar_monitor -> /cellar_status -> cellar_panel\n"
        "           cellar_rules (once, soon after its start) -> /cellar_rule -> cellar_plate\n"
        "           a reading every 1 s, 8 to 17 degrees Celsius,\n"
        "           each one half a degree above or below the last one, or equal to it\n"
        "           Low below 10, High above 14, and Normal otherwise"
    )
    assert "water_hygrometer -> /water_humidity -> (no node)" in Ward(7).patient(6).orders
    assert "5 readings at once every 5 s" in Ward(7).patient(9).orders


def test_no_complaint_and_no_order_names_the_cause():
    for ward in WARDS:
        for number, broken in enumerate(drawn(ward), 1):
            said = repr(ward.patient(number))
            assert not any(truth.mistake in said for truth in broken.truths)
            assert "{" not in said


# A ward.


def test_over_fifty_seeds_every_case_comes_and_every_level_has_its_places():
    level_of = {case.name: case.level for case in CASES}
    assert {one.case for ward in WARDS for one in drawn(ward)} == set(level_of)
    for ward in WARDS:
        levels = [level_of[one.case] for one in drawn(ward)]
        assert levels == [SILENT] * 4 + [HEARD] * 4 + [PAIR] * 3
        assert len({one.case for one in drawn(ward)}) == len(ward)
        assert len({one.system.place for one in drawn(ward)}) == len(ward)


def test_the_same_seed_is_the_same_ward_and_another_one_is_another():
    assert [drawn(Ward(seed)) for seed in range(50)] == [drawn(ward) for ward in WARDS]
    assert len({repr(drawn(ward)) for ward in WARDS}) == len(WARDS)


@pytest.mark.parametrize("seed", ["7", -1, 7.0, True, None, 2**32])
def test_what_is_no_seed_is_refused(says, seed):
    with pytest.raises(ExerciseError) as caught:
        Ward(seed)
    says(caught.value, "There is no ward")


@pytest.mark.parametrize("number", [0, 12, "1", True, None])
def test_what_is_no_patient_is_refused(says, number):
    with pytest.raises(ExerciseError) as caught:
        Ward(7).patient(number)
    says(caught.value, "There is no patient")


def test_a_ward_lists_its_patients():
    assert repr(Ward(7)).splitlines()[0] == "Ward 7, 11 patients"
    assert repr(Ward(7)).splitlines()[3] == "  3: the library"


def test_a_ward_is_drawn_where_ros_is_not_loaded():
    assert sorted(clinic.__all__) == clinic.__all__
    code = (
        "import sys; from rosbeat import clinic; "
        "clinic.Ward(7).patient(1).complaint; sys.exit('rosbeat.clinic.nodes' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

"""The judge of findings, asked about made-up systems: it knows none by heart. Needs no ROS."""

import json

from rosbeat.exercises.scenarios import Report

from rosbeat.exercises.findings import QUESTIONS, judge_greenhouse
from rosbeat.exercises.findings_facts import GreenhouseFindings
from rosbeat.records import Endpoint, GraphSnapshot, LogRecord, Observation, QoS, Sample

KEYS = [question.key for question in QUESTIONS]
FLOAT, BOOL = "std_msgs/msg/Float32", "std_msgs/msg/Bool"


def end(node, name, kind, type_name=FLOAT, depth=10):
    return Endpoint(node, name, type_name, kind, QoS(depth=depth))


#: Another greenhouse than the page's: every answer is another one.
GRAPH = GraphSnapshot(
    ("/well", "/gardener", "/bell"),
    (
        end("/well", "/moisture", "publisher", BOOL, 7),
        end("/gardener", "/moisture", "subscription", BOOL, 4),
        end("/gardener", "/dust", "publisher"),
        end("/bell", "/wind", "subscription"),
        end("/bell", "/moisture", "subscription", BOOL, 9),
    ),
)
SAMPLES = tuple(
    Sample(n * 10**8, "/moisture", BOOL, "/well", {"data": True}) for n in range(1, 31)
) + tuple(Sample(n * 10**9, "/dust", FLOAT, "/gardener", {"data": 1.0}) for n in range(1, 4))
LOGS = (
    LogRecord(1, "WARN", "well", "dry", "f", 1),
    LogRecord(2, "INFO", "bell", "ding", "f", 1),
)
SYSTEM = Observation(3 * 10**9, 0, SAMPLES, LOGS, graph=GRAPH)
TRUTH = dict(zip(KEYS, ["/well", BOOL, 10, 4, "/dust", "/wind", "/well", 0.5], strict=True))


def judged(changes=(), said=None):
    given = {**TRUTH, **dict(changes)} if said is None else said
    report = Report(json.dumps(given), "", type(given).__name__)
    seen = GreenhouseFindings(report, SYSTEM, {"/gardener dry_below": 0.5, "/bell pitch": 440})
    return judge_greenhouse(seen)


def test_the_truth_comes_from_the_system():
    outcome = judged()
    assert outcome.status == "passed"
    assert "8 findings" in outcome.evidence


def test_what_is_true_of_the_page_is_wrong_here():
    page = dict(zip(KEYS, ["/soil_probe", "std_msgs/msg/Int32", 5, 3, "/lights", "/light",
                           "/lamp", 35], strict=True))  # fmt: skip
    for key, value in page.items():
        assert judged({key: value}).status == "failed"


def test_a_wrong_finding_is_named_without_the_right_one():
    for key, value in TRUTH.items():
        for given in ("/bell", "/moisture", 3, "a/b/c", "x"):
            outcome = judged({key: given})
            if outcome.status == "passed":
                continue
            assert repr(given) in outcome.evidence
            assert key in outcome.evidence
            said = f"{outcome.evidence.replace(key, '')} {outcome.hint}".split()
            assert str(value) not in said, outcome


def test_several_wrong_findings_are_counted():
    outcome = judged({KEYS[0]: "/bell", KEYS[2]: 3, KEYS[4]: "/wind"})
    assert "2 more" in outcome.evidence


def test_blanks_are_told_apart_from_wrong_ones():
    assert judged(dict.fromkeys(KEYS, "____")).status == "not attempted"
    outcome = judged({KEYS[3]: "____", KEYS[6]: ""})
    assert outcome.status == "not attempted"
    assert "6 of 8" in outcome.evidence
    assert KEYS[3] in outcome.evidence
    assert KEYS[6] in outcome.evidence
    assert judged({KEYS[3]: "____", KEYS[6]: "/bell"}).status == "failed"


def test_measured_numbers_may_be_a_little_off_and_chosen_ones_may_not():
    rate, depth, value = KEYS[2], KEYS[3], KEYS[7]
    assert judged({rate: 9.7}).status == judged({rate: "10.2"}).status == "passed"
    assert judged({rate: 9.0}).status == judged({depth: 4.1}).status == "failed"
    assert judged({value: 0.51}).status == "failed"


def test_the_other_side_of_a_topic_has_a_name():
    assert judged({KEYS[0]: "/gardener"}).mistake == "sides-confused"
    assert judged({KEYS[3]: 7}).mistake == "sides-confused"
    assert judged({KEYS[4]: "/wind"}).mistake == "sides-confused"
    assert judged({KEYS[5]: "/dust"}).mistake == "sides-confused"


def test_something_else_than_a_dict():
    assert judged(said=[1, 2]).mistake == "other-kind"
    assert judged(said={}).mistake == "finding-missing"
    assert judge_greenhouse(
        GreenhouseFindings(Report("", "", "NoneType"), SYSTEM, {})
    ).mistake == "returns-nothing"  # fmt: skip

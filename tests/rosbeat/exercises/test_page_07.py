"""Page 07: models of right and of misunderstood, what scenarios feed, and findings."""

import json

import pytest

from bank.running import outcome_of
from rosbeat import Session
from rosbeat.exercises.page_07 import Greenhouse, judge_findings
from rosbeat.exercises.registry import EXERCISES
from rosbeat.exercises.scenarios import Report
from rosbeat.records import Endpoint, GraphSnapshot, LogRecord, Observation, QoS, Sample

LATER = """
class Watcher(Node):
    def __init__(self):
        super().__init__("watcher")
        self.names, self.found = self.create_publisher(String, "warnings", 10), []
        self.create_subscription(Log, "/rosout", self.hear, 10)
        self.create_timer(PERIOD, self.tell)

    def hear(self, msg):
        if msg.level >= Log.WARN:
            self.found.append(msg.name)

    def tell(self):
        while self.found:
            self.names.publish(String(data=self.found.pop(0)))
"""


@pytest.mark.ros
@pytest.mark.parametrize(
    ("period", "said"),
    [
        ("0.5", "12 log lines"),
        ("0.7", "A name was published at 7.7 s, and the log line before it came at 7 s."),
    ],
)
def test_a_name_may_follow_its_line_a_moment_later(period, said):
    outcome = outcome_of("07c", LATER.replace("PERIOD", period), "Watcher")
    assert said in outcome.evidence, outcome


@pytest.mark.ros
def test_the_old_name_of_the_greenhouse_still_works_and_says_the_new_one():
    from rosbeat.scenarios.stranger import greenhouse

    with Session(seed=0) as ros:
        with pytest.warns(DeprecationWarning, match="add_greenhouse"):
            greenhouse(ros)
        assert len(ros.nodes) == 5


# Findings about another greenhouse than the page's: the judge knows none by heart.

FLOAT, BOOL = "std_msgs/msg/Float32", "std_msgs/msg/Bool"


def end(node, name, kind, type_name=FLOAT, depth=10):
    return Endpoint(node, name, type_name, kind, QoS(depth=depth))


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
RUN = Observation(3 * 10**9, 0, SAMPLES, LOGS, graph=GRAPH)
HOUSE = Greenhouse(RUN, {"/gardener dry_below": 0.5, "/bell pitch": 440})
TRUTH = {
    "publisher of /moisture": "/well",
    "type of /moisture": BOOL,
    "messages a second on /moisture": 10,
    "queue depth of /gardener for /moisture": 4,
    "topic without a listener": "/dust",
    "topic without a publisher": "/wind",
    "node that warns": "/well",
    "dry_below of /gardener": 0.5,
}
KEYS = list(TRUTH)


def judged(changes=()):
    found = Report(json.dumps({**TRUTH, **dict(changes)}), "", "dict")
    return EXERCISES["07a"].outcome(judge_findings(found, HOUSE))


def test_the_truth_comes_from_the_greenhouse_and_is_never_told():
    assert judged().status == "passed"
    for key, value in TRUTH.items():
        for given in ("/bell", "/moisture", 3, "a/b/c", "x", "/lamp", 35):
            outcome = judged({key: given})
            assert outcome.status == "failed"
            assert f"'{key}' you wrote {given!r}" in outcome.evidence
            said = f"{outcome.evidence.replace(key, '')} {outcome.hint}".split()
            assert str(value) not in said, outcome


def test_blanks_are_told_apart_from_wrong_findings():
    assert judged(dict.fromkeys(KEYS, "____")).status == "not attempted"
    outcome = judged({KEYS[3]: "____", KEYS[6]: ""})
    assert (outcome.status, outcome.mistake, outcome.points) == ("failed", "finding-missing", 2)
    assert outcome.evidence.startswith("6 of 8 findings are right.")
    assert outcome.evidence.endswith(f"Still open: {KEYS[3]}, {KEYS[6]}.")
    assert judged({KEYS[3]: "____", KEYS[6]: "/bell"}).mistake == "finding-wrong"


@pytest.mark.parametrize(("wrong", "points"), [(0, 3), (1, 2), (2, 2), (3, 1), (5, 1), (6, 0)])
def test_points_are_whole_and_those_of_the_findings_that_are_right(wrong, points):
    outcome = judged(dict.fromkeys(KEYS[:wrong], "/moisture"))
    assert (outcome.points, outcome.out_of) == (points, 3), outcome

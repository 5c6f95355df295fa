"""Findings beside a system, and facts from a record of it."""

import pytest
from rosbeat.exercises.scenarios import Report, report

from rosbeat.exercises import findings_facts as facts
from rosbeat.exercises.findings_facts import GreenhouseFindings, beside_the_greenhouse
from rosbeat.records import Observation, Sample


def system(*times):
    samples = tuple(Sample(round(at * 10**9), "/a", "T", "/n", {"data": 1}) for at in times)
    return GreenhouseFindings(Report(""), Observation(10**10, 0, samples), {})


@pytest.mark.parametrize(
    ("times", "rate"),
    [((), 0.0), ((1.0,), 0.0), ((1.0, 1.0), 0.0), ((1.0, 1.5, 2.0), 2.0), ((0.0, 10.0), 0.1)],
)
def test_a_rate_needs_two_messages_and_some_time(times, rate):
    assert facts.rate(system(*times), "/a") == rate
    assert facts.rate(system(*times), "/b") == 0.0


@pytest.mark.parametrize("name", ["lamp", "/lamp", " /lamp "])
def test_a_slash_more_or_less_does_not_matter(name):
    assert facts.full(name) == "/lamp"


def test_a_logger_s_name_is_a_node_s():
    assert facts.full("garden.lamp") == "/garden/lamp"


def test_a_list_of_names():
    assert facts.listed(()) == "nobody"
    assert facts.listed(("b", "a")) == "a and b"


@pytest.mark.ros
def test_what_was_said_stands_beside_what_is():
    seen = beside_the_greenhouse(report(lambda: {"node that warns": "/lamp"}))
    assert seen.said.value == {"node that warns": "/lamp"}
    assert "/lamp" in seen.system.graph.nodes
    assert seen.parameters["/window open_above"] == 25.0
    assert beside_the_greenhouse(Report("")).system == seen.system


@pytest.mark.ros
def test_an_answer_that_raises_is_evidence_too():
    seen = beside_the_greenhouse(report(lambda: 1 / 0))
    assert seen.said.problem.startswith("ZeroDivisionError")
    assert seen.system.samples

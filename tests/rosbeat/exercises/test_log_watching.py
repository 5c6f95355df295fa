"""The judge of the log watcher, asked about made-up runs. Needs no ROS."""

from itertools import pairwise

import pytest

from rosbeat.exercises.log_watching import counts, judge_log_watcher
from rosbeat.exercises.page_07_scenarios import LINES
from rosbeat.records import CallbackRecord, Observation, Sample

STRING = "std_msgs/msg/String"
HEARD = CallbackRecord(10**9, "/watcher", "subscription", "hear", "/rosout")
FED = CallbackRecord(10**9, "/tester", "step", "Publish", "/rosout")


def run(says, type_name=STRING, calls=(HEARD, FED), late=0.0):
    """What a node publishes that says so much of each line; None for nothing."""
    samples = [
        Sample(round((second + late) * 10**9), "/warnings", type_name, "/watcher", {"data": word})
        for second, line in enumerate(LINES, 1)
        for word in (says(line) or ())
    ]
    observation = Observation(20 * 10**9, 0, tuple(samples), callbacks=calls, subject="/watcher")
    return judge_log_watcher("07c", observation)


def from_level(level, text=lambda line: line.name):
    return lambda line: [text(line)] if line.level >= level else None


def test_the_right_one():
    assert run(from_level(30)).status == "passed"


RULES = {
    "all": (from_level(0), "level-too-low"),
    "INFO": (from_level(20), "level-too-low"),
    "errors": (from_level(40), "boundary"),
    "no FATAL": (lambda line: [line.name] if line.level in (30, 40) else None, "level-missed"),
    "the text": (from_level(30, lambda line: line.msg), "text-for-name"),
    "itself": (from_level(30, lambda line: "watcher"), "own-name"),
    "more": (from_level(30, lambda line: f"{line.name}!"), "stray-characters"),
    "something": (from_level(30, lambda line: "x"), "wrong-values"),
    "twice": (lambda line: [line.name] * 2 if counts(line) else None, "alert-too-many"),
}


@pytest.mark.parametrize("case", RULES)
def test_a_mistake_has_a_name(case):
    rule, mistake = RULES[case]
    outcome = run(rule)
    assert (outcome.status, outcome.mistake) == ("failed", mistake), outcome


def test_a_name_said_once():
    known = set()

    def once(line):
        if not counts(line) or line.name in known:
            return None
        known.add(line.name)
        return [line.name]

    assert run(once).mistake == "said-once"


def test_names_at_other_times_than_lines():
    assert run(from_level(30), late=0.25).mistake == "alert-too-many"


def test_another_type():
    assert run(from_level(30), type_name="std_msgs/msg/Float32").mistake == "type-mismatch"


def test_what_is_fed_is_not_what_is_heard():
    assert run(from_level(30), calls=(FED,)).mistake == "no-subscription"


def test_the_lines_try_everything():
    levels = [line.level for line in LINES]
    assert {10, 20, 30, 40, 50} == set(levels)
    named = [line.name for line in LINES if counts(line)]
    assert any(one == two for one, two in pairwise(named))
    assert any("." in name for name in named)
    assert any("warn" in line.msg.lower() and not counts(line) for line in LINES)
    assert any("error" in line.msg.lower() and not counts(line) for line in LINES)

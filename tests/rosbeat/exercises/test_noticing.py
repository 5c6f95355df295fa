"""The judge of a monitor that notices silences, asked about made-up runs. Needs no ROS."""

import pytest
from rosbeat.exercises.evidence import from_json, to_json

from rosbeat.exercises.noticing import judge_noticing
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

NODE, STRING = "/watchman", "std_msgs/msg/String"
READINGS = (5.0, 6.0, 8.5, 9.0, 18.0, 19.0, 27.0, 28.0)
RIGHT = ((12.0, "lost"), (18.0, "back"), (22.5, "lost"), (27.75, "back"))


def outcome(words=RIGHT, heard=True, type_name=STRING):
    second = 10**9
    said = [Sample(round(at * second), "/status", type_name, NODE, {"data": word})
            for at, word in words]  # fmt: skip
    calls = [CallbackRecord(5 * second, NODE, "subscription", "hear", "/temperature")] * heard
    ends = (
        Endpoint(NODE, "/temperature", "std_msgs/msg/Float32", "subscription", QoS()),
        Endpoint(NODE, "/status", type_name, "publisher", QoS()),
    )
    graph = GraphSnapshot((NODE,), ends)
    seen = Observation(30 * second, 0, tuple(said), (), tuple(calls), (), graph, NODE)
    assert from_json(to_json(seen)) == seen
    return judge_noticing("09a", seen, READINGS)


def test_each_silence_is_noticed_once_and_so_is_its_end():
    found = outcome()
    assert (found.status, found.mistake) == ("passed", "")
    assert "2 silences" in found.evidence


@pytest.mark.parametrize("at", [12.0, 12.99, 13.0])
def test_a_second_of_patience(at):
    assert outcome(((at, " LOST "), *RIGHT[1:])).status == "passed"


WRONG = {
    "nothing": ((), "silence-unnoticed", "from 9 s to 18 s"),
    "only the first": (RIGHT[:2], "silence-unnoticed", "from 19 s to 27 s"),
    "before the first reading": (((4.0, "lost"), *RIGHT), "lost-before-found", "at 5 s"),
    "in a short pause": (((8.0, "lost"), *RIGHT), "noticed-early", "at 8 s"),
    "a little too soon": (((11.9, "lost"), *RIGHT[1:]), "noticed-early", "at 11.9 s"),
    "a little too late": (((13.1, "lost"), *RIGHT[1:]), "noticed-late", "4.1 s after"),
    "when it is over": (((18.0, "lost"), *RIGHT[1:]), "noticed-afterwards", "at 18 s"),
    "again and again": ((RIGHT[0], (13.0, "lost"), *RIGHT[1:]), "status-repeated", "again at 13 s"),
    "back in the silence": ((RIGHT[0], (14.0, "back"), *RIGHT[2:]), "back-too-often", "18 s"),
    "back too late": ((RIGHT[0], (19.5, "back"), *RIGHT[2:]), "noticed-late", "back at 19.5 s"),
    "back without lost": (((5.0, "back"), *RIGHT), "back-too-often", "at 5 s"),
    "back twice": ((*RIGHT[:2], (19.0, "back"), *RIGHT[2:]), "back-too-often", "at 19 s"),
    "back at the end": ((*RIGHT, (28.0, "back")), "back-too-often", "at 28 s"),
    "lost at the end": ((*RIGHT, (29.0, "lost")), "noticed-early", "at 29 s"),
    "never back": ((RIGHT[0], RIGHT[2]), "back-missing", "at 18 s"),
    "not back at the end": (RIGHT[:3], "back-missing", "at 27 s"),
    "another word": (((12.0, "gone"), *RIGHT[1:]), "wrong-word", "'gone'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_mistake_has_its_name(case):
    words, mistake, evidence = WRONG[case]
    found = outcome(words)
    assert (found.status, found.mistake) == ("failed", mistake), found
    assert evidence in found.evidence
    assert found.hint


def test_what_is_missing_is_told_first():
    assert outcome(heard=False).mistake != ""
    assert outcome(type_name="std_msgs/msg/Float32").mistake == "type-mismatch"

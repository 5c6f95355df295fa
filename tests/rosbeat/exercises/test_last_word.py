"""The judge of the last word, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.last_word import judge_last_word
from rosbeat.exercises.page_08_scenarios import Display
from rosbeat.records import (
    CallbackRecord,
    Endpoint,
    GraphSnapshot,
    LogRecord,
    Observation,
    QoS,
    Sample,
)

STRING = "std_msgs/msg/String"
KEPT = QoS(depth=10, durability="TRANSIENT_LOCAL")
COMMANDS = ((1.0, "drive"), (2.0, "drive"), (3.0, "stop"))
MODES = ((0.0, "idle"), (1.0, "drive"), (3.0, "stop"))
EARLY, LATE, NEW = Display("early", 0.5, KEPT), Display("late", 2.5, KEPT), Display("new", 2.5)
HEARD = {"early": ["idle", "drive", "stop"], "late": ["drive", "stop"], "new": ["stop"]}


def ns(seconds):
    return round(seconds * 10**9)


def run(modes=MODES, offers=QoS(depth=1, durability="TRANSIENT_LOCAL"), obeyed=True, **heard):  # noqa: B008
    """Ask about a keeper that published these modes, and displays that heard these words."""
    samples = [Sample(ns(at), "/mode", STRING, "/keeper", {"data": word}) for at, word in modes]
    logs = [
        LogRecord(ns(1), "INFO", name, word, "", 0)
        for name, words in (HEARD | heard).items()
        for word in words
    ]
    calls = [CallbackRecord(ns(at), "/keeper", "subscription", "obey", "/command")
             for at, _ in COMMANDS if obeyed]  # fmt: skip
    ends = (Endpoint("/keeper", "/mode", STRING, "publisher", offers),)
    graph = GraphSnapshot(("/keeper",), ends)
    seen = Observation(ns(5), 0, tuple(samples), tuple(logs), tuple(calls), (), graph, "/keeper")
    return judge_last_word("08a", seen, COMMANDS, (EARLY, LATE, NEW))


def test_the_right_one():
    assert run().status == "passed"
    assert "3 displays" in run().evidence


@pytest.mark.parametrize(
    ("modes", "mistake", "said"),
    [
        (((0.0, "ready"), *MODES[1:]), "wrong-start", "'ready', at 0 s"),
        (((0.5, "idle"), *MODES[1:]), "wrong-start", "at 0.5 s"),
        ((*MODES[:2], (2.0, "drive"), MODES[2]), "status-repeated", "At 2 s 'drive'"),
        (MODES[:2], "change-missing", "At 3 s the command was 'stop'"),
        ((*MODES[:2], (3.0, "STOP")), "wrong-values", "'STOP'"),
        ((*MODES, (4.0, "idle")), "wrong-values", "no command asked for it"),
        ((*MODES[:2], (3.5, "stop")), "change-missing", "At 3 s"),
    ],
)
def test_what_was_published(modes, mistake, said):
    outcome = run(modes)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert said in outcome.evidence


def test_a_keeper_that_obeys_nobody():
    assert run(MODES[:1]).mistake == "change-missing"
    outcome = run(MODES[:1], obeyed=False)
    assert outcome.mistake == "no-subscription"


@pytest.mark.parametrize(
    ("options", "mistake", "said"),
    [
        ({"late": ["idle", "drive", "stop"]}, "old-words-too", "'idle' first"),
        ({"late": ["stop"]}, "not-kept", "'drive'"),
        ({"early": [], "offers": QoS()}, "not-kept", "offers VOLATILE"),
        ({"new": [], "offers": QoS("BEST_EFFORT", "TRANSIENT_LOCAL")}, "qos-mismatch", "RELIABLE"),
        # Nothing that these policies explain gets no name.
        ({"late": []}, "new-to-me", "heard nothing, and it should hear 'drive', 'stop'"),
        ({"new": ["drive", "x", "stop"]}, "old-words-too", "'drive', 'x'"),
        ({"late": ["stop", "drive"]}, "new-to-me", "'stop', 'drive'"),
    ],
)
def test_what_was_heard(options, mistake, said):
    outcome = run(**options)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert said in outcome.evidence
    assert outcome.hint

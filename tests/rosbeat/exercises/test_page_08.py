"""Page 08: each misunderstanding shows in what the scenarios feed, and evidence says where."""

from dataclasses import replace
from itertools import combinations

import pytest

from bank.answer import edited
from bank.beyond.archive_right import BASE as ARCHIVE
from bank.beyond.deadline_right import BASE as WATCHDOG
from bank.beyond.mode_keeper_right import BASE as KEEPER
from bank.running import outcome_of
from rosbeat.exercises import page_08 as page
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.model import agree, matching
from rosbeat.records import Endpoint, GraphSnapshot, Observation, QoS

ONE, ROOMY = QoS(depth=1, durability="TRANSIENT_LOCAL"), QoS("BEST_EFFORT", depth=16)
MODES = [(at, word) for at, (word,) in page._keep_mode(page.COMMANDS).items()]
SECOND = 10**9
#: What is fed, the right model, and the suspects.
MODELS = {
    "08a, modes": (page.COMMANDS, page._keep_mode(page.COMMANDS), page.KEEPERS),
    "08c": (
        page.TIMES,
        page._watch(page.TIMES),
        (*page.WATCHDOGS, *page.deadline_suspects([QoS(deadline_ns=3 * SECOND)])),
    ),
}


@pytest.mark.parametrize("name", MODELS)
def test_each_suspect_differs_from_the_right_model_and_from_other_mistakes(name):
    fed, right, suspects = MODELS[name]
    for one in suspects:
        assert not agree(one.model(fed), right), one
    for one, other in combinations(suspects, 2):
        assert one.mistake == other.mistake or not agree(one.model(fed), other.model(fed))


@pytest.mark.parametrize(
    ("wrong", "mistake"),
    [
        ({"durability": "VOLATILE"}, "not-kept"),
        ({"reliability": "BEST_EFFORT"}, "qos-mismatch"),
        ({"depth": 2}, "old-words-too"),
        ({"history": "KEEP_ALL"}, "old-words-too"),
        ({"lifespan_ns": SECOND // 2}, "lifespan-too-short"),
        ({"lifespan_ns": 20 * SECOND}, "lifespan-too-short"),
    ],
)
def test_each_policy_of_a_publisher_of_modes_shows_in_what_displays_hear(wrong, mistake):
    offers = replace(ONE, **wrong)
    done = page._heard_by_displays(MODES, offers)
    assert not agree(done, page._heard_by_displays(MODES, ONE))
    found = matching(MODES, done, page.offer_suspects(MODES, offers))
    assert {one.mistake for one in found} == {mistake}


@pytest.mark.parametrize(
    ("wrong", "mistake"),
    [
        ({"reliability": "RELIABLE"}, "qos-mismatch"),
        ({"durability": "TRANSIENT_LOCAL"}, "qos-mismatch"),
        ({"deadline_ns": SECOND}, "qos-mismatch"),
        ({"depth": 15}, "queue-too-short"),
        ({"depth": 1}, "queue-too-short"),
        ({"lifespan_ns": 7 * SECOND}, "lifespan-too-short"),
    ],
)
def test_each_policy_of_an_archive_shows_in_what_it_holds(wrong, mistake):
    asks = replace(ROOMY, **wrong)
    done = page._archive(page.FED, asks)
    assert not agree(done, page._archive(page.FED, ROOMY))
    found = matching(page.FED, done, page.archive_suspects([asks]))
    assert {one.mistake for one in found} == {mistake}


@pytest.mark.ros
@pytest.mark.parametrize(
    ("exercise", "answer", "said"),
    [
        ("08a", edited(KEEPER, ("depth=1,", "depth=3,")),
         ("at 2.5 s", "heard 'idle', 'drive', 'stop'", "'drive', 'stop'", "a depth of 3")),
        ("08a", edited(KEEPER, ("!= self.mode", "!= 'idle'")),
         ("At 2 s", "'drive' on /mode; nothing was due")),
        ("08b", edited(ARCHIVE, ("depth=16", "depth=15")),
         ("23.125", "1 of 40 readings", "from 5.5 s to 13.5 s", "BEST_EFFORT, VOLATILE")),
        ("08c", edited(WATCHDOG, ("seconds=2", "seconds=3")),
         ("'lost', at 9 s; 'lost' was due, at 8 s", "a deadline of 3 s")),
    ],
)  # fmt: skip
def test_evidence_shows_the_first_moment_and_both_values(exercise, answer, said):
    found = outcome_of(exercise, answer, answer.split("(")[0].removeprefix("class "))
    assert [one for one in said if one not in found.evidence] == [], found


@pytest.mark.ros
def test_both_types_are_named_where_another_one_is_refused():
    other = edited(ARCHIVE, ('(Float32, "reading"', '(String, "reading"'))
    found = outcome_of("08b", other, "Archive")
    assert "On /reading, your node uses String and the other side Float32." in found.evidence


@pytest.mark.ros
def test_a_word_in_capitals_is_told_that_capitals_count():
    found = outcome_of("08c", edited(WATCHDOG, ('"lost"', '"Lost"')), "Watchdog")
    assert (found.mistake, "Capitals" in found.hint) == ("wrong-word", True)


@pytest.mark.ros
def test_only_a_policy_that_stands_alone_is_called_one():
    profile = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
    hints = [
        outcome_of("08a", edited(KEEPER, (profile, wrong)), "ModeKeeper").hint
        for wrong in ("DurabilityPolicy.TRANSIENT_LOCAL", "QoSProfile(depth=1)", "1")
    ]
    assert ["policy alone" in hint for hint in hints] == [True, False, False]


def test_a_policy_that_stands_alone_is_written_down():
    end = Endpoint("/a", "/b", "c", "publisher", QoS(policy_alone="TRANSIENT_LOCAL"))
    seen = Observation(1, 0, graph=GraphSnapshot(("/a",), (end,)))
    assert from_json(to_json(seen)) == seen

"""Each misunderstanding shows in what the scenarios feed: no suspect is right, or another one."""

from dataclasses import replace
from functools import cache, partial

import pytest

from rosbeat.exercises import page_04, page_07, page_08, page_09, page_11, page_12
from rosbeat.exercises.model import agree, matching, tells_apart
from rosbeat.exercises.page_09 import WORK
from rosbeat.exercises.page_12 import DECISIONS, HEATERS, THERMOSTATS, in_turn, right_thermostat
from rosbeat.exercises.registry import EXERCISES
from rosbeat.exercises.system import _SUSPECTS, TOLD, _monitor
from rosbeat.records import QoS

SECOND = 10**9


@cache
def fed(exercise, seed=0):
    """Return what an exercise draws, once for all tests: a draw simulates each suspect."""
    (drawn,) = EXERCISES[exercise].inputs(seed)
    return drawn


def noted(lines):
    """Return log lines as those models are fed them that say what to publish of each."""
    return {1.0 * number: (line, "/watcher") for number, line in enumerate(lines, 1)}


#: What is fed, what is right, the suspects, and maybe when two values are the same; of an exercise
#: that draws its inputs, its id in the place of what is fed.
TABLES = {
    "04a": ("04a", page_04._each(page_04._state), page_04.FRIDGE_SUSPECTS),
    "04b": ("04b", page_04._alerts(), page_04.ROOM_SUSPECTS),
    "04c": ("04c", page_04._means(), page_04.MEAN_SUSPECTS),
    "04d": ("04d", page_04._statuses(compares=False), page_04.EACH_SUSPECTS),
    "04e": ("04e", page_04._statuses(), page_04.STATUS_SUSPECTS),
    "07b": ("07b", page_07._right, page_07._SUSPECT_MONITORS),
    "07b defaults": (
        fed("07b"),
        page_07._right,
        (*page_07._SUSPECT_MONITORS, *page_07.default_suspects(fed("07b").readings)),
    ),
    "07c": ("07c", page_07._warnings, page_07._SUSPECT_LINES),
    "07c name": (
        fed("07c"),
        page_07._warnings,
        (*page_07._SUSPECT_LINES, *page_07._single_names(fed("07c"))),
    ),
    "07c text": (noted(fed("07c")), page_07._names, page_07._SUSPECT_TEXTS),
    "08a": ("08a", page_08._keep_mode, page_08.KEEPERS),
    "08c": ("08c", page_08._watch, page_08._WITH_A_LATE_DEADLINE),
    "09a": ("09a", page_09._watch(), page_09.SILENCE_SUSPECTS),
    "09b": ("09b", page_09._worker(), page_09.WORK_SUSPECTS),
    "09b, longer": (
        fed("09b")._replace(each=WORK + 0.5),
        page_09._worker(),
        page_09.WORK_SUSPECTS,
    ),
    # Elsewhere, limits that stay at their defaults are right, or cannot be told from each other.
    "09c": (fed("09c")[1], page_09._words(), page_09.PLACE_SUSPECTS),
    **{
        f"11a {key}": ("11a", partial(page_11._in_each, find=find), found, page_11._near)
        for key, (find, found) in page_11.ASKED.items()
    },
    "11b": ("11b", *page_11.models()),
    "12a": ("12a", *page_12.SERVICE_MODELS, page_12.same),
    "12b": ("12b", *page_12.PARAMETER_MODELS, page_12.same),
    "system": (TOLD, _monitor, _SUSPECTS),
    "12c": (fed("12c").goals, *in_turn(right_thermostat, DECISIONS), page_12.same),
    "12d": (fed("12d").goals, *in_turn(right_thermostat, HEATERS), page_12.same),
    "12e": (fed("12e").goals, *in_turn(right_thermostat, THERMOSTATS), page_12.same),
}
DRAWN = {name: table for name, table in TABLES.items() if isinstance(table[0], str)}
#: Seeds that are tried of each exercise; the first one is the page's.
SEEDS = range(11)
#: Many more, a few minutes, in a thorough run.
MANY = pytest.param(range(1_001), marks=[pytest.mark.thorough, pytest.mark.timeout(3_600)])


@pytest.mark.parametrize("seeds", [SEEDS, MANY], ids=len)
@pytest.mark.parametrize("exercise", [one.id for one in EXERCISES.values() if one.draw])
def test_evidence_that_was_made_in_advance_does_not_fit(exercise, seeds):
    assert len({repr(fed(exercise, seed)) for seed in seeds}) > 0.99 * len(seeds)


@pytest.mark.parametrize("name", [name for name in TABLES if name not in DRAWN])
def test_each_suspect_differs_from_the_right_model_and_from_other_mistakes(name):
    assert tells_apart(*TABLES[name])


@pytest.mark.parametrize("seeds", [SEEDS, MANY], ids=len)
@pytest.mark.parametrize("name", DRAWN)
def test_whatever_is_drawn_tells_each_suspect_from_the_right_model_and_from_other_mistakes(
    name, seeds
):
    exercise, *models = DRAWN[name]
    assert all(tells_apart(fed(exercise, seed), *models) for seed in seeds)


def test_other_limits_show_wherever_a_monitor_is_told_of_them():
    right = page_09._words()
    for _, greenhouse, _ in (fed("09c", seed) for seed in SEEDS):
        assert tells_apart(greenhouse, right, page_09.PLACE_SUSPECTS)


# Policies of a publisher and of a subscription, page 08.

ONE, ROOMY = QoS(depth=1, durability="TRANSIENT_LOCAL"), QoS("BEST_EFFORT", depth=16)
POLICIES = [
    ("08a", {"durability": "VOLATILE"}, "not-kept"),
    ("08a", {"reliability": "BEST_EFFORT"}, "qos-mismatch"),
    ("08a", {"depth": 2}, "old-words-too"),
    ("08a", {"history": "KEEP_ALL"}, "old-words-too"),
    ("08a", {"lifespan_ns": SECOND // 2}, "lifespan-too-short"),
    ("08a", {"lifespan_ns": 20 * SECOND}, "lifespan-too-short"),
    ("08b", {"reliability": "RELIABLE"}, "qos-mismatch"),
    ("08b", {"durability": "TRANSIENT_LOCAL"}, "qos-mismatch"),
    ("08b", {"deadline_ns": SECOND}, "qos-mismatch"),
    ("08b", {"depth": 15}, "queue-too-short"),
    ("08b", {"depth": 1}, "queue-too-short"),
    ("08b", {"lifespan_ns": 7 * SECOND}, "lifespan-too-short"),
]


@pytest.mark.parametrize(("exercise", "wrong", "mistake"), POLICIES)
def test_each_policy_shows_in_what_is_heard(exercise, wrong, mistake):
    for inputs in (fed(exercise, seed) for seed in range(11)):
        if exercise == "08a":
            words = [(at, word) for at, (word,) in page_08._keep_mode(inputs).items()]
            inputs, right = page_08.Modes(words, inputs.joins), ONE  # what displays hear
            heard, suspects = page_08._heard_by_displays, page_08.offer_suspects
            found = suspects(inputs, replace(right, **wrong))
        else:
            right, heard = ROOMY, page_08._archive
            found = page_08.archive_suspects(inputs, [replace(right, **wrong)])
        done = heard(inputs, replace(right, **wrong))
        assert not agree(done, heard(inputs, right))
        assert {one.mistake for one in matching(inputs, done, found)} == {mistake}

"""Each misunderstanding shows in what the scenarios feed: no suspect is right, or another one."""

from dataclasses import replace
from functools import partial

import pytest

from rosbeat.exercises import page_04, page_07, page_08, page_09, page_11, page_12
from rosbeat.exercises.model import agree, matching, tells_apart
from rosbeat.exercises.page_09 import GREENHOUSE, HOME, PORCH, WORK
from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import QoS

SECOND = 10**9
#: What is fed, what is right, the suspects, and maybe when two values are the same; of an exercise
#: that draws its inputs, its id in the place of what is fed.
TABLES = {
    "04a": ("04a", page_04._each(page_04._state), page_04.FRIDGE_SUSPECTS),
    "04b": ("04b", page_04._alerts(), page_04.ROOM_SUSPECTS),
    "04c mean": ("04c", page_04._means(), page_04.MEAN_SUSPECTS),
    "04c status": ("04c", page_04._statuses(), page_04.STATUS_SUSPECTS),
    **{f"07 {number}": table for number, table in enumerate(page_07.MODELS)},
    "08a": (page_08.COMMANDS, page_08._keep_mode, page_08.KEEPERS),
    "08c": (
        page_08.TIMES,
        page_08._watch,
        (*page_08.WATCHDOGS, *page_08.deadline_suspects([QoS(deadline_ns=3 * SECOND)])),
    ),
    "09a": (page_09.READINGS, page_09._watch(), page_09.SILENCE_SUSPECTS),
    "09b": (WORK, page_09._worker(), page_09.WORK_SUSPECTS),
    "09b, longer": (WORK + 0.5, page_09._worker(), page_09.WORK_SUSPECTS),
    # Elsewhere, limits that stay at their defaults are right, or cannot be told from each other.
    "09c": (GREENHOUSE, page_09._words(), page_09.PLACE_SUSPECTS),
    **{
        f"11a {key}": ("11a", partial(page_11._in_each, find=find), found, page_11._near)
        for key, (find, found) in page_11.ASKED.items()
    },
    "11b": ("11b", *page_11.SICK_SENSOR.models),
    "11c": ("11c", *page_11.TWO_SENSORS.models),
    "12a": ("12a", *page_12.SERVICE_MODELS, page_12.same),
    "12b": ("12b", *page_12.PARAMETER_MODELS, page_12.same),
}
DRAWN = {name: table for name, table in TABLES.items() if isinstance(table[0], str)}
#: Seeds that are tried of each exercise; the first one is the page's.
SEEDS = range(1_001)
#: The same for exercises whose nodes hear several hundred messages; each is simulated.
FEW_SEEDS = {"11b": range(101), "11c": range(51)}


@pytest.mark.parametrize("name", [name for name in TABLES if name not in DRAWN])
def test_each_suspect_differs_from_the_right_model_and_from_other_mistakes(name):
    assert tells_apart(*TABLES[name])


@pytest.mark.parametrize("name", DRAWN)
def test_whatever_is_drawn_tells_each_suspect_from_the_right_model_and_from_other_mistakes(name):
    exercise, *models = DRAWN[name]
    seeds = FEW_SEEDS.get(name, SEEDS)
    draws = [EXERCISES[exercise].inputs(seed) for seed in seeds]
    assert len(set(map(repr, draws))) > 0.99 * len(seeds)  # what was made in advance does not fit
    assert all(tells_apart(fed, *models) for (fed,) in draws)


@pytest.mark.parametrize("suspect", [page_09.TOO_SHORT, page_09.TOO_LONG])
def test_work_of_another_length_is_not_right(suspect):
    assert suspect.model(WORK + 1) != suspect.model(WORK)


@pytest.mark.parametrize("place", [HOME, PORCH])
def test_limits_that_no_parameter_changes_are_right_where_they_are_the_defaults(place):
    fixed = [one for one in page_09.PLACE_SUSPECTS if one.mistake == "limits-fixed"]
    at_default = replace(place, low=20.0, high=26.0)
    assert all(one.model(at_default) == page_09._words()(at_default) for one in fixed)


# Policies of a publisher and of a subscription, page 08.

ONE, ROOMY = QoS(depth=1, durability="TRANSIENT_LOCAL"), QoS("BEST_EFFORT", depth=16)
MODES = [(at, word) for at, (word,) in page_08._keep_mode(page_08.COMMANDS).items()]


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
    done = page_08._heard_by_displays(MODES, offers)
    assert not agree(done, page_08._heard_by_displays(MODES, ONE))
    found = matching(MODES, done, page_08.offer_suspects(MODES, offers))
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
    done = page_08._archive(page_08.FED, asks)
    assert not agree(done, page_08._archive(page_08.FED, ROOMY))
    found = matching(page_08.FED, done, page_08.archive_suspects([asks]))
    assert {one.mistake for one in found} == {mistake}

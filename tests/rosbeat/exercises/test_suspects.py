"""Each misunderstanding shows in what the scenarios feed: no suspect is right, or another one.

Tables of suspects are found by judging each published solution: whatever the judge hands to
`diagnose` is tried here. So a new exercise needs no line in this file.
"""

import ast
import warnings
from dataclasses import replace
from functools import cache
from importlib import import_module
from itertools import combinations
from pathlib import Path
from unittest.mock import patch

import pytest

import rosbeat
from bank.pages import solution, subject
from bank.running import namespace_of
from bank.workspaces import EXERCISES as ON_FILES
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN, unknown_mistake
from rosbeat.exercises import model, page_07, page_08, page_09, page_11, page_12
from rosbeat.exercises.model import Suspect, agree, matching, suspects, tells_apart
from rosbeat.exercises.page_09 import WORK
from rosbeat.exercises.page_12 import DECISIONS, HEATERS, in_turn, right_thermostat
from rosbeat.exercises.registry import EXERCISES, PAGES
from rosbeat.exercises.system import _SUSPECTS, TOLD, _monitor
from rosbeat.records import QoS

SECOND = 10**9
SOURCE = Path(rosbeat.__file__).parent
#: Pages whose judges compare an answer with models.
JUDGED = sorted(set(EXERCISES) - {"system", *ON_FILES})


@cache
def fed(exercise, seed=0):
    """Return what an exercise draws, once for all tests: a draw simulates each suspect."""
    return next(iter(EXERCISES[exercise].inputs(seed)), None)


# Tables that a judge hands to `diagnose`.


@cache
def compared(exercise, seed=0):
    """Judge the published solution; return each table of suspects with what it was tried on.

    A judge may compare a run piece by piece, such as goal by goal. Then the pieces together have to
    tell two suspects apart.
    """
    calls = {}
    usual = model.diagnose

    def diagnose(given, done, right, tried, describe, same=model.equal):
        tried = tuple(tried)
        names = tuple((one.mistake, one.hint) for one in tried)
        calls.setdefault(names, []).append((given, right, tried, same))
        return usual(given, done, right, tried, describe, same)

    found = EXERCISES[exercise]
    inputs = (fed(exercise, seed),) if found.draw else ()
    with patch.object(module_of(exercise), "diagnose", diagnose, create=True):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # as in a cell
            space = namespace_of(exercise, solution(exercise), f"<solution of {exercise}>")
            seen = found.scenario(eval(subject(exercise), space), *inputs, **found.given())
        assert found.outcome(found.judge(seen, *inputs)).status == "passed"
    return calls


def module_of(exercise):
    return import_module(f"rosbeat.exercises.page_{exercise[:2]}")


def confused(calls):
    """Return pairs of mistakes that no piece of a run tells apart; an empty text is a right node.

    Suspects of one mistake need not be told apart: the learner gets both hints.
    """
    names = ["", *(one.mistake for one in calls[0][2])]
    runs = [
        ([right, *(one.model(given) for one in tried)], same) for given, right, tried, same in calls
    ]
    return {
        (names[first], names[second])
        for first, second in combinations(range(len(names)), 2)
        if names[first] != names[second]
        and all(agree(tracks[second], tracks[first], same) for tracks, same in runs)
    }


#: Exercises whose judges hand over more than can be told apart: on page 08, suspects are made of
#: what the answer itself asks for (`POLICIES` below), and exercises of page 12 share a table of
#: which some rows are about a later one (`TABLES`).
MORE_THAN_FED = ("08a", "08b", "08c", "12a", "12c", "12d")
#: Seeds that are tried of each exercise; the first one is the page's.
SEEDS = range(11)
#: Many more, a few minutes, in a thorough run.
MANY = pytest.param(range(1_001), marks=[pytest.mark.thorough, pytest.mark.timeout(3_600)])
RUNS = pytest.param(range(101), marks=[pytest.mark.thorough, pytest.mark.timeout(3_600)])


@pytest.mark.ros
@pytest.mark.parametrize("seeds", [SEEDS, RUNS], ids=len)
@pytest.mark.parametrize("exercise", [one for one in JUDGED if one not in MORE_THAN_FED])
def test_what_is_fed_tells_each_suspect_from_a_right_node_and_from_other_mistakes(exercise, seeds):
    for seed in seeds if EXERCISES[exercise].draw else [0]:
        for calls in compared(exercise, seed).values():
            pairs = confused(calls)
            assert not pairs, (
                f"With seed {seed}, {exercise} is fed nothing that tells these apart: {pairs}. "
                "Feed it something at which they differ."
            )


#: What is fed, what is right, and the suspects, where a judge tries them only after something else
#: has told that the answer is wrong; of an exercise that draws its inputs, its id.
TABLES = {
    "07b defaults": (
        fed("07b"),
        page_07._right,
        (*page_07._SUSPECT_MONITORS, *page_07.default_suspects(fed("07b").readings)),
    ),
    "07c name": (
        fed("07c"),
        page_07._warnings,
        (*page_07._SUSPECT_LINES, *page_07._single_names(fed("07c"))),
    ),
    "08a": ("08a", page_08._keep_mode, page_08.KEEPERS),
    "08c": ("08c", page_08._watch, page_08._WITH_A_LATE_DEADLINE),
    "09b": ("09b", page_09._worker(), page_09.WORK_SUSPECTS),
    "09b, longer": (
        fed("09b")._replace(each=WORK + 0.5),
        page_09._worker(),
        page_09.WORK_SUSPECTS,
    ),
    "11b": ("11b", *page_11.models()),
    "12a": ("12a", *page_12.SERVICE_MODELS, page_12.same),
    "12c": (fed("12c").goals, *in_turn(right_thermostat, DECISIONS), page_12.same),
    "12d": (fed("12d").goals, *in_turn(right_thermostat, HEATERS), page_12.same),
    "system": (TOLD, _monitor, _SUSPECTS),
}
DRAWN = {name: table for name, table in TABLES.items() if isinstance(table[0], str)}
#: Tables that are compared with what an answer left or did, and with nothing that is fed to it.
NOT_FED = {
    "page_01._SUSPECTS": "folders that were made",
    "page_11.SUSPECTS": "a recording at a time; page_11.models makes them models of all",
    "page_13.VENTS": "what a system commanded",
    "page_13.FORGETFUL": "what a system commanded",
    "page_13.REPORTERS": "what a system reported",
}


@pytest.mark.ros
@pytest.mark.parametrize(
    "page", [page for page in PAGES if page.number], ids=lambda one: one.number
)
def test_every_table_of_suspects_is_tried_here(page):
    module = module_of(page.number)
    tried = {one for exercise in page.exercises if exercise.id in JUDGED
             for names in compared(exercise.id) for one in names}  # fmt: skip
    tried |= {(one.mistake, one.hint) for _, _, some, *_ in TABLES.values() for one in some}
    for name, table in vars(module).items():
        if not isinstance(table, tuple) or not any(isinstance(one, Suspect) for one in table):
            continue
        place = f"page_{page.number}.{name}"
        assert place in NOT_FED or {(one.mistake, one.hint) for one in table} <= tried, (
            f"No test has tried {place}: judging the published solution hands it to no `diagnose`. "
            "Add it to TABLES, with what is fed and with what is right."
        )


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


def test_a_suspect_of_an_unknown_mistake_is_refused_where_it_is_written():
    with pytest.raises(ValueError, match=r"no mistake 'off-by-one'.*'counted-wrong'.*add a line"):
        suspects(("boundary", "Look.", dict), ("off-by-one", "Look.", dict))
    assert suspects(*((name, "Look.", dict) for name in MISTAKES))


def test_every_diagnosis_in_the_code_has_a_known_name():
    # Only the bank reaches most of them, so the names are read from the code itself.
    unknown = [
        f"{path.name}:{node.lineno}: {unknown_mistake(node.args[0].value)}"
        for path in SOURCE.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_bytes()))
        if isinstance(node, ast.Call)
        and getattr(node.func, "id", "") == "Diagnosis"
        and node.args
        and isinstance(node.args[0], ast.Constant)
        and node.args[0].value not in {UNKNOWN, *MISTAKES}
    ]
    assert not unknown


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

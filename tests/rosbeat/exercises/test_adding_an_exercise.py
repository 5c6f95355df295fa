"""docs/exercises.md adds an exercise; what stands there is built here, as it stands."""

import re
from pathlib import Path
from types import ModuleType

import pytest

from bank.pages import imports
from bank.reading import parse
from bank.running import outcome_of
from rosbeat import hint
from rosbeat.exercises import registry
from rosbeat.exercises.model import agree

DOCS = Path(__file__).parents[3] / "docs" / "exercises.md"
SOLUTION, EXERCISE, ANSWERS = re.findall(
    r"^```(?:python|text)\n(.*?)^```", DOCS.read_text("utf-8"), re.DOTALL | re.MULTILINE
)


def run(text, name):
    module = ModuleType(name)
    exec(compile(text, name, "exec"), vars(module))
    return module


@pytest.fixture(scope="module")
def page():
    return run(EXERCISE, "page_14")


@pytest.fixture
def added(page, monkeypatch, tmp_path):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    like_page_04 = imports("04a")
    monkeypatch.setattr("bank.running.imports", lambda _: like_page_04)
    for one in page.EXERCISES:
        monkeypatch.setitem(registry.EXERCISES, one.id, one)


def test_it_is_short():
    code = [line for line in EXERCISE.splitlines() if line.strip()]
    assert len(code) < 80


@pytest.mark.ros
@pytest.mark.parametrize("answer", parse("14a", ANSWERS, SOLUTION), ids=lambda one: one.id)
def test_each_answer_is_told_what_is_right_or_wrong(added, answer):
    outcome = outcome_of(answer.exercise, answer.text, answer.subject)
    assert outcome.status == answer.status, outcome
    assert outcome.mistake in (answer.mistakes or ("",)), outcome
    assert outcome.points == (2 if outcome.status == "passed" else 0)


def test_its_suspects_can_be_told_apart(page):
    tracks = [page.lamp(page.READINGS), *(one.model(page.READINGS) for one in page.SUSPECTS)]
    assert not [1 for k, one in enumerate(tracks) for other in tracks[:k] if agree(one, other)]


def test_hints_come_one_by_one(added):
    assert "remembers" in str(hint("14a"))
    assert "publish it only" in str(hint("14a"))

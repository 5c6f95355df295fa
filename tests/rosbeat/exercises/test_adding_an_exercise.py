"""docs/exercises.md adds an exercise; what it prints is built here, as it is printed."""

import re
from collections import Counter
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from bank.reading import parse
from bank.running import outcome_of
from bank.test_bank import least
from rosbeat import hint
from rosbeat.authoring.lint import check_lessons
from rosbeat.authoring.source import Course, read_lesson, with_answers
from rosbeat.exercises import quiz, registry
from rosbeat.exercises.model import tells_apart
from rosbeat.exercises.registry import Page

DOCS = Path(__file__).parents[3] / "docs" / "exercises.md"
LESSON, QUESTIONS, EXERCISE, LINE, ANSWERS, NOTES, COMMANDS = re.findall(
    r"^```(?:python|text|bash)\n(.*?)^```", DOCS.read_text("utf-8"), re.DOTALL | re.MULTILINE
)
SEEDS = range(1, 11)


def run(text, name):
    module = ModuleType(name)
    exec(compile(text, name, "exec"), vars(module))
    return module


@pytest.fixture(scope="module")
def page():
    return run(EXERCISE, "page_14")


@pytest.fixture(scope="module")
def lesson(tmp_path_factory):
    file = tmp_path_factory.mktemp("course") / "14_light_a_lamp.py"
    file.write_text(LESSON, encoding="utf-8")
    return read_lesson(file)


def solution(lesson):
    return "\n".join(with_answers(cell.source) for cell in lesson.cells if cell.exercise) + "\n"


def imports(lesson):
    return next(cell.source for cell in lesson.cells if cell.runs).partition("\nviz.")[0]


@pytest.fixture
def added(page, lesson, monkeypatch, tmp_path):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    monkeypatch.setattr("bank.running.imports", lambda _: imports(lesson))
    for one in page.EXERCISES:
        monkeypatch.setitem(registry.EXERCISES, one.id, one)


def test_it_is_short():
    code = [line for line in EXERCISE.splitlines() if line.strip()]
    assert len(code) < 120


def test_the_lesson_keeps_the_rules(lesson):
    course = Course(DOCS.parents[1])
    assert not check_lessons(course, [*course.lessons(), lesson], [lesson])


def test_the_line_of_the_registry_says_what_the_lesson_says(page, lesson):
    (added,) = eval(LINE, {"Page": Page, "page_14": page})
    head = lesson.header
    assert added == Page("14", head.title, page.EXERCISES, lesson.name, head.minutes, head.needs)


def test_the_questions_can_be_asked(monkeypatch):
    path = SimpleNamespace(joinpath=lambda _: SimpleNamespace(read_text=lambda encoding: QUESTIONS))
    monkeypatch.setattr(quiz, "files", lambda _: path)
    asked = quiz._read_questions()["14"]
    assert [one.id for one in asked] == ["14.1", "14.2", "14.3"]
    right = ["abc"[[one.right for one in question.choices].index(True)] for question in asked]
    assert f'quiz("14", {", ".join(f"{one!r}" for one in right)})'.replace("'", '"') in LESSON


def test_the_notes_have_what_every_section_has():
    assert [NOTES.count(label) for label in ("**Plan.**", "**Board.**", "**Ask.**")] == [1, 1, 1]
    assert NOTES.startswith("\n## 14 Light a lamp\n")


def entries(lesson):
    return parse("14a", ANSWERS, solution(lesson))


def test_the_bank_has_as_many_answers_as_it_needs(lesson):
    counts = Counter(
        "right" if one.status == "passed" else "several" if len(one.mistakes) > 1 else "one"
        for one in entries(lesson)
    )
    wanted = list(least("14a").values())
    found = [counts["right"], counts["one"], counts["several"], 0, ANSWERS.count("hidden: ")]
    assert all(have >= least for have, least in zip(found, wanted, strict=True)), found


@pytest.mark.ros
def test_each_answer_is_told_what_is_right_or_wrong(added, lesson):
    for answer in entries(lesson):
        outcome = outcome_of(answer.exercise, answer.text, answer.subject)
        assert outcome.status == answer.status, (answer.name, outcome)
        assert outcome.mistake in (answer.mistakes or ("",)), (answer.name, outcome)
        assert outcome.points == (2 if outcome.status == "passed" else 0)


@pytest.mark.ros
def test_a_seed_protects_it(added, page, lesson):
    text, (exercise,) = solution(lesson), page.EXERCISES
    assert {outcome_of("14a", text, "Lamp", seed).status for seed in SEEDS} == {"passed"}
    space = run(f"{imports(lesson)}\n{text}", "answer")
    evidence = exercise.observed(space.Lamp)
    assert {exercise.judged(evidence, seed).status for seed in SEEDS} == {"failed"}


def test_its_suspects_can_be_told_apart(page):
    (exercise,) = page.EXERCISES
    for seed in (0, *SEEDS):
        assert tells_apart(*exercise.inputs(seed), page.lamp, page.SUSPECTS)


def test_hints_come_one_by_one(added):
    assert "remembers" in str(hint("14a"))
    assert "publish it only" in str(hint("14a"))


def test_the_commands_exist():
    files = re.findall(r"tests/[\w/.]+", COMMANDS)
    assert files
    assert all((DOCS.parents[1] / file).exists() for file in files)

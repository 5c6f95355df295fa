"""Right answers pass in whatever style they are written, and none is held or refused.

A learner of a class hands in one page, with one answer in one style.
"""

import json
from collections import deque
from functools import cache
from itertools import cycle

import pytest

from bank.graded import course, usable
from bank.pages import ROOT
from natural_answers import STYLES, WRITTEN
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.run import Plan, grade
from rosbeat.grading.submissions import collect
from rosbeat.page_runs.pool import Pool
from rosbeat.page_runs.submitted_page import subject_of

pytestmark = [pytest.mark.ros, pytest.mark.timeout(300), pytest.mark.xdist_group("natural")]
#: Pages whose exercises are answered with a class of one cell.
PAGES = ("03", "04", "00", "08", "03", "07", "04", "09", "00", "12", "04", "03", "11")


@cache
def right_answers():
    """Right answers of the bank by exercise: those whose class has the name that is checked."""
    found = {}
    for one in usable():
        page = course()[one.exercise[:2]]
        parts = [wanted for wanted in page.wanted if wanted.exercise == one.exercise]
        has_one_class = len(parts) == 1 and "class " in one.text
        is_checked = one.subject == subject_of(page, one.exercise)
        if one.status == "passed" and has_one_class and is_checked:
            found.setdefault(one.exercise, []).append(one.text)
    return found


@cache
def handed_in():
    """Texts of answers by style and exercise: each style on one page, around another answer."""
    right = {name: cycle(some) for name, some in right_answers().items()}
    found = {name: {exercise: text} for name, (exercise, text) in WRITTEN.items()}
    for place, (style, page) in enumerate(zip(STYLES, cycle(PAGES), strict=False)):
        there = deque(one for one in right if one.startswith(page))
        there.rotate(place // len(PAGES))
        found[style.name] = {there[0]: style.around(next(right[there[0]]))}
    return found


def page_with(answers):
    """The page of some answers, with these in their cells."""
    page = course()[next(iter(answers))[:2]]
    body = json.loads((ROOT / "notebooks" / f"{page.lesson}.ipynb").read_text(encoding="utf-8"))
    for cell in body["cells"]:
        name = cell["metadata"].get("rosbeat", {}).get("exercise")
        cell["source"] = answers.get(name, cell["source"])
    return f"{page.lesson}.ipynb", json.dumps(body).encode()


@pytest.fixture(scope="module")
def marks(tmp_path_factory):
    """The marks by style and exercise, and the remarks of each."""
    folder, out = tmp_path_factory.mktemp("class"), tmp_path_factory.mktemp("grades")
    names = {}
    for number, (style, answers) in enumerate(handed_in().items()):
        names[f"learner-{number:03}"] = style
        (folder / f"learner-{number:03}").mkdir()
        name, content = page_with(answers)
        (folder / f"learner-{number:03}" / name).write_bytes(content)
    plan = Plan(tuple(course()[one] for one in sorted(set(PAGES))), "natural", seed=815)

    def observe(submissions):
        with Pool(2) as pool:
            yield from pool.observe(submissions)

    with Ledger(out / "judged.jsonl") as ledger:
        found = collect(folder, plan.pages)
        graded = grade(found, plan, ledger, observe, lambda *_: None)
    return {
        names[one.learner]: {mark.exercise: mark for mark in one.marks} for one in graded.learners
    }


@pytest.mark.parametrize("name", WRITTEN)
def test_a_right_answer_passes_however_it_is_built(name, marks):
    (exercise, text), (mark,) = WRITTEN[name], _tried(marks[name])
    assert (mark.exercise, mark.status) == (exercise, "passed"), f"{mark}\n{text}"


def _tried(marks):
    return [one for one in marks.values() if one.status not in ("missing", "not attempted")]


@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.name)
def test_right_answers_pass_in_any_style(style, marks):
    for exercise, text in handed_in()[style.name].items():
        mark = marks[style.name][exercise]
        assert (mark.status, mark.points) == ("passed", mark.out_of), f"{mark}\n{text}"


def test_none_is_held(marks):
    assert [one for some in marks.values() for one in some.values() if one.status == "held"] == []

"""docs/teaching.md fits the pages, and its tables are those of the bank."""

import re

import pytest

from bank import teaching
from bank.teaching import DOCUMENT, LESSON, TOGETHER, blocks, numbered, write
from rosbeat.exercises.quiz import QUESTIONS
from rosbeat.exercises.registry import EXERCISES

TEXT = DOCUMENT.read_text(encoding="utf-8")
PARTS = dict(re.findall(r"(?m)^## (\d\d) .*\n((?:(?!## ).*\n)+)", TEXT))


def test_the_tables_are_up_to_date():
    assert write(TEXT) == TEXT, "run: PYTHONPATH=tests .venv/bin/python -m bank.teaching"


def test_each_page_has_a_section_with_its_table():
    titles = re.findall(r"(?m)^## (\d\d .*)$", TEXT)
    assert titles == [page.heading for page in numbered().values()]
    assert blocks(TEXT) == ["lessons", *numbered()]
    assert {number: blocks(part) for number, part in PARTS.items()} == {
        number: [number] for number in numbered()
    }


@pytest.mark.parametrize("number", numbered())
def test_the_notes_name_what_the_page_has(number):
    notes = " ".join(PARTS[number].partition("<!-- begin")[0].split())
    assert set(re.findall(r"\b\d\d[a-z]\b", notes)) <= {
        one for one in EXERCISES if one[:2] == number
    }
    assert set(re.findall(r"\bquestion (\d\d\.\d)", notes)) <= {one.id for one in QUESTIONS[number]}
    (lesson,) = (teaching.ROOT / "src" / "lessons").glob(f"{number}_*.py")
    headings = re.findall(r"(?m)^# ## (.+)$", lesson.read_text(encoding="utf-8"))
    assert set(re.findall(r"section \*([^*]+)\*", notes)) <= set(headings)
    for label in ("**Plan.**", "**Board.**", "**Ask.**"):
        assert notes.count(label) == 1


def test_a_lesson_is_long_enough_and_comes_after_what_it_needs():
    taught = []
    for group in TOGETHER:
        pages = [numbered()[number] for number in group]
        assert len(group) == 1 or sum(page.minutes for page in pages) <= LESSON
        for page in pages:
            assert set(page.needs) <= set(taught)
            taught.append(page.number)
    assert taught == list(numbered())

"""Answers are found on pages that were mangled."""

import pytest

from grading_files import BLANK, DONE
from rosbeat.grading.mending import Wanted, find_answers
from rosbeat.grading.notebook import Cell

OTHER = DONE.replace("Beat", "Ear")
WANTED = (
    Wanted("03a", "one", BLANK),
    Wanted("03b", "two", BLANK.replace("Beat", "Ear")),
    Wanted("03c", "three", "# a\nx = 1\ny = 2\nz = ____\n"),
)


def cells(*made):
    return [
        Cell(n, one.get("sort", "code"), one.get("source", DONE), one.get("id", ""),
             one.get("exercise", ""), one.get("check", ""))
        for n, one in enumerate(made)
    ]  # fmt: skip


def found(*made, wanted=WANTED[:1]):
    return find_answers(wanted, cells(*made))[0]


def test_a_cell_in_its_place_needs_no_word():
    one = found({"id": "one", "exercise": "03a"})
    assert (one.source, one.place, one.repairs) == (DONE, 0, ())


@pytest.mark.parametrize(
    ("made", "words"),
    [
        ({"exercise": "03a", "id": "new"}, "another id"),
        ({"source": DONE}, "by what it defines"),
        ({"source": "import rclpy\n" + DONE}, "by what it defines"),
        ({"id": "one", "sort": "markdown"}, "markdown cell"),
        ({"id": "one", "sort": "raw"}, "raw cell"),
    ],
)
def test_a_cell_that_lost_something_is_found(made, words):
    one = found({"source": "a = 1"}, made)
    assert one.place == 1
    assert words in " ".join(one.repairs)


def test_a_deleted_cell_is_missing():
    one = found({"source": "a = 1"}, {"source": "check('03a', Beat)", "check": "03a"})
    assert (one.source, one.place) == ("", -1)
    assert "not on the page" in one.repairs[0]


def test_a_check_cell_is_never_an_answer():
    assert found({"source": DONE, "id": "one", "check": "03a"}).place == -1


def test_of_several_the_last_that_is_filled_counts():
    one = found({"id": "one", "source": DONE + "# 1"}, {"id": "one", "source": DONE + "# 2"},
                {"exercise": "03a", "source": BLANK})  # fmt: skip
    assert one.place == 1
    assert "3 times" in one.repairs[0]


def test_an_untouched_copy_counts_if_there_is_no_other():
    assert found({"id": "one", "source": BLANK}, {"id": "one", "source": BLANK}).place == 1


def test_a_cell_that_was_split_is_put_together():
    lines = DONE.splitlines(keepends=True)
    one = found({"id": "one", "source": "".join(lines[:2])}, {"source": "".join(lines[2:])})
    assert "\n".join(one.source.split("\n\n")).split() == DONE.split()
    assert "put together" in one.repairs[-1]


def test_a_cell_with_a_mistake_is_not_joined_with_what_follows():
    one = found({"id": "one", "source": "class Beat(Node:\n    pass"}, {"source": "a = 1"})
    assert one.source == "class Beat(Node:\n    pass"


def test_no_cell_answers_two_exercises():
    answers = find_answers(WANTED[:2], cells({"id": "one"}, {"source": OTHER}))
    assert [one.place for one in answers] == [0, 1]
    answers = find_answers(WANTED[:2], cells({"id": "two", "source": OTHER}))
    assert [one.place for one in answers] == [-1, 0]


def test_a_copied_id_of_another_exercise_is_not_taken():
    answers = find_answers(WANTED[:2], cells({"id": "two", "source": DONE}))
    assert answers[0].place == -1


def test_a_cell_without_a_definition_is_found_by_likeness():
    one = found({"source": "# a\nx = 1\ny = 2\nz = 3\n"}, wanted=WANTED[2:])
    assert one.place == 0
    assert found({"source": "a = 1"}, wanted=WANTED[2:]).place == -1


@pytest.mark.parametrize("source", ["\0", "(" * 10_000, "x = '\ud800'", "%%terminal a\nls ("])
def test_no_text_stops_it(source):
    assert found({"id": "one", "source": source}).source == source


PARTS = (
    Wanted("13b", "one", "class Beat(Node):\n    ____\n"),
    Wanted("13b", "two", "class Ear(Node):\n    ____\n"),
    Wanted("13b", "three", "def greenhouse():\n    ____\n"),
)
FILLED = [one.blank.replace("____", f"x = {n}") for n, one in enumerate(PARTS)]


def parts(*made):
    return find_answers(PARTS, cells(*made))


def test_each_of_several_cells_is_found_by_its_id():
    made = [
        {"source": text, "id": one.id, "exercise": "13b"}
        for text, one in zip(FILLED, PARTS, strict=True)
    ]
    for order in (made, made[::-1]):
        found = parts(*order)
        assert [one.source for one in found] == FILLED
        assert [one.repairs for one in found] == [(), (), ()]


def test_several_cells_without_ids_are_told_apart_by_what_they_define():
    found = parts(*({"source": text, "exercise": "13b"} for text in reversed(FILLED)))
    assert [one.source for one in found] == FILLED
    assert all("another id" in " ".join(one.repairs) for one in found)


def test_one_of_several_cells_may_be_missing():
    found = parts(
        {"source": FILLED[0], "id": "one", "exercise": "13b"},
        {"source": FILLED[2], "id": "three", "exercise": "13b"},
    )
    assert [one.source for one in found] == [FILLED[0], "", FILLED[2]]
    assert "not on the page" in " ".join(found[1].repairs)

from __future__ import annotations

import pytest

from rosbeat.authoring import builder
from rosbeat.errors import LessonError

BODY = "# %%\nprint('hello')"


@pytest.fixture
def told():
    return []


def build(checkout, told, **plan):
    return builder.build(checkout.course, builder.Plan(**plan), told.append)


def contents(checkout):
    return {path: path.read_bytes() for path in checkout.course.root.rglob("*.ipynb")}


def test_a_second_build_changes_not_one_byte(checkout, told):
    checkout.write(BODY)
    assert [change.kind for change in build(checkout, told)] == ["new", "new"]
    before = contents(checkout)
    assert len(before) == 2
    assert build(checkout, told) == []
    assert contents(checkout) == before
    assert told[-1] == "same     solutions/00_hear_it.ipynb"


def test_check_finds_what_differs_and_writes_nothing(checkout, told):
    checkout.write(BODY)
    changes = build(checkout, told, check=True, run=False)
    assert [change.kind for change in changes] == ["new"]
    assert contents(checkout) == {}


def test_a_page_without_a_lesson_goes_if_it_is_ours(checkout, told):
    path = checkout.write(BODY)
    build(checkout, told, run=False)
    path.unlink()
    checkout.write(BODY, name="00_say_it", title="Say it")
    changes = build(checkout, told, run=False, check=True)
    assert {change.path.name: change.kind for change in changes} == {
        "00_say_it.ipynb": "new", "00_hear_it.ipynb": "stale"
    }  # fmt: skip
    build(checkout, told, run=False)
    assert [path.name for path in contents(checkout)] == ["00_say_it.ipynb"]


def test_a_broken_rule_stops_the_build_before_anything_is_written(checkout, told):
    checkout.write("# %%\nrclpy.spin(node)")
    with pytest.raises(LessonError, match="endless") as caught:
        build(checkout, told)
    assert "nothing was built" in caught.value.means
    assert contents(checkout) == {}


def test_a_page_that_was_worked_in_is_kept_before_it_is_replaced(checkout, told):
    checkout.write(BODY)
    build(checkout, told, run=False)
    page = checkout.course.notebooks / "00_hear_it.ipynb"
    worked = page.read_text().replace('"execution_count": null', '"execution_count": 1', 1)
    page.write_text(worked)
    build(checkout, told, run=False, check=True)
    assert not (page.parent / "kept").exists()
    build(checkout, told, run=False)
    assert (page.parent / "kept" / "00_hear_it-1.ipynb").read_text() == worked
    assert any(line.startswith("kept     notebooks/kept/00_hear_it-1.ipynb") for line in told)
    assert '"execution_count": 1' not in page.read_text()


EXERCISE = """
# %% exercise="00a"
def f():
    # --- answer
    return 7
    # --- blank
    # return ____
    # --- end

# %% check="00a"
f()
"""


def test_both_trees_say_what_an_exercise_is_worth(checkout, told):
    checkout.write(EXERCISE)
    build(checkout, told, points={"00a": 11})
    assert len(contents(checkout)) == 2
    assert all(b'"points": 11' in text for text in contents(checkout).values())

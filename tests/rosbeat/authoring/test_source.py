from __future__ import annotations

import pytest

from rosbeat.authoring.source import read_lesson
from rosbeat.errors import LessonError


def test_cells_have_kind_role_tags_and_their_line(checkout):
    lesson = checkout.lesson("""
        # %% exercise="00a" tags=["hide-input"]

        x = 1

        # %% check="00a"
        %matplotlib inline

        # %% [markdown] only="solution"
        # Only here.
    """)
    lines = lesson.path.read_text().split("\n")
    _, exercise, check, prose = lesson.cells
    assert (exercise.exercise, exercise.tags, exercise.source) == ("00a", ("hide-input",), "x = 1")
    assert (check.check, check.source) == ("00a", "%matplotlib inline")
    assert (prose.kind, prose.only, prose.source) == ("markdown", "solution", "Only here.")
    assert lines[exercise.line - 1] == "x = 1"
    assert lines[prose.line - 1] == "# Only here."
    assert (lesson.name, lesson.number) == ("00_hear_it", "00")


def test_a_cell_may_ask_for_a_prediction(checkout):
    lesson = checkout.lesson("""
        # %% predict=true
        x = 1

        # %%
        y = 2
    """)
    assert [cell.predict for cell in lesson.cells] == [False, True, False]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('x = """\n# %% inside\n"""', "lines begin a cell"),
        ("# %% A title\nx = 1", "does not know 'title'"),
        ("# %% [raw]\n# x", "kind 'raw'"),
        ('# %% only="learner"\nx = 1', "only= is 'learner'"),
        ('# %% exercize="00a"\nx = 1', "does not know 'exercize'"),
        ("# %% predict=false\nx = 1", "predict= is False"),
        ('# %% predict="00a"\nx = 1', "predict= is '00a'"),
    ],
)
def test_what_the_format_does_not_know_is_refused(checkout, body, message):
    with pytest.raises(LessonError, match=message):
        checkout.lesson(body)


@pytest.mark.parametrize("name", ["hear", "0_hear", "00_Hear", "00-hear", "00_"])
def test_a_file_has_a_number_and_a_name(checkout, name):
    with pytest.raises(LessonError, match="NN_slug"):
        read_lesson(checkout.write("", name=name))


def test_text_before_the_first_cell_is_refused(checkout):
    path = checkout.write("")
    path.write_text(path.read_text().replace("\n# %%", "\nimport os\n# %%", 1))
    with pytest.raises(LessonError, match="before the first cell"):
        read_lesson(path)

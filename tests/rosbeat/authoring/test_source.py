"""Lesson sources: the header, the cells, their ids, and the answers inside them."""

from __future__ import annotations

import ast
import textwrap

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat.authoring import source
from rosbeat.authoring.source import choose, find_course, read_lesson
from rosbeat.errors import LessonError

HEADER = ["# ---", "# title: Hear it: now", "# minutes: 5", '# needs: ["00", 03]',
          "# summary: One.", "# ---"]  # fmt: skip


def test_cells_have_kind_role_tags_and_their_line(checkout):
    lesson = checkout.lesson("""
        # %% exercise="00a" tags=["hide-input"]

        x = 1

        # %% check="00a" predict=true
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
    assert [cell.predict for cell in lesson.cells] == [False, False, True, False]
    assert (lesson.name, lesson.number) == ("00_hear_it", "00")


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('x = """\n# %% inside\n"""', "lines begin a cell"),
        ("# %% A title\nx = 1", "does not know 'title'"),
        ("# %% [raw]\n# x", "kind 'raw'"),
        ('# %% only="learner"\nx = 1', "only= is 'learner'"),
        ('# %% exercize="00a"\nx = 1', "does not know 'exercize'"),
        ("# %% predict=false\nx = 1", "predict= is False"),
        ("# %% shows=false\nx = 1", "shows= is False"),
        ('# %% exercise="00a" shows=true\nx = 1', "does not only show something"),
        ('# %% check="00a" shows=true\ncheck("00a", x)', "does not only show something"),
        ('# %% terminal="a"\nls', "'ls' stands without a comment sign"),
        ('# %% terminal="a" save="b.py"\nx = 1', "do not go together"),
    ],
)
def test_what_the_format_does_not_know_is_refused(checkout, body, message):
    with pytest.raises(LessonError, match=message):
        checkout.lesson(body)


@pytest.mark.parametrize("name", ["hear", "00_Hear", "00-hear"])
def test_a_file_has_a_number_and_a_name(checkout, name):
    with pytest.raises(LessonError, match="NN_slug"):
        read_lesson(checkout.write("", name=name))


def test_text_before_the_first_cell_is_refused(checkout):
    path = checkout.write("")
    path.write_text(path.read_text().replace("\n# %%", "\nimport os\n# %%", 1))
    with pytest.raises(LessonError, match="before the first cell"):
        read_lesson(path)


def test_a_header_is_read(tmp_path):
    path = tmp_path / "04_hear_it.py"
    path.write_text("\n".join([*HEADER, "", "# %%", "1"]))
    header = read_lesson(path).header
    assert (header.title, header.minutes, header.needs) == ("Hear it: now", 5, ("00", "03"))


@pytest.mark.parametrize(
    ("line", "replacement"),
    [(0, "# %%"), (5, "#"), (1, "# titel: x"), (2, "# minutes: ten"), (3, "# needs: [first]"),
     (4, "# summary:")],
)  # fmt: skip
def test_a_wrong_line_of_a_header_is_named(tmp_path, line, replacement):
    path = tmp_path / "04_hear_it.py"
    path.write_text("\n".join([*HEADER[:line], replacement, *HEADER[line + 1 :], "# %%"]))
    with pytest.raises(LessonError, match=rf"^04_hear_it.py:{line + 1}: the header has") as caught:
        read_lesson(path)
    assert "# minutes: 40" in caught.value.to_try


# Ids.


def ids(checkout, body):
    return [cell.id for cell in checkout.lesson(body).cells]


def test_cells_that_open_alike_have_different_ids(checkout):
    alike = ids(checkout, "# %%\nx = 1\n\n" * 3)
    assert len(set(alike)) == 4
    terminals = ids(checkout, '# %% terminal="a"\n# ls\n\n# %% terminal="a"\n# pwd')
    assert not any(one.endswith("-2") for one in terminals)


def test_a_sentence_further_down_does_not_change_the_id(checkout):
    before = ids(checkout, "# %% [markdown]\n# Opening.\n# One.")
    assert before == ids(checkout, "# %% [markdown]\n# Opening.\n# Two.")
    assert before != ids(checkout, "# %% [markdown]\n# Another.\n# One.")


# Answers and blanks.

TEXT = textwrap.dedent("""\
    class A:
        def f(self):
            # --- answer
            x = 1
            return x
            # --- blank
            # return ____
            # --- end

        def g(self):
            return 2""")


def test_each_page_gets_its_part_at_the_same_indentation():
    solution, learner = source.with_answers(TEXT), source.with_blanks(TEXT)
    assert "        x = 1\n        return x\n\n    def g" in solution
    assert "    def f(self):\n        # about 2 lines\n        return ____\n\n    def g" in learner
    assert "---" not in solution + learner
    assert "____" not in solution
    assert "x = 1" not in learner


def test_blanks_in_place_stand_on_the_lines_of_the_source():
    masked, lines = source.with_blanks_in_place(TEXT).split("\n"), TEXT.split("\n")
    assert len(masked) == len(lines)
    assert masked.index("        return ____") == lines.index("        # return ____")
    assert [line for line in masked if line] == [
        line for line in source.with_blanks(TEXT).split("\n") if line and "# about" not in line
    ]


@pytest.mark.parametrize(
    ("answer", "blank", "shown"),
    [
        ("x = 1", "x = ____", "x = ____"),
        ("x = 1\n# Why.\n\n", "x = ____", "x = ____"),
        ("x = 1\ny = 2", "x = ____\n# y = ____", "x = ____\ny = ____"),
        ("x = 1\ny = 2\nz = 3", "x = ____", "# about 3 lines\nx = ____"),
        ("x = 1\n\ny = 2", "# Copy x.\n# ____", "# Copy x.\n# about 2 lines\n____"),
        ("if x:\n    y = 1\nz = 2", "if x:\n#     ____", "if x:\n    # about 3 lines\n    ____"),
    ],
)
def test_a_blank_with_fewer_lines_than_its_answer_says_how_many_are_wanted(answer, blank, shown):
    text = f"# --- answer\n{answer}\n# --- blank\n# {blank}\n# --- end"
    assert source.with_blanks(text) == shown


GOOD = "# --- answer\nx = 1\n# --- blank\n# ____\n# --- end"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("# --- answer\nx = 1", 10, "not a marker of a complete block"),
        (f"# --- answer\n{GOOD}", 11, "complete block"),
        (f"{GOOD}\n# --- answer\nx = 2\n# --- end", 15, "complete block"),
        ("# --- blank", 10, "complete block"),
        (f"{GOOD}\n# --- end", 15, "complete block"),
        ("# --- Answer", 10, "'# --- Answer' is not a marker"),
        ("# --- answer here", 10, "complete block"),
        (GOOD.replace("x = 1", "# --- END"), 11, "complete block"),
        (GOOD.replace("# ____", "# ____\n# --- blank"), 14, "complete block"),
        (GOOD.replace("x = 1\n", ""), 10, "no answer"),
        (GOOD.replace("____", "x = 2"), 10, "has no ____"),
        (GOOD.replace("# ____", "x = ____"), 10, "complete block"),
        (GOOD.replace("# ____", "    # ____"), 10, "complete block"),
        (GOOD.replace("# --- blank", "    # --- blank"), 10, "complete block"),
    ],
)
def test_wrong_markers_are_refused_with_their_line(text, line, message):
    with pytest.raises(LessonError, match=message) as caught:
        source.find_blocks(text, "00_x.py", 10)
    assert caught.value.what.startswith(f"00_x.py:{line}: ")
    for rewrite in (source.with_answers, source.with_blanks):
        with pytest.raises(LessonError):
            rewrite(text)


@given(st.lists(st.tuples(st.integers(0, 3), st.booleans()), max_size=6))
def test_both_pages_parse_whatever_is_nested_around(parts):
    rows = []
    for depth, has_block in parts:
        indent = "    " * depth
        rows += [f"{'    ' * level}if True:" for level in range(depth)]
        rows += [indent + "y = 0"]
        block = ["# --- answer", "y = 1", "# --- blank", "# y = ____", "# --- end"]
        rows += [indent + line for line in block] if has_block else []
    text = "\n".join(rows)
    for page in (text, source.with_answers(text), source.with_blanks(text)):
        ast.parse(page)
    assert source.with_blanks(text).count("____") == sum(has for _, has in parts)
    assert len(source.find_blocks(text)) == sum(has for _, has in parts)


# Courses.


def test_a_course_is_found_from_anywhere_inside(checkout, tmp_path_factory):
    assert find_course(checkout.course.sources) == checkout.course
    with pytest.raises(LessonError, match="no lessons are found") as caught:
        find_course(tmp_path_factory.mktemp("outside"))
    assert "--root" in caught.value.to_try


@pytest.mark.parametrize(
    "name", ["01", "01_say_it", "notebooks/01_say_it.ipynb", "src/lessons/01_say_it.py"]
)
def test_lessons_are_chosen_by_number_name_or_file(checkout, name):
    checkout.write("")
    checkout.write("", name="01_say_it")
    lessons = checkout.course.lessons()
    assert [lesson.name for lesson in choose(lessons, [name])] == ["01_say_it"]
    assert choose(lessons, []) == lessons


def test_an_unknown_lesson_names_the_known_ones(checkout):
    lesson = checkout.lesson("")
    with pytest.raises(LessonError) as caught:
        choose([lesson], ["09"])
    assert "00_hear_it" in caught.value.to_try

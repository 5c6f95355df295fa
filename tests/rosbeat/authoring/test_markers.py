from __future__ import annotations

import ast
import textwrap

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat.authoring import markers
from rosbeat.errors import LessonError

SOURCE = textwrap.dedent("""\
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


def test_the_solution_keeps_the_answer_at_its_indentation():
    kept = "        x = 1\n        return x\n\n    def g"
    assert kept in markers.solution(SOURCE)
    assert "---" not in markers.solution(SOURCE)
    assert "____" not in markers.solution(SOURCE)


def test_the_learner_gets_the_blank_at_the_same_indentation():
    assert "    def f(self):\n        return ____\n\n    def g" in markers.learner(SOURCE)
    assert "x = 1" not in markers.learner(SOURCE)


def test_the_masked_text_is_the_learners_on_the_lines_of_the_source():
    masked = markers.masked(SOURCE).split("\n")
    source = SOURCE.split("\n")
    assert len(masked) == len(source)
    assert masked.index("        return ____") == source.index("        # return ____")
    assert [line for line in masked if line] == [
        line for line in markers.learner(SOURCE).split("\n") if line
    ]


def test_the_source_runs_with_the_answer_in_force():
    names: dict = {}
    exec(SOURCE, names)
    assert names["A"]().f() == 1


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("# --- answer\nx = 1", "not closed"),
        ("# --- answer\nx = 1\n# --- blank\n# ____", "not closed"),
        ("# --- answer\n# --- answer", "stands after '# --- answer'"),
        ("# --- answer\nx = 1\n# --- end", "stands after '# --- answer'"),
        ("# --- blank", "outside of a block"),
        ("# --- end", "outside of a block"),
        ("# --- Answer", "nearly a marker"),
        ("#--- answer", "nearly a marker"),
        ("# ---- answer", "nearly a marker"),
        ("# --- answer here", "nearly a marker"),
        ("# --- answer\n# --- blank\n# ____\n# --- end", "no answer"),
        ("# --- answer\nx = 1\n# --- blank\n# --- end", "has no ____"),
        ("# --- answer\nx = 1\n# --- blank\n# x = 2\n# --- end", "has no ____"),
        ("# --- answer\nx = 1\n# --- blank\nx = ____\n# --- end", "not a comment"),
        ("# --- answer\nx = 1\n# --- blank\n    # ____\n# --- end", "not a comment"),
        ("# --- answer\nx = 1\n    # --- blank\n# ____\n# --- end", "differ in indentation"),
    ],
)
def test_wrong_markers_are_refused_with_their_line(source, message):
    with pytest.raises(LessonError, match=message) as caught:
        markers.find_blocks(source, "00_x.py", 10)
    assert caught.value.what.startswith("00_x.py:1")


@given(st.lists(st.tuples(st.integers(0, 3), st.booleans()), max_size=6))
def test_both_pages_parse_whatever_is_nested_around(parts):
    rows = []
    for depth, has_block in parts:
        indent = "    " * depth
        rows += [f"{'    ' * level}if True:" for level in range(depth)]
        rows += [indent + "y = 0"]
        block = ["# --- answer", "y = 1", "# --- blank", "# y = ____", "# --- end"]
        rows += [indent + line for line in block] if has_block else []
    source = "\n".join(rows)
    for text in (source, markers.solution(source), markers.learner(source)):
        ast.parse(text)
    assert markers.learner(source).count("____") == sum(has for _, has in parts)

from __future__ import annotations

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

from notebooks.comparison import OUTCOME, comparable, missing_outputs, wrong_outcome
from notebooks.plugin import CELL_TIMEOUT

PLUGIN = ("-p", "notebooks.plugin", "-p", "no:cacheprovider", "--collect-only", "-q")


@pytest.fixture
def course(pytester):
    """A checkout with one page in each tree, one elsewhere and one ordinary test."""
    for name in ("solutions/a", "notebooks/a", "elsewhere/a"):
        path = pytester.path / f"{name}.ipynb"
        path.parent.mkdir()
        nbformat.write(new_notebook(cells=[new_code_cell("1")]), path)
    (pytester.path / "tests").mkdir()
    (pytester.path / "tests" / "test_plain.py").write_text("def test_it(): pass\n")
    pytester.makeini("[pytest]\ntestpaths = tests\n")
    return pytester


def collected(pytester, *arguments):
    items, _ = pytester.inline_genitems(*PLUGIN, *arguments)
    return [item.nodeid for item in items]


def test_a_plain_run_collects_tests_and_both_trees(course):
    nodes = collected(course)
    assert "tests/test_plain.py::test_it" in nodes
    assert "solutions/a.ipynb::stored outputs" in nodes
    assert "notebooks/a.ipynb::Cell 0" in nodes
    assert "notebooks/a.ipynb::stored outputs" not in nodes
    assert not [node for node in nodes if "elsewhere" in node]


def test_tests_alone_can_be_run(course):
    assert collected(course, "tests") == ["tests/test_plain.py::test_it"]


@pytest.mark.parametrize(("option", "strict"), [("--nbval", True), ("--nbval-lax", False)])
@pytest.mark.parametrize("tree", ["solutions", "notebooks", "elsewhere"])
def test_options_typed_by_hand_rule(course, option, strict, tree):
    nodes = collected(course, option, tree)
    assert (f"{tree}/a.ipynb::stored outputs" in nodes) is strict
    assert nodes.count(f"{tree}/a.ipynb::Cell 0") == 1


def test_the_time_limit_is_ours_unless_one_is_given(course):
    assert course.parseconfigure(*PLUGIN).option.nbval_cell_timeout == CELL_TIMEOUT
    given = course.parseconfigure(*PLUGIN, "--nbval-cell-timeout=7")
    assert given.option.nbval_cell_timeout == 7


def test_missing_outputs_says_which():
    run = new_code_cell("1", execution_count=1, outputs=[])
    assert "never run" in missing_outputs([new_code_cell("first line\nsecond")])
    assert "not one" in missing_outputs([run])
    assert missing_outputs([new_code_cell("")]) == ""


def test_comparison_leaves_the_originals_alone():
    output = nbformat.v4.new_output("display_data", {"image/png": "AAAA", "text/plain": "x"})
    assert comparable([output])[0].data == {"picture": "a picture", "text/plain": "x"}
    assert "image/png" in output.data


CHECK = new_code_cell("check(...)", metadata={"rosbeat": {"check": "03a"}})


def said(status, exercise="03a"):
    data = {"text/plain": "...", OUTCOME: {"exercise": exercise, "status": status}}
    return new_output("execute_result", data=data)


@pytest.mark.parametrize(
    ("outputs", "right_if_solved"),
    [
        ([said("passed")], True),
        ([said("not attempted")], False),
        ([], None),
        ([said("failed")], None),
        ([said("passed"), said("not attempted")], None),
        ([said("passed", "03b")], None),
        ([new_output("stream", text="passed")], None),
    ],
)
def test_a_check_that_says_something_else_is_found(outputs, right_if_solved):
    for solved in (True, False):
        wrong = wrong_outcome(CHECK, outputs, solved=solved)
        assert (wrong == "") is (solved is right_if_solved)
        assert wrong_outcome(new_code_cell("1"), outputs, solved=solved) == ""

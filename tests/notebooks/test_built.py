"""One run of a page serves nbval and the comparison that a build makes."""

from pathlib import Path

import nbformat
import pytest

from notebooks.built import Ran, difference, solution, source_of
from rosbeat.authoring import pages
from rosbeat.authoring.source import read_lesson
from rosbeat.errors import LessonError

GOLDEN = Path(__file__).parents[1] / "golden"
NAME = "00_hear_a_pulse"
LESSON = GOLDEN / "src" / "lessons" / f"{NAME}.py"


@pytest.fixture
def runs():
    """What the cells of the golden page gave when it was built."""
    page = nbformat.read(GOLDEN / "solutions" / f"{NAME}.ipynb", as_version=4)
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    return [Ran(cell.execution_count, cell.outputs) for cell in code]


@pytest.fixture
def page(runs, tmp_path):
    """A page as it was built of these runs."""
    path = tmp_path / "solutions" / f"{NAME}.ipynb"
    path.parent.mkdir()
    path.write_bytes(pages.to_bytes(solution(read_lesson(LESSON), path.parent, runs, {})))
    return path


def test_the_same_run_is_the_same_page(page, runs):
    assert difference(page, LESSON, runs, {}) is None


def _first_with(runs, kind):
    return next(ran for ran in runs if any(one.output_type == kind for one in ran.outputs))


def _another_number(runs):
    runs[0].count += 1


def _another_text(runs):
    _first_with(runs, "stream").outputs[0].text += "!"


def _one_more(runs):
    runs[-1].outputs.append(nbformat.v4.new_output("stream", text="done\n"))


def _none(runs):
    _first_with(runs, "stream").outputs.clear()


@pytest.mark.parametrize("change", [_another_number, _another_text, _one_more, _none])
def test_whatever_is_different_is_seen(page, runs, change):
    change(runs)
    found = difference(page, LESSON, runs, {})
    assert found.kind == "changed"
    assert found.diff


def test_what_cannot_be_repeated_is_refused(page, runs):
    runs[-1].outputs.append(nbformat.v4.new_output("stream", text="<object at 0x7f1234567890>\n"))
    with pytest.raises(LessonError, match="a memory address"):
        difference(page, LESSON, runs, {})


def test_a_page_that_was_run_in_part_is_not_compared(page, runs):
    with pytest.raises(ValueError, match="shorter"):
        difference(page, LESSON, runs[:-1], {})


def test_what_comes_from_the_kernel_is_kept_in_order():
    def message(kind, **content):
        return {"msg_type": kind, "header": {"msg_type": kind}, "content": content}

    ran = Ran()
    ran.see(message("execute_input", code="1", execution_count=4))
    ran.see(message("stream", name="stdout", text="a"))
    ran.see(message("display_data", data={"text/plain": "b"}, metadata={}))
    ran.see(message("status", execution_state="idle"))
    assert ran.count == 4
    assert [one.output_type for one in ran.outputs] == ["stream", "display_data"]


def test_only_solutions_with_a_lesson_are_built(tmp_path):
    root = GOLDEN
    assert source_of(root / "solutions" / f"{NAME}.ipynb") == LESSON
    assert source_of(root / "notebooks" / f"{NAME}.ipynb") is None
    assert source_of(tmp_path / "solutions" / "mine.ipynb") is None

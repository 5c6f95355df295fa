import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

from rosbeat.authoring.keeping import keep_work, was_worked_in


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "03_a_page.ipynb"
    nbformat.write(new_notebook(cells=[new_code_cell("x = ____")]), path)
    return path


def work_in(path, source="x = 1"):
    output = new_output("stream", name="stdout", text="1")
    cell = new_code_cell(source, execution_count=1, outputs=[output])
    nbformat.write(new_notebook(cells=[cell]), path)


def test_an_untouched_page_is_not_kept(page):
    assert not was_worked_in(page)
    assert keep_work(page) is None
    assert list(page.parent.iterdir()) == [page]


def test_work_is_copied_aside_whole_and_never_overwritten(page):
    copies = []
    for answer in ("x = 1", "x = 2"):
        work_in(page, answer)
        copies.append(keep_work(page))
    assert [copy.name for copy in copies] == ["03_a_page-1.ipynb", "03_a_page-2.ipynb"]
    assert ["x = 1" in copy.read_text() for copy in copies] == [True, False]


def test_a_page_that_was_run_without_output_was_worked_in(page):
    nbformat.write(new_notebook(cells=[new_code_cell("x = 1", execution_count=3)]), page)
    assert was_worked_in(page)


def test_what_is_no_notebook_any_more_is_kept(page):
    page.write_text("half a file")
    assert keep_work(page).read_text() == "half a file"


def test_a_page_that_does_not_exist_needs_no_keeping(tmp_path):
    assert keep_work(tmp_path / "none.ipynb") is None

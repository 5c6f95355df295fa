"""What the tests of this folder rest on: a run is waited for, and an error is seen."""

import pytest

from browser.notebook import Notebook, write_notebook


@pytest.fixture
def notebook(page, lab):
    sources = ("import time; time.sleep(2); print('slept')", "1 / 0", "print('never')")
    write_notebook(lab.root / "helper.ipynb", *sources)
    made = Notebook(page, lab, "helper.ipynb")
    yield made
    made.shut_down()


def test_a_run_is_over_when_it_is_over_and_what_was_raised_is_seen(notebook):
    assert notebook.errors() == {}
    notebook.run_all()
    assert notebook.output(0) == "slept\n"
    assert notebook.errors() == {1: "ZeroDivisionError: division by zero"}
    assert notebook.cell(2).locator(".jp-OutputArea-output").count() == 0


def test_a_cell_that_runs_alone_is_waited_for(notebook):
    notebook.write(1, "import time; time.sleep(1); print('mended')")
    notebook.run(1)
    assert notebook.output(1) == "mended\n"
    assert notebook.errors() == {}


def test_a_text_that_is_missing_is_told_with_what_is_there(notebook, monkeypatch):
    monkeypatch.setattr("browser.notebook.PATIENCE", 500)
    notebook.run(0)
    with pytest.raises(AssertionError, match=r"(?s)'waking'.*slept"):
        notebook.says(0, "waking")

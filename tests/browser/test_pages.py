"""Every page as a learner opens it: Run All, then an answer, then the check."""

import json
import shutil
from pathlib import Path

import pytest

from browser.accessibility import serious
from browser.notebook import Notebook

pytestmark = [pytest.mark.ros, pytest.mark.timeout(400)]

ROOT = Path(__file__).parents[2]
PAGES = sorted(path.name for path in (ROOT / "notebooks").glob("[0-9][0-9]_*.ipynb"))
LESSONS = sorted(path.stem for path in (ROOT / "src" / "lessons").glob("[0-9][0-9]_*.py"))
#: Which exercise of a page is done; the first of page 06 needs nodes that Run All has ended.
RANKS = {"06": 1}
#: In how many pixels of height a whole page can be seen at once.
TALL = 16_000


def code_cells(path):
    """The code cells of a page: what the lesson says about each, and its source."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [
        (cell["metadata"].get("rosbeat", {}), "".join(cell["source"]))
        for cell in cells
        if cell["cell_type"] == "code"
    ]


def meant_to_fail(path):
    """The code cells of a page that have to raise."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    return {k for k, c in enumerate(code) if "raises-exception" in c["metadata"].get("tags", [])}


def checks(cells):
    """The cells that check an exercise: number of the cell, and the exercise."""
    return [(k, about["check"]) for k, (about, _) in enumerate(cells) if "check" in about]


def answer_to(exercise, name):
    """What the solution page has in the cell of an exercise."""
    cells = code_cells(ROOT / "solutions" / name)
    return next(source for about, source in cells if about.get("exercise") == exercise)


@pytest.fixture
def open_page(page, lab):
    made = []

    def open_one(name, tree="notebooks"):
        shutil.copy(ROOT / tree / name, lab.root / name)
        made.append(Notebook(page, lab, name))
        return made[-1], code_cells(lab.root / name)

    yield open_one
    for one in made:
        one.shut_down()


def test_there_is_a_page_for_each_lesson():
    assert [Path(name).stem for name in PAGES] == LESSONS
    assert len(PAGES) >= 7


@pytest.mark.parametrize("name", PAGES)
def test_a_page_runs_and_an_exercise_is_checked(open_page, name):
    notebook, cells = open_page(name)
    raising = meant_to_fail(ROOT / "notebooks" / name)
    notebook.run_all()
    assert notebook.errors().keys() == raising, notebook.errors()
    assert len(checks(cells)) >= 2
    for number, _ in checks(cells):
        notebook.says(number, "still open")
    check, exercise = checks(cells)[RANKS.get(name[:2], 0)]
    blank = next(k for k, (about, _) in enumerate(cells) if about.get("exercise") == exercise)
    notebook.write(blank, answer_to(exercise, name))
    notebook.run(blank)
    notebook.run(check)
    notebook.says(check, ": passed")
    assert notebook.errors().keys() == raising, notebook.errors()


def found(page):
    """What axe-core calls serious in the outputs of a page."""
    outputs = page.locator(".jp-OutputArea-output").all()
    return [line for output in outputs for line in serious(output)]


@pytest.mark.parametrize("name", PAGES)
def test_a_solved_page_can_be_looked_at(open_page, page, name, tmp_path):
    """Saves what a person sees who opens a solution and runs nothing."""
    page.set_viewport_size({"width": 1280, "height": TALL})
    notebook, _ = open_page(name, "solutions")
    shown = page.locator(".jp-Notebook")
    for theme in ("light", "dark"):
        notebook.theme(theme)
        notebook.wait_until_drawn()
        path = notebook.picture(f"{Path(name).stem}-{theme}", shown, tmp_path)
        assert path.stat().st_size > 50_000
        assert found(page) == []
    broken = "all => all.filter(one => one.complete && !one.naturalWidth).length"
    assert page.eval_on_selector_all(".jp-Notebook img", broken) == 0

"""Pages 00 to 06 as a learner opens them: Run All, then an answer, then the check."""

import json
import shutil
from pathlib import Path

import pytest

from browser.notebook import Notebook

pytestmark = [pytest.mark.ros, pytest.mark.timeout(400)]

ROOT = Path(__file__).parents[2]
PAGES = sorted(path.name for path in (ROOT / "notebooks").glob("0[0-6]_*.ipynb"))
BLANK = "____"
#: Which exercise of a page is done; the first of page 06 needs nodes that Run All has ended.
RANKS = {"06": 1}


def code_cells(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def an_exercise(name):
    """The cell to fill in, what is right there, and the check cell after it."""
    asked = code_cells(ROOT / "notebooks" / name)
    check = checks(name)[RANKS.get(name[:2], 0)]
    blank = next(k for k in range(check - 1, -1, -1) if BLANK in asked[k])
    return blank, code_cells(ROOT / "solutions" / name)[blank], check


def checks(name):
    """Which cells check an exercise."""
    sources = code_cells(ROOT / "notebooks" / name)
    return [k for k, source in enumerate(sources) if source.startswith("check(")]


@pytest.fixture
def open_page(page, lab):
    made = []

    def open_one(name):
        shutil.copy(ROOT / "notebooks" / name, lab.root / name)
        made.append(Notebook(page, lab, name))
        return made[-1]

    yield open_one
    for one in made:
        one.shut_down()


def test_there_are_seven_pages():
    assert [name[:2] for name in PAGES] == [f"0{number}" for number in range(7)]


@pytest.mark.parametrize("name", PAGES)
def test_a_page_runs_and_an_exercise_is_checked(open_page, name):
    notebook = open_page(name)
    notebook.run_all()
    assert notebook.errors() == []
    assert len(checks(name)) >= 2
    for number in checks(name):
        notebook.says(number, "not attempted yet")
    blank, answer, check = an_exercise(name)
    notebook.write(blank, answer)
    notebook.run(blank)
    notebook.run(check)
    notebook.says(check, ": passed")
    assert notebook.errors() == []

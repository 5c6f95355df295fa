"""What takes long, in a real browser: it is said while it is true, and gone afterwards."""

import json

import pytest

from browser.notebook import PATIENCE, Notebook, write_notebook

pytestmark = pytest.mark.ros

IMPORTS = """
import time
from pathlib import Path
from rosbeat import workspace
from rosbeat.workspace.busy_notice import counting, step
"""
READS = "%%terminal one\n{}"
COUNTS = """
with counting("looking"):
    step("listening")
    while not Path("go").exists():
        time.sleep(0.05)
"""


@pytest.fixture
def notebook(page, lab, request):
    name = f"{request.node.name.split('[')[0]}.ipynb"
    write_notebook(lab.root / name, IMPORTS, request.param)
    made = Notebook(page, lab, name)
    made.run(0)
    yield made
    made.shut_down()


@pytest.mark.parametrize(
    "notebook", [READS.format("cat"), READS.format("python3")], indirect=True, ids=["cat", "python"]
)
def test_a_program_that_waits_for_input_is_named_and_how_to_end_it(notebook, page):
    notebook.start(1)
    notebook.says(1, "waits for input")
    notebook.says(1, "%terminal one --ctrl-d")
    notebook.interrupt()
    notebook.says(1, "goes on running in the terminal")
    # The note goes; what stays in the page is the error, which says how to end the program.
    (error,) = (one for one in notebook.stored(1) if one["output_type"] == "error")
    assert "%terminal one --ctrl-d" in "".join(error["traceback"])
    others = [one for one in notebook.stored(1) if one is not error]
    assert "waits for input" not in json.dumps(others)


@pytest.mark.parametrize("notebook", [COUNTS], indirect=True)
def test_steps_are_told_as_they_pass(notebook, page, lab):
    notebook.start(1)
    notebook.says(1, "\N{CHECK MARK} looking")
    notebook.says(1, "\N{HORIZONTAL ELLIPSIS} listening, ")
    (lab.root / "go").touch()
    note = notebook.cell(1).locator(".jp-OutputArea", has_text="listening")
    note.wait_for(state="detached", timeout=PATIENCE)
    assert "listening" not in json.dumps(notebook.stored(1))

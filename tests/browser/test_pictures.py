"""A picture in JupyterLab: it has the colours of the page around it, and its words."""

from io import BytesIO

import nbformat
import pytest
from PIL import Image

from browser.notebook import Notebook, write_notebook
from rosbeat.records import queue_steps
from rosbeat.viz.queues import of_steps

DRAW = """\
from rosbeat.records import queue_steps
from rosbeat.viz.queues import of_steps
of_steps(queue_steps([0] * 4, [1], 3), 3)
"""
PICTURE = "figure.rosbeat-picture img"
THEMES = ("dark", "light")


def card(page):
    """Whether a corner of the picture, inside its rounded edge, is light or dark."""
    image = page.locator(PICTURE)
    image.wait_for()
    page.wait_for_function(f"() => document.querySelector('{PICTURE}').naturalWidth > 0")
    with Image.open(BytesIO(image.screenshot())) as shot:
        return "light" if shot.convert("L").getpixel((8, 8)) > 200 else "dark"


@pytest.fixture
def stored(lab):
    """A notebook with a picture that was not drawn here, so nobody trusts it."""
    path = lab.root / "stored.ipynb"
    write_notebook(path, DRAW)
    notebook = nbformat.read(path, as_version=4)
    bundle = of_steps(queue_steps([0] * 4, [1], 3), 3)._repr_mimebundle_()
    output = nbformat.v4.new_output("execute_result", bundle, execution_count=1)
    notebook.cells[0].outputs = [output]
    nbformat.write(notebook, path)
    return path.name


@pytest.mark.parametrize("is_run", [True, False])
def test_a_picture_follows_the_theme_whether_it_is_trusted_or_not(page, lab, stored, is_run):
    notebook = Notebook(page, lab, stored)
    if is_run:
        notebook.run_all()
    for preference in THEMES:
        page.emulate_media(color_scheme=preference)
        for name in THEMES:
            notebook.theme(name)
            assert card(page) == name
    assert page.locator(PICTURE).get_attribute("alt").startswith("A queue of depth 3")
    notebook.shut_down()

"""What a page says in a real browser when its kernel has started anew."""

import nbformat
import pytest
from playwright.sync_api import expect

from browser.notebook import SHOWN, Notebook

CELLS = (
    ("markdown", "# Title\n\n## The class\n"),
    ("code", "class Sensor:\n    kind = 'thermometer'"),
    ("markdown", "\n".join(f"Line {number}\n" for number in range(60))),
    ("code", "Sensor.kind"),
)


def write_page(path, cells):
    """A page with ids and metadata as the course's pages have them."""
    page = nbformat.v4.new_notebook(metadata={"kernelspec": {
        "name": "python3", "display_name": "Python 3", "language": "python"}})  # fmt: skip
    for number, (kind, text) in enumerate(cells):
        make = getattr(nbformat.v4, f"new_{kind}_cell")
        page.cells.append(make(text, id=f"cell-{number}"))
    nbformat.write(page, path)


@pytest.fixture
def page_of(page, lab, request):
    opened = []

    def open_page(*cells):
        name = f"{request.node.name.split('[')[0]}.ipynb"
        write_page(lab.root / name, cells)
        opened.append(Notebook(page, lab, name))
        return opened[-1]

    yield open_page
    for one in opened:
        one.shut_down()


def test_a_name_of_a_cell_above_leads_to_that_cell(page_of, page):
    notebook = page_of(*CELLS)
    notebook.run(1)
    notebook.says(1, "Run the cell above that begins with `class Sensor:`, under the heading")
    notebook.says(1, '"The class", then this cell again.')
    above = page.locator(f"{SHOWN} .jp-CodeCell").first
    expect(above).not_to_be_in_viewport()
    page.get_by_role("link", name="Go to that cell").click()
    expect(above).to_be_in_viewport()
    notebook.run(0)
    notebook.run(1)
    notebook.says(1, "thermometer")

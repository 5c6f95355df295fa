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


SENSOR = """
from rclpy.node import Node
class WeatherReader(Node):
    def __init__(self):
        super().__init__("weather_reader")
"""
#: Each kind of cell that offers something, what it offers, and what is there when that is gone.
OFFERS = {
    "check": (SENSOR + 'check("00a", WeatherReader)', "Hint", "The buttons of this check went"),
    "quiz": ('quiz("03")', "Half a second later", "The choices went with the kernel."),
    "prediction": ('predict("____", 40)', "Compare", "The field to predict went"),
}


@pytest.mark.parametrize("way", ["restart", "shut down", "open again"])
@pytest.mark.parametrize("kind", OFFERS)
def test_what_went_with_the_kernel_says_so_and_comes_back(page_of, page, lab, kind, way):
    cell, offered, gone = OFFERS[kind]
    notebook = page_of(("code", cell))
    notebook.run(0)
    button = page.get_by_role("button", name=offered)
    button.first.wait_for()
    words = page.get_by_text(gone)
    page.wait_for_timeout(3500)  # what is tested is that it stays away
    expect(words).to_be_hidden()
    if way == "restart":
        notebook.restart()
    elif way == "shut down":
        page.evaluate("() => window.jupyterapp.commands.execute('kernelmenu:shutdown')")
    else:
        notebook.save()
        notebook.shut_down()
        notebook = Notebook(page, lab, notebook.name)
    expect(words).to_be_visible()
    expect(button.first).to_be_hidden()
    page.get_by_text("Error displaying widget").wait_for(state="hidden")
    if way == "shut down":
        notebook.start_kernel()
    notebook.run(0)
    button.first.wait_for()
    expect(words).to_be_hidden()
    assert notebook.errors() == {}


def test_where_everything_is_done_nothing_is_to_be_run_again(page_of, page, lab):
    notebook = page_of(("code", OFFERS["prediction"][0]))
    notebook.run(0)
    page.get_by_role("button", name="Show me").click()
    notebook.says(0, "It was 40.")
    notebook.save()
    notebook.shut_down()
    again = Notebook(page, lab, notebook.name)
    again.says(0, "It was 40.")
    assert page.get_by_text(OFFERS["prediction"][2]).count() == 0


FOLDED = """<details class="rosbeat-answer"><summary>After your prediction</summary>

It was **forty**.

</details>"""


@pytest.mark.parametrize("way", ["field", "cell", "show"])
def test_what_answers_a_prediction_is_folded_until_it_is_compared(page_of, page, way):
    cell = "predict('____', 40)"
    notebook = page_of(("code", cell), ("code", "1 + 1"), ("markdown", FOLDED), ("code", "2"))
    answer = page.get_by_text("It was forty.")
    notebook.run(0)
    page.get_by_label("Your prediction").wait_for()
    expect(answer).to_be_hidden()
    if way == "field":
        page.get_by_label("Your prediction").fill("39")
        page.get_by_role("button", name="Compare", exact=True).click()
    elif way == "show":
        page.get_by_role("button", name="Show me").click()
    else:
        notebook.write(0, cell.replace("____", "41"))
        notebook.run(0)
    expect(answer).to_be_visible()
    assert notebook.errors() == {}

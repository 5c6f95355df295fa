"""The field for a prediction in a real browser: the outcome comes after the answer."""

import pytest
from playwright.sync_api import expect

from browser.notebook import PATIENCE, Notebook, write_notebook

FIELD = ".rosbeat-predict"
IMPORTS = "from IPython.display import HTML, display\nimport sys\nfrom rosbeat import predict"
CELL = """
print("first 41")
display(HTML("<b id='drawn'>second 42</b>"))
print("third 43", file=sys.stderr)
found = 40 + 4
predict("____", found, because="Four more.")
"""
AFTER = "print('found is there:', found)"


@pytest.fixture
def notebook(page, lab, request):
    name = f"{request.node.name.split('[')[0]}.ipynb"
    write_notebook(lab.root / name, IMPORTS, getattr(request, "param", CELL), AFTER)
    made = Notebook(page, lab, name)
    made.run_all()
    yield made
    made.shut_down()


def shown(notebook):
    return notebook.cell(1).locator(".jp-Cell-outputWrapper").inner_text()


def test_nothing_is_told_before_the_answer_and_all_of_it_after(notebook, page):
    page.locator(FIELD).wait_for()
    assert "found is there: 44" in notebook.output(2)
    assert not any(number in shown(notebook) for number in ("41", "42", "43", "44"))
    field = page.get_by_label("Your prediction")
    field.fill("some words")
    field.press("Enter")
    page.locator(FIELD, has_text="cannot be compared with what happened: write a number").wait_for()
    assert "44" not in shown(notebook)
    field.fill("44")
    page.locator(FIELD).get_by_role("button", name="Compare").click()
    notebook.says(1, "You predicted 44, and it was 44.")
    expect(page.locator("#drawn")).to_be_visible()
    kinds = [one.get("name", one["output_type"]) for one in notebook.stored(1)]
    assert kinds == [
        "display_data",
        "display_data",
        "stdout",
        "display_data",
        "stderr",
        "display_data",
    ]
    expect(page.get_by_label("Your prediction")).to_be_hidden()


def test_who_wants_to_see_it_at_once_does(notebook, page):
    page.locator(FIELD).get_by_role("button", name="Show me").click()
    notebook.says(1, "No prediction yet. It was 44.")
    notebook.says(1, "third 43")
    assert not notebook.errors()


def test_a_page_that_was_loaded_anew_has_the_field_and_its_result(notebook, page, lab):
    page.locator(FIELD).wait_for()
    notebook.save()
    again = Notebook(page, lab, notebook.name)
    page.get_by_label("Your prediction").fill("44")
    page.locator(FIELD).get_by_role("button", name="Compare").click()
    page.locator(FIELD, has_text="You predicted 44, and it was 44.").wait_for()
    again.save()
    Notebook(page, lab, notebook.name)
    page.locator(FIELD, has_text="You predicted 44, and it was 44.").wait_for()
    expect(page.get_by_label("Your prediction")).to_be_hidden()


@pytest.mark.parametrize("notebook", [CELL.replace("____", "45")], indirect=True)
def test_a_prediction_in_the_cell_is_compared_at_once(notebook, page):
    notebook.says(1, "You predicted 45, and it was 44.")
    expect(page.get_by_label("Your prediction")).to_be_hidden()


@pytest.mark.parametrize(
    "notebook", [CELL.replace("found = 40 + 4", "found = 1 / 0")], indirect=True
)
def test_a_cell_that_raises_shows_everything(notebook, page):
    notebook.says(1, "ZeroDivisionError")
    notebook.says(1, "third 43")
    page.locator("#drawn").wait_for(timeout=PATIENCE)
    assert page.locator(FIELD).count() == 0


@pytest.mark.parametrize("notebook", [CELL + "found"], indirect=True)
def test_a_cell_that_does_not_end_with_its_prediction_shows_everything(notebook, page):
    notebook.says(1, "third 43")
    assert page.locator(FIELD).count() == 0

"""The card of a check in a real browser: its buttons, by mouse and by keyboard."""

import nbformat
import pytest
from playwright.sync_api import expect

from bank.pages import solution
from browser.notebook import PATIENCE, Notebook

pytestmark = pytest.mark.ros

IMPORTS = """
from rclpy.node import Node
from std_msgs.msg import Float32
from rosbeat import check
"""
WRONG = solution("03a").replace('"humidity", 5', '"humidity", 10')
CHECK = 'check("03a", HumiditySensor)'
BUTTONS = ".rosbeat-check"
#: A cell that runs until a file is there, and a check that then does the same.
WAITS = """
import time
from pathlib import Path
from rosbeat.exercises.cells import cells_of
def wait_for(name):
    while not Path(name).exists():
        time.sleep(0.05)
(buttons,) = (one for widgets in cells_of().widgets.values() for one in widgets)
again = buttons._actions["again"]
buttons._actions["again"] = lambda sent: wait_for("end of the check") or again(sent)
print("waiting", flush=True)
wait_for("end of the cell")
"""


def write_page(path, *cells):
    """A notebook with the metadata that a page of the course has."""
    roles = [{}, {"exercise": "03a"}, {"check": "03a"}]
    made = [
        nbformat.v4.new_code_cell(source, metadata={"rosbeat": role} if role else {})
        for source, role in zip(cells, roles, strict=True)
    ]
    spec = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
    nbformat.write(nbformat.v4.new_notebook(cells=made, metadata={"kernelspec": spec}), path)


@pytest.fixture
def notebook(page, lab, request):
    """A page with a wrong answer that was checked."""
    name = f"{request.node.name.split('[')[0]}.ipynb"
    for kept in lab.root.parent.glob(".rosbeat/progress*"):
        kept.unlink()
    write_page(lab.root / name, IMPORTS, WRONG, CHECK)
    made = Notebook(page, lab, name)
    for cell in range(3):
        made.run(cell)
    made.says(2, "Exercise 03a: not there yet")
    page.locator(BUTTONS).wait_for()
    yield made
    made.shut_down()


def press(page, name):
    page.locator(BUTTONS).get_by_role("button", name=name).click()


def says(page, text):
    page.locator(BUTTONS, has_text=text).wait_for(timeout=PATIENCE)


def test_hints_come_one_by_one_and_the_answer_after_a_question(notebook, page):
    press(page, "Hint")
    says(page, "Hint 1 of")
    press(page, "Hint")
    says(page, "Hint 2 of")
    press(page, "Show the answer")
    assert "class HumiditySensor" not in page.locator(BUTTONS).inner_text()
    press(page, "No, not yet")
    expect(page.locator(BUTTONS).get_by_role("button", name="Show the answer")).to_be_focused()
    press(page, "Show the answer")
    press(page, "Yes, show it")
    says(page, "class HumiditySensor")
    assert page.locator(BUTTONS).get_by_role("button", name="Yes, show it").count() == 0


def test_run_again_runs_the_edited_cell_and_then_the_check_and_a_pass_is_saved(notebook, page, lab):
    notebook.write(1, solution("03a"))
    press(page, "Run again")
    notebook.says(2, "Exercise 03a: passed")
    expect(page.locator(BUTTONS).get_by_role("button")).to_have_count(0)
    card, _, buttons = notebook.stored(2)
    assert "passed" in "".join(card["data"]["text/plain"])
    assert not [mime for mime in card["data"] if "widget" in mime]
    assert "".join(buttons["data"]["text/plain"]) == ""
    saved = lab.root / notebook.name
    page.wait_for_function("() => !window.jupyterapp.shell.currentWidget.context.model.dirty")
    assert solution("03a").strip() in nbformat.read(saved, as_version=4).cells[1].source


def without_jupyterlab(page):
    """Let the page find no JupyterLab that it could ask, as with another front end."""
    page.evaluate("() => { window.aside = window.jupyterapp; delete window.jupyterapp; }")


def with_jupyterlab(page):
    """Let the page find it again, as the other steps need it."""
    page.evaluate("() => { window.jupyterapp = window.aside; }")


def test_where_jupyterlab_cannot_be_asked_the_button_judges_the_last_run_and_says_so(
    notebook, page
):
    notebook.write(1, solution("03a"))
    notebook.run(1)
    without_jupyterlab(page)
    press(page, "Hint")  # which brings the buttons up to date
    says(page, "Hint 1 of")
    press(page, "Check again")
    says(page, "Checked the cell above as it last ran: passed.")
    with_jupyterlab(page)
    notebook.says(2, "Exercise 03a: passed")


def test_run_again_says_that_the_cell_above_did_not_run(notebook, page):
    notebook.write(1, WRONG.replace("def publish_humidity(self):", "def publish_humidity(self)"))
    press(page, "Run again")
    notebook.says(2, "The cell above did not run (line ")


def test_a_page_that_was_loaded_anew_has_the_buttons_and_what_they_say(notebook, page, lab):
    press(page, "Hint")
    says(page, "Hint 1 of")
    notebook.save()
    again = Notebook(page, lab, notebook.name)
    says(page, "Hint 1 of")
    again.write(1, solution("03a"))
    press(page, "Run again")
    again.says(2, "Exercise 03a: passed")


def test_buttons_are_hidden_once_their_kernel_is_gone_and_other_widgets_stay(notebook, page, lab):
    notebook.write(0, "from ipywidgets import Button\nButton(description='Plain')")
    notebook.run(0)
    for name in ("Plain", "Hint"):
        expect(page.get_by_role("button", name=name, exact=True)).to_be_visible()
    notebook.save()
    notebook.shut_down()
    Notebook(page, lab, notebook.name)
    dead = page.locator(".jp-OutputArea-child", has=page.locator("> .jupyter-widgets"))
    expect(dead).to_have_count(2)
    expect(dead.first).to_be_visible()  # of others; ours say that the cell is to be run again
    expect(dead.last).to_be_hidden()


def test_the_keyboard_is_enough(notebook, page):
    page.locator(BUTTONS).get_by_role("button", name="Hint").focus()
    page.keyboard.press("Enter")
    says(page, "Hint 1 of")
    page.keyboard.press("Tab")
    expect(page.locator(BUTTONS).get_by_role("button", name="Show the answer")).to_be_focused()
    outline = page.evaluate("() => getComputedStyle(document.activeElement).outlineStyle")
    assert outline == "solid"
    page.keyboard.press("Enter")
    expect(page.locator(BUTTONS).get_by_role("button", name="No, not yet")).to_be_focused()
    page.keyboard.press("Tab")
    page.keyboard.press("Space")
    says(page, "class HumiditySensor")


def test_a_click_waits_for_the_cell_that_runs_and_then_for_its_check(notebook, page, lab):
    notebook.write(0, WAITS)
    notebook.start(0)
    notebook.says(0, "waiting")
    without_jupyterlab(page)
    page.locator(BUTTONS).get_by_role("button", name="Run again").click()
    says(page, "The kernel has not answered yet.")
    (lab.root / "end of the cell").touch()
    says(page, "Checking")
    (lab.root / "end of the check").touch()
    says(page, "Checked the cell above as it last ran: not there yet.")
    with_jupyterlab(page)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_picture_of_it(notebook, page, theme, tmp_path):
    notebook.theme(theme)
    press(page, "Hint")
    says(page, "Hint 1 of")
    assert notebook.picture(f"check card {theme}", notebook.cell(2), tmp_path).is_file()

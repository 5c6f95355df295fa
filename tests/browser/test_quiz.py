"""The questions of a page in a real browser: a click is answered at once, by mouse or keyboard."""

import pytest

from browser.notebook import Notebook, write_notebook


@pytest.fixture
def notebook(page, lab):
    write_notebook(lab.root / "questions.ipynb", "from rosbeat import quiz", 'quiz("03")')
    made = Notebook(page, lab, "questions.ipynb")
    made.run_all()
    yield made
    made.shut_down()


def test_a_click_is_answered_with_a_reason(notebook, page):
    group = page.get_by_role("group", name="Question 03.1")
    group.get_by_role("button", name="a) At once, in the constructor").click()
    page.get_by_role("status").filter(has_text="Question 03.1: not right.").wait_for()
    notebook.says(1, "\N{BALLOT X} Question 03.1")
    right = group.get_by_role("button", name="b) Half a second later")
    right.focus()
    page.keyboard.press("Enter")
    page.get_by_role("status").filter(has_text="Question 03.1: right.").wait_for()
    notebook.says(1, "\N{CHECK MARK} Question 03.1")
    assert right.get_attribute("aria-pressed") == "true"
    notebook.says(1, "\N{WHITE CIRCLE} Question 03.2")

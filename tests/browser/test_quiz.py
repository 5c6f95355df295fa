"""The questions of a page in a real browser: a click is answered at once, by mouse or keyboard."""

from dataclasses import replace

import pytest
from playwright.sync_api import expect

from browser.accessibility import issues
from browser.notebook import Notebook, write_notebook
from rosbeat.exercises.quiz import QUESTIONS

FIRST, *_ = QUESTIONS["03"]
#: Without the marks of code.
CHOICES = [
    replace(one, text=one.text.replace("`", ""), reason=one.reason.replace("`", ""))
    for one in FIRST.choices
]
WRONG, RIGHT = CHOICES[0], CHOICES[1]


@pytest.fixture
def notebook(page, lab):
    write_notebook(lab.root / "questions.ipynb", 'quiz("03")')
    made = Notebook(page, lab, "questions.ipynb")
    made.run_all()
    yield made
    made.shut_down()


def choice(page, text):
    return page.get_by_role("group", name="Question 03.1").get_by_role("button", name=text)


def test_choices_are_clicked_and_stay_and_the_reason_comes_once(notebook, page):
    choice(page, WRONG.text).click()
    reason = page.get_by_role("status").filter(has_text=WRONG.reason)
    reason.wait_for()
    for one in CHOICES:
        expect(choice(page, one.text)).to_be_visible()
    expect(choice(page, WRONG.text)).to_have_attribute("aria-pressed", "true")
    expect(choice(page, "\N{BALLOT X}")).to_have_count(1)
    expect(choice(page, RIGHT.text)).to_have_attribute("aria-pressed", "false")
    assert page.get_by_text(WRONG.reason).locator("visible=true").count() == 1


def test_the_keyboard_chooses_and_keeps_its_place(notebook, page):
    choice(page, WRONG.text).focus()
    page.keyboard.press("Tab")
    expect(choice(page, RIGHT.text)).to_be_focused()
    page.keyboard.press("Enter")
    page.get_by_role("status").filter(has_text=RIGHT.reason).wait_for()
    expect(choice(page, RIGHT.text)).to_be_focused()
    expect(choice(page, RIGHT.text)).to_have_attribute("aria-pressed", "true")
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Space")
    page.get_by_role("status").filter(has_text=WRONG.reason).wait_for()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_questions_can_be_read_by_everybody(notebook, page, theme):
    notebook.theme(theme)
    choice(page, WRONG.text).click()
    page.get_by_role("status").filter(has_text=WRONG.reason).wait_for()
    page.evaluate("() => document.activeElement.blur()")  # a mouse shows no focus
    assert issues(page.locator(".rosbeat-exercise")) == []


def test_what_was_chosen_is_in_the_stored_page(notebook, page):
    choice(page, WRONG.text).click()
    page.get_by_role("status").filter(has_text=WRONG.reason).wait_for()
    page.wait_for_function(
        """() => JSON.stringify(window.jupyterapp.shell.currentWidget.context.model.toJSON())
            .includes("\N{RIGHTWARDS ARROW} a)")"""
    )

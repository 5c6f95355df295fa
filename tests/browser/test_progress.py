"""`progress()` in JupyterLab: links that open pages, marks that keep up, and the home page."""

import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from playwright.sync_api import expect

from browser.accessibility import cut_off, issues
from browser.notebook import SHOWN, Notebook, write_notebook
from rosbeat.exercises.exercise import failed, passed
from rosbeat.exercises.progress import ProgressFile

ROOT = Path(__file__).parents[2]
LIST = f"{SHOWN} .rosbeat-progress-live .rosbeat-progress"
SHOW = "progress()"


@pytest.fixture
def folder(lab):
    """The folder of a learner who has done nothing yet, with every page of the course."""
    for path in (ROOT / "notebooks").glob("*.ipynb"):
        shutil.copy(path, lab.root)
    shutil.rmtree(lab.root.parent / ".rosbeat", ignore_errors=True)
    return lab.root


@pytest.fixture
def progress(lab):
    return ProgressFile(lab.root.parent / ".rosbeat")


@pytest.fixture
def opened(page, lab, folder):
    """Open a notebook of the folder."""
    made = []

    def open_one(name):
        made.append(Notebook(page, lab, name))
        return made[-1]

    yield open_one
    for one in made:
        one.shut_down()


def pass_one(progress, exercise):
    right = replace(passed(""), points=1)
    progress.change(exercise, lambda before: before.after(right))


def mark(page, words):
    return page.locator(f"{LIST} span", has_text=words)


def test_the_home_page_keeps_up_with_checks_on_other_pages(opened, page, progress):
    home = opened("home.ipynb")
    home.run_all()
    mark(page, "○ 00a").wait_for()
    assert page.locator(f"{LIST} caption").count() == 2
    pass_one(progress, "00a")
    mark(page, "✓ 00a").wait_for()
    progress.change("00b", lambda before: before.after(failed("00b", "", "")))
    mark(page, "✗ 00b").wait_for()
    assert home.errors() == {}


@pytest.mark.parametrize(("name", "cell"), [("home", 0), ("00_hear_the_heartbeat", -1)])
def test_a_page_that_was_not_run_shows_the_list_and_keeps_it_up(
    opened, page, lab, progress, name, cell
):
    refresh(lab)
    pass_one(progress, "00a")
    notebook = opened(f"{name}.ipynb")
    page.locator(f"{SHOWN} .jp-CodeCell").nth(cell).scroll_into_view_if_needed()
    mark(page, "✓ 00a").wait_for()
    expect(page.get_by_text("when this list was stored")).to_be_hidden()
    pass_one(progress, "00b")
    mark(page, "✓ 00b").wait_for()
    notebook.restart()
    page.get_by_text("Run this cell to bring the list up to date.").wait_for()
    pass_one(progress, "01a")
    notebook.run(page.locator(f"{SHOWN} .jp-CodeCell").count() - 1)
    mark(page, "✓ 00b").wait_for()
    expect(page.get_by_text("Run this cell to bring the list up to date.")).to_be_hidden()


def test_without_a_kernel_the_stored_list_says_what_it_is(opened, page, lab, progress):
    pass_one(progress, "00a")
    refresh(lab)
    text = (lab.root / "home.ipynb").read_text(encoding="utf-8")
    (lab.root / "of_somebody_else.ipynb").write_text(text.replace("Welcome!", "Hello!"))
    opened("of_somebody_else.ipynb")
    page.get_by_text("when this list was stored").wait_for()
    page.locator(".rosbeat-progress-stored span", has_text="✓ 00a").wait_for()


def test_the_home_page_ends_with_a_text_so_that_running_its_list_adds_no_cell(opened, page):
    home = opened("home.ipynb")
    before = page.locator(f"{SHOWN} .jp-Cell").count()
    home.cell(0).locator(".cm-content").click()
    page.keyboard.press("Shift+Enter")
    mark(page, "○ 00a").wait_for()
    assert page.locator(f"{SHOWN} .jp-Cell").count() == before


def test_it_keeps_up_while_the_kernel_is_busy(opened, page, lab, progress):
    write_notebook(lab.root / "busy.ipynb", SHOW, "import time; time.sleep(120)")
    notebook = opened("busy.ipynb")
    notebook.run(0)
    notebook.start(1)
    notebook.cell(1).locator(".jp-InputPrompt", has_text="*").wait_for()
    pass_one(progress, "00a")
    mark(page, "✓ 00a").wait_for()
    notebook.interrupt()


@pytest.mark.parametrize("is_run", [True, False], ids=["run", "stored and not trusted"])
def test_a_link_opens_its_page_here(opened, page, lab, progress, is_run):
    pass_one(progress, "00a")
    if not is_run:
        refresh(lab)
    home = opened("home.ipynb")
    if is_run:
        home.run_all()
    mark(page, "✓ 00a").wait_for()
    page.locator(LIST).get_by_role("link", name="03 Write a publisher").click()
    page.locator(f"{SHOWN} h1", has_text="Write a publisher").wait_for()
    assert len(page.context.pages) == 1
    # From there the last cell leads on, and back.
    page.locator(SHOWN).get_by_role("link", name="The whole course").click()
    page.locator(f"{SHOWN} h1", has_text="Find your way").wait_for()


def refresh(lab):
    """Bring the home page up to date as `course lab` does before it opens."""
    environment = {
        **os.environ,
        "ROSBEAT_PROGRESS_IN": str(lab.root.parent),
        "JUPYTER_DATA_DIR": str(lab.root.parent / "data"),
    }
    command = [sys.executable, "-m", "rosbeat", "progress", "--home", str(lab.root / "home.ipynb")]
    subprocess.run(command, env=environment, check=True)


#: Cards of a check that failed, of one that was not attempted, and of a hint.
CARDS = (
    "from rclpy.node import Node\nfrom rosbeat import check, hint, progress",
    "class Mute(Node):\n    def __init__(self):\n        super().__init__('mute')\n"
    "check('00a', Mute)",
    "class Blank(Node):\n    def __init__(self):\n        super().__init__(____)\n"
    "check('00a', Blank)",
    "hint('00a')",
    "progress()",
)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_lists_and_cards_can_be_read_by_everybody(opened, page, lab, progress, theme, tmp_path):
    pass_one(progress, "00a")
    progress.change("01b", lambda before: before.after(failed("01b", "", "")))
    shutil.copy(lab.root / "home.ipynb", lab.root / "home_too.ipynb")
    write_notebook(lab.root / "00_hear_the_heartbeat.ipynb", *CARDS)
    for name in ("home_too.ipynb", "00_hear_the_heartbeat.ipynb"):
        notebook = opened(name)
        notebook.theme(theme)
        notebook.run_all()
        shown = page.locator(f"{SHOWN} .jp-OutputArea-output:visible")
        shown.first.wait_for()
        for output in shown.all():
            assert issues(output) == []
        assert notebook.errors() == {}
        notebook.picture(f"progress-{name[:4]}-{theme}", page.locator(LIST).last, tmp_path)


@pytest.mark.parametrize("width", [1000, 667], ids=["1000", "1000 at 150 %"])
def test_nothing_of_the_list_is_cut_off_in_a_narrow_window(opened, page, width):
    page.set_viewport_size({"width": width, "height": 900})
    home = opened("home.ipynb")
    home.run_all()
    assert cut_off(page.locator(LIST)) == []

"""The live view of a robot in a real browser: look, drive, restart."""

import os
import re

import pytest

from browser.accessibility import cut_off, issues
from browser.notebook import PATIENCE, Notebook, write_notebook

pytestmark = pytest.mark.ros

ROVER = """
import os, subprocess, sys
rover = os.path.join(sys.prefix, "lib", "rosie", "rover")
program = subprocess.Popen([sys.executable, rover], stderr=subprocess.DEVNULL)
"""
STOP = "program.terminate(); program.wait()"
OPEN = "view = watch_robot()\nview"
CLOSED = "view.close()"
ROBOT = ".rosbeat-robot"


@pytest.fixture
def notebook(page, lab, request):
    name = f"{request.node.originalname}.ipynb"
    write_notebook(lab.root / name, ROVER, OPEN, STOP)
    made = Notebook(page, lab, name)
    yield made
    made.run(2)
    made.shut_down()


def words(page, pattern):
    """Wait until the words below the picture match."""
    page.locator(f"{ROBOT} .rv-words", has_text=re.compile(pattern)).wait_for(timeout=PATIENCE)
    return page.locator(f"{ROBOT} .rv-words").inner_text()


def x_of(text):
    return float(re.search(r"x (-?[\d.]+) m", text)[1])


def test_it_waits_for_a_robot_and_drives_it_with_buttons_and_keys(notebook, page):
    notebook.run(1)
    page.locator(ROBOT).scroll_into_view_if_needed()
    words(page, r"not here yet.*ros2 run rosie rover")
    assert page.get_by_label("Drive ahead").is_disabled()
    notebook.run(0)
    assert x_of(words(page, r"x 0\.50 m")) == 0.5
    ahead = page.get_by_label("Drive ahead")
    page.get_by_label("Speed").fill("1")
    ahead.dispatch_event("pointerdown", {"pointerId": 1})
    words(page, r"x 0\.[6-9]\d m|x [1-9]")
    ahead.dispatch_event("pointerup", {"pointerId": 1})
    ahead.focus()
    page.keyboard.down("ArrowLeft")
    words(page, r"· [1-9]\d*°")
    page.keyboard.up("ArrowLeft")
    assert page.locator(f"{ROBOT} .rv-room").get_attribute("d")
    assert page.locator(f"{ROBOT} .rv-trail").get_attribute("d")
    label = page.locator(f"{ROBOT} svg").get_attribute("aria-label")
    assert label.startswith("Rosie from above. x ")


def test_it_can_be_read_everywhere(notebook, page):
    notebook.run(0)
    notebook.run(1)
    for theme in ("dark", "light"):
        notebook.theme(theme)
        for width in (667, 1280):
            page.set_viewport_size({"width": width, "height": 1000})
            words(page, r"x 0\.50 m")
            view = page.locator(ROBOT)
            view.scroll_into_view_if_needed()
            if folder := os.environ.get("ROSBEAT_SCREENSHOTS"):
                view.screenshot(path=f"{folder}/robot_{theme}_{width}.png")
            assert issues(view) == []
            assert cut_off(view) == []


def test_a_kernel_that_is_gone_is_said(notebook, page):
    notebook.run(0)
    notebook.run(1)
    words(page, r"x 0\.50 m")
    notebook.run(2)
    notebook.restart()
    page.locator(f"{ROBOT} [role=alert]", has_text="Run this cell again").wait_for(timeout=PATIENCE)
    notebook.run(0)
    notebook.run(1)
    words(page, r"x 0\.50 m")

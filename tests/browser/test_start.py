"""A learner's first steps: `course lab`, their own pages, the solutions, and Ctrl+C."""

import json
import re
import sys
import time
from pathlib import Path

import pytest

from browser.course import ROOT, open_course
from browser.notebook import PATIENCE, SHOWN, Notebook

NAME = "03_write_a_publisher.ipynb"

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(600),
    pytest.mark.skipif(Path(sys.prefix) != ROOT / ".venv", reason="needs this checkout's .venv"),
]


@pytest.fixture(scope="session")
def course(browser, tmp_path_factory):
    with open_course(tmp_path_factory.mktemp("start")) as made:
        yield made


@pytest.fixture(scope="session")
def lab(course):
    """The server that `course lab` started, in the place of the one of the other tests."""
    return course.lab


@pytest.fixture
def open_page(page, lab):
    made = []

    def open_one(name):
        made.append(Notebook(page, lab, name))
        cells = json.loads((lab.root / name).read_text())["cells"]
        code = [one for one in cells if one["cell_type"] == "code"]
        about = [one["metadata"].get("rosbeat", {}) for one in code]
        return made[-1], about, ["".join(one["source"]) for one in code]

    yield open_one
    for one in made:
        one.shut_down()


def number(about, **wanted):
    """The number of the code cell of which a lesson says this."""
    return next(k for k, one in enumerate(about) if wanted.items() <= one.items())


def test_it_says_where_the_course_is_and_how_to_stop(course):
    made, opened, stop = course.said
    assert made == "Your own pages are in the folder my_course.\n"
    assert re.fullmatch(r"The course is open at  http://\S+/lab/tree/home.ipynb\n", opened)
    assert stop.endswith("go to my_course/.rosbeat/lab.log\n")


def test_the_address_leads_to_the_first_page_and_its_first_message(page, course, lab):
    page.goto(course.said[1].split()[-1])
    page.locator(".rosbeat-progress").get_by_role(
        "link", name="00 Hear the heartbeat"
    ).first.click()
    page.wait_for_selector(f"{SHOWN} h1:has-text('Hear the heartbeat')", timeout=PATIENCE)
    page.get_by_text("ROS 2 (rosbeat) | Idle").wait_for(timeout=PATIENCE)
    # A page that was only opened has nothing to save.
    assert page.locator(".jp-mod-dirty").count() == 0
    names = page.locator(".jp-DirListing-item .jp-DirListing-itemText > span")
    found = names.all_inner_texts()
    pages = {path.name for path in (ROOT / "notebooks").glob("*.ipynb")}
    assert set(found) <= {"docs", "solutions", "COLCON_IGNORE", *pages}
    assert found.index("solutions") < found.index(NAME) < found.index("home.ipynb")
    cut = "all => all.filter(one => one.scrollWidth > one.parentElement.clientWidth).length"
    assert names.evaluate_all(cut) == 0
    cell = page.locator(f"{SHOWN} .jp-CodeCell")
    cell.first.locator(".cm-content").click()
    for _ in range(4):
        page.keyboard.press("Shift+Enter")
    said = page.locator(".jp-OutputArea-output", has_text="It is 22.5 degrees").first
    said.wait_for(timeout=PATIENCE)
    page.keyboard.press("Control+Shift+L")
    cards = page.locator(".jp-LauncherCard:visible")
    cards.first.wait_for(timeout=PATIENCE)
    assert cards.all_inner_texts() == [
        *("ROS 2 (rosbeat)", "Terminal", "Text File", "Markdown File", "Python File"),
        "Show Contextual Help",
    ]


def test_a_terminal_of_a_page_starts_in_the_learners_folder(open_page, course):
    notebook, _, sources = open_page("01_create_a_workspace.ipynb")
    notebook.run(0)
    pwd = next(k for k, source in enumerate(sources) if source.endswith("pwd"))
    notebook.run(pwd)
    notebook.says(pwd, str(course.own))


def test_a_solution_looks_like_one_and_does_not_count(open_page, page, course):
    notebook, about, _ = open_page(f"solutions/{NAME}")
    assert page.get_by_text("This is a solution", exact=True).is_visible()
    tab = page.locator(".lm-TabBar-tab.lm-mod-current[title*='Path: solutions/']")
    assert tab.evaluate("one => getComputedStyle(one).boxShadow") != "none"
    answer, check = number(about, exercise="03a"), number(about, check="03a")
    notebook.write(answer, "changed")
    assert "changed" not in notebook.cell(answer).locator(".cm-content").inner_text()
    for cell in (0, answer, check):
        notebook.run(cell)
    notebook.says(check, ": passed")
    assert course.progress() == set()


def test_a_page_of_ones_own_counts(open_page, course):
    notebook, about, _ = open_page(NAME)
    solved = json.loads((ROOT / "solutions" / NAME).read_text())["cells"]
    answer, check = number(about, exercise="03a"), number(about, check="03a")
    text = next(
        "".join(one["source"]) for one in solved
        if one["metadata"].get("rosbeat", {}).get("exercise") == "03a"
    )  # fmt: skip
    notebook.run(0)
    notebook.write(answer, text)
    for cell in (answer, check):
        notebook.run(cell)
    notebook.says(check, ": passed")
    assert course.progress() == {"03a"}
    notebook.save()
    assert text in [
        "".join(one["source"]) for one in json.loads((course.own / NAME).read_text())["cells"]
    ]
    shipped = course.root / "notebooks" / NAME
    assert shipped.read_bytes() == (ROOT / "notebooks" / NAME).read_bytes()


def test_ctrl_c_ends_it_all(page, lab, course):
    Notebook(page, lab, NAME)
    page.close()
    assert any("ipykernel" in line for line in course.programs())
    out, err = course.stop()
    assert (course.process.returncode, err) == (0, "")
    assert out.splitlines()[1:] == [
        "Stopping JupyterLab and its kernels ...", "Stopped. Your pages are as you saved them."
    ]  # fmt: skip
    deadline = time.monotonic() + 60
    while course.programs() and time.monotonic() < deadline:
        time.sleep(0.1)
    assert course.programs() == []

"""What is around the cells of a page: line numbers, colors, and how all of it fits a window."""

import shutil
from pathlib import Path

import pytest

from browser.accessibility import faint
from browser.notebook import SHOWN, Notebook, write_notebook

pytestmark = [pytest.mark.ros, pytest.mark.timeout(300)]

ROOT = Path(__file__).parents[2]
THEMES = ("light", "dark")
#: All colors of a terminal, printed and as an error; and a traceback with its own.
COLORS = """\
import sys
for stream in (sys.stdout, sys.stderr):
    for number in [*range(30, 38), *range(90, 98)]:
        print(f"\\x1b[{number}mcolor {number}\\x1b[0m", file=stream)
def divide(number):
    return number / 0
divide("one" if False else 1)"""
TERMINAL = """\
%%terminal one
cd nowhere  # a comment
export ROBOT="Rosie"
if true; then echo "I am $ROBOT"; fi"""

#: The lines of a text as they are broken in the window.
LINES = """pre => {
    const text = pre.textContent, range = document.createRange(), node = pre.firstChild;
    const lines = [];
    let top = null;
    for (let at = 0; at < text.length; at += 1) {
        range.setStart(node, at);
        range.setEnd(node, at + 1);
        const box = range.getBoundingClientRect();
        if (box.width && box.top !== top) {
            lines.push('');
            top = box.top;
        }
        if (lines.length) lines[lines.length - 1] += text[at];
    }
    return lines;
}"""


@pytest.fixture
def open_page(page, lab):
    made = []

    def open_one(name, width=1280):
        page.set_viewport_size({"width": width, "height": 12_000})
        made.append(Notebook(page, lab, name))
        return made[-1]

    yield open_one
    for notebook in made:
        notebook.shut_down()


def test_code_cells_have_line_numbers(open_page, page, lab):
    write_notebook(lab.root / "lines.ipynb", "a = 1\nb = 2\nc = 3")
    open_page("lines.ipynb")
    numbers = page.locator(f"{SHOWN} .jp-CodeCell .cm-lineNumbers .cm-gutterElement:visible")
    assert numbers.all_inner_texts() == ["1", "2", "3"]


def test_a_file_of_python_is_no_page(page, lab):
    (lab.root / "robot.py").write_text("print('Rosie')\n")
    assert page.request.get(f"{lab.url}api/contents/robot.py").json()["type"] == "file"


def test_a_long_line_breaks_between_words(open_page, page, lab):
    write_notebook(lab.root / "long.ipynb", "print('temperature ' * 40)")
    notebook = open_page("long.ipynb", 720)
    notebook.run(0)
    output = page.locator(f"{SHOWN} .jp-OutputArea-output pre")
    lines = output.evaluate(LINES)
    assert len(lines) > 2
    assert {word for line in lines for word in line.split()} == {"temperature"}


def test_every_word_of_an_output_can_be_read(open_page, page, lab):
    write_notebook(lab.root / "colors.ipynb", COLORS, TERMINAL)
    notebook = open_page("colors.ipynb")
    for cell in (0, 1):
        notebook.run(cell)
    notebook.says(1, "I am Rosie")
    for theme in THEMES:
        notebook.theme(theme)
        assert faint(page.locator(f"{SHOWN} .jp-OutputArea").nth(0)) == []
        assert faint(page.locator(f"{SHOWN} .jp-OutputArea").nth(1)) == []


def test_a_solution_can_be_read(open_page, page, lab, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "environment")
    from course_tool.folder import as_solution

    name = "01_create_a_workspace.ipynb"
    (lab.root / name).write_bytes(as_solution(name, (ROOT / "solutions" / name).read_bytes()))
    notebook = open_page(name)
    notebook.wait_until_drawn()
    for theme in THEMES:
        notebook.theme(theme)
        texts = page.locator(f"{SHOWN} :is(.jp-OutputArea, .jp-RenderedMarkdown)")
        assert [line for text in texts.all() for line in faint(text)] == []


@pytest.mark.parametrize("width", [390, 720, 1440])
def test_a_window_is_for_the_page(open_page, page, lab, width):
    name = "03_write_a_publisher.ipynb"
    shutil.copy(ROOT / "solutions" / name, lab.root / name)
    notebook = open_page(name, width)
    browser = page.locator("#jp-left-stack").bounding_box()["width"]
    assert browser >= 290 if width == 1440 else browser <= width / 3
    notebook.wait_until_drawn()
    # What is wider than its place scrolls by itself; the output around it does not move.
    outputs = page.locator(f"{SHOWN} .jp-OutputArea-output:has(figure.rosbeat-picture)")
    assert outputs.count() >= 2
    assert outputs.evaluate_all("all => all.filter(one => one.scrollWidth > one.clientWidth)") == []

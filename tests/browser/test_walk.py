"""A walk through pages 00 to 06 in JupyterLab, by somebody who does nothing right at first.

On each page the kernel starts anew in the middle and at the end, and whoever walks goes on where
they are. They try a wrong answer of the bank before each right one, take a hint, press every
button, and do what the messages say.

It takes minutes, so it is left out unless pytest is given `--thorough`.
"""

import sys
from pathlib import Path

import pytest

from browser.accessibility import serious
from browser.course import ROOT, open_course
from browser.notebook import SHOWN, Notebook
from browser.walker import Walker, wrong_tries

PAGES = sorted(path.name for path in (ROOT / "notebooks").glob("0[0-6]_*.ipynb"))
WIDTHS = (390, 720, 1440)
LIST = f"{SHOWN} .rosbeat-progress-live .rosbeat-progress"
#: What reaches out of the page, and does not scroll by itself.
OVERFLOW = """() => {
    const notebook = document.querySelector('.jp-NotebookPanel:not(.lm-mod-hidden) .jp-Notebook');
    const edge = Math.min(window.innerWidth, notebook.getBoundingClientRect().right) + 1;
    const scrolls = one => one !== notebook && notebook.contains(one)
        && (['auto', 'scroll', 'hidden'].includes(getComputedStyle(one).overflowX)
            || scrolls(one.parentElement));
    const wide = [...notebook.querySelectorAll('*')].filter(one => one.checkVisibility()
        && !one.closest('svg, .cm-editor') && one.getBoundingClientRect().right > edge
        && !scrolls(one.parentElement));
    const whole = document.scrollingElement;
    return (whole.scrollWidth > window.innerWidth ? ['the whole window'] : [])
        .concat(wide.map(one => one.outerHTML.slice(0, 160)));
}"""

pytestmark = [
    pytest.mark.ros,
    pytest.mark.thorough,
    pytest.mark.timeout(900),
    pytest.mark.skipif(Path(sys.prefix) != ROOT / ".venv", reason="needs this checkout's .venv"),
]


@pytest.fixture(scope="session")
def course(browser, tmp_path_factory):
    with open_course(tmp_path_factory.mktemp("walk")) as made:
        yield made


@pytest.fixture(scope="session")
def lab(course):
    """The server of the course: one for the whole walk."""
    return course.lab


@pytest.fixture
def walker(page, lab, request):
    made = Walker(page, lab, request.param)
    yield made
    made.notebook.shut_down()


@pytest.mark.parametrize("walker", PAGES, indirect=True)
def test_nobody_is_left_stuck(walker, page, course):
    for number in range(len(walker.ids)):
        if number == len(walker.ids) // 2:
            walker.restart()
        go_on(walker, number, tries=1)
    walker.restart()
    first, last = min(walker.open), max(walker.open)
    for number in (first, last):
        if not walker.exercise_of(number):
            walker.run(number)
        if number in walker.open:
            finish(walker, number)
    walker.notebook.save()
    walker.notebook = Notebook(page, walker.lab, walker.name)
    progress_is_true(page, course, walker)
    it_fits(page, walker.notebook)
    walker.notebook = Notebook(page, walker.lab, "home.ipynb")
    progress_is_true(page, course, walker)


def go_on(walker, number, tries):
    """Do what a page asks for at one cell."""
    source = walker.sources[number]
    if exercise := walker.about(number, "exercise"):
        known = wrong_tries(exercise)
        walker.exercise(number, known[:: -(-len(known) // tries)])
    elif not walker.exercise_of(number):
        walker.run(number)
    if "predict(" in source:
        walker.predict(number)
        walker.run(number)  # so that it is open when the kernel starts anew
        walker.open.add(number)
    if "quiz(" in source:
        walker.choose(number, right=False)
        walker.open.add(number)


def finish(walker, number):
    """Answer what a cell asks after its kernel has started anew."""
    if "quiz(" in walker.sources[number]:
        walker.choose(number, right=True)
    else:
        walker.predict(number)


def progress_is_true(page, course, walker):
    """What a list says that nobody has run is what was passed, and what the file holds."""
    passed = page.locator(f"{LIST} span", has_text="\N{CHECK MARK}")
    for exercise in walker.passed:
        shown = page.locator(f"{LIST} span, {LIST} li", has_text=f"\N{CHECK MARK} {exercise}")
        shown.first.wait_for()
    assert set(walker.passed) <= course.progress()
    assert passed.count() <= len(course.progress())


def it_fits(page, notebook):
    """The page is as wide as its window, and can be read, in light and dark."""
    for theme in ("light", "dark"):
        notebook.theme(theme)
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 1000})
            notebook.wait_until_drawn()
            assert page.evaluate(OVERFLOW) == [], (theme, width)
        outputs = page.locator(f"{SHOWN} .jp-OutputArea-output").all()
        assert [line for output in outputs for line in serious(output)] == []
    page.set_viewport_size({"width": 1280, "height": 1000})
    notebook.theme("light")

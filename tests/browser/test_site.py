"""The site in a browser: both themes, phone, tablet and desk, and nothing from elsewhere."""

import functools
import http.server
import os
import re
import subprocess
import threading
from pathlib import Path

import pytest

from browser.accessibility import serious

pytestmark = pytest.mark.timeout(400)

ROOT = Path(__file__).parents[2]
WIDTHS = (375, 768, 1440)
#: The tests that share the pages: one alone would take minutes.
PARTS = 4
#: The links and controls that the keyboard does not reach.
NOT_REACHED = """() => [...document.querySelectorAll('main a[href], main button, main summary')]
    .filter(one => one.checkVisibility() && one.tabIndex < 0)
    .map(one => one.outerHTML.slice(0, 120))"""
#: Opens what is folded: it has to read as well as the rest.
OPEN = "document.querySelectorAll('main details').forEach(box => { box.open = true })"
#: Waits until the window has its width and is drawn, and what watches its size has been told.
DRAWN = """async width => {
    const frame = () => new Promise(requestAnimationFrame);
    while (innerWidth !== width) await frame();
    await frame();
    await frame();
}"""
#: The pictures that did not load.
BROKEN = """() => [...document.images]
    .filter(one => one.checkVisibility() && one.complete && !one.naturalWidth)
    .map(one => one.src.slice(0, 120))"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves files without a line for each."""

    def log_message(self, *_):
        """Say nothing."""


@pytest.fixture(scope="module")
def site(tmp_path_factory, chromium):
    """The folder of a site built by the command, and the address that serves it."""
    folder = tmp_path_factory.mktemp("site")
    command = [ROOT / "environment" / "course", "site", folder]
    made = subprocess.run(command, capture_output=True, text=True, env=os.environ, timeout=300)
    assert made.returncode == 0, made.stdout + made.stderr
    handler = functools.partial(Quiet, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield folder, f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


@pytest.fixture(params=["light", "dark"])
def tab(chromium, site, request):
    """A tab in one theme, in which nothing may be fetched from elsewhere or go wrong unseen."""
    context = chromium.new_context(color_scheme=request.param)
    made = context.new_page()
    wrong = []
    made.on("pageerror", lambda error: wrong.append(str(error)))
    made.on(
        "console",
        lambda line: wrong.append(line.text) if line.type in ("error", "warning") else None,
    )
    own = (site[1], "data:", "blob:")
    made.on("request", lambda sent: None if sent.url.startswith(own) else wrong.append(sent.url))
    yield made
    context.close()
    assert wrong == []


def test_the_rules_see_a_picture_without_words(tab):
    tab.set_content("<main><h1>One</h1><img src='data:,'></main>")
    assert any("image-alt" in line for line in serious(tab.locator("html")))


@pytest.mark.parametrize("part", range(PARTS))
def test_every_page_reads_well_at_every_width(site, tab, part):
    folder, address = site
    names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.html"))
    pages = [name for name in names if not name.startswith("_static/")]
    assert len(pages) > 30
    for name in pages[part::PARTS]:
        tab.goto(address + name)
        tab.evaluate(OPEN)
        for width in WIDTHS:
            tab.set_viewport_size({"width": width, "height": 900})
            tab.evaluate(DRAWN, width)
            assert tab.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
            if width in (WIDTHS[0], WIDTHS[-1]):
                assert serious(tab.locator("html")) == [], (name, width)
        assert tab.evaluate(NOT_REACHED) == [], name
        assert tab.evaluate(BROKEN) == [], name


def test_answers_are_folded_until_somebody_asks(site, tab):
    tab.goto(site[1] + "notebooks/03_write_a_publisher.html")
    blank, answer = tab.locator("pre", has_text="class HumiditySensor").all()
    assert blank.is_visible()
    assert "____" in blank.inner_text()
    assert not answer.is_visible()
    box = tab.locator("details", has_text="class HumiditySensor")
    assert box.locator("summary").inner_text() == "The answer to exercise 03a"
    box.locator("summary").press("Enter")
    assert answer.is_visible()
    assert "____" not in answer.inner_text()


def test_whoever_reads_can_choose_before_the_answer_is_shown(site, tab):
    tab.goto(site[1] + "notebooks/00_hear_the_heartbeat.html")
    choices = tab.locator(".quiz ol").first
    assert choices.locator("li").count() == 3
    assert choices.is_visible()
    reason = tab.get_by_text("If both match, messages flow")
    assert not reason.is_visible()
    tab.get_by_text("The answer to question 00.1").click()
    assert reason.is_visible()


def test_a_prediction_is_made_before_one_sees_what_happened(site, tab):
    tab.goto(site[1] + "notebooks/04_write_a_subscriber.html")
    assert tab.locator("pre", has_text='predict("____"').first.is_visible()
    texts = ("It was 10.", "Ten. In the picture of the queue")
    queue = tab.locator("img[alt^='The queue'], pre:has-text('viz.queue(')").first
    hidden = [*(tab.get_by_text(text) for text in texts), queue]
    assert [part.is_visible() for part in hidden] == [False] * 3
    tab.locator("details", has=hidden[0]).locator("summary").click()
    assert [part.is_visible() for part in hidden] == [True] * 3


def test_the_numbers_of_the_pages_lead_through_the_course(site, tab):
    tab.set_viewport_size({"width": 1440, "height": 900})
    tab.goto(site[1] + "notebooks/03_write_a_publisher.html")
    listed = tab.locator("#pst-primary-sidebar nav a").all_inner_texts()
    numbered = [name[:3] for name in listed if name[:1].isdigit()]
    assert numbered == [f"{number:02} " for number in range(14)]
    # One row, and nothing that lies over the text.
    assert tab.locator("main a", has_text="02 Create a package").count() == 1
    assert tab.locator("main a", has_text="04 Write a subscriber").count() == 1
    assert tab.locator("#pst-back-to-top").count() == 0


@pytest.mark.parametrize(
    ("page", "text", "colored"),
    [
        ("02_create_a_package", "%%save src/sensor_simulator/package.xml", "<license>"),
        ("03_write_a_publisher", "%%save src/sensor_simulator/", "import"),
        ("01_create_a_workspace", "echo $ROS2_WORKSPACE", "echo"),
        ("03_write_a_publisher", "class HumiditySensor", "class"),
    ],
)
def test_a_cell_has_the_colors_of_its_language(site, tab, page, text, colored):
    tab.goto(f"{site[1]}notebooks/{page}.html")
    code = tab.locator("pre", has_text=text).first
    plain = code.evaluate("one => getComputedStyle(one).color")
    colors = {
        part.inner_text(): part.evaluate("one => getComputedStyle(one).color")
        for part in code.locator("span").all()
    }
    assert colors[colored] != plain


@pytest.mark.parametrize(
    ("page", "wide"),
    [
        ("notebooks/00_hear_the_heartbeat", "figure.rosbeat-picture"),
        ("notebooks/10_find_the_fault", ".pst-scrollable-table-container"),
        ("docs/architecture", "p:has(> img)"),
    ],
)
def test_what_is_wider_than_a_phone_says_that_it_scrolls(site, tab, page, wide):
    tab.set_viewport_size({"width": 390, "height": 900})
    tab.goto(f"{site[1]}{page}.html")
    box = tab.locator(f"{wide}.goes-on").first
    box.wait_for()
    faded = "one => getComputedStyle(one).maskImage !== 'none'"
    assert box.evaluate(faded)
    place = tab.locator(wide).first
    if wide != ".pst-scrollable-table-container":
        words = place.evaluate("one => getComputedStyle(one, '::before').content")
        assert "Scroll the picture sideways" in words
    place.evaluate("one => one.scrollTo(one.scrollWidth, 0)")
    tab.wait_for_function("one => !one.classList.contains('goes-on')", arg=place.element_handle())
    assert not place.evaluate(faded)
    tab.set_viewport_size({"width": 1440, "height": 900})
    tab.wait_for_function("one => !one.classList.contains('scrolls')", arg=place.element_handle())
    assert place.evaluate("one => one.tabIndex") < 0


def test_a_term_says_what_it_means_when_one_points_at_it(site, tab):
    tab.goto(site[1] + "notebooks/03_write_a_publisher.html")
    said = tab.locator("a", has_text="random walk").first.get_attribute("title")
    glossary = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    assert " ".join(glossary.partition("## random walk")[2].split()).startswith(said)


#: What is wider than its place on paper, and would be cut off.
CUT = """() => [...document.querySelectorAll('#cheat-sheet pre, #cheat-sheet table')]
    .filter(one => one.scrollWidth > one.clientWidth + 1)
    .map(one => one.outerHTML.slice(0, 120))"""


@pytest.mark.parametrize("paper", ["A4", "Letter"])
def test_the_cheat_sheet_is_one_sheet_of_paper(site, tab, paper):
    tab.goto(site[1] + "docs/cheat_sheet.html")
    printed = tab.pdf(format=paper, prefer_css_page_size=True)
    assert len(re.findall(rb"/Type /Page\b", printed)) == 1
    tab.emulate_media(media="print")
    tab.set_viewport_size({"width": 995, "height": 755})  # of Letter, which is the narrower one
    assert tab.evaluate(CUT) == []


def test_words_are_found(site, tab):
    tab.goto(site[1] + "search.html?q=hysteresis")
    first = tab.locator("ul.search li").first
    first.wait_for()
    assert "ysteresis" in first.inner_text()

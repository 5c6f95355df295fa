"""The site in a browser: both themes, phone, tablet and desk, and nothing from elsewhere."""

import functools
import http.server
import os
import subprocess
import threading
from pathlib import Path

import pytest

from browser.accessibility import serious

pytestmark = pytest.mark.timeout(400)

ROOT = Path(__file__).parents[2]
WIDTHS = (375, 768, 1440)
#: The links and controls that the keyboard does not reach.
NOT_REACHED = """() => [...document.querySelectorAll('main a[href], main button, main summary')]
    .filter(one => one.checkVisibility() && one.tabIndex < 0)
    .map(one => one.outerHTML.slice(0, 120))"""
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


def test_every_page_reads_well_at_every_width(site, tab):
    folder, address = site
    names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.html"))
    assert len(names) > 30
    for name in names:
        if name.startswith("_static/"):
            continue
        for width in WIDTHS:
            tab.set_viewport_size({"width": width, "height": 900})
            tab.goto(address + name)
            assert tab.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
            assert serious(tab.locator("html")) == [], (name, width)
        assert tab.evaluate(NOT_REACHED) == [], name
        assert tab.evaluate(BROKEN) == [], name


def test_answers_are_folded_until_somebody_asks(site, tab):
    tab.goto(site[1] + "notebooks/03_write_a_publisher.html")
    answer = tab.locator("pre", has_text="class HumiditySensor")
    assert not answer.is_visible()
    tab.locator("details", has=answer).locator("summary").press("Enter")
    assert answer.is_visible()


def test_a_term_says_what_it_means_when_one_points_at_it(site, tab):
    tab.goto(site[1] + "notebooks/03_write_a_publisher.html")
    said = tab.locator("a", has_text="random walk").first.get_attribute("title")
    glossary = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    assert " ".join(glossary.partition("## random walk")[2].split()).startswith(said)


def test_words_are_found(site, tab):
    tab.goto(site[1] + "search.html?q=hysteresis")
    first = tab.locator("ul.search li").first
    first.wait_for()
    assert "ysteresis" in first.inner_text()

"""A browser and a JupyterLab for the tests of this folder.

They need a Chromium on the machine, and some minutes, so they run only when they are named:
`./environment/course test tests/browser`.
"""

from pathlib import Path

import pytest

from browser.lab import lab_server
from browser.notebook import PATIENCE, browser_path

HERE = Path(__file__).parent


def pytest_ignore_collect(collection_path, config):
    """Leave the folder out unless somebody names it."""
    named = [Path(argument.split("::")[0]).resolve() for argument in config.args]
    is_meant = any(path == HERE or HERE in path.parents for path in named)
    return None if is_meant else True


@pytest.fixture(scope="session")
def browser():
    """The path of the browser."""
    return browser_path() or pytest.skip(
        "no Chromium on this machine; ROSBEAT_BROWSER may name one"
    )


@pytest.fixture(scope="session")
def lab(browser, tmp_path_factory):
    folder = tmp_path_factory.mktemp("lab")
    root = folder / "pages"
    root.mkdir()
    with lab_server(folder, root) as server:
        yield server


@pytest.fixture(scope="session")
def chromium(browser):
    """Start the browser of all tests: playwright runs once in a process."""
    from playwright.sync_api import expect, sync_playwright

    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as tools:
        options = ["--no-sandbox", "--disable-dev-shm-usage"]
        made = tools.chromium.launch(executable_path=browser, args=options)
        yield made
        made.close()


@pytest.fixture(scope="session")
def context(chromium, lab):
    """One for all tests: JupyterLab is large, and the browser keeps it."""
    made = chromium.new_context(viewport={"width": 1280, "height": 1000})
    made.set_default_timeout(PATIENCE)
    yield made
    made.close()


@pytest.fixture
def page(context):
    """A tab in which nothing may go wrong unseen."""
    made = context.new_page()
    errors = []
    made.on("pageerror", lambda error: errors.append(str(error)))
    yield made
    made.close()
    assert errors == []

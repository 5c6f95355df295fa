"""A notebook that is open in a browser, as a person sees it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import nbformat

#: Milliseconds of patience with what a click does, and with a whole page that runs.
PATIENCE, LONG_PATIENCE = 60_000, 240_000
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
#: Notes when a command of JupyterLab, the next one of this name, is done.
WATCH = """command => {
    const { commands } = window.jupyterapp;
    const done = () => { window.rosbeatDone = true; };
    const hear = (_, { id, result }) => {
        if (id !== command) return;
        commands.commandExecuted.disconnect(hear);
        Promise.resolve(result).then(done, done);
    };
    window.rosbeatDone = false;
    commands.commandExecuted.connect(hear);
}"""
#: What code cells have raised, from the notebook itself: number of the cell, and the error.
RAISED = """() => window.jupyterapp.shell.currentWidget.context.model.toJSON().cells
    .filter(cell => cell.cell_type === 'code')
    .flatMap((cell, number) => cell.outputs.filter(one => one.output_type === 'error')
        .map(one => [number, `${one.ename}: ${one.evalue}`]))"""
#: The outputs of a code cell, as they would be saved.
OUTPUTS = """n => window.jupyterapp.shell.currentWidget.context.model.toJSON().cells
    .filter(cell => cell.cell_type === 'code')[n].outputs"""
#: The notebook in front.
SHOWN = ".jp-NotebookPanel:not(.lm-mod-hidden)"
#: Whether every cell is on the page; JupyterLab adds those of a long notebook bit by bit.
DRAWN = """() => {
    const { content } = window.jupyterapp.shell.currentWidget;
    const all = (what) => [...content.node.querySelectorAll(what)];
    return content.model.cells.length === all('.jp-Cell').length
        && all('.jp-CodeCell').every(cell => cell.querySelector('.cm-content'))
        && all('.jp-MarkdownCell').every(cell => cell.querySelector('.jp-RenderedMarkdown > *'))
        && all('img').every(one => one.complete);
}"""


def browser_path():
    """The browser to use: `ROSBEAT_BROWSER`, or one that is installed; None if there is none."""
    named = os.environ.get("ROSBEAT_BROWSER")
    return named or next(filter(None, map(shutil.which, BROWSERS)), None)


def write_notebook(path: Path, *sources: str):
    """A notebook of code cells, not run yet."""
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    spec = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": spec}), path)


class Notebook:
    """The notebook in front.

    Args:
        page: Playwright's page.
        lab: The server.
        name: Path of the notebook below the server's folder.
    """

    def __init__(self, page, lab, name):
        self.page, self.name = page, name
        page.goto(f"{lab.url}lab/workspaces/{Path(name).stem}/tree/{name}?reset")
        page.wait_for_selector(f"{SHOWN} .jp-Cell", timeout=PATIENCE)
        self._wait_for_idle()

    def run_all(self):
        """Click Run, Run All Cells, and wait until the last one has run."""
        self._finish("notebook:run-all-cells", lambda: self._menu("Run", "Run All Cells"))

    def run(self, cell):
        """Run one cell, as Shift-Enter does, and wait for it."""
        self._finish("notebook:run-cell", lambda: self.start(cell))

    def start(self, cell):
        """Run one cell and do not wait."""
        self.cell(cell).locator(".cm-content").click()
        self.page.keyboard.press("Control+Enter")

    def cell(self, number):
        """A code cell, counted from 0."""
        found = self.page.locator(".jp-Notebook .jp-CodeCell").nth(number)
        found.scroll_into_view_if_needed(timeout=PATIENCE)
        return found

    def write(self, number, text):
        """Type over what is in a cell."""
        self.cell(number).locator(".cm-content").click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(text)

    def output(self, number):
        """The text of a cell's output."""
        return self.cell(number).locator(".jp-OutputArea-output").first.text_content()

    def stored(self, number):
        """The outputs of a cell, as they would be saved."""
        return self.page.evaluate(OUTPUTS, number)

    def says(self, number, text):
        """Wait until a text is in a cell's output."""
        from playwright.sync_api import TimeoutError as Late

        output = self.cell(number).locator(".jp-OutputArea", has_text=text)
        try:
            output.wait_for(state="attached", timeout=PATIENCE)
        except Late:
            said = self.cell(number).inner_text()
            raise AssertionError(f"cell {number} does not say {text!r}, but: {said}") from None

    def _finish(self, command, act):
        """Start a command of JupyterLab as a person does, and wait until it is done.

        The prompts alone do not tell: some time passes between a click and the first `[*]`.
        """
        self.page.evaluate(WATCH, command)
        act()
        self.page.wait_for_function("() => window.rosbeatDone", timeout=LONG_PATIENCE)
        self._wait_for_idle()

    def _wait_for_idle(self):
        # The prompt is [*] while a cell waits or runs; the status bar says what the kernel does.
        self.page.wait_for_function(
            """() => {
                const prompts = [...document.querySelectorAll('.jp-InputPrompt')];
                const status = document.querySelector('#jp-bottom-panel')?.innerText || '';
                return prompts.length && !prompts.some((one) => one.innerText.includes('[*]'))
                    && status.includes('| Idle');
            }""",
            timeout=LONG_PATIENCE,
        )

    def errors(self):
        """What code cells have raised: number of the cell, and the error."""
        return dict(self.page.evaluate(RAISED))

    def interrupt(self):
        """Interrupt the kernel, and wait until it is idle."""
        self._do("notebook:interrupt-kernel")
        self._wait_for_idle()

    def restart(self):
        """Restart the kernel, and wait until it answers."""
        self.page.evaluate(
            "() => window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.restart()"
        )
        self._wait_for_idle()

    def start_kernel(self):
        """Start a kernel for a page that has none, and wait until it answers."""
        self.page.evaluate(
            "() => window.jupyterapp.shell.currentWidget.sessionContext"
            ".changeKernel({ name: 'python3' })"
        )
        self._wait_for_idle()

    def save(self):
        """Save, and wait until it is saved."""
        self._do("docmanager:save")
        self.page.wait_for_function("() => !document.querySelector('.jp-mod-dirty')")

    def theme(self, name):
        """Choose a theme, `light` or `dark`."""
        self._do("apputils:change-theme", theme=f"JupyterLab {name.title()}")
        wanted = "true" if name == "light" else "false"
        self.page.wait_for_selector(f"body[data-jp-theme-light='{wanted}']", state="attached")
        # While it fades out, another change would make JupyterLab remove it twice.
        self.page.wait_for_selector("#jupyterlab-splash", state="detached")

    def wait_until_drawn(self):
        """Wait until all cells and pictures are on the page; it has to fit on the screen."""
        self.page.wait_for_function(DRAWN, timeout=PATIENCE)

    def picture(self, name, element, folder):
        """Save a picture of an element; return its path."""
        target = Path(os.environ.get("ROSBEAT_SCREENSHOTS") or folder)
        target.mkdir(parents=True, exist_ok=True)
        path = target / f"{name}.png"
        element.screenshot(path=str(path))
        return path

    def shut_down(self):
        """End the kernel, so that the next test has the machine for itself."""
        request = self.page.request
        base = self.page.url.split("/lab")[0]
        for session in request.get(f"{base}/api/sessions").json():
            request.delete(f"{base}/api/sessions/{session['id']}")

    def _do(self, command, **arguments):
        """Run one of JupyterLab's commands, as a menu does."""
        self.page.evaluate(
            "([command, given]) => window.jupyterapp.commands.execute(command, given)",
            [command, arguments],
        )

    def _menu(self, menu, item):
        self.page.get_by_role("menuitem", name=menu, exact=True).click()
        self.page.get_by_role("menuitem", name=item, exact=True).click()

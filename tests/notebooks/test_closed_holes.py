"""Each hole of nbval that is closed, seen closed: one small notebook per hole, one pytest run."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

ROOT = Path(__file__).parents[2]
RAISES = {"tags": ["raises-exception"]}
THREAD = "import threading; t = threading.Thread(target=lambda: 1 / 0); t.start(); t.join()"


def code(source, *outputs, metadata=None, count=1):
    return new_code_cell(
        source, outputs=list(outputs), metadata=metadata or {}, execution_count=count
    )


def printed(text, name="stdout"):
    return new_output("stream", name=name, text=text)


def shown(**data):
    mimes = {"html": "text/html", "plain": "text/plain", "png": "image/png"}
    return new_output("display_data", {mimes[key]: value for key, value in data.items()})


HTML = "from IPython.display import display, HTML\n"
PICTURE = '<img src="data:image/png;base64,{}" alt="two nodes">'
BUNDLE = "display({{'text/html': {!r}, 'text/plain': {!r}}}, raw=True)"

LATE = """import threading, time
def die():
    time.sleep(0.1)
    1 / 0
threading.Thread(target=die).start()"""
TRANSPORT = """import json, ipykernel
print(json.load(open(ipykernel.get_connection_file()))["transport"])"""
ABORT = "import atexit, os, signal; _ = atexit.register(os.kill, os.getpid(), signal.SIGABRT)"

# Cells that share a page cost one kernel; a page of its own is for what ends or outlives a cell.
PAGES = {
    "solutions/fine": {
        "logs": code("import os; _ = os.write(2, b'from C\\n')", printed("from C\n", "stderr")),
        "semicolon": code("1 + 1;"),
        "transport": code(TRANSPORT, printed("ipc\n")),
        "interpreter": code("import sys; print(sys.executable)", printed(sys.executable + "\n")),
        "pixels": code(
            HTML + BUNDLE.format(PICTURE.format("AAAA"), "two nodes"),
            shown(html=PICTURE.format("BBBB"), plain="two nodes"),
        ),
    },
    "solutions/wrong": {
        "expected": code("print(1)", printed("1\n"), metadata=RAISES),
        "clear": code("from IPython.display import clear_output; clear_output()"),
        "differs": code("print(1)", printed("2\n")),
        "description": code(
            HTML + BUNDLE.format(PICTURE.format("AAAA"), "two nodes"),
            shown(html=PICTURE.format("AAAA"), plain="one node"),
        ),
        "no_picture": code(
            HTML + "display({'text/plain': 'two nodes'}, raw=True)",
            shown(html=PICTURE.format("AAAA"), plain="two nodes"),
        ),
    },
    "solutions/dies": {"dies": code("import os; os._exit(3)"), "after": code("print(1)")},
    "solutions/late": {"late": code(LATE), "after": code("time.sleep(0.5)")},
    "solutions/slow": {"slow": code("import time; time.sleep(60)")},
    "solutions/aborts": {"aborts": code(ABORT), "after": code("print(1)", printed("1\n"))},
    "solutions/stripped": {"stripped": code("print(1)", count=None)},
    "notebooks/lax": {
        "differs": code("print(1)", printed("2\n")),
        "stripped": code("print(1)", count=None),
        "raises": code("1 / 0", count=None),
        "magic": code("%alias_magic", count=None),
        "thread": code(THREAD, count=None),
        "still_alive": code("print(1)", count=None),
    },
}
CELLS = {
    f"{page}:{name}": (f"{page}.ipynb", f"Cell {number}")
    for page, cells in PAGES.items()
    for number, name in enumerate(cells)
}


@dataclass(frozen=True)
class Run:
    """What a pytest run said: messages of failures by page and item, and what passed."""

    failures: dict[tuple[str, str], str]
    passed: set[tuple[str, str]]

    def failure(self, cell):
        return self.failures[CELLS[cell]]


GOLDEN = ROOT / "tests" / "golden"
BUILT = "00_hear_a_pulse"


def write_built_page(root):
    """A page of a lesson, in which only a number differs that nbval does not look at."""
    (root / "src" / "lessons").mkdir(parents=True)
    shutil.copy(GOLDEN / "src" / "lessons" / f"{BUILT}.py", root / "src" / "lessons")
    page = nbformat.read(GOLDEN / "solutions" / f"{BUILT}.ipynb", as_version=4)
    next(cell for cell in page.cells if cell.cell_type == "code").execution_count = 7
    nbformat.write(page, root / "solutions" / f"{BUILT}.ipynb")


def write_pages(root):
    for name, cells in PAGES.items():
        path = root / f"{name}.ipynb"
        path.parent.mkdir(exist_ok=True)
        nbformat.write(new_notebook(cells=list(cells.values())), path)


def run_pytest(root, *options):
    report = root / "report.xml"
    plain = {k: v for k, v in os.environ.items() if not k.startswith(("PYTEST", "COV"))}
    paths = [str(ROOT / "tests"), str(ROOT / "src"), plain.get("PYTHONPATH", "")]
    subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "notebooks.plugin", "-p", "no:cacheprovider",
         "-W", "error", "--rootdir", root, f"--junitxml={report}", "-o", "addopts=", *options],
        cwd=root, env=plain | {"PYTHONPATH": os.pathsep.join(paths)}, check=False,
        capture_output=True, timeout=100,
    )  # fmt: skip
    return read_report(report)


def read_report(report):
    failures, passed = {}, set()
    for case in ElementTree.parse(report).iter("testcase"):
        key = (case.get("classname").replace(".ipynb", "").replace(".", "/") + ".ipynb",
               case.get("name"))  # fmt: skip
        texts = [child.text or "" for child in case if child.tag in ("failure", "error")]
        if texts:
            failures[key] = "\n".join(texts)
        elif not list(case.iter("skipped")):
            passed.add(key)
    return Run(failures, passed)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    root = tmp_path_factory.mktemp("course")
    write_pages(root)
    write_built_page(root)
    (root / "pytest.ini").write_text("[pytest]\ntestpaths = tests\n")
    return run_pytest(root, "--nbval-cell-timeout=6", "solutions", "notebooks")


@pytest.mark.parametrize("cell", [cell for cell in CELLS if "/fine:" in cell])
def test_logs_of_c_code_and_other_ordinary_things_pass(run, cell):
    assert CELLS[cell] in run.passed


@pytest.mark.parametrize(
    ("cell", "message"),
    [
        ("solutions/dies:dies", "The kernel died in this cell"),
        ("solutions/slow:slow", "Timeout of 6 seconds"),
        ("solutions/wrong:expected", "raised none"),
        ("solutions/wrong:clear", "clear_output"),
        ("solutions/wrong:differs", "Cell outputs differ"),
        ("solutions/wrong:description", "one node"),
        ("solutions/wrong:no_picture", "picture"),
        ("notebooks/lax:raises", "ZeroDivisionError"),
        ("notebooks/lax:magic", "error without a message"),
        ("notebooks/lax:thread", "An exception in the background"),
    ],
)
def test_what_goes_wrong_is_seen(run, cell, message):
    assert message in run.failure(cell)


def test_an_exception_in_a_thread_that_outlives_its_cell_is_seen(run):
    texts = [text for (page, _), text in run.failures.items() if "late" in page]
    assert any("in the background" in text for text in texts)


def test_a_page_without_outputs_is_refused_under_strict_mode(run):
    text = run.failures["solutions/stripped.ipynb", "stored outputs"]
    assert "Nothing can be compared" in text


def test_what_only_a_build_compares_is_seen(run):
    text = run.failures[f"solutions/{BUILT}.ipynb", "as it is built"]
    assert '-   "execution_count": 7' in text


def test_a_kernel_that_aborts_at_exit_is_seen(run):
    assert "code -6" in run.failures["solutions/aborts.ipynb", "end of the page"]


@pytest.mark.parametrize("cell", ["differs", "stripped", "still_alive"])
def test_notebooks_are_lax_in_the_same_run(run, cell):
    assert CELLS[f"notebooks/lax:{cell}"] in run.passed

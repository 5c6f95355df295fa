"""Progress: a standing, the file that remembers it, and how it is shown."""

import json
import shutil
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import asdict, replace
from pathlib import Path
from queue import Empty
from types import SimpleNamespace

import IPython
import nbformat
import pytest
from nbformat.sign import NotebookNotary

from notebooks.kernel import WatchedKernel
from parsed_html import Shown
from rosbeat import cli, progress
from rosbeat.exercises import progress as file
from rosbeat.exercises.exercise import failed, passed
from rosbeat.exercises.progress import (
    ProgressFile,
    Standing,
    progress_file,
)
from rosbeat.exercises.registry import EXERCISES, PAGES
from rosbeat.workspace import location


def after(*outcomes):
    standing = Standing()
    for outcome in outcomes:
        standing = standing.after(outcome)
    return standing


def test_attempts_are_counted_and_the_last_mistake_is_kept():
    standing = after(failed("03a", "", "", "depth-missing"), failed("03a", "", "", "wrong-rate"))
    assert (standing.attempts, standing.status, standing.mistake) == (2, "failed", "wrong-rate")


# The file.


PASSED = Standing("passed", True, 2, 1)


def one_more(standing):
    return replace(standing, attempts=standing.attempts + 1)


@pytest.fixture
def told():
    return []


@pytest.fixture
def folder(tmp_path):
    return tmp_path / ".rosbeat"


@pytest.fixture
def remembered(folder, told):
    return ProgressFile(folder, told.append)


def test_what_is_changed_is_there_for_the_next_kernel(remembered, folder, told):
    assert remembered.change("03a", lambda before: PASSED) == PASSED
    remembered.change("00a", one_more)
    again = ProgressFile(folder).standings()
    assert again == {"00a": Standing(attempts=1), "03a": PASSED}
    assert told == []


def test_git_and_colcon_leave_the_folder_alone(remembered, folder):
    remembered.change("03a", one_more)
    assert (folder / ".gitignore").read_text() == "*\n"
    assert (folder / "COLCON_IGNORE").exists()
    subprocess.run(["git", "init", "-q", str(folder.parent)], check=True)
    command = ["git", "-C", str(folder.parent), "status", "--porcelain"]
    assert subprocess.run(command, capture_output=True, check=True).stdout == b""


def test_the_file_names_no_time(remembered):
    remembered.change("03a", lambda before: PASSED)
    first = remembered.path.read_bytes()
    remembered.path.unlink()
    remembered.change("03a", lambda before: PASSED)
    assert remembered.path.read_bytes() == first
    assert first.decode() == (
        '{\n "version": 2,\n "exercises": {\n  "03a": {\n   "outcome": "passed",\n'
        '   "passed": true,\n   "points": 2,\n   "attempts": 1,\n   "hints": 0,\n'
        '   "answer": false,\n   "mistake": "",\n   "lead": ""\n  }\n }\n}\n'
    )


DAMAGED = [
    *(
        b"",
        b"[]",
        b"\xff\xfe",
        b'{"version": 2}',
        b'{"version": 3, "exercises": {}}',
        b"[" * 100_000,
    ),
    *(
        f'{{"version": 2, "exercises": {{"03a": {standing}}}}}'.encode()
        for standing in ('{"points": -1}', '{"passed": 1}', '{"mistake": null}', "[]")
    ),
]


def test_what_another_version_has_added_or_left_out_disturbs_nothing(remembered, folder, told):
    folder.mkdir()
    standing = '{"passed": true, "points": 2, "colour": "blue"}'
    remembered.path.write_text(f'{{"exercises": {{"03a": {standing}, "00a": {{}}}}, "version": 1}}')
    assert remembered.standings() == {"03a": Standing(passed=True, points=2), "00a": Standing()}
    assert told == []


@pytest.mark.parametrize("content", DAMAGED)
def test_a_damaged_file_is_kept_aside_and_a_new_one_begun(remembered, folder, told, content):
    folder.mkdir()
    remembered.path.write_bytes(content)
    assert dict(remembered.standings()) == {}
    assert remembered.path.read_bytes() == content  # reading moves nothing
    remembered.change("03a", one_more)
    remembered.change("03a", one_more)
    assert (folder / "progress-unreadable.json").read_bytes() == content
    assert remembered.standings() == {"03a": Standing(attempts=2)}
    assert len(told) == 1
    assert ".rosbeat/progress-unreadable.json" in told[0]


@pytest.mark.parametrize("stands_there", ["a file", "a folder"])
def test_where_nothing_can_be_written_it_is_said_once_and_remembered(
    remembered, folder, told, stands_there
):
    if stands_there == "a file":
        folder.write_text("mine")
    else:
        remembered.path.mkdir(parents=True)
    for _ in range(3):
        remembered.change("03a", one_more)
    remembered.change("03b", one_more)
    assert remembered.standings() == {"03a": Standing(attempts=3), "03b": Standing(attempts=1)}
    assert len(told) == 1
    assert "cannot be saved" in told[0]


KERNEL = """
import sys
from dataclasses import replace
from pathlib import Path
from rosbeat.exercises.progress import ProgressFile
file = ProgressFile(Path(sys.argv[1]))
for number in range(15):
    file.change(sys.argv[2], lambda one: replace(one, attempts=one.attempts + 1))
    file.change("both", lambda one: replace(one, hints=one.hints + 1))
"""


def test_kernels_that_write_at_once_lose_nothing(folder):
    command = [sys.executable, "-c", KERNEL, str(folder)]
    kernels = [subprocess.Popen([*command, name]) for name in ("00a", "00b")]
    assert [kernel.wait(timeout=100) for kernel in kernels] == [0, 0]
    found = ProgressFile(folder).standings()
    assert found.pop("both").hints == 30
    assert found == {name: Standing(attempts=15) for name in ("00a", "00b")}
    assert {path.name for path in folder.iterdir()} == {
        *(".gitignore", "COLCON_IGNORE", "progress.json")
    }


def test_the_folder_lies_beside_the_workspace(tmp_path, monkeypatch):
    monkeypatch.delenv("ROSBEAT_PROGRESS_IN")
    monkeypatch.setenv("ROSBEAT_WORKSPACE_IN", str(tmp_path))
    assert file.progress_file().path == tmp_path / ".rosbeat" / "progress.json"
    assert file.progress_file() is file.progress_file()
    monkeypatch.setenv("ROSBEAT_PROGRESS_IN", str(tmp_path / "other"))
    assert file.progress_file().path.parent == tmp_path / "other" / ".rosbeat"
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path / "home"))
    assert file.progress_file().path.parent == tmp_path / "home" / ".rosbeat"


# The list on a page.


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def open_page(home, tmp_path, monkeypatch):
    """Open a page by the name of its file, beside all others."""

    def open_one(name):
        for page in PAGES:
            (tmp_path / f"{page.lesson}.ipynb").touch()
        monkeypatch.setenv("JPY_SESSION_NAME", str(tmp_path / name))

    return open_one


def pass_all(*pages):
    for one in (one for page in PAGES if page.number in pages for one in page.exercises):
        right = replace(passed(""), points=one.points)
        progress_file().change(one.id, lambda before, right=right: before.after(right))


def shown():
    """The list as a page has it: tables by their captions, paragraphs, and links by their words."""
    return Shown(progress().html())


def test_a_page_shows_its_exercises_and_the_course_in_two_lines(open_page):
    open_page("03_write_a_publisher.ipynb")
    pass_all("00")
    progress_file().change("03a", lambda before: before.after(failed("03a", "", "")))
    found = shown()
    assert found.items == [
        f"✗ 03a {EXERCISES['03a'].title}: not there yet, 0 of 2 points",
        f"○ 03b {EXERCISES['03b'].title}: still open, 0 of 2 points",
        f"○ 03c {EXERCISES['03c'].title}: still open, 0 of 4 points",
    ]
    core, electives = found.paragraphs[-2:]
    assert core.startswith("Core pages: ✓ 00 2/2, 01 0/")
    assert "03 (this page) 0/3" in core
    assert core.endswith("06 0/2, the whole system 0/1.")
    assert electives.startswith("Electives: 07 0/")
    assert " 13 0/" in electives
    assert found.links["00"] == "00_hear_the_heartbeat.ipynb"
    assert found.links["the whole system"] == "06_build_source_run.ipynb"


def test_elsewhere_the_whole_course_is_shown_core_and_electives_apart(open_page):
    open_page("home.ipynb")
    pass_all("00")
    found = shown()
    core, electives = found.tables
    assert core.startswith("Core pages: 2 of ")
    assert electives.startswith("Electives: 0 of ")
    numbers = [[row[0].split()[0] for row in rows[1:]] for rows in found.tables.values()]
    listed = [one.number for one in PAGES if one.number]
    assert numbers == [[*listed[:7], "The"], listed[7:]]
    rows = dict(found.tables[core])
    assert rows["03 Write a publisher60 minutes, needs 00, 02"] == "○ 03a ○ 03b ○ 03c"
    assert "✓ passed, ✗ not there yet, ○ still open" in found.paragraphs
    assert rows["00 Hear the heartbeat35 minutes"] == "✓ 00a ✓ 00b"
    assert found.links["02"] == "02_create_a_package.ipynb"


@pytest.mark.parametrize(
    ("done", "here", "onward"),
    [
        ([], "home", "00 Hear the heartbeat"),
        (["00", "01"], "home", "02 Create a package"),
        (["01"], "01_create_a_workspace", "00 Hear the heartbeat"),
        (["00"], "01_create_a_workspace", "exercise 01a on this page"),
        ([page.number for page in PAGES if page.number], "home", "The whole system"),
        # The core is finished before the electives begin.
        (["00", "01", "02", "03", "04", "05", "06"], "home", "The whole system"),
        (["00", "01", "02", "03", "04", "05", "06", ""], "home", "07 Look inside the graph"),
    ],
)
def test_it_says_where_to_go_on(open_page, done, here, onward):
    open_page(f"{here}.ipynb")
    pass_all(*done)
    found = shown()
    assert found.paragraphs[0].endswith(f"Continue here: {onward}.")
    assert onward in found.links or "on this page" in onward


CORE = [one.id for page in PAGES if not page.elective for one in page.exercises]
ELECTIVES = [one.id for page in PAGES if page.elective for one in page.exercises]


@pytest.mark.parametrize(
    ("done", "said"),
    [
        ([], f"0 of {len(CORE)} exercises in the core."),
        (["00"], f"2 of {len(CORE)} exercises in the core."),
        # Electives are counted once one of them is passed, or the core is done.
        (
            ["00", "07"],
            f"2 of {len(CORE)} exercises in the core, 3 of {len(ELECTIVES)} in the electives.",
        ),
        (
            ["00", "01", "02", "03", "04", "05", "06", ""],
            f"{len(CORE)} of {len(CORE)} exercises in the core, 0 of {len(ELECTIVES)} in the "
            "electives.",
        ),
    ],
)
@pytest.mark.parametrize("here", ["home", "01_create_a_workspace"])
def test_the_core_is_counted_first(open_page, done, said, here):
    open_page(f"{here}.ipynb")
    pass_all(*done)
    assert shown().paragraphs[0].startswith(f"Your progress: {said} Continue here:")
    assert str(progress()).startswith(f"Your progress: {said}")


def test_the_list_is_shown_also_where_the_folder_of_the_kernel_is_gone(home, tmp_path, monkeypatch):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert len(shown().tables) == 2


KERNEL_CELLS = (
    "import os; del os.environ['ROSBEAT_STEADY_HOME']",
    "from rosbeat import progress; progress()",
)


@pytest.mark.ros
def test_a_list_changes_when_a_check_passes_in_another_kernel(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_PROGRESS_IN", str(tmp_path))
    kernel = WatchedKernel(str(tmp_path), 60)
    try:
        for cell in KERNEL_CELLS:
            kernel.await_reply(kernel.execute_cell_input(cell), 60)
        first = message(kernel, "display_data")
        assert "Still open: all." in first["data"]["text/plain"]
        assert "when this list was stored" in first["data"]["text/html"]
        view = message(kernel, "display_data")["data"]["application/vnd.jupyter.widget-view+json"]
        assert view["model_id"] == "rosbeat-progress"
        right = replace(passed(""), points=1)
        ProgressFile(tmp_path / ".rosbeat").change("00a", lambda before: before.after(right))
        second = message(kernel, "comm_msg")
        assert second["comm_id"] == view["model_id"]
        assert "✓ 00a" in second["data"]["state"]["html"]
    finally:
        kernel.stop()


def message(kernel, kind):
    """The content of the next message of a kind."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        with suppress(Empty):
            found = kernel.get_message("iopub", timeout=1)
            if found["msg_type"] == kind:
                return found["content"]
    raise AssertionError(f"no {kind} before the deadline")


# The table.


@pytest.fixture
def two_checked(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    file = progress_file()
    right = replace(passed(""), points=1)
    file.change("00a", lambda before: before.after(right))
    file.change("00b", lambda before: before.after(failed("00b", "", "", "wrong-rate")))
    file.change("00b", lambda before: replace(before, hints=2, answer=True))


def row(text, exercise):
    return next(line.split() for line in text.splitlines() if f" {exercise} " in line)


def test_the_table_has_every_page_every_exercise_and_the_total(two_checked, capsys):
    assert cli.main(["progress"]) == 0
    text = capsys.readouterr().out
    assert all(f"\n{page.heading}\n" in text for page in PAGES)
    assert {one for one in EXERCISES if f" {one} " in text} == set(EXERCISES)
    assert row(text, "00a")[0] == "✓"
    assert row(text, "00a")[-5:] == ["1", "of", "1", "1", "0"]
    assert row(text, "00b")[0] == "✗"
    assert "not there yet" in " ".join(row(text, "00b"))
    assert text.count("2 and the answer") == 1
    assert row(text, "01a")[0] == "○"
    core, electives = text.splitlines()[-2:]
    assert core.startswith(f"Core pages: 1 of {len(CORE)} exercises passed, 1 of ")
    assert electives.startswith(f"Electives: 0 of {len(ELECTIVES)} exercises passed, 0 of ")
    assert text.index("\nThe whole system\n") < text.index("\n07 ")


def test_the_same_as_json(two_checked, capsys):
    assert cli.main(["progress", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert (data["version"], data["passed"], data["points"]) == (1, 1, 1)
    assert [one["exercise"] for one in data["exercises"]] == list(EXERCISES)
    assert data["out_of"] == sum(one.points for one in EXERCISES.values())
    second = data["exercises"][1]
    assert (second["status"], second["mistake"], second["hints"]) == ("failed", "wrong-rate", 2)
    assert (second["page"], second["title"]) == ("00", EXERCISES["00b"].title)


# The course's home page.

HOME = Path(__file__).parents[3] / "notebooks" / "home.ipynb"


@pytest.fixture
def own_home(two_checked, tmp_path, monkeypatch):
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "data"))  # which pages are signed
    shutil.copy(HOME, tmp_path)
    return tmp_path / HOME.name


def stored(page):
    cells = [one for one in json.loads(page.read_bytes())["cells"] if one["cell_type"] == "code"]
    return [output["data"] for cell in cells for output in cell["outputs"]]


def test_the_home_page_is_brought_up_to_date_and_changed_nowhere_else(own_home, capsys):
    assert stored(own_home) == []
    assert cli.main(["progress", "--home", str(own_home)]) == 0
    data, view = stored(own_home)
    assert view["application/vnd.jupyter.widget-view+json"]["model_id"] == "rosbeat-progress"
    assert "Passed: 00a. Not there yet: 00b." in data["text/plain"]
    assert "✓ 00a" in data["text/html"]
    page = nbformat.read(own_home, as_version=4)
    nbformat.validate(page)
    for cell in page.cells:
        if cell.cell_type == "code":
            cell.update(outputs=[], execution_count=None)
    assert page == nbformat.read(HOME, as_version=4)
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("content", [None, b"", b'{"cells": []}'])
def test_what_is_no_home_page_is_left_alone(two_checked, tmp_path, content):
    page = tmp_path / "home.ipynb"
    if content is not None:
        page.write_bytes(content)
    assert cli.main(["progress", "--home", str(page)]) == 0
    assert (page.read_bytes() if page.exists() else None) == content


def test_a_page_that_nobody_has_run_has_the_list_and_any_other_stays(own_home):
    new, old = (own_home.parent / f"{one}_page.ipynb" for one in ("00", "01"))
    cells = [nbformat.v4.new_code_cell("1 + 1"), nbformat.v4.new_code_cell("progress()")]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), new)
    cells[0].outputs = [nbformat.v4.new_output("stream", text="2")]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), old)
    before = old.read_bytes()
    assert cli.main(["progress", "--home", str(own_home)]) == 0
    assert "✓ 00a" in stored(new)[0]["text/html"]
    assert "exercise 00b on this page" in stored(new)[0]["text/html"]
    assert old.read_bytes() == before
    assert NotebookNotary().check_signature(nbformat.read(new, as_version=4))
    assert not NotebookNotary().check_signature(nbformat.read(old, as_version=4))


# Which runs count.


def passes(exercise):
    progress_file().change(exercise, lambda before: before.after(passed("All is well.")))


def kept(course):
    """What another kernel reads from the learner's file."""
    return ProgressFile(course / "my_course" / ".rosbeat").standings()


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course in which this process is the kernel of a page."""
    monkeypatch.delenv("ROSBEAT_PROGRESS_IN")
    monkeypatch.setattr(location, "course_root", lambda: tmp_path)
    monkeypatch.setattr(location, "learners_folder", lambda: str(tmp_path / "my_course"))
    monkeypatch.setattr(IPython, "get_ipython", lambda: SimpleNamespace(kernel=object()))
    return tmp_path


@pytest.mark.parametrize(
    ("page", "counts"),
    [
        ("my_course/03_write_a_publisher.ipynb", True),
        ("my_course/solutions/03_write_a_publisher.ipynb", False),
        ("solutions/03_write_a_publisher.ipynb", False),
        ("elsewhere/solutions/03_write_a_publisher.ipynb", True),
    ],
)
@pytest.mark.parametrize("has_server", [True, False])
def test_a_learners_own_pages_count_and_solutions_do_not(
    course, monkeypatch, page, counts, has_server
):
    if has_server:
        monkeypatch.setenv("JPY_SESSION_NAME", str(course / page))
    else:  # an editor starts the kernel in the folder of the page
        monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
        (course / page).parent.mkdir(parents=True)
        monkeypatch.chdir((course / page).parent)
    passes("03a")
    assert (course / "my_course" / ".rosbeat" / "progress.json").exists() == counts
    assert ("03a" in kept(course)) == counts


def test_programs_and_tests_do_not_count(course, monkeypatch):
    monkeypatch.setattr(IPython, "get_ipython", lambda: None)
    passes("03a")
    assert dict(kept(course)) == {}


def test_a_page_that_does_not_count_still_knows_its_hints(course, monkeypatch):
    monkeypatch.setattr(IPython, "get_ipython", lambda: None)
    for number in (1, 2):
        progress_file().change("03a", lambda before: replace(before, hints=before.hints + 1))
        assert progress_file().standings()["03a"].hints == number
    assert dict(kept(course)) == {}


#: The exercises that version 1 of the file had in one, and their steps.
SPLIT = [("04c", ("04c", "04d", "04e")), ("12c", ("12c", "12d", "12e"))]


def stored_before(path, **standings):
    """Write a file as version 1 of its form."""
    path.parent.mkdir(exist_ok=True)
    text = {name: asdict(one) for name, one in standings.items()}
    path.write_text(json.dumps({"version": 1, "exercises": text}))


@pytest.mark.parametrize(("old", "steps"), SPLIT)
def test_a_pass_of_an_exercise_that_was_split_is_a_pass_of_each_step(remembered, told, old, steps):
    passed = Standing("passed", passed=True, points=4, attempts=3, hints=1)
    stored_before(remembered.path, **{"00a": PASSED, old: passed})
    remembered.change("03a", one_more)
    after = dict(remembered.standings())
    assert (after.pop("00a"), after.pop("03a")) == (PASSED, Standing(attempts=1))
    assert {name: one.points for name, one in after.items()} == {
        step: EXERCISES[step].points for step in steps
    }
    assert all(replace(one, points=4) == passed for one in after.values())
    assert sum(one.points for one in after.values()) == 4
    assert told == []


@pytest.mark.parametrize(("old", "steps"), SPLIT)
def test_attempts_of_an_exercise_that_was_split_are_attempts_of_its_last_step(
    remembered, old, steps
):
    failed = Standing("failed", attempts=2, hints=1, mistake="boundary")
    stored_before(remembered.path, **{old: replace(failed, lead="Look at the limits.")})
    assert remembered.standings() == {steps[-1]: failed}

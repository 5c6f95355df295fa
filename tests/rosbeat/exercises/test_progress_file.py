from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace

import pytest

from rosbeat.exercises import progress as file
from rosbeat.exercises.progress import ProgressFile, Standing

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
def progress(folder, told):
    return ProgressFile(folder, told.append)


def test_nothing_is_there_at_first_and_reading_makes_nothing(progress, folder):
    assert dict(progress.standings()) == {}
    assert not folder.exists()


def test_what_is_changed_is_there_for_the_next_kernel(progress, folder, told):
    assert progress.change("03a", lambda before: PASSED) == PASSED
    progress.change("00a", one_more)
    again = ProgressFile(folder).standings()
    assert again == {"00a": Standing(attempts=1), "03a": PASSED}
    assert told == []


def test_git_and_colcon_leave_the_folder_alone(progress, folder):
    progress.change("03a", one_more)
    assert (folder / ".gitignore").read_text() == "*\n"
    assert (folder / "COLCON_IGNORE").exists()
    subprocess.run(["git", "init", "-q", str(folder.parent)], check=True)
    command = ["git", "-C", str(folder.parent), "status", "--porcelain"]
    assert subprocess.run(command, capture_output=True, check=True).stdout == b""


def test_the_file_names_no_time(progress):
    progress.change("03a", lambda before: PASSED)
    first = progress.path.read_bytes()
    progress.path.unlink()
    progress.change("03a", lambda before: PASSED)
    assert progress.path.read_bytes() == first
    assert json.loads(first)["version"] == 1


DAMAGED = [
    b"", b"{", b"[]", b"null", b"\xff\xfe", b"{}", b'{"version": 1}', b'{"version": 2}',
    b'{"version": 1, "exercises": []}', b'{"version": 1, "exercises": {"03a": 3}}',
    b'{"version": 1, "exercises": {"03a": {"points": "two"}}}', b"[" * 100_000,
]  # fmt: skip


@pytest.mark.parametrize("content", DAMAGED)
def test_a_damaged_file_is_kept_aside_and_a_new_one_begun(progress, folder, told, content):
    folder.mkdir()
    progress.path.write_bytes(content)
    assert dict(progress.standings()) == {}
    assert progress.path.read_bytes() == content  # reading moves nothing
    progress.change("03a", one_more)
    progress.change("03a", one_more)
    assert (folder / "progress-unreadable-1.json").read_bytes() == content
    assert progress.standings() == {"03a": Standing(attempts=2)}
    assert len(told) == 1
    assert ".rosbeat/progress-unreadable-1.json" in told[0]


def test_what_was_kept_aside_is_never_replaced(progress, folder):
    for content in (b"one", b"two"):
        progress.change("03a", one_more)
        progress.path.write_bytes(content)
        progress.change("03a", one_more)
    kept = [(folder / f"progress-unreadable-{number}.json").read_bytes() for number in (1, 2)]
    assert kept == [b"one", b"two"]


@pytest.mark.parametrize("stands_there", ["a file", "a folder"])
def test_where_nothing_can_be_written_it_is_said_once_and_remembered(
    progress, folder, told, stands_there
):
    if stands_there == "a file":
        folder.write_text("mine")
    else:
        progress.path.mkdir(parents=True)
    for _ in range(3):
        progress.change("03a", one_more)
    progress.change("03b", one_more)
    assert progress.standings() == {"03a": Standing(attempts=3), "03b": Standing(attempts=1)}
    assert len(told) == 1
    assert "cannot be saved" in told[0]


def test_what_could_not_be_written_is_written_later(progress, folder):
    folder.write_text("mine")
    progress.change("03a", one_more)
    folder.unlink()
    progress.change("03b", one_more)
    expected = {"03a": Standing(attempts=1), "03b": Standing(attempts=1)}
    assert ProgressFile(folder).standings() == expected


KERNEL = """
import sys
from dataclasses import replace
from pathlib import Path
from rosbeat.exercises.progress import ProgressFile
file = ProgressFile(Path(sys.argv[1]))
for number in range(40):
    file.change(sys.argv[2], lambda one: replace(one, attempts=one.attempts + 1))
    file.change("both", lambda one: replace(one, hints=one.hints + 1))
"""


def test_kernels_that_write_at_once_lose_nothing(folder):
    command = [sys.executable, "-c", KERNEL, str(folder)]
    kernels = [subprocess.Popen([*command, name]) for name in ("00a", "00b", "00c")]
    assert [kernel.wait(timeout=100) for kernel in kernels] == [0, 0, 0]
    found = ProgressFile(folder).standings()
    assert found.pop("both").hints == 120
    assert found == {name: Standing(attempts=40) for name in ("00a", "00b", "00c")}
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

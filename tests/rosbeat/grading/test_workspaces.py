"""The workspace as a page finds it, as plain files."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading import workspaces as module
from rosbeat.grading.workspaces import files_before, read_workspace, workspace_line
from rosbeat.workspace.catching_up import Report


@pytest.fixture(autouse=True)
def _afresh():
    files_before.cache_clear()
    yield
    files_before.cache_clear()


def test_pages_before_leave_their_folders_and_files(monkeypatch):
    def made(page, root):
        (root / "src" / "deep").mkdir(parents=True)
        (root / "src" / "a.py").write_bytes(b"\xff\0")
        return Report(())

    monkeypatch.setattr(module, "catch_up", made)
    assert dict(files_before("05")) == {"src/": b"", "src/a.py": b"\xff\0", "src/deep/": b""}


def test_it_is_made_once(monkeypatch):
    calls = []

    def made(page, root):
        calls.append((page, root))
        return Report(())

    monkeypatch.setattr(module, "catch_up", made)
    assert files_before("05") is files_before("05")
    files_before("06")
    assert [page for page, _ in calls] == ["05", "06"]
    assert not any(root.exists() for _, root in calls)


def test_a_workspace_that_cannot_be_made_is_said(monkeypatch, says):
    monkeypatch.setattr(module, "catch_up", lambda *_: Report((), ("colcon is not there.",)))
    with pytest.raises(GradingError) as caught:
        files_before("05")
    says(caught.value, "page 05", "colcon is not there.")


def test_nobody_may_change_it(monkeypatch):
    monkeypatch.setattr(module, "catch_up", lambda *_: Report(()))
    with pytest.raises(TypeError):
        files_before("05")["a"] = b""


def test_page_01_begins_with_nothing_and_page_05_with_a_package():
    assert not any("setup.py" in name for name in files_before("01"))
    assert "src/sensor_simulator/setup.py" in files_before("05")


def test_a_workspace_is_one_line_and_comes_back(monkeypatch):
    def made(page, root):
        (root / "src").mkdir()
        (root / "src" / "a b.py").write_bytes(bytes(range(256)))
        return Report(())

    monkeypatch.setattr(module, "catch_up", made)
    line = workspace_line("05")
    assert "\n" not in line
    assert read_workspace(line) == ("05", {"src/": b"", "src/a b.py": bytes(range(256))})


@pytest.mark.parametrize("line", ["", "{}", '{"exercise": "03a"}', "[]", "x"])
def test_another_line_is_no_workspace(line):
    assert read_workspace(line) is None


def test_threads_that_want_the_same_wait_for_each_other(monkeypatch):
    calls = []

    def made(page, root):
        calls.append(page)
        time.sleep(0.05)
        return Report(())

    monkeypatch.setattr(module, "catch_up", made)
    with ThreadPoolExecutor(4) as threads:
        assert len(set(threads.map(workspace_line, ["05"] * 8))) == 1
    assert calls == ["05"]

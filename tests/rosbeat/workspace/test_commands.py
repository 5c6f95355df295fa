import sys

import pytest

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.commands import run_command, surroundings


@pytest.fixture
def programs(tmp_path, monkeypatch):
    """A place of our own for programs."""
    folder = tmp_path / "prefix" / "bin"
    folder.mkdir(parents=True)
    monkeypatch.setattr(sys, "prefix", str(folder.parent))

    def make(name, text):
        (folder / name).write_text(f"#!/bin/sh\n{text}\n")
        (folder / name).chmod(0o755)

    return make


def test_exit_code_and_everything_written(programs, tmp_path):
    programs("ros2", "echo out; echo err >&2; pwd; exit 3")
    assert run_command(["ros2"], tmp_path, 60) == (3, f"out\nerr\n{tmp_path}\n")


def test_one_that_is_not_installed(programs, tmp_path, says):
    with pytest.raises(WorkspaceError) as caught:
        run_command(["colcon", "build"], tmp_path, 60)
    says(caught.value, "colcon")


def test_one_that_does_not_end(programs, tmp_path, says):
    programs("colcon", "exec sleep 100")
    with pytest.raises(WorkspaceError) as caught:
        run_command(["colcon", "build"], tmp_path, 0.2)
    says(caught.value, "`colcon build`", "0.2 seconds")


def test_a_steady_run_names_no_person(tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    found = surroundings()
    assert (found["USER"], found["HOME"]) == ("you", str(tmp_path))
    monkeypatch.delenv("ROSBEAT_STEADY_HOME")
    monkeypatch.setenv("USER", "ann")
    assert surroundings()["USER"] == "ann"

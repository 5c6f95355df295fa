"""A workspace for each answer about files or a terminal."""

import pytest


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """Return the folder of a workspace that is not there yet, where a page would find it."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    return tmp_path / "ROS2_and_RL_Tutorials"

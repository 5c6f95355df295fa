"""A workspace for each answer about files or a terminal; one for all answers that are cells."""

import pytest

from bank.workspaces import EXERCISES

FOLDER = "ROS2_and_RL_Tutorials"


@pytest.fixture(scope="session")
def caught_up(tmp_path_factory):
    """Return a home whose workspace the first cell of a page completes, as on page 09."""
    return tmp_path_factory.mktemp("caught_up")


@pytest.fixture
def workspace(request, answer, caught_up, monkeypatch):
    """Return the folder of a workspace, where a page would find it.

    It is not there yet for answers about files and terminals. A cell only reads its workspace, so
    that cells share one: to make the package anew takes longer than to check most answers.
    """
    own = answer.exercise in EXERCISES
    home = request.getfixturevalue("tmp_path") if own else caught_up
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(home))
    return home / FOLDER

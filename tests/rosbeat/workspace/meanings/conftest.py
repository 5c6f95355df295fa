"""Asks for the meaning of a command, in the workspace of a test."""

import pytest

from rosbeat.workspace.meanings import explain


@pytest.fixture
def meaning(root):
    """What is said about a command; in the workspace itself if no folder is named."""

    def ask(command, output="", code=1, folder=None):
        return explain(command, output, code, folder or root, root)

    return ask

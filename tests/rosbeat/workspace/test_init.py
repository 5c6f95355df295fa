"""`from rosbeat import workspace` is light, and makes the commands of a page known."""

import subprocess
import sys

import pytest

import rosbeat
from rosbeat import workspace

IMPORTS = "import sys, rosbeat.workspace; print(*{'rclpy', 'IPython'} & set(sys.modules))"
IN_IPYTHON = """
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
shell.run_cell("from rosbeat import workspace")
shell.run_cell("%load_ext rosbeat")
cell, line = (shell.magics_manager.magics[kind] for kind in ("cell", "line"))
print("save" in cell, "terminal" in cell, "terminal" in line)
"""


def printed(code):
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.strip()


def test_importing_it_imports_neither_ros_nor_ipython():
    assert printed(IMPORTS) == ""


def test_inside_ipython_the_commands_are_known():
    assert printed(IN_IPYTHON) == "True True True"


def test_what_it_offers(root):
    assert workspace is rosbeat.workspace
    assert workspace.folder() == root
    assert callable(workspace.terminal)
    assert set(workspace.__all__) <= set(dir(workspace))


def test_an_unknown_name():
    with pytest.raises(AttributeError, match="no attribute 'termnal'"):
        _ = workspace.termnal


def test_registering_twice_changes_nothing(shell):
    rosbeat.load_ipython_extension(shell)
    known = {kind: set(names) for kind, names in shell.magics_manager.magics.items()}
    workspace.register(shell)
    assert {kind: set(names) for kind, names in shell.magics_manager.magics.items()} == known

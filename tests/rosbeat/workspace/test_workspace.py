"""`from rosbeat import workspace` in a program, on a page, and on a page that nbgrader runs."""

import os
import subprocess
import sys

import pytest

import rosbeat
from rosbeat import workspace
from rosbeat.workspace.busy_notice import counting, step

IMPORTS = "import sys, rosbeat.workspace; print(*{'rclpy', 'IPython'} & set(sys.modules))"
SEEN = """
import os, sys
before = sys.stderr
import rosbeat
home = os.environ.get("ROSBEAT_STEADY_HOME", "")
open(os.path.join(home, "kept"), "w").close() if home else None
if os.fork() == 0: raise SystemExit
os.wait()
print("python", file=sys.stderr)
sys.stdout.flush()
os.write(2, b"C\\n")
print(home, sys.stderr is before, os.path.isdir(home))
"""


def run(code, **variables):
    """Run code in a fresh Python; what it printed, what went to stderr."""
    left_out = ("ROSBEAT_STEADY_HOME", "NBGRADER_EXECUTION")
    environ = {name: value for name, value in os.environ.items() if name not in left_out}
    return subprocess.run(
        [sys.executable, "-c", code],
        env={**environ, **variables},
        capture_output=True,
        text=True,
        check=True,
    )


def test_importing_it_imports_neither_ros_nor_ipython():
    assert run(IMPORTS).stdout == "\n"


def test_inside_ipython_the_commands_are_known_and_known_once(shell):
    for _ in range(2):
        rosbeat.load_ipython_extension(shell)
        workspace.register(shell)
        known = {kind: set(names) for kind, names in shell.magics_manager.magics.items()}
    assert {"save", "terminal"} <= known["cell"]
    assert "terminal" in known["line"]


def test_what_it_offers(root):
    assert workspace.folder() == root
    assert set(workspace.__all__) <= set(dir(workspace))
    with pytest.raises(AttributeError, match="no attribute 'termnal'"):
        _ = workspace.termnal


def test_nothing_is_said_about_waiting_where_no_browser_shows_it(capsys):
    with counting("something"):
        step("a step")
    step("outside")
    assert capsys.readouterr().out == ""


# A page that nbgrader runs.


@pytest.mark.parametrize("execution", ["autograde", "validate"])
def test_a_graded_page_has_one_stream_and_a_home_that_goes_with_it(execution):
    done = run(SEEN, NBGRADER_EXECUTION=execution)
    python, c_code, said = done.stdout.splitlines()
    home, *seen = said.split()
    assert (python, c_code, seen, done.stderr) == ("python", "C", ["False", "True"], "")
    assert os.path.isabs(home)
    assert not os.path.exists(home)


def test_what_a_graded_page_starts_is_at_home_there(tmp_path):
    done = run(SEEN, NBGRADER_EXECUTION="autograde", ROSBEAT_STEADY_HOME=str(tmp_path))
    assert done.stdout.split() == [str(tmp_path), "True", "True"]
    assert done.stderr == "python\nC\n"
    assert (tmp_path / "kept").exists()


def test_nothing_changes_without_nbgrader():
    done = run(SEEN)
    assert done.stdout == " True False\n"
    assert done.stderr == "python\nC\n"

"""A kernel that nbgrader starts settles in; anything else is left alone."""

import os
import subprocess
import sys

import pytest

SEEN = """
import os, sys
before = sys.stderr
import rosbeat
home = os.environ.get("ROSBEAT_STEADY_HOME", "")
open(os.path.join(home, "kept"), "w").close() if home else None
print("python", file=sys.stderr)
sys.stdout.flush()
os.write(2, b"C\\n")
print(home, sys.stderr is before)
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


@pytest.mark.parametrize("execution", ["autograde", "validate"])
def test_a_graded_page_has_one_stream_and_a_home_that_goes_with_it(execution):
    done = run(SEEN, NBGRADER_EXECUTION=execution)
    python, c_code, said = done.stdout.splitlines()
    home, same = said.split()
    assert (python, c_code, same, done.stderr) == ("python", "C", "False", "")
    assert os.path.isabs(home)
    assert not os.path.exists(home)


def test_what_a_graded_page_starts_is_at_home_there(tmp_path):
    done = run(SEEN, NBGRADER_EXECUTION="autograde", ROSBEAT_STEADY_HOME=str(tmp_path))
    assert done.stdout.split() == [str(tmp_path), "True"]
    assert done.stderr == "python\nC\n"
    assert (tmp_path / "kept").exists()


def test_a_process_that_was_forked_does_not_take_the_home_along():
    code = (
        "import os, rosbeat\n"
        "if os.fork() == 0: raise SystemExit\n"
        "os.wait(); print(os.path.isdir(os.environ['ROSBEAT_STEADY_HOME']))"
    )
    assert run(code, NBGRADER_EXECUTION="autograde").stdout == "True\n"


def test_nothing_changes_without_nbgrader():
    done = run(SEEN)
    assert done.stdout == " True\n"
    assert done.stderr == "python\nC\n"

"""colcon on the course's underlay, in a bare bash: builds and tests, and never a warning."""

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

SETUP = Path(sys.prefix) / "setup.bash"
UNFRIENDLY = "[tool.pytest.ini_options]\naddopts = '--no-such-option'\n"
CREATE = (
    "ros2 pkg create --build-type ament_python --license Apache-2.0 --description 'A sensor.' "
    "sensor_simulator --dependencies rclpy std_msgs"
)

pytestmark = [
    pytest.mark.skipif(not SETUP.exists(), reason="needs the .venv of a checkout"),
    # Each starts a dozen Pythons one after the other: 5 s alone, many times that on a busy machine.
    pytest.mark.timeout(400),
]


@dataclass(frozen=True)
class Workspace:
    """A workspace below a folder that has settings for other tests."""

    folder: Path

    def run(self, commands: str) -> str:
        """Type commands into a bare bash; return what they print, errors and warnings too."""
        done = subprocess.run(
            ["bash", "-c", f"set -e; . '{SETUP}'; {commands}"],
            env={"PATH": os.defpath, "HOME": str(self.folder)},
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout
        return done.stdout


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    """A built workspace with a new package, in a folder with a space."""
    parent = tmp_path_factory.mktemp("my course")
    (parent / "pyproject.toml").write_text(UNFRIENDLY)
    (parent / "conftest.py").write_text("raise RuntimeError\n")
    found = Workspace(parent / "ROS2_and_RL_Tutorials")
    (found.folder / "src").mkdir(parents=True)
    found.run(f"cd src; {CREATE}")
    (parent / "build.txt").write_text(found.run("colcon build"))
    return found


def quiet(output):
    return "stderr" not in output and "arning" not in output


def test_a_build_is_silent_and_chains_to_the_underlay(workspace):
    output = (workspace.folder.parent / "build.txt").read_text()
    assert "Summary: 1 package finished" in output
    assert quiet(output)
    chained = workspace.run("env -i bash -c '. install/setup.bash; echo $AMENT_PREFIX_PATH'")
    assert chained == f"{workspace.folder}/install/sensor_simulator:{sys.prefix}\n"


def test_a_second_build_and_the_tests_of_a_new_package_are_silent(workspace):
    """Whatever lies above, and on top of itself."""
    output = workspace.run(
        ". install/setup.bash; colcon build; colcon test --return-code-on-test-failure"
    )
    assert output.count("Summary: 1 package finished") == 2
    assert quiet(output)
    result = workspace.run("colcon test-result --verbose")
    assert result == "Summary: 3 tests, 0 errors, 0 failures, 1 skipped\n"

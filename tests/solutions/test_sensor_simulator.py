"""The finished package: copied into an empty workspace it builds, is tested, runs and ends well.

`ROSBEAT_TORTURE=full` sends each signal 50 times, and wants the end within a second.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rosbeat.domains import lease_domain

pytestmark = pytest.mark.ros

PACKAGE = Path(__file__).parents[2] / "solutions" / "sensor_simulator"
FULL = os.environ.get("ROSBEAT_TORTURE") == "full"
ROUNDS, WITHIN = (50, 1.0) if FULL else (2, 20.0)
STARTED = {
    "temperature_publisher": "Publishing: ",
    "temperature_subscriber": "Status:",
}


@pytest.fixture(scope="module")
def environ(tmp_path_factory):
    """A person's environment with the course active, a home and a ROS domain of its own."""
    lease = lease_domain()
    dropped = ("PYTEST_CURRENT_TEST", "PYTHONDONTWRITEBYTECODE", "PYTHONPATH", "COLCON_HOME")
    kept = {name: value for name, value in os.environ.items() if name not in dropped}
    yield {
        **kept,
        "HOME": str(tmp_path_factory.mktemp("home")),
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),
        "ROS_DOMAIN_ID": str(lease.domain_id),
    }
    lease.release()


@pytest.fixture(scope="module")
def workspace(tmp_path_factory, environ):
    """An empty workspace with the package in it, built."""
    folder = tmp_path_factory.mktemp("workspace")
    shutil.copytree(PACKAGE, folder / "src" / "sensor_simulator")
    done = run("colcon build", folder, environ)
    assert done.returncode == 0
    assert "stderr" not in done.stdout + done.stderr
    assert "warning" not in (done.stdout + done.stderr).lower()
    return folder


def run(command, folder, environ):
    return subprocess.run(
        ["bash", "-c", command], cwd=folder, env=environ, capture_output=True, text=True, timeout=90
    )


def test_its_own_tests_and_linters_pass(workspace, environ):
    done = run("colcon test && colcon test-result --verbose", workspace, environ)
    assert done.returncode == 0, done.stdout
    assert "0 errors, 0 failures, 0 skipped" in done.stdout


def test_ros2_finds_it_once_it_is_sourced(workspace, environ):
    listing = "ros2 pkg executables sensor_simulator"
    assert run(listing, workspace, environ).stdout == ""
    loaded = run(f"source install/setup.bash && {listing}", workspace, environ)
    assert loaded.stdout.split("\n")[:2] == [f"sensor_simulator {name}" for name in STARTED]


def test_a_link_instead_of_a_copy_builds_too(workspace, environ, tmp_path):
    shutil.copytree(PACKAGE, tmp_path / "src" / "sensor_simulator")
    done = run("colcon build --symlink-install", tmp_path, environ)
    assert done.returncode == 0
    assert "stderr" not in done.stdout + done.stderr
    assert list(tmp_path.glob("install/sensor_simulator/lib/python3*/site-packages/*.egg-link"))


class Program:
    """`ros2 run` of one executable, in a process group of its own as in a terminal."""

    def __init__(self, executable, folder, environ, log):
        self.log = log
        command = f"source install/setup.bash && exec ros2 run sensor_simulator {executable}"
        with log.open("w") as output:
            self.process = subprocess.Popen(
                ["bash", "-c", command],
                cwd=folder,
                env=environ,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def wait_for(self, text):
        deadline = time.monotonic() + 60
        while text not in self.log.read_text():
            assert time.monotonic() < deadline, self.log.read_text()
            time.sleep(0.02)

    def end(self, signal_number):
        started = time.monotonic()
        os.killpg(self.process.pid, signal_number)
        code = self.process.wait(timeout=30)
        return code, time.monotonic() - started


@pytest.mark.parametrize("signal_number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.timeout(600)
def test_readings_cross_and_both_programs_end_with_0(workspace, environ, tmp_path, signal_number):
    for number in range(ROUNDS):
        # The monitor first: it would miss what is sent before it is there.
        programs = [
            Program(executable, workspace, environ, tmp_path / f"{executable}-{number}")
            for executable in reversed(STARTED)
        ]
        try:
            for program in programs:
                program.wait_for(STARTED[program.log.name.rpartition("-")[0]])
            for program in programs:
                code, seconds = program.end(signal_number)
                assert code == 0, program.log.read_text()
                assert "Traceback" not in program.log.read_text()
                assert seconds < WITHIN
        finally:
            for program in programs:
                if program.process.poll() is None:
                    os.killpg(program.process.pid, signal.SIGKILL)
                    program.process.wait()

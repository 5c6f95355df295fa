"""Running the command as a user does, beside real nodes in a domain of their own."""

import os
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "ros2_command"
DEMO = Path(__file__).with_name("demo_node.py")
# The command need not be installed to be tested.
sys.path.insert(0, str(SOURCE))


class Ros2:
    """The command, with an environment."""

    def __init__(self, **environment):
        paths = [str(SOURCE), os.environ.get("PYTHONPATH", "")]
        self.environment = os.environ | {
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "COLUMNS": "80",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        self.environment.pop("FASTRTPS_DEFAULT_PROFILES_FILE", None)
        self.environment |= environment

    def words(self, *words):
        return [sys.executable, "-m", "ros2_command", *map(str, words)]

    def __call__(self, *words, cwd=None, stdin=None, code=0, timeout=60, **environment):
        """Run to the end, compare the exit code, and return the completed process."""
        done = subprocess.run(
            self.words(*words), env=self.environment | environment, cwd=cwd, input=stdin,
            stdin=subprocess.DEVNULL if stdin is None else None,
            capture_output=True, text=True, timeout=timeout, check=False,
        )  # fmt: skip
        assert "Traceback" not in done.stderr, done.stderr
        assert done.returncode == code, (done.stdout, done.stderr)
        return done

    def out(self, *words, **options):
        return self(*words, **options).stdout

    def error(self, *words, code=1, **options):
        return self(*words, code=code, **options).stderr

    @contextmanager
    def running(self, *words):
        process = subprocess.Popen(
            self.words(*words), env=self.environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        with process:
            try:
                yield process
            finally:
                process.kill()


@pytest.fixture(scope="session")
def ros2():
    return Ros2()


@contextmanager
def demo_node(ros2, name, topic, period):
    process = subprocess.Popen(
        [sys.executable, str(DEMO), name, topic, str(period)], env=ros2.environment,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    with process:
        assert process.stdout.readline() == "ready\n"
        try:
            yield process
        finally:
            process.stdin.close()
            process.wait(30)


@pytest.fixture
def another_node():
    """Starts one more node: `with another_node(graph, name, topic, period):`."""
    return demo_node


@pytest.fixture(scope="session")
def graph():
    """In a domain where `/one` publishes on `/temperature`, and `/ns_two` on `/slow`."""
    from rosbeat.domains import lease_domain

    lease = lease_domain()
    profile = SOURCE / "ros2_command" / "data" / "fastdds.xml"
    quick = Ros2(ROS_DOMAIN_ID=str(lease.domain_id), FASTRTPS_DEFAULT_PROFILES_FILE=str(profile))
    with ExitStack() as stack:
        stack.callback(lease.release)
        stack.enter_context(demo_node(quick, "one", "temperature", 0.05))
        stack.enter_context(demo_node(quick, "ns_two", "slow", 1.0))
        yield quick

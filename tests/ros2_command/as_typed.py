"""Running the command as a person does, beside real nodes in a domain of their own."""

import os
import signal
import subprocess
import sys
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "ros2_command"
PROFILE = SOURCE / "ros2_command" / "data" / "fastdds.xml"
HERE = Path(__file__).parent


class Ros2:
    """The command, with an environment.

    Args:
        forks: Run commands that end by themselves; without them, each is a new process.
        environment: What differs from this process's.
    """

    def __init__(self, forks=None, **environment):
        self._forks = forks
        paths = [str(SOURCE), os.environ.get("PYTHONPATH", "")]
        self.environment = os.environ | {
            "ROS2_COMMAND_NO_NOTES": "1",  # whether a wait takes long depends on the machine
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "COLUMNS": "80",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        self.environment.pop("FASTRTPS_DEFAULT_PROFILES_FILE", None)
        self.environment |= environment

    def words(self, *words):
        return [sys.executable, "-m", "ros2_command", *map(str, words)]

    def __call__(self, *words, cwd=None, stdin=None, code=0, timeout=100, **environment):
        """Run to the end, compare the exit code, if any, and return the completed process."""
        if self._forks and "PYTHONPATH" not in environment:  # theirs is read already
            done = self._forks.run(
                list(map(str, words)), self.environment | environment, cwd, stdin, timeout
            )
        else:
            done = subprocess.run(
                self.words(*words), env=self.environment | environment, cwd=cwd, input=stdin,
                stdin=subprocess.DEVNULL if stdin is None else None,
                capture_output=True, text=True, timeout=timeout, check=False,
            )  # fmt: skip
        assert "Traceback" not in done.stderr, done.stderr
        assert code in (None, done.returncode), (done.stdout, done.stderr)
        return done

    def out(self, *words, **options):
        return self(*words, **options).stdout

    def error(self, *words, code=1, **options):
        return self(*words, code=code, **options).stderr

    @contextmanager
    def running(self, *words):
        """Start in a process group of its own, as a terminal does, and kill that at the end.

        All of it: a node whose `ros2 run` alone was killed would stay in its domain for ever, and
        whoever leases that domain next would see it.
        """
        process = subprocess.Popen(
            self.words(*words), env=self.environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        )  # fmt: skip
        with process:
            try:
                yield process
            finally:
                with suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)


def interrupted(process):
    """What a running command prints, out and error, after Ctrl+C, by which it has to end."""
    process.send_signal(signal.SIGINT)
    found = process.communicate(timeout=60)
    assert process.returncode == 2
    return found


@contextmanager
def demo_node(ros2, *words, file="demo_node.py"):
    """Run `demo_node.py`, or another file, in the environment of a command."""
    process = subprocess.Popen(
        [sys.executable, str(HERE / file), *map(str, words)], env=ros2.environment,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    with process:
        assert process.stdout.readline() == "ready\n"
        try:
            yield process
        finally:
            process.stdin.close()
            process.wait(60)


def empty_domain(stack):
    """Lease a domain in which no process is left from somebody who was killed."""
    from ros2_command.graph import count_participants

    from rosbeat.domains import lease_domain

    while True:
        lease = lease_domain()
        stack.callback(lease.release)
        if not count_participants(lease.domain_id):
            return lease.domain_id


@contextmanager
def own_graph(*nodes, file="demo_node.py", forks=None, **environment):
    """Run nodes, each with its arguments, in a domain that nobody else has."""
    with ExitStack() as stack:
        quick = Ros2(
            forks,
            ROS_DOMAIN_ID=str(empty_domain(stack)),
            FASTRTPS_DEFAULT_PROFILES_FILE=str(PROFILE),
            **environment,
        )
        for node in nodes:
            stack.enter_context(demo_node(quick, *node, file=file))
        yield quick

"""What is done before ROS is imported, and what remains when a worker is killed."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rosbeat.errors import GradingError
from rosbeat.grading import start_worker as module
from rosbeat.grading.jobs import READY, Job, write_line
from rosbeat.grading.pool import Worker
from rosbeat.grading.sandbox.processes import children
from rosbeat.grading.start_worker import UNSAFE, main


@pytest.fixture
def done(monkeypatch):
    """What is done, in order, when a worker is started."""
    seen = []

    class Stub:
        trouble = None

        @classmethod
        def main(cls, unsafe):
            seen.append(("main", unsafe))
            if cls.trouble:
                raise cls.trouble

    monkeypatch.setattr(module, "become_able", lambda: seen.append("able"))
    monkeypatch.setattr(module.linux, "prctl", lambda *_: seen.append("dies with its parent"))
    monkeypatch.setattr(module, "import_module", lambda _: Stub)
    return seen, Stub


def test_rights_come_first_for_they_change_what_comes_second(done):
    main([])
    assert done[0] == ["able", "dies with its parent", ("main", False)]


def test_without_a_sandbox_no_rights_are_asked_for(done):
    main([UNSAFE])
    assert done[0] == ["dies with its parent", ("main", True)]


def test_who_gets_no_rights_hears_of_it_from_the_sandbox(done, monkeypatch):
    def refuses():
        raise PermissionError

    monkeypatch.setattr(module, "become_able", refuses)
    main([])
    assert done[0][-1] == ("main", False)


def test_a_worker_without_what_makes_sandboxes_ends(done):
    done[1].trouble = ConnectionError("the process that makes sandboxes has ended")
    with pytest.raises(SystemExit, match=r"makes sandboxes has ended\. What it was doing is done"):
        main([])


def test_nothing_of_ros_is_imported_by_it():
    program = (
        "import rosbeat.grading.start_worker, sys\nprint({'rclpy', 'numpy'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.strip() == "set()", done.stderr


def descendants(process):
    return [one for child in children(process) for one in (child, *descendants(child))]


def is_alive(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.fixture
def worker():
    """A worker that observes an answer that sleeps."""
    run = subprocess.Popen(
        [sys.executable, "-m", module.__name__], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        start_new_session=True,
    )  # fmt: skip
    assert run.stdout.readline().decode().rstrip() == READY
    job = Job("03a", "Beat", "import time\ntime.sleep(600)")
    run.stdin.write(f"{write_line(job)}\n".encode())
    run.stdin.flush()
    yield run
    run.kill()
    run.communicate()


@pytest.mark.ros
def test_what_runs_in_a_sandbox_ends_with_the_worker(worker, eventually):
    eventually(lambda: len(children(worker.pid)) == 2, 30)  # what makes sandboxes, and the answer
    all_of_them = descendants(worker.pid)
    assert len(all_of_them) == 4
    worker.kill()
    eventually(lambda: not any(map(is_alive, all_of_them)), 20)


@pytest.mark.ros
def test_a_worker_that_loses_what_makes_sandboxes_is_replaced(eventually):
    worker = Worker()
    try:
        assert worker.observe(Job("03a", "5", "x = 5")) is not None
        (maker,) = children(worker.pid)
        os.kill(maker, signal.SIGKILL)
        eventually(lambda: not is_alive(maker), 20)
        assert worker.observe(Job("03a", "5", "x = 5")) is None
    except GradingError as refused:
        pytest.skip(str(refused))
    finally:
        worker.close()

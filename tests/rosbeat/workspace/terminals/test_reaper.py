"""Nothing of a kernel's terminals stays behind."""

import os
import signal
import subprocess
import sys

import pytest

from rosbeat.workspace.terminals import reaper


@pytest.fixture
def mark():
    return f"test-{os.getpid()}-{os.urandom(4).hex()}."


@pytest.fixture
def start(mark):
    """Start programs that carry the mark; kill what is left of them."""
    started = []

    def start(code, number=1):
        environ = {**os.environ, reaper.VARIABLE: f"{mark}{number}."}
        command = [sys.executable, "-I", "-S", "-c", code]
        process = subprocess.Popen(
            command, env=environ, stdout=subprocess.PIPE, start_new_session=True
        )
        started.append(process)
        assert process.stdout.readline() == b"ready\n"
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()
        process.stdout.close()


SLEEP = "import time; print('ready', flush=True); time.sleep(100)"
CHILD = f"""
import os, subprocess, sys
subprocess.Popen([sys.executable, "-I", "-S", "-c", {SLEEP!r}])
import time; time.sleep(100)
"""


def test_marked_processes_are_found(mark, start):
    one, two = start(SLEEP, 1), start(SLEEP, 12)
    assert set(reaper.marked(mark)) == {one.pid, two.pid}
    assert reaper.marked(f"{mark}1.") == [one.pid]
    assert reaper.marked("nobody.") == []


def test_a_follower_is_asked_first(mark, start, eventually):
    polite = """
import signal, sys, time
signal.signal(signal.SIGTERM, lambda *_: sys.exit(7))
print('ready', flush=True)
time.sleep(100)
"""
    leader = start(CHILD.replace(repr(SLEEP), repr(polite)))
    reaper.end_marked(mark)
    assert leader.wait(10) == -signal.SIGKILL
    assert reaper.marked(mark) == []


def test_the_deaf_are_killed(mark, start):
    deaf = "import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); " + SLEEP
    process = start(CHILD.replace(repr(SLEEP), repr(deaf)))
    reaper.end_marked(mark, grace=0.1)
    assert process.wait(10) == -signal.SIGKILL
    assert reaper.marked(mark) == []


def test_the_watcher_ends_what_is_marked_when_its_pipe_closes(mark, start, eventually):
    process = start(SLEEP)
    command = [sys.executable, "-I", "-S", reaper.__file__, mark, str(os.getpid())]
    watcher = subprocess.Popen(command, stdin=subprocess.PIPE)
    assert process.poll() is None
    watcher.stdin.close()
    assert watcher.wait(20) == 0
    assert process.wait(10) == -signal.SIGKILL

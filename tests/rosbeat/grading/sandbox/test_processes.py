"""What is told of other processes, also of those that are not there."""

import os
import subprocess
import sys

from rosbeat.grading.sandbox.processes import children, memory_of

PROGRAM = "import sys, subprocess\nmuch = b'x' * 50_000_000\nprint(len(much), flush=True)\ninput()"
PARENT = f"import subprocess, sys\nsubprocess.run([sys.executable, '-c', {PROGRAM!r}])"


def test_memory_is_that_of_descendants_too():
    run = subprocess.Popen(
        [sys.executable, "-c", PARENT], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    run.stdout.readline()
    (child,) = children(run.pid)
    assert memory_of([run.pid]) > memory_of([child]) > 50_000_000
    run.communicate(b"\n")
    assert children(run.pid) == []
    assert memory_of([child]) == 0


def test_whoever_asks_is_a_process_like_others():
    assert memory_of([os.getpid()]) > 1_000_000

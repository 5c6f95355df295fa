"""What a terminal's program waits for, and that nothing is said where no browser shows it."""

import os
import pty
import signal
import sys
import time
from pathlib import Path

import pytest

from rosbeat.workspace.terminals.shell import _reads_terminal
from rosbeat.workspace.waiting import Note, counting, in_a_browser, step

DEADLINE = 60.0


def comes_true(condition):
    end = time.monotonic() + DEADLINE
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return condition()


@pytest.fixture
def on_a_terminal():
    """Start a program on a terminal of its own, and end it."""
    started = []

    def start(*command):
        process, end = pty.fork()
        if process == 0:
            os.execvp(command[0], command)
        started.append((process, end))
        return process

    yield start
    for process, end in started:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        os.close(end)


@pytest.mark.parametrize(
    "command",
    [("cat",), (sys.executable, "-c", "input()"), (sys.executable, "-q", "-I")],
    ids=["cat", "input", "python"],
)
def test_a_program_that_reads_the_terminal_is_recognised(on_a_terminal, command):
    process = on_a_terminal(*command)
    assert comes_true(lambda: _reads_terminal(process))


def test_a_program_that_sleeps_does_not_read(on_a_terminal):
    process = on_a_terminal("sleep", "1000")
    sleeps = Path(f"/proc/{process}/comm")
    assert comes_true(lambda: sleeps.read_text() == "sleep\n")
    assert not any(_reads_terminal(process) for _ in range(50))
    assert not _reads_terminal(0)


def test_nothing_is_said_where_no_browser_shows_it(capsys):
    assert not in_a_browser()
    note = Note()
    note.say("a word")
    note.clear()
    with counting("something"):
        step("a step")
    step("outside")
    assert capsys.readouterr().out == ""

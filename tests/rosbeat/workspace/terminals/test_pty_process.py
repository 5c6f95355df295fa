"""A bash starts in peace, whatever the kernel around it has set."""

import signal
import time

import pytest

from rosbeat.workspace.terminals import Terminals


@pytest.fixture
def deaf():
    """A process that ignores Ctrl+C, as one that a script started in the background."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_works_in_a_terminal_of_a_deaf_kernel(deaf, home):
    with Terminals() as terminals:
        sensor = terminals.get("sensor")
        sensor.type("sleep 100", seconds=0.1, show=str)
        assert sensor.ctrl_c(show=str) == 130


def test_a_closed_pipe_ends_a_program_quietly(seen):
    assert seen("yes | head -1") == ["~$ yes | head -1", "y"]


def test_a_terminal_starts_at_once(home):
    with Terminals() as terminals:
        began = time.monotonic()
        terminals.get("first")
        assert time.monotonic() - began < 5  # 30 ms on a quiet machine

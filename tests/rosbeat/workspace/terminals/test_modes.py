"""What the modes of a terminal say about who listens to the keyboard."""

import os
import pty
import termios
import tty

import pytest

from rosbeat.workspace.terminals.modes import Modes, modes_of


@pytest.fixture
def terminal():
    ours, theirs = pty.openpty()
    yield theirs
    os.close(ours)
    os.close(theirs)


def with_flags(terminal, index, on=0, off=0):
    flags = termios.tcgetattr(terminal)
    flags[index] = flags[index] & ~off | on
    termios.tcsetattr(terminal, termios.TCSANOW, flags)
    return modes_of(terminal)


def test_a_new_terminal_collects_lines(terminal):
    modes = modes_of(terminal)
    assert (modes.reads_lines, modes.wants_keys, modes.edits_lines) == (True, False, False)
    assert modes.obeys_ctrl_c
    assert not modes.may_want_no_enter("y")


def test_a_question_for_a_key_may_want_no_enter(terminal):
    modes = with_flags(terminal, 3, off=termios.ICANON)
    assert (modes.reads_lines, modes.wants_keys, modes.edits_lines) == (False, True, False)
    assert [modes.may_want_no_enter(line) for line in ("", "y", "abc")] == [False, True, True]


def test_who_edits_lines_wants_enter_after_more_than_a_key(terminal):
    with_flags(terminal, 3, off=termios.ICANON)
    modes = with_flags(terminal, 0, off=termios.ICRNL)
    assert (modes.wants_keys, modes.edits_lines) == (True, True)
    assert [modes.may_want_no_enter(line) for line in ("", "y", "abc")] == [False, True, False]


def test_a_raw_terminal_takes_ctrl_c_for_a_key(terminal):
    tty.setraw(terminal)
    assert not modes_of(terminal).obeys_ctrl_c


@pytest.mark.parametrize("descriptor", [-1, 987654])
def test_a_terminal_that_has_ended_wants_nothing(descriptor):
    modes = modes_of(descriptor)
    assert modes == Modes()
    assert not modes.wants_keys
    assert not modes.may_want_no_enter("y")

import os
import subprocess

import pytest

from rosbeat.workspace.terminals.foreground import (
    Program,
    group,
    program,
    sleeps_within,
    would_have_ended,
)


@pytest.mark.parametrize(
    ("trap", "ends"), [("true", True), ("trap 'echo' INT", False), ("trap '' INT", False)]
)
def test_a_program_that_handles_interrupts_is_known(trap, ends):
    command = ["bash", "-c", f"{trap}; echo ready; read"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
    ) as process:
        assert process.stdout.readline() == b"ready\n"
        assert would_have_ended(process.pid) == ends
        process.kill()


def test_a_program_that_is_gone_is_not_known():
    assert not would_have_ended(2**22 + 1)


def test_a_program_is_known_by_its_words():
    with subprocess.Popen(["cat", "-n"], stdin=subprocess.PIPE) as process:
        assert sleeps_within(process.pid, 10)
        assert program(process.pid) == Program(process.pid, b"cat\0-n\0", True)
        process.stdin.close()
    assert program(2**22 + 1) == Program(2**22 + 1)


NODE = Program(7, b"node", False)


@pytest.mark.parametrize(
    ("before", "now", "missed"),
    [
        (NODE, Program(8, b"node", False), True),  # a loop has gone on to the next
        (NODE, NODE, False),  # it takes its time to end
        (NODE, Program(7, b"node", True), False),  # it has taken its handlers away: the end
        (NODE, Program(7, b"other", True), True),  # the interrupt was lost as it became another
        (NODE, Program(7, b"other", False), False),
        (Program(7, b"loop", True), Program(7, b"loop", True), True),
    ],
)
def test_who_is_on_the_way_out_was_not_missed(before, now, missed):
    assert now.was_missed(before) == missed


def test_a_file_has_no_foreground():
    reading, writing = os.pipe()
    assert group(reading) == 0
    os.close(reading)
    os.close(writing)


def test_a_process_that_waits_sleeps():
    with subprocess.Popen(["cat"], stdin=subprocess.PIPE) as process:
        assert sleeps_within(process.pid, 10)
        process.stdin.close()


def test_a_process_that_works_does_not_sleep():
    with subprocess.Popen(["bash", "-c", "while :; do :; done"]) as process:
        assert not sleeps_within(process.pid, 0.05)
        process.kill()

"""Whoever waits is told how far it is."""

import io

import pytest

from rosbeat.grading import progress_bar as module
from rosbeat.grading.progress_bar import progress_bar


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def told(monkeypatch):
    """The lines of a log; each step is how long it took, how many are done, and of how many."""
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])

    def told(*steps):
        log = io.StringIO()
        with progress_bar(log) as tell:
            for seconds, done, total in steps:
                now[0] += seconds
                tell(done, total)
        return log.getvalue().splitlines()

    return told


def test_a_log_gets_a_line_now_and_then_and_one_at_the_end(told):
    lines = told((0, 0, 100), *((1.0, done, 100) for done in range(1, 101)))
    assert lines[0] == "100 different answers; preparing sandboxes, trying the first ..."
    assert lines[1] == "10 of 100 judged, 90 s left"
    assert lines[-1] == "100 of 100 judged"
    assert len(lines) == 11


def test_neither_preparing_nor_earlier_runs_count_for_the_time_that_is_left(told):
    lines = told((0, 0, 11), (60.0, 1, 11), (6.0, 2, 11), (6.0, 3, 11))
    assert lines[1:] == ["1 of 11 judged", "3 of 11 judged, 48 s left"]
    lines = told((0, 80, 100), *((1.0, done, 100) for done in range(81, 101)))
    assert lines[0].startswith("100 different answers, 80 of them judged already; ")
    assert lines[1:] == ["90 of 100 judged, 10 s left", "100 of 100 judged"]


def test_nothing_to_do_is_not_worth_a_line(told):
    assert told((0, 7, 7)) == []
    terminal = Terminal()
    with progress_bar(terminal) as tell:
        tell(7, 7)
    assert "judging" not in terminal.getvalue()


def test_a_terminal_gets_a_bar():
    terminal = Terminal()
    with progress_bar(terminal) as tell:
        tell(3, 7)
        tell(4, 7)
        tell(7, 7)
    shown = terminal.getvalue()
    assert "7 different answers, 3 of them judged already." in shown
    assert shown.index("preparing sandboxes") < shown.index("judging") < shown.index("7/7")
    assert "0:0" in shown

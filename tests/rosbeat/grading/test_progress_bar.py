"""Whoever waits is told how far it is."""

import io

import pytest

from rosbeat.grading import progress_bar as module
from rosbeat.grading.progress_bar import progress_bar


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def clock(monkeypatch):
    """A clock that the test moves."""
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    return now


def test_a_log_gets_a_line_now_and_then_and_one_at_the_end(clock):
    log = io.StringIO()
    with progress_bar(log) as tell:
        tell(0, 100)
        for done in range(1, 101):
            clock[0] += 1.0
            tell(done, 100)
    lines = log.getvalue().splitlines()
    assert lines[0] == "100 different answers; preparing sandboxes, trying the first ..."
    assert lines[1] == "10 of 100 judged, 90 s left"
    assert lines[-1] == "100 of 100 judged"
    assert len(lines) == 11


def test_the_time_for_preparing_is_not_that_of_answers(clock):
    log = io.StringIO()
    with progress_bar(log) as tell:
        tell(0, 11)
        for seconds, done in ((60.0, 1), (6.0, 2), (6.0, 3)):
            clock[0] += seconds
            tell(done, 11)
    assert log.getvalue().splitlines()[1:] == ["1 of 11 judged", "3 of 11 judged, 48 s left"]


def test_what_was_judged_in_earlier_runs_is_said_and_takes_no_time(clock):
    log = io.StringIO()
    with progress_bar(log) as tell:
        tell(80, 100)
        for done in range(81, 101):
            clock[0] += 1.0
            tell(done, 100)
    lines = log.getvalue().splitlines()
    assert lines[0].startswith("100 different answers, 80 of them judged already; ")
    assert lines[1:] == ["90 of 100 judged, 10 s left", "100 of 100 judged"]


def test_nothing_to_do_is_not_worth_a_line(clock):
    log = io.StringIO()
    with progress_bar(log) as tell:
        tell(7, 7)
    assert log.getvalue() == ""


def test_nothing_done_yet_has_no_time_left(clock):
    log = io.StringIO()
    with progress_bar(log) as tell:
        clock[0] += 60
        tell(0, 5)
    (line,) = log.getvalue().splitlines()
    assert line == "5 different answers; preparing sandboxes, trying the first ..."


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


def test_a_terminal_shows_no_bar_if_nothing_is_to_do():
    terminal = Terminal()
    with progress_bar(terminal) as tell:
        tell(7, 7)
    assert "judging" not in terminal.getvalue()
    assert "preparing" not in terminal.getvalue()

"""Code that never ends by itself is ended. Upper limits are for busy machines, and not reached."""

import contextlib
import os
import queue
import re
import signal
import subprocess
import sys
import threading
import time

import pytest

from rosbeat.ros.isolation import DeadlinePassed, within

SHORT = 0.2


def loop():
    while True:
        pass


def catch_everything():
    while True:
        try:  # noqa: SIM105 - as a learner writes it
            time.time()
        except:  # noqa: E722
            pass


def catch_it_twice():
    while True:
        try:
            try:
                time.sleep(0.01)
            except:  # noqa: E722
                time.time()
        except:  # noqa: E722
            time.time()


def suppress():
    while True:
        with contextlib.suppress(BaseException):
            threading.Event().wait()


def in_a_finally():
    try:
        loop()
    finally:
        time.sleep(1000)


def with_another_handler():
    signal.signal(signal.SIGALRM, signal.SIG_IGN)
    loop()


def without_a_timer():
    signal.setitimer(signal.ITIMER_REAL, 0)
    loop()


def with_the_signal_blocked():
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM})
    loop()


ENDLESS = {
    "loop": loop,
    "catches everything": catch_everything,
    "catches it twice": catch_it_twice,
    "suppresses": suppress,
    "in a finally": in_a_finally,
    "sleep": lambda: time.sleep(1000),
    "event": lambda: threading.Event().wait(),
    "queue": lambda: queue.Queue().get(),
    "process": lambda: subprocess.run(["sleep", "1000"]),
    "regular expression": lambda: re.match(r"(a+)+$", "a" * 40 + "b"),
    "numbers": lambda: 7 ** (10**9),
    "another handler": with_another_handler,
    "without a timer": without_a_timer,
    "signal blocked": with_the_signal_blocked,
}


def state():
    return (
        signal.getsignal(signal.SIGALRM), signal.getsignal(signal.SIGINT), sys.gettrace(),
        signal.pthread_sigmask(signal.SIG_BLOCK, ()), threading.active_count(),
    )  # fmt: skip


@pytest.mark.parametrize("case", ENDLESS)
def test_endless_code_ends_and_nothing_is_left(case):
    before = state()
    with within(SHORT) as deadline:
        ENDLESS[case]()
        pytest.fail("it returned")
    assert deadline.passed
    assert deadline.place[0] > 0
    assert state() == before
    catch_nothing = sum(range(1000))  # and no late shot comes
    assert catch_nothing == 499500


@pytest.mark.parametrize("case", ["loop", "catches everything"])
def test_the_same_in_another_thread(case):
    done = []

    def run():
        with within(SHORT) as deadline:
            ENDLESS[case]()
        done.append(deadline.passed)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(60)
    assert done == [True]


def test_code_that_ends_in_time_is_left_alone():
    with within(60) as deadline:
        value = sum(range(10))
    assert (value, deadline.passed, deadline.place) == (45, False, (0, ""))


def test_an_exception_goes_its_way():
    with pytest.raises(ZeroDivisionError), within(60):
        raise ZeroDivisionError


def test_it_says_where_the_code_was_and_calls_back_once():
    noted = []
    with within(SHORT, noting=lambda: noted.append(1)) as deadline:
        while True:
            time.sleep(0.01)  # here
    assert noted == [1]
    assert deadline.place[1] in ("time.sleep(0.01)  # here", "while True:")


def test_what_waits_in_c_is_nudged():
    nudged = threading.Event()
    with within(SHORT, nudge=nudged.set) as deadline:
        while not nudged.is_set():
            with contextlib.suppress(BaseException):
                time.sleep(0.01)
        loop()
    assert deadline.passed
    assert nudged.is_set()


def test_a_deadline_can_be_declared_passed():
    with within(60) as deadline:
        deadline.expire()
    assert deadline.passed


def test_one_in_another():
    with within(60) as outer:
        with within(SHORT) as inner:
            suppress()
        still_here = True
    assert (inner.passed, outer.passed, still_here) == (True, False, True)


def test_the_outer_one_comes_first():
    with within(SHORT) as outer:
        with within(60):
            loop()
        pytest.fail("it went on")
    assert outer.passed


@pytest.mark.parametrize("place", [threading.Thread, signal], ids=["the watchdog", "the signals"])
def test_time_that_is_up_before_the_block_begins_ends_the_block(place, monkeypatch):
    name = "start" if place is threading.Thread else "setitimer"
    begin = getattr(place, name)

    def slowly(*arguments):
        value = begin(*arguments)
        end = time.monotonic() + 2 * SHORT
        while time.monotonic() < end:
            time.sleep(0.001)
        return value

    before = signal.getsignal(signal.SIGALRM)
    monkeypatch.setattr(place, name, slowly)
    with within(SHORT) as deadline:
        monkeypatch.undo()
        loop()
    assert deadline.passed
    assert signal.getsignal(signal.SIGALRM) == before
    assert "rosbeat deadline" not in [thread.name for thread in threading.enumerate()]


def test_the_alarm_of_somebody_else_is_put_back():
    before = signal.getsignal(signal.SIGALRM), signal.setitimer(signal.ITIMER_REAL, 0)
    rung = []
    signal.signal(signal.SIGALRM, lambda *_: rung.append(1))
    try:
        signal.setitimer(signal.ITIMER_REAL, 1000, 7)
        with within(SHORT):
            loop()
        left, again = signal.getitimer(signal.ITIMER_REAL)
        assert (left < 1000, again, rung) == (True, 7, [])
    finally:
        signal.signal(signal.SIGALRM, before[0])
        signal.setitimer(signal.ITIMER_REAL, *before[1])


@pytest.mark.parametrize("case", ["loop", "catches it twice", "suppresses"])
def test_interrupt_means_interrupt_also_for_code_that_catches_it(case):
    press = threading.Timer(SHORT, os.kill, (os.getpid(), signal.SIGINT))
    press.start()
    with pytest.raises(KeyboardInterrupt), within(1000) as deadline:
        ENDLESS[case]()
    press.join()
    assert deadline.interrupted
    assert not isinstance(deadline, DeadlinePassed)

"""Code that never ends is ended, and the process is as it was before.

Upper limits are for busy machines, and not reached.
"""

import builtins
import contextlib
import gc
import os
import signal
import sys
import threading
import time
import warnings

import pytest

from rosbeat.ros.isolation import Deadline, DeadlinePassed, unharmed

SHORT = 0.2


def loop():
    while True:
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


#: `failing_answers.ENDLESS` has more, each of which ends in a check: see `test_scenario.py`.
ENDLESS = {
    "loop": loop,
    "catches it twice": catch_it_twice,
    "suppresses": suppress,
    "in a finally": in_a_finally,
    "sleep": lambda: time.sleep(1000),
}


def state():
    return (
        signal.getsignal(signal.SIGALRM), signal.getsignal(signal.SIGINT), sys.gettrace(),
        signal.pthread_sigmask(signal.SIG_BLOCK, ()), threading.active_count(),
    )  # fmt: skip


def test_code_that_gets_on_has_more_time():
    looks = []
    began = time.monotonic()
    with Deadline(2, gets_on=lambda: not looks.append(time.monotonic())) as deadline:
        while not looks:
            pass
    assert not deadline.passed
    assert looks[0] >= began + 2  # only when the time is up: a look may be slow


def test_code_that_gets_on_for_ever_ends_all_the_same():
    with Deadline(SHORT, gets_on=lambda: True) as deadline:
        loop()
    assert deadline.passed


@pytest.mark.parametrize("case", ENDLESS)
def test_endless_code_ends_and_nothing_is_left(case):
    before = state()
    with Deadline(SHORT) as deadline:
        ENDLESS[case]()
        pytest.fail("it returned")
    assert deadline.passed
    assert deadline.place[0] > 0
    assert state() == before
    catch_nothing = sum(range(1000))  # and no late shot comes
    assert catch_nothing == 499500


def test_it_says_where_the_code_was_and_calls_back_once():
    noted = []
    with Deadline(SHORT, noting=lambda: noted.append(1)) as deadline:
        while True:
            time.sleep(0.01)  # here
    assert noted == [1]
    assert deadline.place[1] in ("time.sleep(0.01)  # here", "while True:")


def test_one_in_another():
    with Deadline(60) as outer:
        with Deadline(SHORT) as inner:
            suppress()
        still_here = True
    assert (inner.passed, outer.passed, still_here) == (True, False, True)


def test_the_alarm_of_somebody_else_is_put_back():
    before = signal.getsignal(signal.SIGALRM), signal.setitimer(signal.ITIMER_REAL, 0)
    rung = []
    signal.signal(signal.SIGALRM, lambda *_: rung.append(1))
    try:
        signal.setitimer(signal.ITIMER_REAL, 1000, 7)
        with Deadline(SHORT):
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
    with pytest.raises(KeyboardInterrupt), Deadline(1000) as deadline:
        ENDLESS[case]()
    press.join()
    assert deadline.interrupted
    assert not isinstance(deadline, DeadlinePassed)


# What is put back.


def process_state():
    return (
        os.getcwd(), dict(os.environ), dict(vars(builtins)), signal.getsignal(signal.SIGINT),
        signal.getsignal(signal.SIGUSR1), sys.stdout, sys.stderr, sys.stdin, sys.excepthook,
        threading.excepthook, sys.getrecursionlimit(), gc.isenabled(), list(warnings.filters),
    )  # fmt: skip


def test_everything_is_put_back():
    before = process_state()
    with unharmed():
        os.chdir("/")
        os.environ["ROS_DOMAIN_ID"] = "3"
        os.environ.pop("PATH")
        builtins.len = builtins.print = 3
        builtins.surplus = 3
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGUSR1, signal.SIG_IGN)
        sys.stdout = sys.stderr = sys.stdin = sys.excepthook = None
        threading.excepthook = None
        sys.setrecursionlimit(5000)
        gc.disable()
        warnings.simplefilter("error")
    del builtins.surplus
    assert process_state() == before


def test_also_after_an_exception_and_in_a_folder_that_is_gone(tmp_path, monkeypatch):
    place = tmp_path / "gone"
    place.mkdir()
    monkeypatch.chdir(place)
    handler = signal.getsignal(signal.SIGINT)
    with pytest.raises(ZeroDivisionError), unharmed():
        _do_harm(place)
    assert signal.getsignal(signal.SIGINT) is handler


def test_what_is_printed_is_counted_and_not_shown(capsys):
    with unharmed() as count:
        print("abc")
        print("de", file=sys.stderr, end="")
        sys.stdout.flush()
    assert count.characters == 6
    assert capsys.readouterr() == ("", "")


def test_a_thread_that_was_there_before_prints_as_ever(capsys):
    begin, done = threading.Event(), threading.Event()

    def speak():
        begin.wait(60)
        print("hello")
        done.set()

    thread = threading.Thread(target=speak)
    thread.start()
    with unharmed() as count:
        begin.set()
        assert done.wait(60)
    thread.join()
    assert (count.characters, capsys.readouterr().out) == (0, "hello\n")


def _do_harm(place):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.chdir("/")
    place.rmdir()
    raise ZeroDivisionError


def test_traces_and_collection_are_put_back():
    tracing, threshold = sys.gettrace(), gc.get_threshold()
    with unharmed():
        sys.settrace(lambda *_: None)
        gc.set_threshold(1)
        signal.signal(signal.SIGVTALRM, lambda *_: None)
        signal.setitimer(signal.ITIMER_VIRTUAL, 60, 60)
    assert (sys.gettrace(), gc.get_threshold()) == (tracing, threshold)
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)

import builtins
import gc
import os
import random
import signal
import sys
import threading
import time
import warnings

import pytest
import rclpy
from rclpy.node import Node
from rclpy.publisher import Publisher

from rosbeat.ros.isolation import unharmed


def state():
    return (
        os.getcwd(), dict(os.environ), dict(vars(builtins)), signal.getsignal(signal.SIGINT),
        signal.getsignal(signal.SIGUSR1), sys.stdout, sys.stderr, sys.stdin, sys.excepthook,
        threading.excepthook, sys.getrecursionlimit(), gc.isenabled(), list(warnings.filters),
    )  # fmt: skip


def test_everything_is_put_back():
    before = state()
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
    assert state() == before


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


def test_nobody_types():
    with unharmed(), pytest.raises(EOFError, match="nobody types"):
        input("?")


def test_in_another_thread_too():
    errors = []

    def run():
        try:
            with unharmed():
                os.environ["SURPLUS"] = "1"
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert errors == []
    assert "SURPLUS" not in os.environ


def _do_harm(place):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.chdir("/")
    place.rmdir()
    raise ZeroDivisionError


@pytest.mark.parametrize(
    ("owner", "name"),
    [(time, "sleep"), (time, "monotonic"), (random, "uniform"), (random, "setstate"),
     (rclpy, "init"), (Node, "create_timer"), (Publisher, "publish")],
    ids=lambda one: getattr(one, "__name__", one),
)  # fmt: skip
def test_names_of_others_are_put_back(owner, name):
    before = vars(owner)[name]
    with unharmed():
        setattr(owner, name, None)
    assert vars(owner)[name] is before


def test_traces_and_collection_are_put_back():
    tracing, threshold = sys.gettrace(), gc.get_threshold()
    with unharmed():
        sys.settrace(lambda *_: None)
        gc.set_threshold(1)
        signal.signal(signal.SIGVTALRM, lambda *_: None)
        signal.setitimer(signal.ITIMER_VIRTUAL, 60, 60)
    assert (sys.gettrace(), gc.get_threshold()) == (tracing, threshold)
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)

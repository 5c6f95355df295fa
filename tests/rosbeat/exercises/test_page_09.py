"""Page 09: what a thread of an answer prints after its check."""

import threading

import pytest

from bank.answer import edited
from bank.beyond import worker_wrong
from bank.running import namespace_of
from rosbeat.exercises.check import check


@pytest.mark.ros
def test_a_thread_that_raises_after_the_check_prints_nothing(capsys):
    space = namespace_of("09b", edited(worker_wrong._THREAD, ("0.2", "GATE.wait()")), "<thread>")
    space["time"] = type("Time", (), {"sleep": staticmethod(lambda _: None)})
    space["GATE"] = gate = threading.Event()
    before = set(threading.enumerate())
    check("09b", space["Worker"])
    left = set(threading.enumerate()) - before
    gate.set()
    for thread in left:
        thread.join(5)
    assert left
    assert "Traceback" not in capsys.readouterr().err

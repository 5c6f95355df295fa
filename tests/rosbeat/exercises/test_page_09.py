"""Page 09: what a thread of an answer prints after its check."""

import threading

import pytest

from bank.running import namespace_of
from rosbeat.exercises.check import check

WORKER = """
class Worker(Node):
    def __init__(self):
        super().__init__("worker")
        self.dones = self.create_publisher(Int32, "done", 10)
        self.create_subscription(Int32, "order", self.take, 10)

    def take(self, msg):
        def work():
            GATE.wait()
            self.dones.publish(msg)

        threading.Thread(target=work).start()
"""


@pytest.mark.ros
def test_a_thread_that_raises_after_the_check_prints_nothing(capsys):
    space = namespace_of("09b", WORKER, "<thread>")
    space["GATE"] = gate = threading.Event()
    before = set(threading.enumerate())
    check("09b", space["Worker"])
    # It was a thread of the node's simulated process, and has ended with it.
    assert set(threading.enumerate()) == before
    gate.set()
    assert "Traceback" not in capsys.readouterr().err

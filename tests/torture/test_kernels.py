"""Kernels with sessions in them are started, ended, interrupted and run again.

The counts are small by default; `ROSBEAT_TORTURE=full` runs 50 starts, 20 re-runs and 20
interrupts of each kind.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from torture.kernel import FULL, Kernel

STARTS, RERUNS, INTERRUPTS = (50, 20, 20) if FULL else (5, 6, 1)
#: Interrupt ends every cell within this many seconds.
# What is promised, where the machine is not busy with other tests. Otherwise an interrupt has to
# work; how quickly says more about the machine.
AT_ONCE = 0.5 if FULL else 5.0
#: Shared by every kernel and every DDS process on the machine, so somebody else may hold them.
SHARED = ("/dev/shm/lttng", "/dev/shm/fastrtps_port70")

PRELUDE = """
from functools import partial
import rclpy
from nodes import *
from rosbeat import Session
"""

PROBE = """
with Session() as probe:
    probe.add(Talker)
    ear = probe.add(Listener)
    probe.run(3)
    assert ear.heard == [1, 2, 3], ear.heard
"""

#: IPython saves its history from a thread, and opens a journal for that now and then.
COUNT_FILES = """
import os
from contextlib import suppress

def count_files():
    found = []
    for number in os.listdir("/proc/self/fd"):
        with suppress(OSError):
            found.append(os.readlink(f"/proc/self/fd/{number}"))
    return sum(not file.endswith(".sqlite-journal") for file in found)
"""

#: Those first that leave most to end; a short run tries only these.
ENDINGS = {
    "in a domain that was joined": "from rosbeat.domains import lease_domain; "
    "lease = lease_domain(); ros = Session(domain_id=lease.domain_id); "
    "ros.add(partial(Talker, period=0.001)); ros.add(Listener); ros.start(); ros.wait(0.05)",
    "session and a learner's own": "rclpy.init(); node = Talker(); ros = Session(); "
    "ros.add(Listener); ros.start()",
    "two, one live": "one = Session(); two = Session(); one.add(Talker); one.run(1); "
    "two.add(partial(Talker, period=0.001)); two.start()",
    "dropped while live": "ros = Session(); ros.add(Talker); ros.start(); ros = Session(); "
    "ros.add(Talker); ros.start(); ros.wait(0.05)",
    "ended by a cell": "ros = Session(); ros.add(partial(Talker, period=0.001)); ros.start()",
    "virtual, open": "ros = Session(); ros.add(Talker); ros.add(Listener); ros.run(5)",
    "closed": "ros = Session(); ros.add(Talker); ros.run(5); ros.close()",
    "a learner's own": "rclpy.init(); node = Talker()",
}


@pytest.mark.parametrize("number", range(STARTS))
def test_a_kernel_starts_and_exits(number):
    name, code = list(ENDINGS.items())[number % len(ENDINGS)]
    before = {f"/dev/shm/{file}" for file in os.listdir("/dev/shm")}
    with Kernel() as kernel:
        reply = kernel.run(PRELUDE + code)
        assert reply.error == "", reply.text
        mapped = kernel.shared_memory()
        exit_code = kernel.exit("exit()" if name == "ended by a cell" else "")
        assert exit_code == 0, kernel.log()
        left = {
            file for file in mapped - before if Path(file).exists() and not file.startswith(SHARED)
        }
        assert "Fatal" not in kernel.log()
    assert not left, left


def test_a_cell_run_again_and_again():
    with Kernel() as kernel:
        kernel.run(PRELUDE + COUNT_FILES)
        cell = """
ros = Session()
ros.add(partial(Talker, period=0.1))
ear = ros.add(Listener)
ros.run(2)
ros.start()
ros.wait(0.05)
print(len(ear.heard) // 20, len(os.listdir("/proc/self/task")), count_files())
"""
        counts = [kernel.run(cell).text.split() for _ in range(RERUNS)]
        assert {count[0] for count in counts} == {"1"}
        # From the second time on, when the first session has been replaced, nothing piles up.
        for column in list(zip(*counts[2:], strict=True))[1:]:
            assert len(set(column)) == 1, counts
        assert kernel.exit() == 0


LONG = "ros = Session(); ros.add(partial(Talker, period=0.001)); ros.add(Listener)\n"
CASES = {
    # The first, for the kernel still has no session then.
    "spin without a session": "ros = None; rclpy.init(); node = Node('alone'); "
    "print('go', flush=True); rclpy.spin(node)",
    "run, long": LONG + "print('go', flush=True); ros.run(1e6, quiet=True)",
    "run, heavy": "ros = Session(); ros.add(partial(Doer, lambda _: sum(range(3_000_000)), "
    "period=0.1))\nprint('go', flush=True); ros.run(1e6)",
    "run, logging": "ros = Session(); ros.add(partial(Speaker, period=0.001))\n"
    "print('go', flush=True); ros.run(1e6)",
    "endless callback": "ros = Session()\ndef forever(_):\n    print('go', flush=True)\n"
    "    while True: pass\nros.add(partial(Doer, forever)); ros.run(5)",
    "endless async callback": "ros = Session()\nasync def forever(_):\n"
    "    print('go', flush=True)\n    while True: pass\nros.add(partial(AsyncDoer, forever)); "
    "ros.run(5)",
    "wait": LONG + "ros.start(); print('go', flush=True); ros.wait()",
    "wait, endless callback": "ros = Session()\ndef forever(_):\n    while True: pass\n"
    "ros.add(partial(Doer, forever, period=0.01)); ros.start(); print('go', flush=True); "
    "ros.wait()",
    "spin in a session": LONG + "print('go', flush=True); rclpy.spin(ros.nodes[0])",
    "spin, nothing to do": "ros = Session(); node = ros.add(lambda: Node('idle')); "
    "print('go', flush=True); rclpy.spin(node)",
    "a call that nobody answers": "ros = Session(); client = ros.add(lambda: Node('asker'))"
    ".create_client(Trigger, 'nothing'); ros.start(); print('go', flush=True); "
    "client.call(Trigger.Request())",
}


@pytest.mark.parametrize("name", CASES)
def test_interrupt_ends_the_cell_and_ros_lives(name, kernel):
    for number in range(INTERRUPTS):
        reply = kernel.interrupt(CASES[name], 0.02 + 0.031 * (number % 7))
        assert reply.error == "KeyboardInterrupt", (number, reply)
        assert reply.seconds < AT_ONCE, (number, reply)
        probe = kernel.run(PROBE)
        assert probe.error == "", (number, probe)

"""Checks in real kernels, of answers that go wrong in every way: the kernel lives.

`ROSBEAT_TORTURE=full` tries all of them, and 20 interrupts of each kind.
"""

from __future__ import annotations

import pytest

import failing_answers
from torture.kernel import FULL, Kernel

INTERRUPTS = 20 if FULL else 1
#: What is promised for one check, where the machine is not busy; else it has to answer at all.
WITHIN = 6.0 if FULL else 30.0
AT_ONCE = 0.8 if FULL else 5.0

PRELUDE = """
import builtins, os, sys, threading, time
from rclpy import spin  # before rosbeat puts its own in its place
from rosbeat import check
from rosbeat.ros import scenario
import failing_answers

alive = [True]

class Right(failing_answers.Base):
    pass

def told(answer):
    outcome = check("03a", answer).outcome
    print(outcome.status, outcome.mistake, outcome.evidence)

def seen(answer):
    print(scenario.observe(answer, 5, deadline=0.5).faults[0].kind)
"""
PROBE = """
told(Right)
assert print is builtins.print and builtins.len("abc") == 3
"""
#: Cells, and how each ends.
CELLS = {
    "a blank": ("class A(failing_answers.Base):\n    ____\n", "NameError"),
    "quit": ("told(failing_answers.doing(lambda _: quit()))", ""),
    "exit": ("told(failing_answers.born(lambda _: exit()))", ""),
    "a builtin replaced in the cell": ("input = sum = 3\ntold(Right)", ""),
    "stdout taken away": (
        "told(failing_answers.doing(lambda _: setattr(sys, 'stdout', None)))",
        "",
    ),
    "a thread in the cell": (
        "def go():\n    while alive:\n        time.sleep(0.01); print(end='')\n"
        "threading.Thread(target=go, name='nasty').start()\ntold(Right)",
        "",
    ),
    "a busy thread in the cell": (
        "def go():\n    while alive: pass\n"
        "threading.Thread(target=go, name='nasty').start()\ntold(Right)",
        "",
    ),
    "spinning at birth, by rclpy's own function": ("seen(failing_answers.born(spin))", ""),
    "an interrupt of its own": (
        "told(failing_answers.doing(failing_answers.raising(KeyboardInterrupt())))",
        "",
    ),
    "a folder that is gone": (
        "import tempfile\nplace = tempfile.mkdtemp(); os.chdir(place); os.rmdir(place)\n"
        "told(Right)\nos.chdir('/')",
        "",
    ),
}
SOME = ("loop in a callback", "loop that catches everything", "prints",
        "replaced handlers, then loop")  # fmt: skip


def groups():
    """Some endless ones for each kernel, so that no test takes long."""
    names = list(failing_answers.ENDLESS) if FULL else list(SOME)
    return [names[at : at + 4] for at in range(0, len(names), 4)]


@pytest.mark.parametrize("names", groups(), ids=lambda names: names[0])
def test_a_check_of_what_never_ends_answers_and_the_kernel_lives(names):
    with Kernel() as kernel:
        assert kernel.run(PRELUDE).error == ""
        right = kernel.run(PROBE).text
        for number, name in enumerate(names):
            call = "told({})" if FULL or number == 0 else "seen({})"
            reply = kernel.run(call.format(f"failing_answers.ENDLESS[{name!r}]"))
            assert reply.error == "", (name, reply)
            assert reply.text.startswith(("failed", "DeadlinePassed")), (name, reply)
            assert reply.seconds < WITHIN, (name, reply)
            probe = kernel.run(PROBE)
            assert (probe.error, probe.text) == ("", right), (name, probe)
        assert kernel.exit() == 0, kernel.log()


def test_cells_that_spoil_the_kernel_do_not_spoil_the_check():
    with Kernel() as kernel:
        assert kernel.run(PRELUDE).error == ""
        right = kernel.run(PROBE).text
        for name, (cell, error) in CELLS.items():
            reply = kernel.run(cell)
            assert reply.error == error, (name, reply)
            probe = kernel.run(PROBE)
            assert (probe.error, probe.text) == ("", right), (name, probe)
        # ipykernel itself aborts now and then if a thread still prints when it ends.
        kernel.run(
            "alive.clear()\n[one.join() for one in threading.enumerate() if one.name == 'nasty']"
        )
        assert kernel.exit() == 0, kernel.log()


INTERRUPTED = {
    "loop": "failing_answers.loop",
    "catches everything": "failing_answers.swallow",
    "suppresses": "failing_answers.suppress",
}


@pytest.mark.parametrize("name", INTERRUPTED)
def test_interrupt_ends_a_check(name, kernel):
    cell = f"""
def act(node):
    os.write(ready, b"x")
    {INTERRUPTED[name]}(node)
told_ready, ready = os.pipe()
def tell():
    os.read(told_ready, 1); out.write("go"); out.flush()
out = sys.stdout
threading.Thread(target=tell, daemon=True).start()
scenario.observe(failing_answers.doing(act), 5, deadline=60)
"""
    right = kernel.run(PROBE).text
    for number in range(INTERRUPTS):
        reply = kernel.interrupt(cell, 0.02 + 0.031 * (number % 7))
        assert reply.error == "KeyboardInterrupt", (number, reply)
        assert reply.seconds < AT_ONCE, (number, reply)
        probe = kernel.run(PROBE)
        assert (probe.error, probe.text) == ("", right), (number, probe)

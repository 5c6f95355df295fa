"""How a finished node under `ros2 run` ends: by Ctrl+C, and by signals to each process alone."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from commands import offer
from measuring import Row
from processes import at_95_percent

sys.path.append(str(Path(__file__).resolve().parent.parent / "ros2_command"))

from as_typed import Ros2, own_graph

WITHIN = 1.0


def _child(process: subprocess.Popen[str]) -> int:
    """The node that a `ros2 run` has started; its other child has the command line of `ros2`."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    own = Path(f"/proc/{process.pid}/cmdline").read_bytes()
    (node,) = (one for one in children if Path(f"/proc/{one}/cmdline").read_bytes() != own)
    return int(node)


SENDERS: dict[str, Callable[[subprocess.Popen[str], int], None]] = {
    "ros2 alone": lambda process, number: process.send_signal(number),
    "the node alone": lambda process, number: os.kill(_child(process), number),
    "both, as Ctrl+C does": lambda process, number: os.killpg(process.pid, number),
}


def measure(quick: bool) -> list[Row]:
    """Every signal to every process, at any moment of a running node."""
    count = 5 if quick else 50
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        ros2 = stack.enter_context(own_graph())
        offer(folder / "offered")
        ros2.environment["AMENT_PREFIX_PATH"] = str(folder / "offered")
        return [
            _row(ros2, signal.Signals(number), to, count)
            for number in (signal.SIGINT, signal.SIGTERM)
            for to in SENDERS
        ]


def _row(ros2: Ros2, number: signal.Signals, to: str, count: int) -> Row:
    chance = random.Random(count)
    endings = [_end(ros2, number, to, chance.uniform(0, 0.15)) for _ in range(count)]
    good = sum(clean and seconds < WITHIN for clean, seconds in endings)
    times = [seconds for _, seconds in endings]
    text = f"{good}/{count} good, 95 % {at_95_percent(times):.2f} s, worst {max(times):.2f} s"
    return Row(f"{number.name} to {to}", text, "", f"code 0 in {WITHIN:g} s", good == count)


def _end(ros2: Ros2, number: int, to: str, after: float) -> tuple[bool, float]:
    """Whether it ended with exit code 0 and without a word, and how many seconds that took."""
    with ros2.running("run", "demo", "node") as process:
        assert process.stdout.readline() == "published\n"
        time.sleep(after)  # so that the signal hits any part of the node's cycle
        begin = time.perf_counter()
        SENDERS[to](process, number)
        out, error = process.communicate(timeout=30)
        seconds = time.perf_counter() - begin
    return process.returncode == 0 and not error and not out.replace("published\n", ""), seconds

"""Private sessions: how many fit on a machine, what each costs, and that none hears another.

Each session has a publisher and a subscription. All of them are open at the same time, in one
process and in several.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

import psutil
from measuring import MB, Row
from rclpy.node import Node
from std_msgs.msg import Int32

from rosbeat import Session


class Repeater(Node):
    """Publishes its number once a second."""

    def __init__(self, number: int) -> None:
        super().__init__("repeater")
        self.heard: list[int] = []
        publisher = self.create_publisher(Int32, "count", 10)
        self.create_subscription(Int32, "count", lambda msg: self.heard.append(msg.data), 10)
        self.create_timer(1.0, lambda: publisher.publish(Int32(data=number)))


def measure(quick: bool) -> list[Row]:
    """One process with all of the sessions, then many processes with a few each."""
    number, processes = (100, 10) if quick else (500, 50)
    return [*_rows(number, 1), *_rows(number, processes)]


def _rows(number: int, processes: int) -> list[Row]:
    each = number // processes
    ranges = [(first, first + each) for first in range(0, number, each)]
    running = [
        subprocess.Popen(
            [sys.executable, __file__, *map(str, one)], stdin=subprocess.PIPE, text=True,
            stdout=subprocess.PIPE,
        )
        for one in ranges
    ]  # fmt: skip
    # Ready: nobody is asked before all are open.
    errors = sum(_answer(process)[1] for process in running)
    told = []
    for process in running:
        assert process.stdin is not None
        print(file=process.stdin, flush=True)
        told.append(json.loads(_answer(process)[0]))
    for process in running:
        process.communicate()
    alone = sum(one["alone"] for one in told)
    what = f"{number} sessions in {processes} process{'es' if processes > 1 else ''}"
    return [
        Row(f"{what}: hear only themselves", str(alone), target=str(number), met=alone == number),
        Row(f"{what}: to open, median", f"{median(one['ms'] for one in told):.0f} ms"),
        Row(f"{what}: memory of each", f"{median(one['mb'] for one in told):.1f} MB"),
        Row(f"{what}: files in shared memory", str(sum(one["shared"] for one in told))),
        Row(f"{what}: errors printed by Fast DDS", str(errors)),
    ]


def _answer(process: subprocess.Popen[str]) -> tuple[str, int]:
    """Return the next line that is not from Fast DDS, and how many errors came before it."""
    assert process.stdout is not None
    errors = 0
    while "Error]" in (line := process.stdout.readline()):
        errors += 1
    return line, errors


def _open(first: int, last: int) -> None:
    """Open sessions of these numbers, run them when a line is read, and print what was found."""
    with Session() as warm:
        warm.add(partial(Repeater, 0))
    before, times, opened = psutil.Process().memory_info().rss, [], []
    for number in range(first, last):
        begin = time.perf_counter()
        session = Session()
        opened.append((number, session, session.add(partial(Repeater, number))))
        times.append(time.perf_counter() - begin)
    used = psutil.Process().memory_info().rss - before
    print("ready", flush=True)
    sys.stdin.readline()
    for _, session, _ in opened:
        session.run(3)
    maps = {line.split()[-1] for line in Path("/proc/self/maps").read_text("utf-8").splitlines()}
    found: dict[str, Any] = {
        "alone": sum(node.heard == [number] * 3 for number, _, node in opened),
        "ms": median(times) * 1000,
        "mb": used / MB / (last - first),
        "shared": sum(name.startswith("/dev/shm/fastrtps") for name in maps),
    }
    print(json.dumps(found), flush=True)
    sys.stdin.readline()


if __name__ == "__main__":
    _open(int(sys.argv[1]), int(sys.argv[2]))

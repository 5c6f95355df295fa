"""A class on a hub: what a learner takes, and how long twenty wait who work at the same moment."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from statistics import mean, median, quantiles
from threading import Barrier

import nbformat
import psutil
from measuring import MB, Row

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from hub.learner import Kernel, Learner
from hub.machine import ROOT, User, installation, missing, running_hub, users

PAGE = "00_hear_the_heartbeat.ipynb"
LEARNERS, ALONE = 20, 5
#: How often a learner who works runs a cell, in seconds, and what of the processors they may take.
_BETWEEN_CELLS, _SHARE = 10.0, 0.7
_FIRST_MESSAGE = """
from rclpy.node import Node
from std_msgs.msg import Float32
from rosbeat import Session
class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(1.0, lambda: self.publisher.publish(Float32(data=20.0)))
class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.heard = []
        self.create_subscription(Float32, "temperature", self.heard.append, 10)
ros = Session()
ros.add(Talker)
listener = ros.add(Listener)
ros.run(seconds=1)
assert ros.messages("temperature")
"""


def measure(quick: bool) -> list[Row]:
    """Start a hub with twenty users of the system, and let them work alone and all at once."""
    reason = missing()
    if reason:
        raise SystemExit(f"hub: {reason}")
    free = psutil.virtual_memory().available
    with (
        tempfile.TemporaryDirectory() as folder,
        installation() as course,
        users(LEARNERS, course.parent / "homes") as (group, members),
        running_hub(course, group, members, Path(folder) / "hub.log") as hub,
        ThreadPoolExecutor(LEARNERS) as pool,
    ):
        learners = [hub.log_in(user) for user in members]
        starts = list(pool.map(lambda one: _seconds(one.start_server), learners))
        alone = [_first_message(one) for one in learners[:ALONE]]
        together = list(pool.map(_first_message, learners))
        rounds = 3 if quick else 10
        classes = list(pool.map(lambda one: Desk(one, members), learners))
        plain = mean(desk.plain for desk in classes)
        single = [classes[0].check() for _ in range(rounds)]
        barrier = Barrier(LEARNERS)
        checks = [
            one
            for spans in pool.map(lambda desk: desk.checks(barrier, rounds), classes)
            for one in spans
        ]
        list(pool.map(Desk.draw, classes))
        drawn, server = map(mean, zip(*(desk.memory() for desk in classes), strict=True))
        cost = mean(desk.cpu for desk in classes)
        for desk in classes:
            desk.close()
        list(pool.map(Learner.stop_server, learners))
    each, cores = server + drawn, os.cpu_count() or 1
    by_cpu = cores * _SHARE * _BETWEEN_CELLS / cost
    return [
        Row("memory of a learner's server", f"{server / MB:.0f} MB"),
        Row("memory of a kernel with a session", f"{plain / MB:.0f} MB"),
        Row("memory of a kernel that has drawn pictures", f"{drawn / MB:.0f} MB"),
        Row("learners at once, by memory", f"{free / each:.0f}", f"{free / 1e9:.1f} GB free"),
        Row("learners at once, by processor", f"{by_cpu:.0f}",
            f"{cores} cores, a cell of {cost:.2f} s every {_BETWEEN_CELLS:.0f} s"),
        Row("start of a server, 20 at once, p95", f"{_p95(starts):.1f} s"),
        Row("kernel start to first message, alone", f"{median(alone):.2f} s"),
        Row("kernel start to first message, 20 at once, p95", f"{_p95(together):.1f} s"),
        Row("a check, alone", f"{median(single):.2f} s"),
        Row("a check, 20 at once, p95", f"{_p95(checks):.2f} s"),
    ]  # fmt: skip


class Desk:
    """A learner with page 00 open, in which the answer to 00a is written.

    Args:
        learner: The learner.
        members: The users, among whom the learner is.
    """

    def __init__(self, learner: Learner, members: list[User]) -> None:
        self.user = next(one for one in members if one.name == learner.name)
        self._context = learner.kernel(PAGE)
        self._kernel: Kernel = self._context.__enter__()
        self._cells = [
            one
            for one in nbformat.read(ROOT / "solutions" / PAGE, as_version=4).cells
            if one.cell_type == "code"
        ]
        self.cpu = 0.0
        self._run(_FIRST_MESSAGE)
        self.plain = self.memory()[0]  # the first cell of the page draws a picture
        place = [one.metadata.get("rosbeat", {}).get("exercise") for one in self._cells]
        self._run(self._cells[0].source)
        self._run(self._cells[place.index("00a")].source)

    def memory(self) -> tuple[float, float]:
        """Return the bytes of the learner's kernel, and of all their other processes.

        They are proportional shares (PSS): what several processes share counts once.
        """
        kernel = others = 0.0
        for pid in self.user.pids():
            with suppress(psutil.Error):
                process = psutil.Process(pid)
                share = float(process.memory_full_info().pss)
                if "ipykernel_launcher" in process.cmdline():
                    kernel += share
                else:
                    others += share
        return kernel, others

    def check(self) -> float:
        """Return the seconds of a check."""
        return _seconds(lambda: self._run('check("00a", WeatherReader)'))

    def checks(self, barrier: Barrier, rounds: int) -> list[float]:
        """Return the seconds of checks that all learners begin at the same moment."""
        spans = []
        for _ in range(rounds):
            barrier.wait(600)
            spans.append(self.check())
        return spans

    def draw(self) -> None:
        """Run the whole page, pictures and all, and note the processor's seconds for each cell."""
        before = _cpu(self.user)
        for cell in self._cells:
            self._run(cell.source)
        self.cpu = (_cpu(self.user) - before) / len(self._cells)

    def close(self) -> None:
        """End the kernel."""
        self._context.__exit__(None, None, None)

    def _run(self, code: str) -> None:
        outputs, status = self._kernel.run(code)
        if status != "ok":
            raise RuntimeError(f"{code}: {outputs}")


def _first_message(learner: Learner) -> float:
    begin = time.perf_counter()
    with learner.kernel(PAGE) as kernel:
        kernel.says(_FIRST_MESSAGE)
        return time.perf_counter() - begin


def _seconds(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def _p95(spans: list[float]) -> float:
    return quantiles(spans, n=20)[-1]


def _cpu(user: User) -> float:
    total = 0.0
    for pid in user.pids():
        with suppress(psutil.Error):
            total += sum(psutil.Process(pid).cpu_times()[:4])
    return total

"""Live mode at 100 Hz against a bare SingleThreadedExecutor in a thread."""

from __future__ import annotations

import threading
import time
from collections import defaultdict
from collections.abc import Callable
from statistics import median, quantiles

import rclpy
from actors import Pulse, Stopwatch
from measuring import Row
from rclpy.executors import SingleThreadedExecutor

from rosbeat import Session

TARGET = 1.1


def measure(quick: bool) -> list[Row]:
    """Latency and processor time in short turns, each beginning with the other side."""
    turns, seconds = (4, 1.0) if quick else (20, 1.0)
    middles, ends, shares = (defaultdict(list) for _ in range(3))
    for turn in range(turns):
        for name, way in sorted(WAYS.items(), reverse=bool(turn % 2)):
            heard, share = way(seconds)
            middles[name].append(median(heard))
            ends[name].append(quantiles(heard, n=20)[-1])
            shares[name].append(share)
    return [
        _row("live latency, median", middles, 1e-3, "us"),
        _row("live latency, 95th percentile", ends, 1e-3, "us"),
        _row("live processor time", shares, 100, "% of a core"),
    ]


def _row(what: str, turns: dict[str, list[float]], scale: float, unit: str) -> Row:
    session, bare = median(turns["session"]) * scale, median(turns["bare"]) * scale
    ratio = session / bare
    text = f"{session:.1f} against {bare:.1f} {unit}"
    return Row(what, text, f"{ratio:.2f} x", f"<= {TARGET:g} x", ratio <= TARGET)


def _session(seconds: float) -> tuple[list[int], float]:
    with Session() as ros:
        ros.add(Pulse)
        watch = ros.add(Stopwatch)
        ros.start()
        return _observe(watch, seconds)


def _bare(seconds: float) -> tuple[list[int], float]:
    rclpy.init(args=["--ros-args", "--disable-stdout-logs", "--disable-external-lib-logs"],
               domain_id=50)  # fmt: skip
    executor = SingleThreadedExecutor()
    nodes = [Pulse(), Stopwatch()]
    for node in nodes:
        executor.add_node(node)
    stop = threading.Event()
    thread = threading.Thread(target=_spin, args=(executor, stop.is_set))
    thread.start()
    try:
        return _observe(nodes[1], seconds)
    finally:
        stop.set()
        thread.join()
        executor.shutdown()
        for node in nodes:
            node.destroy_node()
        rclpy.shutdown()


def _spin(executor: SingleThreadedExecutor, stopped: Callable[[], bool]) -> None:
    while not stopped():
        executor.spin_once(timeout_sec=1.0)


def _observe(watch: Stopwatch, seconds: float) -> tuple[list[int], float]:
    time.sleep(0.2)  # let it settle; this is a measurement, not a wait for something
    watch.delays.clear()
    processor, wall = time.process_time(), time.perf_counter()
    time.sleep(seconds)
    share = (time.process_time() - processor) / (time.perf_counter() - wall)
    assert len(watch.delays) > 50 * seconds, "far too few messages"
    return list(watch.delays), share


WAYS = {"session": _session, "bare": _bare}

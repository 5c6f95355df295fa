"""Runs cases as real processes, with rclpy's own executors, against the wall clock.

`measure` starts this file as a program. It imports rclpy and the cases once, and then forks a
process for each process of a case: each has a context and a global executor of its own, as with
`ros2 run`, and starts in milliseconds. A case has a private domain. Several cases run at once, for
they mostly sleep. Time zero is when all processes of a case have found each other.

Where the machine itself stood still for longer than a third of the usual tolerance (`machine`), a
measurement says nothing about rclpy, and the case is measured anew.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, Pipe
from pathlib import Path
from typing import Any

from conformance.entry_points import LOG, LOOPBACK
from conformance.machine import Watch, read_lines

if __name__ == "__main__":  # and not in a process of tests, whose sessions have their own settings
    os.environ.update(LOOPBACK)  # before the middleware looks

import rclpy
from rcl_interfaces.msg import Log, ParameterEvent
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.type_support import check_for_type_support
from std_msgs.msg import Int32
from test_msgs.action import Fibonacci
from test_msgs.srv import BasicTypes

from conformance.cases import CASES
from conformance.programs import JOURNAL, Case, Entry, Process, run_main

#: Processes that run at once, and their start, keep two cores busy; more would disturb each other.
PROCESSES_AT_ONCE = 16
#: Cases that run together begin one after the other, so that their timers are not due together.
STAGGER = 0.037
_OWN_LOGGER = "conformance"
_OF_EVERY_NODE = ("/rosout", "/parameter_events")


def _own_topics(nodes: list[Node], kind: str) -> list[Any]:
    ends = (end for node in nodes for end in getattr(node, kind))
    return [end for end in ends if end.topic_name not in _OF_EVERY_NODE]


def _waitables(nodes: list[Node], kind: type) -> list[Any]:
    return [item for node in nodes for item in node.waitables if isinstance(item, kind)]


def _endpoints(nodes: list[Node]) -> dict[str, list[str]]:
    """Return the names of what other processes can be matched with."""
    return {
        "nodes": [node.get_name() for node in nodes],
        "publishers": [end.topic_name for end in _own_topics(nodes, "publishers")],
        "subscriptions": [end.topic_name for end in _own_topics(nodes, "subscriptions")],
        "services": [end.service_name for node in nodes for end in node.services],
        "actions": ["action" for _ in _waitables(nodes, ActionServer)],
    }


def _unmatched(nodes: list[Node], everyone: dict[str, list[str]], misfits: bool) -> bool:
    """Return whether this process does not know all nodes, or an endpoint is not connected yet.

    Args:
        nodes: The nodes of this process.
        everyone: The endpoints of all processes of the case.
        misfits: Whether endpoints of one topic need not fit each other.
    """
    if any(not set(everyone["nodes"]) <= set(node.get_node_names()) for node in nodes[:1]):
        return True
    if not misfits:
        for publisher in _own_topics(nodes, "publishers"):
            expected = everyone["subscriptions"].count(publisher.topic_name)
            if publisher.get_subscription_count() != expected:
                return True
        for subscription in _own_topics(nodes, "subscriptions"):
            expected = everyone["publishers"].count(subscription.topic_name)
            if subscription.get_publisher_count() != expected:
                return True
    for client in (client for node in nodes for client in node.clients):
        if client.service_name in everyone["services"] and not client.service_is_ready():
            return True
    for action in _waitables(nodes, ActionClient):
        if everyone["actions"] and not action.server_is_ready():
            return True
    return False


def _sleep_until(moment: float) -> None:
    while (left := moment - time.monotonic()) > 0:
        time.sleep(left)


def _spin(process: Process, nodes: list[Node]) -> None:
    """Spin as most programs do: one node by `rclpy.spin`, several by an executor of their own."""
    if process.threads == 1 and len(nodes) == 1:
        rclpy.spin(nodes[0])
        return
    if process.threads == 1:
        executor: Any = SingleThreadedExecutor()
    else:
        executor = MultiThreadedExecutor(num_threads=process.threads)
    for node in nodes:
        executor.add_node(node)
    executor.spin()


def _run_process(number: int, process: Process, connection: Connection) -> None:
    """Run one process of a case; what its nodes write goes to the journal's file."""
    nodes: list[Node] = []
    # The first log line of a process takes 13 ms of a processor, and 0.1 s of a busy machine.
    get_logger(_OWN_LOGGER).info("the first line")
    if process.main is None:
        rclpy.init(args=[])
        if process.start:
            # How long two processes need to find each other is not rclpy's doing, so those that
            # begin later are known before, by a node without endpoints.
            options = {"start_parameter_services": False, "enable_rosout": False}
            nodes = [rclpy.create_node(f"scout_{os.getpid()}", **options)]
        else:
            nodes = [make() for make in process.nodes]
    connection.send(_endpoints(nodes))
    everyone, misfits = connection.recv()
    while _unmatched(nodes, everyone, misfits):
        time.sleep(0.005)
    connection.send("matched")
    zero = connection.recv()
    _sleep_until(zero + process.start)
    connection.send(time.monotonic() - zero - process.start)
    if process.main is not None:
        sys.argv = ["main"]
        run_main(number, process.main)
        return
    if process.start:
        nodes = [make() for make in process.nodes]
    for timer in (timer for node in nodes for timer in node.timers):
        if not process.start and not timer.is_canceled():
            timer.reset()  # it has counted since its node was made
    _spin(process, nodes)


@dataclass
class Child:
    """A process of a case, from outside."""

    pid: int
    connection: Connection
    journal: Path
    stderr: Path


def _end_with_parent() -> None:
    """Have Linux kill this process when its parent ends, however that ends (PR_SET_PDEATHSIG)."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


def _fork(number: int, process: Process, domain: int, folder: Path) -> Child:
    """Fork a process of a case, the first of which has number 0."""
    ours, theirs = Pipe()
    name = len(list(folder.iterdir()))
    journal, stderr = folder / f"{name}.journal", folder / f"{name}.stderr"
    journal.touch()
    stderr.touch()
    pid = os.fork()
    if pid:
        theirs.close()
        return Child(pid, ours, journal, stderr)
    ours.close()
    _end_with_parent()
    os.environ["ROS_DOMAIN_ID"] = str(domain)
    os.dup2(os.open(stderr, os.O_WRONLY), 2)
    JOURNAL.file = os.open(journal, os.O_WRONLY | os.O_APPEND)
    end = ""
    try:
        _run_process(number, process, theirs)
    except BaseException as error:
        traceback.print_exc()
        end = traceback.format_exception_only(type(error), error)[-1].strip()
    JOURNAL.write(time.time_ns(), "", end)
    while process.threads > 1:
        signal.pause()  # Python would wait for the threads of the executor
    os._exit(0)


def _end(children: Sequence[Child]) -> None:
    for child in children:
        with suppress(ProcessLookupError):
            os.kill(child.pid, signal.SIGKILL)
    for child in children:
        with suppress(ChildProcessError):
            os.waitpid(child.pid, 0)


def _receive(child: Child, deadline: float) -> Any:
    if not child.connection.poll(max(0.0, deadline - time.monotonic())):
        raise TimeoutError(child.stderr.read_text()[-500:])
    return child.connection.recv()


def _entries(case: Case, children: Sequence[Child], zero_ns: int) -> dict[str, Any]:
    """Return what a case did, as plain data."""
    entries, ends = [], []
    for number, child in enumerate(children):
        for nanoseconds, node, text in read_lines(child.journal):
            seconds = (nanoseconds - zero_ns) / 1e9
            if seconds > case.seconds:
                continue
            if node:
                entries.append([seconds, node, text])
            else:
                ends.append([number, seconds, text])
        if case.logs:
            entries += [line for line in _log_lines(child, zero_ns) if line[0] <= case.seconds]
    return {"entries": sorted(entries, key=lambda entry: entry[0]), "ends": ends}


def _log_lines(child: Child, zero_ns: int) -> Iterator[list[Any]]:
    """Yield what the loggers of a process wrote: time, name, and level and text.

    What the middleware says of its own settings, and this program, is left out.
    """
    for line in LOG.finditer(child.stderr.read_text()):
        if line["node"] != _OWN_LOGGER and not line["node"].startswith("rmw_"):
            seconds = round(float(line["stamp"]) * 1e9 - zero_ns) / 1e9
            yield [seconds, f"log {line['node']}", f"{line['level']} {line['text']}"]


def _run_wave(wave: list[tuple[Case, int]], folder: Path, watch: Watch) -> dict[str, Any]:
    """Run cases at once and return what each did, or why it says nothing."""
    children: dict[str, list[Child]] = {case.name: [] for case, _ in wave}
    try:
        for case, domain in wave:
            for number, process in enumerate(case.processes):
                children[case.name].append(_fork(number, process, domain, folder))
        return _run_forked(wave, children, watch)
    finally:
        _end([child for each in children.values() for child in each])


def _run_forked(
    wave: list[tuple[Case, int]], children: dict[str, list[Child]], watch: Watch
) -> dict[str, Any]:
    results: dict[str, Any] = {}
    deadline = time.monotonic() + 30
    ready = []
    for case, _ in wave:
        try:
            _introduce(case, children[case.name], deadline)
            ready.append(case)
        except (TimeoutError, EOFError) as error:
            results[case.name] = {"lag": None, "why": str(error)}
    zeros = {}
    begin = time.monotonic() + 0.3
    for number, case in enumerate(ready):
        zeros[case.name] = begin + number * STAGGER
        for child in children[case.name]:
            child.connection.send(zeros[case.name])
    for case in sorted(ready, key=lambda case: zeros[case.name] + case.seconds):
        zero = zeros[case.name]
        _sleep_until(zero + case.seconds + 0.1)
        zero_ns = time.time_ns() - time.monotonic_ns() + round(zero * 1e9)
        late = [c.connection.recv() for c in children[case.name] if c.connection.poll(0)]
        results[case.name] = _entries(case, children[case.name], zero_ns)
        results[case.name]["lag"] = max(late, default=0.0)
        results[case.name]["stderr"] = [one.stderr.read_text() for one in children[case.name]]
        _end(children[case.name])
    for case in ready:
        lag = watch.lag(zeros[case.name] - 0.1, zeros[case.name] + case.seconds)
        results[case.name]["lag"] = max(results[case.name]["lag"], lag)
    return results


def _introduce(case: Case, children: Sequence[Child], deadline: float) -> None:
    """Wait until all processes of a case have found each other.

    Raises:
        TimeoutError: If they have not until the deadline.
        EOFError: If one of them has ended.
    """
    endpoints = [_receive(child, deadline) for child in children]
    everyone = {kind: [name for each in endpoints for name in each[kind]] for kind in endpoints[0]}
    for child in children:
        child.connection.send((everyone, case.misfits))
    for child in children:
        _receive(child, deadline)


def _waves(cases: list[Case], domains: list[int]) -> Iterator[list[tuple[Case, int]]]:
    """Return which cases run together: those that take about as long."""
    rest = sorted(cases, key=lambda case: -case.seconds)
    while rest:
        wave: list[Case] = []
        processes = 0
        for case in list(rest):
            fits = processes + len(case.processes) <= PROCESSES_AT_ONCE
            if (fits or not wave) and len(wave) < len(domains):
                wave.append(case)
                rest.remove(case)
                processes += len(case.processes)
        yield list(zip(wave, domains, strict=False))


def _is_valid(case: Case, result: dict[str, Any]) -> bool:
    """Return whether the machine was quick enough for a measurement to say anything."""
    return result["lag"] is not None and bool(result["lag"] <= min(case.tolerance, 0.15) / 3)


def _prepare() -> None:
    """Load what every process needs, so that each of them starts in milliseconds."""
    for kind in (Int32, BasicTypes, Fibonacci, Log, ParameterEvent):
        check_for_type_support(kind)
    rclpy.get_rmw_implementation_identifier()


def main() -> None:
    """Measure the cases that standard input names, and write what they did to standard output."""
    if any(name.partition(".")[0] == "rosbeat" for name in sys.modules):
        raise RuntimeError("rosbeat patches rclpy, so it must not be imported here")
    order = json.load(sys.stdin)
    _prepare()
    give_up = time.monotonic() + order["deadline"]
    results: dict[str, Any] = {}
    with tempfile.TemporaryDirectory(prefix="conformance-") as name:
        folder = Path(name)
        journals = folder / "journals"
        journals.mkdir()
        with Watch(folder / "lag") as watch:
            rest = [CASES[name] for name in order["cases"]]
            while rest and time.monotonic() < give_up:
                for wave in _waves(rest, order["domains"]):
                    results.update(_run_wave(wave, journals, watch))
                rest = [case for case in rest if not _is_valid(case, results[case.name])]
    json.dump(results, sys.stdout)


@dataclass(frozen=True)
class Measurement:
    """What a case did as real processes.

    Attributes:
        entries: What its nodes wrote, by time.
        invalid: Why this says nothing about rclpy; empty if it does.
        stderr: What each of its processes wrote to standard error.
    """

    entries: list[Entry]
    invalid: str
    stderr: list[str]


def measure(
    cases: Sequence[Case], domains: Sequence[int], deadline: float = 90.0
) -> dict[str, Measurement]:
    """Run cases as real processes.

    Args:
        cases: The cases.
        domains: Private domain ids; so many cases run at once.
        deadline: After how many seconds nothing is measured anew.
    """
    names = [case.name for case in cases]
    order = {"cases": names, "domains": list(domains), "deadline": deadline}
    done = subprocess.run(
        [sys.executable, "-m", "conformance.real"],
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])},
        input=json.dumps(order),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        timeout=deadline + 120,
    )
    results = json.loads(done.stdout)
    return {case.name: _measurement(case, results[case.name]) for case in cases}


def _measurement(case: Case, result: dict[str, Any]) -> Measurement:
    invalid = ""
    if result["lag"] is None:
        invalid = f"its processes did not find each other: {result['why']}"
    elif not _is_valid(case, result):
        invalid = f"the machine stood still for {result['lag']:.3f} s"
    entries = [Entry(*entry) for entry in result.get("entries", [])]
    return Measurement(entries, invalid, result.get("stderr", []))


if __name__ == "__main__":
    main()

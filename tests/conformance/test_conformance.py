"""Virtual time does what rclpy's own executors do against the wall clock.

Each case and each program runs twice: as real processes (`real`, `entry_points`) and in a session
(`virtual`). The real side of all of them is measured once, in less than a minute.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, replace
from itertools import groupby, zip_longest
from statistics import median

import pytest

from conformance.cases import CASES
from conformance.entry_points import AT_ONCE as PROGRAMS_AT_ONCE
from conformance.entry_points import LINES_APART, RUNS, Line, Outcome, Run, measure_programs
from conformance.programs import Case, Entry
from conformance.real import Measurement, measure
from conformance.virtual import run_case, run_program
from rosbeat.domains import lease_domain

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(400),
    pytest.mark.skipif(sys.platform != "linux", reason="forks, and asks Linux to end children"),
]

#: Cases that have a domain, and may run at once.
CASES_AT_ONCE = 12
#: How long the start of a program may take longer, between a timer and the first log line, in
#: seconds.
START_APART = 0.6
#: How long before and after its end nothing happens in a case, in seconds.
MARGIN = 0.09


def chosen(request: pytest.FixtureRequest, function: str) -> list[str]:
    """Return the parameters of a test function that this run has selected."""
    items = (item for item in request.session.items if item.path == request.path)
    return [item.callspec.params["name"] for item in items if item.originalname == function]


@dataclass(frozen=True)
class Real:
    """What the cases and the programs did as real processes."""

    cases: dict[str, Measurement]
    programs: dict[str, Outcome | str]


@pytest.fixture(scope="module")
def real(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Real]:
    """Measure both at once: cases sleep most of the time."""
    lag = tmp_path_factory.mktemp("programs") / "lag"
    with ExitStack() as stack:
        leases = [lease_domain() for _ in range(CASES_AT_ONCE + PROGRAMS_AT_ONCE)]
        for lease in leases:
            stack.callback(lease.release)
        domains = [lease.domain_id for lease in leases]
        runs = [RUNS[name] for name in chosen(request, "test_program")]
        cases = [CASES[name] for name in chosen(request, "test_case")]
        with ThreadPoolExecutor(1) as pool:
            programs = pool.submit(measure_programs, runs, domains[CASES_AT_ONCE:], lag)
            measured = measure(cases, domains[:CASES_AT_ONCE])
            yield Real(measured, programs.result())


@pytest.mark.parametrize("name", CASES)
def test_case(name: str, real: Real) -> None:
    seconds, done = CASES[name].seconds, real.cases[name]
    virtual = run_case(replace(CASES[name], seconds=seconds + MARGIN))
    # What comes just before or after the end would be there in one of two real runs.
    assert not [one for one in virtual if one.time > seconds - MARGIN]
    if done.invalid:
        pytest.skip(f"no valid measurement before the deadline: {done.invalid}")
    differences = list(compare(CASES[name], done.entries, virtual))
    if CASES[name].differs:
        assert differences, f"There is no difference any more: {CASES[name].differs}"
    else:
        assert not differences, "\n".join([CASES[name].about, *differences, *done.stderr])


@pytest.mark.parametrize("name", RUNS)
def test_program(name: str, real: Real) -> None:
    done = real.programs[name]
    if isinstance(done, str):
        pytest.skip(f"no valid measurement before the deadline: {done}")
    virtual, moved = run_program(RUNS[name]), RUNS[name]
    offset = start_offset(moved, done, virtual)
    if moved.signal is not None and not moved.beside and offset:
        moved = replace(moved, at=moved.at - offset)  # at the same place between two timer ticks
        virtual = run_program(moved)
    if done.race:  # a session has none of them; until the signal both have done the same
        assert until_signal(moved, virtual) == until_signal(RUNS[name], done)
        return
    if RUNS[name].differs:
        same = (virtual.returncode, virtual.error) == (done.returncode, done.error)
        assert not same, f"There is no difference any more: {RUNS[name].differs}"
        return
    assert (virtual.returncode, virtual.error) == (done.returncode, done.error)
    assert virtual.frames == done.frames
    assert virtual.printed == done.printed
    assert texts(RUNS[name], virtual) == texts(RUNS[name], done)
    if not RUNS[name].beside:
        assert_close_in_time(done, virtual, offset)


def compare(case: Case, real: Sequence[Entry], virtual: Sequence[Entry]) -> Iterator[str]:
    """Yield in what two runs of a case differ."""
    if case.from_first:
        real, virtual = _from_first(real), _from_first(virtual)
    for node in sorted({entry.node for entry in (*real, *virtual)}):
        yield from _differences(
            node,
            case.tolerance,
            [entry for entry in real if entry.node == node],
            [entry for entry in virtual if entry.node == node],
        )
    if case.global_order:
        orders = [[f"{entry.node}: {entry.text}" for entry in side] for side in (real, virtual)]
        if orders[0] != orders[1]:
            yield f"order of all events\n  real:    {orders[0]}\n  virtual: {orders[1]}"


def _from_first(entries: Sequence[Entry]) -> list[Entry]:
    return [replace(entry, time=entry.time - entries[0].time) for entry in entries]


def _differences(
    node: str, tolerance: float, real: Sequence[Entry], virtual: Sequence[Entry]
) -> Iterator[str]:
    same_texts = [entry.text for entry in real] == [entry.text for entry in virtual]
    apart = max((abs(a.time - b.time) for a, b in zip(real, virtual, strict=False)), default=0.0)
    if same_texts and apart <= tolerance:
        return
    yield f"{node}: " + ("times differ" if same_texts else "events differ")
    yield f"  {'real':>40} | virtual"
    for one, other in zip_longest(real, virtual):
        left, right = (f"{e.text} {e.time:7.3f}" if e else "-" for e in (one, other))
        yield f"  {left:>40} | {right}"


def texts(run: Run, outcome: Outcome) -> dict[str, list[tuple[str, str]]]:
    """Return level and text of each node's lines."""
    found = {
        node: [(line.level, line.text) for line in lines] for node, lines in outcome.logs.items()
    }
    if run.beside:
        return {node: [line for line, _ in groupby(lines)] for node, lines in found.items()}
    return found


def until_signal(run: Run, outcome: Outcome) -> dict[str, list[tuple[str, str]]]:
    """Return level and text of each node's lines before the signal was sent."""
    logs = {
        node: [line for line in lines if line.time < run.at] for node, lines in outcome.logs.items()
    }
    return texts(run, replace(outcome, logs=logs))


def _pairs(real: Outcome, virtual: Outcome) -> Iterator[tuple[Line, Line]]:
    for node, lines in real.logs.items():
        yield from zip(lines, virtual.logs.get(node, ()), strict=False)


def start_offset(run: Run, real: Outcome, virtual: Outcome) -> float:
    """Return by how much the timers of a real program tick later than in virtual time, in seconds.

    Time zero is the first log line. A node that has made its timer needs 15 ms of a processor until
    it logs; on a busy machine that has taken 0.3 s, and the timer has counted meanwhile.
    """
    found = [a.time - b.time for a, b in _pairs(real, virtual) if 0 < a.time < run.at]
    return median(found) if found else 0.0


def assert_close_in_time(real: Outcome, virtual: Outcome, offset: float) -> None:
    assert abs(offset) <= START_APART
    apart = [
        (a.text, a.time, b.time)
        for a, b in _pairs(real, virtual)
        if min(abs(a.time - b.time), abs(a.time - b.time - offset)) > LINES_APART
    ]
    assert not apart

"""Runs the same cases in virtual time."""

from __future__ import annotations

import asyncio
import io
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout

from rclpy.node import Node

from conformance.entry_points import FOLDER, Outcome, Run, outcome_of
from conformance.programs import JOURNAL, Case, Entry, run_main
from rosbeat.ros.session import Session

#: Seconds after which a run in virtual time is interrupted; most take some hundredths.
LIMIT = 20.0
#: Seconds between two interrupts: a program may have hung while the first one ended it.
AGAIN = 2.0


@contextmanager
def _limited() -> Iterator[None]:
    """Press Ctrl+C until this block ends, if it takes too long.

    A program that never gives the loop of the session back would hold up all tests that follow.

    Raises:
        TimeoutError: If it has taken too long.
    """
    main, ended = threading.get_ident(), threading.Event()
    pressed = False

    def interrupt() -> None:
        nonlocal pressed
        wait = LIMIT
        while not ended.wait(wait):
            pressed, wait = True, AGAIN
            signal.pthread_kill(main, signal.SIGINT)

    watcher = threading.Thread(target=interrupt, daemon=True)
    watcher.start()
    try:
        yield
    except KeyboardInterrupt:
        if not pressed:
            raise
    finally:
        ended.set()
        watcher.join()
    if pressed:
        raise TimeoutError(f"the session did not go on for {LIMIT:g} s")


def run_case(case: Case) -> list[Entry]:
    """Run a case in a session and return what its nodes wrote, in order."""

    async def run_in_loop() -> list[Entry]:
        return _run_case(case)

    with _limited():
        return asyncio.run(run_in_loop()) if case.in_kernel else _run_case(case)


def _run_case(case: Case) -> list[Entry]:
    JOURNAL.entries.clear()
    now = 0.0
    processes = list(enumerate(case.processes))
    with Session(seed=1) as ros:
        begin_ns = _clock_of(ros)
        JOURNAL.now = lambda: begin_ns + round(ros.time * 1e9)
        for number, process in sorted(processes, key=lambda pair: pair[1].start):
            ros.run(process.start - now, quiet=True)
            now = process.start
            if process.main is not None:
                ros.spawn(_observed(number, process.main))
            elif process.threads > 1:
                ros.add(*process.nodes, threads=process.threads)
            else:
                ros.add(*process.nodes)
        ros.run(case.seconds - now, quiet=True)
        entries = [Entry((ns - begin_ns) / 1e9, node, text) for ns, node, text in JOURNAL.entries]
        if case.logs:
            entries += [
                Entry(line.time, f"log {line.name}", f"{line.level} {line.text}")
                for line in ros.logs()
            ]
    # The clock of a real process is late: what is due at the very end is not seen there.
    return [entry for entry in entries if entry.time < case.seconds - 1e-6]


def _observed(number: int, main: Callable[[], None]) -> Callable[[], None]:
    def observed_main() -> None:
        run_main(number, main)

    return observed_main


def _clock_of(ros: Session) -> int:
    """Return what the clock of a node shows now, in nanoseconds."""
    node = ros.add(lambda: Node("scout", start_parameter_services=False, enable_rosout=False))
    now: int = node.get_clock().now().nanoseconds
    ros.remove(node)
    return now


def run_program(run: Run) -> Outcome:
    """Run a program as a simulated process and return how it ended."""
    printed = io.StringIO()
    with _limited(), Session(seed=1) as ros, redirect_stdout(printed):
        for other in run.beside:
            ros.spawn(str(FOLDER / other))
        program = ros.spawn(str(FOLDER / run.file), *run.arguments)
        ros.run(run.first_line + run.at, quiet=True)
        if run.signal is not None:
            assert program.returncode is None, program.stderr
            program.send_signal(run.signal)
        ros.run(3.0, quiet=True)
        logs = [(line.time, line.level, line.name, line.text) for line in ros.logs()]
        # A session prints log lines and what the programs print into one stream.
        lines = printed.getvalue().splitlines(keepends=True)
        own = "".join(
            line
            for line in lines
            if not line.startswith(("[DEBUG]", "[INFO]", "[WARN]", "rosbeat:"))
        )
        return outcome_of(program.returncode, own, program.stderr, logs)

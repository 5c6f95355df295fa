"""Runs the same cases in virtual time."""

from __future__ import annotations

import io
from contextlib import redirect_stdout

from conformance.entry_points import FOLDER, Outcome, Run, outcome_of
from conformance.programs import JOURNAL, Case, Entry
from rosbeat import Session


def run_case(case: Case) -> list[Entry]:
    """Run a case in a session and return what its nodes wrote, in order."""
    JOURNAL.entries.clear()
    now = 0.0
    with Session(seed=1) as ros:
        for process in sorted(case.processes, key=lambda process: process.start):
            ros.run(process.start - now, quiet=True)
            now = process.start
            if process.main is not None:
                ros.spawn(process.main)
            elif process.threads > 1:
                ros.add(*process.nodes, threads=process.threads)
            else:
                ros.add(*process.nodes)
        ros.run(case.seconds - now, quiet=True)
        # A session's clock begins at zero.
        entries = [Entry(ns / 1e9, node, text) for ns, node, text in JOURNAL.entries]
    # The clock of a real process is late: what is due at the very end is not seen there.
    return [entry for entry in entries if entry.time < case.seconds - 1e-6]


def run_program(run: Run) -> Outcome:
    """Run a program as a simulated process and return how it ended."""
    printed = io.StringIO()
    with Session(seed=1) as ros, redirect_stdout(printed):
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
            line for line in lines if not line.startswith(("[INFO]", "[WARN]", "rosbeat:"))
        )
        return outcome_of(program.returncode, own, program.stderr, logs)

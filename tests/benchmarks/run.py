"""All benchmarks, in one table. Called by `./environment/course bench`; `--quick` takes a minute.

Ratios are what counts: both sides of each are measured in this run, in turns. A missed target is
shown and does not change the exit code, which is 0 unless a benchmark breaks.
"""

from __future__ import annotations

import argparse
import os
import platform
import time
from functools import partial

import checks
import class_on_a_hub
import commands
import endings
import grading
import growth
import live_mode
import memory
import panel
import scaling
import sessions
import simulation
import terminals
import throughput
from measuring import Row, table

BENCHMARKS = {
    "throughput": throughput.measure,
    "simulation": simulation.measure,
    "live": live_mode.measure,
    "memory": memory.measure,
    "sessions": sessions.measure,
    "panel": panel.measure,
    "scaling": scaling.measure,
    "commands": commands.measure,
    "terminals": terminals.measure,
    "endings": endings.measure,
    "checks": checks.measure,
    "grading": partial(grading.measure, 30),
    "grading-120": partial(grading.measure, 120),
    "growth": growth.measure,
}
#: Those that run only when they are named: a hub needs root, and minutes.
NAMED = {"hub": class_on_a_hub.measure}


def main() -> None:
    """Run what was asked for and print the table."""
    known = {**BENCHMARKS, **NAMED}
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer repeats, for a first look")
    parser.add_argument("names", nargs="*", metavar="name", help=f"of {', '.join(known)}")
    options = parser.parse_args()
    for name in options.names:
        if name not in known:
            parser.error(f"there is no benchmark {name}; there are {', '.join(known)}")
    begin = time.monotonic()
    rows: list[Row] = []
    for name in options.names or BENCHMARKS:
        print(f"{name} ...", flush=True)
        rows += known[name](options.quick)
    print(f"\n{table(rows)}\n")
    missed = sum(bool(row.target) and not row.met for row in rows)
    print(f"{missed} targets missed; {time.monotonic() - begin:.0f} s; {_machine()}")


def _machine() -> str:
    load = os.getloadavg()[0]
    return f"Python {platform.python_version()}, {os.cpu_count()} cores, load {load:.1f}"


if __name__ == "__main__":
    main()

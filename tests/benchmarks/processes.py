"""What a whole process costs: wall time, processor time, and the part that went into imports."""

from __future__ import annotations

import os
import re
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

#: A line of `python -X importtime`: microseconds of the module itself, then with all below it.
_IMPORT = re.compile(r"import time:\s+(\d+) \|")


@dataclass(frozen=True)
class Cost:
    """One process, and those that it started and waited for.

    Attributes:
        wall: Seconds from start to end.
        cpu: Seconds of processor time, user and system.
        code: The exit code.
        out: Its standard output.
        error: Its standard error.
    """

    wall: float
    cpu: float
    code: int
    out: str
    error: str


def cost(words: Sequence[str], environ: Mapping[str, str], folder: Path | None = None) -> Cost:
    """Run a process to its end."""
    begin = time.perf_counter()
    process = subprocess.Popen(
        words, env=environ, cwd=folder, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    out, error = process.stdout.read(), process.stderr.read()  # type: ignore[union-attr]
    _, status, used = os.wait4(process.pid, 0)  # before Popen does: only this tells the usage
    process.returncode = os.waitstatus_to_exitcode(status)
    wall = time.perf_counter() - begin
    for pipe in (process.stdout, process.stderr):
        pipe.close()  # type: ignore[union-attr]
    return Cost(wall, used.ru_utime + used.ru_stime, process.returncode, out, error)


def seconds_in_imports(words: Sequence[str], environ: Mapping[str, str], folder: Path) -> float:
    """Run Python code once, and add up what each of its imports took by itself.

    Args:
        words: A command line that begins with the Python to use.
        environ: Its environment.
        folder: Where to run it.
    """
    told = cost([words[0], "-X", "importtime", *words[1:]], environ, folder).error
    return sum(map(int, _IMPORT.findall(told))) / 1e6


def at_95_percent(values: Sequence[float]) -> float:
    """The value that 95 of 100 do not exceed."""
    return sorted(values)[int(0.95 * (len(values) - 1))]


def shown(costs: Sequence[Cost], imports: float | None = None) -> str:
    """Medians as text, in seconds."""
    wall, cpu = median(one.wall for one in costs), median(one.cpu for one in costs)
    tail = "" if imports is None else f", imports {imports:.2f}"
    return f"{wall:.2f} s wall, {cpu:.2f} cpu{tail}"

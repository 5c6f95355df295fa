"""Measuring several ways of doing one thing in one run, turn by turn."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import psutil

#: Where the environment's own programs are.
PROGRAMS = Path(sys.executable).parent
MB = 1_000_000
#: Seconds between two looks at the memory.
_LOOK = 0.25


@dataclass(frozen=True)
class Row:
    """One line of the table.

    Attributes:
        what: What was measured.
        value: The result, with its unit.
        ratio: Against what, and how much.
        target: What is wanted of it, or an empty string.
        met: Whether it is as wanted.
    """

    what: str
    value: str
    ratio: str = ""
    target: str = ""
    met: bool = True


def interleaved(ways: Mapping[str, Callable[[], None]], repeats: int) -> dict[str, float]:
    """Median seconds of each way; they take turns, so that a disturbance hits all alike."""
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(repeats + 1):
        for name, way in ways.items():
            begin = time.perf_counter()
            way()
            times[name].append(time.perf_counter() - begin)
    return {name: median(spans[1:]) for name, spans in times.items()}  # the first turn warms up


@dataclass(frozen=True)
class Use:
    """Say what a command has used.

    Attributes:
        seconds: From its start to its end.
        memory: Bytes at most, of the command and all processes below it together. Counted are their
            proportional shares (PSS): a page that several of them share counts once. It is looked
            at four times a second.
    """

    seconds: float
    memory: int


def use_of(command: Sequence[str | Path], folder: Path) -> Use:
    """Run a command of the environment in a folder, and return what it has used.

    Args:
        command: Its name and what is typed behind it.
        folder: Where it runs. What it prints goes into the file `said.txt` there.

    Raises:
        RuntimeError: If it fails.
    """
    path = os.pathsep.join([str(PROGRAMS), os.environ.get("PATH", "")])
    begin = time.perf_counter()
    with (folder / "said.txt").open("wb") as said:
        process = subprocess.Popen(
            [PROGRAMS / command[0], *command[1:]],
            cwd=folder,
            env={**os.environ, "PATH": path},
            stdout=said,
            stderr=said,
        )
        memory = _watched(process)
    seconds = time.perf_counter() - begin
    if process.returncode:
        typed, told = " ".join(map(str, command)), (folder / "said.txt").read_text()
        raise RuntimeError(f"{typed} ended with {process.returncode}:\n{told[-3000:]}")
    return Use(seconds, memory)


def _watched(process: subprocess.Popen[bytes]) -> int:
    """Wait for a command, and return the bytes of memory that it had at most."""
    most = 0
    while True:
        try:
            process.wait(_LOOK)
        except subprocess.TimeoutExpired:
            most = max(most, _pss(process.pid))
        else:
            return most


def _pss(pid: int) -> int:
    """Return the memory of a process and of all below it; what they share is divided among them."""
    total = 0
    try:
        parent = psutil.Process(pid)
        family = [parent, *parent.children(recursive=True)]
    except psutil.Error:
        return 0
    for one in family:
        try:
            total += one.memory_full_info().pss
        except (psutil.Error, OSError):
            continue  # it has just ended
    return total


def table(rows: list[Row]) -> str:
    """The rows as text, in columns."""
    cells = [("", "measured", "ratio", "target", "")]
    cells += [(r.what, r.value, r.ratio, r.target, _verdict(r)) for r in rows]
    widths = [max(len(row[column]) for row in cells) for column in range(5)]
    lines = [
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True))
        for row in cells
    ]
    return "\n".join(line.rstrip() for line in lines)


def _verdict(row: Row) -> str:
    return "" if not row.target else "met" if row.met else "MISSED"

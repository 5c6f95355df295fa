"""What a session prints in the cell that ran it.

Log lines look as `ros2 run` prints them, with virtual time where wall time would stand, so that a
page prints the same text on every run.
"""

from __future__ import annotations

import sys

from rosbeat.diagnosis.faults import first_sentence, meaning_of
from rosbeat.errors import RosbeatError
from rosbeat.records import Fault, LogRecord

#: Log lines printed for one call of `run`; the rest is counted and stays in `logs()`.
MOST_LINES = 100


def seconds_text(time_ns: int) -> str:
    """Nanoseconds as seconds, cut to three decimals."""
    whole, rest = divmod(time_ns, 1_000_000_000)
    return f"{whole}.{rest // 1_000_000:03d}"


def log_text(record: LogRecord) -> str:
    """One log line: level, time in seconds, logger, message."""
    return f"[{record.level}] [{seconds_text(record.time_ns)}] [{record.name}]: {record.text}"


_ENDS = (
    "n exception that leaves a callback ends its node, as it would end the node's process. The "
    "other nodes go on."
)
_GIVES_UP = (
    "n exception in the work on a goal aborts that goal: the client gets an empty result. The node "
    "goes on."
)
_MEANS = "\n  What it means: "
_AGAIN = "run the cell that adds the node again."


def fault_text(fault: Fault) -> str:
    """An exception in a callback, in three parts."""
    where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
    # An error of our own says what it means itself.
    known = None if _MEANS in fault.text else meaning_of(fault)
    return (
        f"{fault.node} stopped at {seconds_text(fault.time_ns)} s, in {fault.callback}: "
        f"{fault.kind}: {first_sentence(fault.text) if known else fault.text}{where}\n"
        f"  What it means: {f'{known.beside_error} A' if known else 'a'}{_ENDS}\n"
        f"  What to try:   {f'{known.to_try} Then ' if known else 'mend that line, then '}{_AGAIN}"
    )


def work_text(fault: Fault) -> str:
    """An exception in the work on a goal, in three parts."""
    where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
    known = None if _MEANS in fault.text else meaning_of(fault)
    return (
        f"{fault.node} gave a goal up at {seconds_text(fault.time_ns)} s, in {fault.callback}: "
        f"{fault.kind}: {first_sentence(fault.text) if known else fault.text}{where}\n"
        f"  What it means: {f'{known.beside_error} A' if known else 'a'}{_GIVES_UP}\n"
        f"  What to try:   {f'{known.to_try} Then ' if known else 'mend that line, then '}{_AGAIN}"
    )


class Console:
    """Prints log lines as they come, up to a limit for each call of `run`.

    Args:
        quiet: Print no log lines at all.
    """

    def __init__(self, quiet: bool = False) -> None:
        self._quiet = quiet
        self._printed = 0
        self._held_back = 0

    def begin(self, quiet: bool = False) -> None:
        """Count anew, for the next call of `run`."""
        self._quiet, self._printed, self._held_back = quiet, 0, 0

    def log(self, record: LogRecord) -> None:
        """Print one log line, unless the limit is reached."""
        if self._quiet:
            return
        if self._printed >= MOST_LINES:
            self._held_back += 1
            return
        self._printed += 1
        print(log_text(record))

    def fault(self, fault: Fault) -> None:
        """Print an exception that left a callback."""
        print(fault_text(fault), file=sys.stderr)

    def work(self, fault: Fault) -> None:
        """Print an exception that left the work on a goal."""
        print(work_text(fault), file=sys.stderr)

    def deadlock(self, fault: Fault, error: RosbeatError) -> None:
        """Print that a callback waits for ever."""
        where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
        print(
            f"{error.what}{where}\n  What it means: {error.means}\n  What to try:   {error.to_try}",
            file=sys.stderr,
        )

    def end(self) -> None:
        """Say how many lines were not printed."""
        if self._held_back:
            print(f"... and {self._held_back} more lines; logs() has them all.")
            self._held_back = 0


def note(text: str) -> None:
    """Tell the learner something that is not an error."""
    print(f"rosbeat: {text}")

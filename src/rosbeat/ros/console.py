"""Print a session's log lines and faults in the cell that ran it.

Log lines have the format of `ros2 run`, with virtual time instead of wall time, so that a page
prints the same text on every run.
"""

from __future__ import annotations

from rosbeat.diagnosis.exceptions import first_sentence, meaning_of
from rosbeat.errors import RosbeatError
from rosbeat.records import Fault, LogRecord

#: Log lines printed for one call of `run`; the rest is counted and stays in `logs()`.
MOST_LINES = 100

_NODE_ENDS = (
    "n uncaught exception in a callback ends its node, as it would end the node's process. The "
    "other nodes keep running."
)
_GOAL_ENDS = (
    "n uncaught exception in an execute callback aborts its goal, and the client gets an empty "
    "result. The node keeps running."
)
_MEANS = "\n  What it means: "


def seconds_text(time_ns: int) -> str:
    """Format nanoseconds as seconds, cut to three decimals."""
    whole, rest = divmod(time_ns, 1_000_000_000)
    return f"{whole}.{rest // 1_000_000:03d}"


def log_text(record: LogRecord) -> str:
    """Format a log line: level, time in seconds, logger, message."""
    return f"[{record.level}] [{seconds_text(record.time_ns)}] [{record.name}]: {record.text}"


def fault_text(fault: Fault, event: str = "stopped", outcome: str = _NODE_ENDS) -> str:
    """Format an exception in a callback, in three parts."""
    # An error of our own says what it means itself.
    known = None if _MEANS in fault.text else meaning_of(fault)
    text = first_sentence(fault.text) if known else fault.text
    time = seconds_text(fault.time_ns)
    return _three_parts(
        f"{fault.node} {event} at {time} s, in {fault.callback}: {fault.kind}: {text}",
        fault,
        f"{known.evidence} A{outcome}" if known else f"a{outcome}",
        f"{known.hint if known else 'correct that line,'} {'Then' if known else 'then'} run "
        "the cell that adds the node again.",
    )


def work_text(fault: Fault) -> str:
    """Format an exception in the work on a goal, in three parts."""
    return fault_text(fault, "aborted a goal", _GOAL_ENDS)


def deadlock_text(fault: Fault, error: RosbeatError) -> str:
    """Format that a callback waits for ever, in three parts."""
    return _three_parts(error.what, fault, error.means, error.to_try)


def _three_parts(what: str, fault: Fault, means: str, to_try: str) -> str:
    where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
    return f"{what}{where}{_MEANS}{means}\n  What to try:   {to_try}"


class Console:
    """Print log lines as they come, up to a limit for each call of `run`."""

    def __init__(self) -> None:
        self.begin()

    def begin(self, quiet: bool = False) -> None:
        """Count anew, for the next call of `run`; print no log lines if it is `quiet`."""
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

    def end(self) -> None:
        """Say how many lines were not printed."""
        if self._held_back:
            print(f"... and {self._held_back} more lines; logs() has them all.")
            self._held_back = 0


def note(text: str) -> None:
    """Tell the learner something that is not an error."""
    print(f"rosbeat: {text}")

"""Lines of a terminal that ROS's logging wrote, as records."""

from __future__ import annotations

import re
from collections.abc import Iterable

from rosbeat.records import LogRecord
from rosbeat.workspace.terminals.history import Line

_LOG = re.compile(
    r"\[(?P<level>DEBUG|INFO|WARN|ERROR|FATAL)\] "
    r"(?:\[(?P<seconds>\d+)\.(?P<fraction>\d{1,9})\] )?"
    r"\[(?P<name>[^\]]+)\]: (?P<text>.*)"
)


def log_records(lines: Iterable[Line]) -> tuple[LogRecord, ...]:
    """Return a record for every line that is one of ROS's, in order.

    Args:
        lines: Lines of a terminal. One without a stamp gets the moment at which it was read.
    """
    matches = ((line, _LOG.match(line.text)) for line in lines if not line.typed)
    return tuple(_record(line, match) for line, match in matches if match)


def _record(line: Line, match: re.Match[str]) -> LogRecord:
    when = line.time_ns
    if match["seconds"]:
        when = int(match["seconds"]) * 10**9 + int(match["fraction"].ljust(9, "0"))
    return LogRecord(when, match["level"], match["name"], match["text"], "", 0)

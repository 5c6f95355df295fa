"""What crossed between two processes, in words."""

from __future__ import annotations

from collections.abc import Iterable

from rosbeat.records import LogRecord
from rosbeat.viz.pairs import Pairs
from rosbeat.viz.words import count, listing

#: What stands for a process that logged nothing.
SILENT = "the receiver"


def name_of(records: Iterable[LogRecord]) -> str:
    """Who logged these lines: one name, or several if a process has several nodes."""
    return listing(dict.fromkeys(one.name for one in records)) or SILENT


def describe(shown: Pairs, sender: str, receiver: str) -> str:
    """The picture in whole sentences, without times."""
    said = [f"{sender} sent {count(len(shown.sent), 'message')}: {sums(shown, receiver)}."]
    if shown.early and shown.arrived:
        number = len(shown.early)
        which = "The first one" if number == 1 else f"The first {number}"
        said.append(f"{which} {_was(number)} sent before anything arrived.")
    if shown.strange:
        said.append(
            f"{count(len(shown.strange), 'line')} of {receiver} "
            f"{'has' if len(shown.strange) == 1 else 'have'} a number that {sender} did not log."
        )
    return " ".join([*said, left_out(shown)]).strip()


def sums(shown: Pairs, receiver: str) -> str:
    """What became of the messages: how many arrived, how many were lost."""
    parts = [f"{_all(shown)} arrived at {receiver}"]
    lost, late = len(shown.lost), len(shown.late)
    parts.append(f"{lost or 'none'} {_was(lost or 1)} lost")
    if late:
        parts.append(f"{late} {_was(late)} sent after its last line")
    return listing(parts)


def left_out(shown: Pairs) -> str:
    """What the picture does not show, or an empty string."""
    if not shown.skipped:
        return ""
    verb = "is" if shown.skipped == 1 else "are"
    return f"{count(shown.skipped, 'later message')} {verb} not shown."


def _all(shown: Pairs) -> str:
    arrived = len(shown.arrived)
    return "all" if arrived == len(shown.sent) > 1 else str(arrived or "none")


def _was(number: int) -> str:
    return "was" if number == 1 else "were"

"""Which lines of two logs tell of the same message. Pure functions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.records import NANOSECONDS, LogRecord

#: More messages than this cannot be told apart in one picture.
MOST = 60
#: A publisher may log after it has published, so the other side may have logged before; and a time
#: may be that of reading the line, which is late when the machine is busy.
_HASTE_NS = 2 * NANOSECONDS
# Not the 2 of `sensor2`; the unit may follow without a space, as in 22.13C.
_NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?")


@dataclass(frozen=True)
class Line:
    """A log line with a number in it.

    Attributes:
        time_ns: When it was logged, in nanoseconds.
        words: The number as it was written.
        partner: Place of the line of the same message in the other log, or None.
    """

    time_ns: int
    words: str
    partner: int | None = None

    @property
    def value(self) -> float:
        """The number."""
        return float(self.words.replace("−", "-"))


@dataclass(frozen=True)
class Pairs:
    """Two logs, side by side.

    Attributes:
        sent: Lines of the sender that carry a number, in order.
        received: Lines of the receiver that carry a number, in order.
        skipped: How many later lines of the sender are left out.
    """

    sent: tuple[Line, ...]
    received: tuple[Line, ...]
    skipped: int = 0

    @property
    def arrived(self) -> tuple[Line, ...]:
        """What was sent and received."""
        return tuple(line for line in self.sent if line.partner is not None)

    @property
    def early(self) -> tuple[Line, ...]:
        """What was lost before anything arrived."""
        first = next((rank for rank, line in enumerate(self.sent) if line in self.arrived), None)
        return self.lost if first is None else self.sent[:first]

    @property
    def late(self) -> tuple[Line, ...]:
        """What was sent after the receiver's last line: whether it arrived, nobody can say."""
        last = max((line.time_ns for line in self.received), default=None)
        missing = (line for line in self.sent if line.partner is None)
        return tuple(line for line in missing if last is not None and line.time_ns > last)

    @property
    def lost(self) -> tuple[Line, ...]:
        """What was sent while the receiver was there or not yet there, and not received."""
        late = self.late
        missing = (line for line in self.sent if line.partner is None)
        return tuple(line for line in missing if line not in late)

    @property
    def strange(self) -> tuple[Line, ...]:
        """What was received although the sender's lines do not have it."""
        return tuple(line for line in self.received if line.partner is None)


def pairs(sent: Sequence[LogRecord], received: Sequence[LogRecord]) -> Pairs:
    """Pair the lines that carry the same number, in order, as many as possible.

    The number is the first one in the text. If there is a choice, lines close in time are paired.

    Args:
        sent: What the sender logged.
        received: What the receiver logged.
    """
    every, others = _numbered(sent), _numbered(received)
    here = every[:MOST]
    if len(every) > MOST:
        others = [line for line in others if line.time_ns < every[MOST].time_ns]
    there = others[: 2 * MOST]
    links = _links(here, there)
    back = {target: source for source, target in links.items()}
    return Pairs(
        tuple(Line(one.time_ns, one.words, links.get(rank)) for rank, one in enumerate(here)),
        tuple(Line(one.time_ns, one.words, back.get(rank)) for rank, one in enumerate(there)),
        len(every) - len(here),
    )


def first_number(text: str) -> str:
    """The first number in a text as it is written there, or an empty string."""
    found = _NUMBER.search(text)
    return found.group() if found else ""


def _numbered(records: Sequence[LogRecord]) -> list[Line]:
    found = ((one, first_number(one.text)) for one in records)
    return sorted((Line(one.time_ns, words) for one, words in found if words), key=_time)


def _time(line: Line) -> int:
    return line.time_ns


def _links(here: Sequence[Line], there: Sequence[Line]) -> dict[int, int]:
    """The longest common subsequence; among those the one with the least time in between."""
    # best[i][j]: the pairs among here[i:] and there[j:], and minus the time between them.
    best = [[(0, 0)] * (len(there) + 1) for _ in range(len(here) + 1)]
    for i in reversed(range(len(here))):
        for j in reversed(range(len(there))):
            choices = [best[i + 1][j], best[i][j + 1]]
            if _same(here[i], there[j]):
                choices.append(_plus(best[i + 1][j + 1], here[i], there[j]))
            best[i][j] = max(choices)
    return _walk(best, here, there)


def _same(one: Line, other: Line) -> bool:
    return one.value == other.value and other.time_ns >= one.time_ns - _HASTE_NS


def _plus(rest: tuple[int, int], one: Line, other: Line) -> tuple[int, int]:
    return rest[0] + 1, rest[1] - abs(other.time_ns - one.time_ns)


def _walk(
    best: list[list[tuple[int, int]]], here: Sequence[Line], there: Sequence[Line]
) -> dict[int, int]:
    links: dict[int, int] = {}
    i = j = 0
    while i < len(here) and j < len(there):
        if best[i][j] == best[i + 1][j]:
            i += 1
        elif best[i][j] == best[i][j + 1]:
            j += 1
        else:
            links[i] = j
            i, j = i + 1, j + 1
    return links

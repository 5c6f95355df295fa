"""How many ROS processes of a domain run on this machine, by the ports they hold.

Each participant of DDS listens on a UDP port that follows from the domain and from its number on
the machine: 7400 + 250 * domain + 10 + 2 * number (RTPS specification, section 9.6.1). Counting
those ports says how many processes there are to discover, before any of them has answered.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

_TABLES = ("/proc/net/udp", "/proc/net/udp6")


def domain_id() -> int:
    """The domain of this process."""
    return int(os.environ.get("ROS_DOMAIN_ID") or 0)


def only_this_machine() -> bool:
    """Whether processes of other machines are out of reach anyway."""
    return os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() in ("LOCALHOST", "OFF")


def count_participants(domain: int, tables: str | None = None) -> int:
    """The number of participants on this machine; 0 where that cannot be known.

    Args:
        domain: The domain's id.
        tables: The text of the system's tables of UDP sockets, read from the system by default.
    """
    text = _read_tables() if tables is None else tables
    fields = [line.split() for line in text.splitlines()]
    ports = {
        int(row[1].rpartition(":")[2], 16) for row in fields if row[:1] and row[0][:1].isdigit()
    }
    base = 7400 + 250 * domain
    return len(ports & set(range(base + 10, base + 250, 2)))


def _read_tables() -> str:
    text = ""
    for name in _TABLES:
        with suppress(OSError):
            text += Path(name).read_text(encoding="ascii")
    return text

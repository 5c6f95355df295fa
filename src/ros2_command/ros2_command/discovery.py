"""Detect processes and endpoints that must exist but have not been discovered yet.

Fast DDS numbers the endpoints of a process 1, 2, 3 and so on, publishers and subscriptions in one
sequence, and announces the two kinds in two separate streams. When one stream lags behind, as it
does when the machine is busy, numbers are missing in between. Destroyed endpoints leave such gaps
forever, so a gap is a reason to wait for a short time only.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

#: Bytes of an endpoint's address (GID): that of its process, then its number, then its kind.
PROCESS = slice(0, 12)
_NUMBER = slice(12, 15)
_TABLES = ("/proc/net/udp", "/proc/net/udp6")


def has_gaps(addresses: Iterable[bytes]) -> bool:
    """Return whether some process lacks an endpoint with a number below a known one.

    Args:
        addresses: The GIDs of all known endpoints.
    """
    numbers: defaultdict[bytes, set[int]] = defaultdict(set)
    for address in addresses:
        numbers[address[PROCESS]].add(int.from_bytes(address[_NUMBER], "big"))
    return any(len(known) < max(known) for known in numbers.values())


def domain_id() -> int:
    """Return the domain of this process."""
    return int(os.environ.get("ROS_DOMAIN_ID") or 0)


def only_this_machine() -> bool:
    """Return whether processes of other machines are out of reach anyway."""
    return os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() in ("LOCALHOST", "OFF")


def count_participants(domain: int, tables: str | None = None) -> int:
    """Count the ROS processes on this machine, before any of them has answered.

    Each participant of DDS listens on two UDP ports that follow from the domain and from its number
    on the machine: 7400 + 250 * domain + 10 + 2 * number, and the next one (RTPS specification,
    section 9.6.1). One of them alone, or each with another user, is a socket of another program.

    Args:
        domain: The domain's id.
        tables: The text of the system's tables of UDP sockets, read from the system by default.

    Returns:
        The number, or 0 where that cannot be known.
    """
    text = _read_tables() if tables is None else tables
    fields = [line.split() for line in text.splitlines()]
    ports = {  # each with the number of the user
        (int(row[1].rpartition(":")[2], 16), row[7])
        for row in fields
        if len(row) > 7 and row[0][0].isdigit()
    }
    first = 7400 + 250 * domain + 10
    numbers = range(first, first + 240, 2)
    return sum(port in numbers and (port + 1, user) in ports for port, user in ports)


def _read_tables() -> str:
    text = ""
    for name in _TABLES:
        with suppress(OSError):
            text += Path(name).read_text(encoding="ascii")
    return text

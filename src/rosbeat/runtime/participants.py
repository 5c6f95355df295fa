"""Which ROS domains somebody of this machine takes part in, by the ports that are held.

Each participant of DDS listens on two UDP ports that follow from the domain and from its number on
the machine: 7400 + 250 * domain + 10 + 2 * number for discovery, and the next one for data (RTPS
specification, section 9.6.1). So they can be counted before any of them has answered.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

_TABLES = ("/proc/net/udp", "/proc/net/udp6")
_OPEN_FILES = Path("/proc/self/fd")
#: Domains whose ports Linux does not hand out by itself.
_DOMAINS = range(102)
#: In the system's table: the local address with its port, and the socket's number.
_ADDRESS, _INODE = 1, 9


def count_participants(domain_id: int, table: str | None = None) -> int:
    """How many participants of this machine are in a domain; 0 where that cannot be known.

    Args:
        domain_id: The domain.
        table: The text of the system's table of UDP sockets, read from the system by default.
    """
    ports = set(_ports(_read() if table is None else table))
    return len(_participants(domain_id, ports))


def domains_in_use(table: str | None = None, own: Iterable[str] | None = None) -> list[int]:
    """The domains in which a process other than this one takes part, ascending.

    Args:
        table: The text of the system's table of UDP sockets, read from the system by default.
        own: Numbers of sockets that do not count, by default those of this process.
    """
    skipped = _own_sockets() if own is None else frozenset(own)
    ports = set(_ports(_read() if table is None else table, skipped))
    return [number for number in _DOMAINS if _participants(number, ports)]


def _participants(domain_id: int, ports: set[int]) -> list[int]:
    first = 7400 + 250 * domain_id + 10
    # Both ports: another program may hold one of them by chance.
    return [port for port in range(first, first + 240, 2) if {port, port + 1} <= ports]


def _ports(table: str, skipped: frozenset[str] = frozenset()) -> list[int]:
    rows = [line.split() for line in table.splitlines()]
    return [
        int(row[_ADDRESS].rpartition(":")[2], 16)
        for row in rows
        if len(row) > _INODE and row[0][:1].isdigit() and row[_INODE] not in skipped
    ]


def _read() -> str:
    text = ""
    for name in _TABLES:
        with suppress(OSError):
            text += Path(name).read_text(encoding="ascii")
    return text


def _own_sockets() -> frozenset[str]:
    found = set()
    with suppress(OSError):
        for one in _OPEN_FILES.iterdir():
            with suppress(OSError):  # closed meanwhile
                target = os.readlink(one)
                if target.startswith("socket:["):
                    found.add(target[len("socket:[") : -1])
    return frozenset(found)

"""Lease ROS domain ids, for programs of checks and for terminals.

Two participants of DDS talk if their domain ids are equal. Whoever holds a leased id holds the TCP
port with the number of that domain's UDP discovery port, 7400 + 250 * id (RTPS specification,
section 9.6.1). The operating system keeps a port for its holder, in the same network namespace that
DDS traffic stays in, and takes it back when the process ends, however it ends. A node that outlives
the process that held the id still speaks in that domain, so an id is given out only if no process
of anybody else is a participant.

**Programs of a check or a build** get an id from 51 to 101 (`lease_domain`), one holder each.

**Terminals** have one id per user and checkout (`lease_terminal_domain`). Jupyter servers, kernels
and shells hold it together: Linux lets several sockets have one port (SO_REUSEPORT), if all belong
to the same user. A file in the user's home names the id of each checkout
(`environment.leased_domains`): a server gets back the id that it had, and a Python that holds no
lease uses it, too. The file is a memory only; the sockets decide what is taken.

The first choice is the usual id of a user and checkout, from 1 to 50, so on a computer with one
user all Pythons agree, whether they hold a lease or not. If it is taken, the next ones are 1 to 50,
102 to 214 and 51 to 87: 200 in all. From 102 on, the ports of DDS are among those that Linux hands
out to any program, 32768 to 60999 (ROS 2 documentation, "The ROS_DOMAIN_ID"). If one of them is
taken, Fast DDS goes on to the next of 32 participant numbers; and a participant is told from other
sockets by its two neighbouring ports of one user. `tests/benchmarks/terminals.py` measures both
ranges. A profile with ports of its own for each user, or partitions, would offer more domains, but
ROS_DOMAIN_ID alone would no longer say which nodes of the machine meet.

**A private session** needs no id of its own: its context is made with discovery off
(`rosbeat.ros.context`), and accepts no other participant on whatever domain. The domain decides
only which UDP ports Fast DDS binds, and those of 215 and above lie beyond the ones that Linux hands
out. Fast DDS numbers the participants of a process and ends the process if a number leads to a port
above 65535; in domain 222 that is the 1312th.
"""

from __future__ import annotations

import fcntl
import os
import socket
from collections.abc import Collection, Iterable, Iterator, MutableMapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from rosbeat import environment
from rosbeat.errors import DomainsExhaustedError

PRIVATE_IDS = range(51, 102)
"""Ids to lease, each to the programs of one check, build or test."""

TERMINAL_IDS = (*environment.SHARED_DOMAINS, *range(102, 215), *range(51, 88))
"""Ids to lease to terminals, in this order; 88 to 101 are left to checks in any case."""

SESSION_DOMAINS = range(215, 223)
"""Domains of private sessions, whose UDP ports begin at 61160."""

LAST_DOMAIN = 214
"""The last domain that a session may join; those of private sessions are above."""

#: The file of leased ids remembers so many.
_MOST_REMEMBERED = 100
#: A lease that other programs inherit has a file descriptor that no script uses by its number.
_OUT_OF_THE_WAY = 100


@dataclass
class DomainLease:
    """Hold a domain id until `release` is called or the process ends.

    Attributes:
        domain_id: The id.
    """

    domain_id: int
    _lock: socket.socket

    def release(self) -> None:
        """Give the id back; a second call does nothing."""
        self._lock.close()

    def keep(self) -> None:
        """Hold the id until the process ends, also if nobody keeps this object."""
        self._lock.detach()

    def keep_across_exec(self) -> None:
        """Hold the id until the programs that inherit this process's open files have ended, too."""
        fcntl.fcntl(self._lock, fcntl.F_DUPFD, _OUT_OF_THE_WAY)
        self._lock.close()


def lease_domain(ids: range = PRIVATE_IDS) -> DomainLease:
    """Take a domain id that nobody else on this machine has leased or uses.

    Args:
        ids: The ids to choose from.

    Raises:
        DomainsExhaustedError: If all of them are taken.
    """
    start = os.getpid() % len(ids)  # processes begin at different places, so they rarely meet
    lease = _first_free([*ids[start:], *ids[:start]])
    if lease is None:
        raise DomainsExhaustedError(
            f"All {len(ids)} ROS domain ids for checks and builds are in use on this machine.",
            "Each check or build that starts programs gives them a domain of their own.",
            "Wait until other checks and builds have ended, then try again.",
        )
    return lease


def lease_terminal_domain(
    environ: MutableMapping[str, str],
    prefix: str | None = None,
    ids: Collection[int] = TERMINAL_IDS,
) -> DomainLease | None:
    """Take the domain id of this user's terminals in a checkout, and set it in an environment.

    Whoever leases for the same user and checkout meanwhile gets the same id.

    Args:
        environ: The environment of the terminals. A domain that somebody has chosen in it stays.
        prefix: The installation that brings ROS, by default that of the running Python.
        ids: The ids to choose from.

    Returns:
        The lease; None if somebody has chosen a domain, or if the id cannot be written down, as on
        a full disk.

    Raises:
        DomainsExhaustedError: If all of them are taken; the environment then stays as it was.
    """
    if environ.get(environment.DOMAIN, "") not in ("", environ.get(environment.CHOSEN)):
        return None
    try:
        with _remembered() as known:
            who = environment.who(prefix)
            former, usual = known.get(who), environment.usual_domain_id(prefix)
            lease = _take_back(former) if former and former in ids else None
            lease = lease or _first_free([usual, *ids] if usual in ids else ids)
            if lease is None:
                raise DomainsExhaustedError(
                    f"All {len(ids)} ROS domain ids for terminals are leased on this machine.",
                    f"Terminals opened from here use domain {environment.domain_id(prefix)}, which "
                    "is somebody else's, too: nodes may find each other.",
                    "When another server or kernel has ended, restart this one. Or choose a domain "
                    "that nobody uses: `export ROS_DOMAIN_ID=...`, before you start.",
                )
            lease._lock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
            _remember(known, who, lease.domain_id)
    except OSError:
        return None
    environ[environment.DOMAIN] = environ[environment.CHOSEN] = str(lease.domain_id)
    return lease


# Taking an id.


def _first_free(ids: Iterable[int]) -> DomainLease | None:
    bound = udp_ports()
    for domain_id in ids:
        if not participants(domain_id, bound):
            with suppress(OSError):
                return _hold(domain_id)
    return None


def _take_back(domain_id: int) -> DomainLease | None:
    """Take an id that this user had for the same checkout, unless somebody else is there now."""
    with suppress(OSError):
        lease = _hold(domain_id)
        if set(participants(domain_id, udp_ports())) <= {os.geteuid()}:
            return lease
        lease.release()
        return None
    with suppress(OSError):
        return _hold(domain_id, shared=True)
    return None


def _hold(domain_id: int, *, shared: bool = False) -> DomainLease:
    """Bind the port of an id, alone or together with sockets of the same user."""
    lock = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        lock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, shared)
        lock.bind(("127.0.0.1", 7400 + 250 * domain_id))
    except OSError:
        lock.close()
        raise
    return DomainLease(domain_id, lock)


# The file of leased ids.


@contextmanager
def _remembered() -> Iterator[dict[str, int]]:
    """Return the ids by what `environment.who` says, and let nobody else change them meanwhile."""
    folder = Path(environment.leased_domains()).parent
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield _read(Path(environment.leased_domains()))
    finally:
        os.close(descriptor)


def _read(file: Path) -> dict[str, int]:
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines() if file.exists() else []
    pairs = [line.rpartition(" ") for line in lines]
    return {who: int(number) for who, _, number in pairs if number.isdecimal()}


def _remember(known: dict[str, int], who: str, domain_id: int) -> None:
    """Write an id down, as that of one checkout only; another one's lease on it has ended."""
    if known.get(who) == domain_id:
        return
    machine = who.partition(" ")[2]
    others = [
        (one, number)
        for one, number in known.items()
        if one != who and (number != domain_id or one.partition(" ")[2] != machine)
    ]
    kept = [*others, (who, domain_id)][-_MOST_REMEMBERED:]
    file = Path(environment.leased_domains())
    unfinished = file.with_suffix(".new")
    unfinished.write_text("".join(f"{one} {number}\n" for one, number in kept), encoding="utf-8")
    unfinished.replace(file)


# Who is in a domain, before any of them has answered.
#
# Each participant of DDS listens on two UDP ports that follow from the domain and from its number
# on the machine: 7400 + 250 * domain + 10 + 2 * number for discovery, and the next one for data
# (RTPS specification, section 9.6.1).


def participants(domain_id: int, bound: Collection[tuple[int, int]]) -> list[int]:
    """Return the user id of each participant that this machine has in a domain.

    Args:
        domain_id: The domain.
        bound: What `udp_ports` returns.
    """
    first = 7400 + 250 * domain_id + 10
    numbers = range(first, first + 240, 2)
    # Both ports, of one user: another program may have bound one of them by chance.
    return [user for port, user in bound if port in numbers and (port + 1, user) in bound]


def udp_ports(table: str | None = None, ignored: Collection[str] = ()) -> set[tuple[int, int]]:
    """Return the UDP ports that are bound, each with the user id of who has it.

    Args:
        table: The text of the system's tables of UDP sockets, by default read from the system.
        ignored: Inodes of sockets to leave out.
    """
    rows = [line.split() for line in (_socket_tables() if table is None else table).splitlines()]
    # Column 1 is the local address with its port, column 7 the user, column 9 the inode.
    sockets = [row for row in rows if len(row) > 9 and row[0][0].isdigit()]
    return {
        (int(row[1].rpartition(":")[2], 16), int(row[7]))
        for row in sockets
        if row[9] not in ignored
    }


def _socket_tables() -> str:
    text = ""
    for name in ("/proc/net/udp", "/proc/net/udp6"):
        with suppress(OSError):
            text += Path(name).read_text(encoding="ascii")
    return text

"""Which ROS domain ids are for whom, and a lease on one for programs that nobody else shall hear.

Two participants of DDS talk if their domain ids are equal. Ids 1 to 50 are for the course's
terminals (`rosbeat.environment`). Programs that a check or a build runs get an id of their own from
51 to 101; above, the ports of DDS reach into those that Linux hands out by itself, 32768 to 60999
(ROS 2 documentation, "The ROS_DOMAIN_ID").

A private session needs no id of its own: its context is made with discovery off
(`rosbeat.ros.context`), and accepts no other participant on whatever domain. The domain decides
only which UDP ports Fast DDS binds, and those of 215 and above lie beyond the ones that Linux hands
out. Fast DDS numbers the participants of a process and ends the process if a number leads to a port
above 65535; in domain 222 that is the 1312th.

Whoever holds a leased id also holds the TCP port with the number of that domain's UDP discovery
port, 7400 + 250 * id (RTPS specification, section 9.6.1). The operating system gives a port to one
process only, in the same network namespace that DDS traffic stays in, and takes it back when the
process ends, however it ends. A node that outlives the process that held the id still speaks in
that domain, so an id is given out only while the UDP port of a domain's first participant, 7410 +
250 * id, is free.
"""

from __future__ import annotations

import os
import socket
from dataclasses import dataclass

from rosbeat.errors import DomainsExhaustedError

PRIVATE_IDS = range(51, 102)
"""Ids to lease, each to the programs of one check, build or test."""

SESSION_DOMAINS = range(215, 223)
"""Domains of private sessions, whose UDP ports begin at 61160."""


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


def _try_lock(domain_id: int) -> socket.socket | None:
    lock = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        lock.bind(("127.0.0.1", 7400 + 250 * domain_id))
        _require_silence(domain_id)
    except OSError:
        lock.close()
        return None
    return lock


def _require_silence(domain_id: int) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 7410 + 250 * domain_id))


def lease_domain(ids: range = PRIVATE_IDS) -> DomainLease:
    """Take a domain id that nobody else on this machine has leased or uses.

    Args:
        ids: The ids to choose from.

    Raises:
        DomainsExhaustedError: If all of them are taken.
    """
    start = os.getpid()  # processes begin at different places, so they rarely try the same id
    for step in range(len(ids)):
        domain_id = ids[(start + step) % len(ids)]
        lock = _try_lock(domain_id)
        if lock is not None:
            return DomainLease(domain_id, lock)
    raise DomainsExhaustedError(
        f"All {len(ids)} ROS domain ids for checks and builds are in use on this machine.",
        "Each check or build that starts programs gives them a domain of their own.",
        "Wait until other checks and builds have ended, then try again.",
    )

"""Private ROS domain ids, so that two sessions never hear each other.

Two participants of DDS talk if their domain ids are equal. Each session therefore takes an id of
its own from 51 to 101; ids 1 to 50 are for the course's terminals (`rosbeat.environment`), and
above 101 the ports of DDS reach into those that Linux hands out by itself
(ROS 2 documentation, "The ROS_DOMAIN_ID").

Whoever holds an id also holds the TCP port with the number of that domain's UDP discovery port,
7400 + 250 * id (RTPS specification, section 9.6.1). The operating system gives a port to one
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


@dataclass
class DomainLease:
    """Hold a private domain id until `release` is called or the process ends.

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
    """Take a domain id that no other session on this machine has.

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
        f"All {len(ids)} private ROS domain ids are in use on this machine.",
        "Each open session holds one, and so do sessions in other notebooks.",
        "Close sessions you no longer need (`ros.close()`), or restart their kernels.",
    )

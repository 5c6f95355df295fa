"""How much a sandbox lets its program use."""

from __future__ import annotations

import resource
from dataclasses import dataclass

MB = 1_000_000


@dataclass(frozen=True)
class Limits:
    """How much one run may use.

    Attributes:
        wall: Seconds by the clock on the wall.
        cpu: Seconds of processor time of each process.
        memory: Bytes of memory of all processes together.
        address_space: Bytes of address space of each process; libraries take hundreds of MB.
        processes: Processes and threads.
        file: Bytes of one file.
        scratch: Bytes of all files in `/tmp`, and as many again in `/dev/shm`.
        output: Bytes that are read of what it prints.
        result: Bytes that are read of its result.
    """

    wall: float = 30.0
    cpu: int = 30
    memory: int = 1_000 * MB
    address_space: int = 4_000 * MB
    processes: int = 128
    file: int = 50 * MB
    scratch: int = 100 * MB
    output: int = 64_000
    result: int = 40 * MB

    def apply(self) -> None:
        """Limit this process and those that it starts; it cannot be undone."""
        for what, most in (
            (resource.RLIMIT_CPU, self.cpu),
            (resource.RLIMIT_AS, self.address_space),
            (resource.RLIMIT_NPROC, self.processes),
            (resource.RLIMIT_FSIZE, self.file),
            (resource.RLIMIT_CORE, 0),
            (resource.RLIMIT_NOFILE, 512),
            (resource.RLIMIT_MEMLOCK, 0),
        ):
            _, hard = resource.getrlimit(what)
            bound = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.setrlimit(what, (bound, bound))

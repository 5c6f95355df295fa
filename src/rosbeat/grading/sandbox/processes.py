"""What Linux tells of other processes, from proc(5)."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress

_COUNTED = (b"RssAnon:", b"RssShmem:")  # in KiB


def children(process: int) -> list[int]:
    """The children of all threads of a process; none if it has ended.

    Args:
        process: Its number.
    """
    found: list[int] = []
    with suppress(OSError):
        for task in os.listdir(f"/proc/{process}/task"):
            path = f"/proc/{process}/task/{task}/children"
            with suppress(OSError), open(path, encoding="ascii") as file:  # a thread may have ended
                found += map(int, file.read().split())
    return found


def memory_of(processes: Iterable[int]) -> int:
    """Bytes of memory of some processes and all of their descendants.

    Counted are its own pages and those of memory that it shares; not those of files, as libraries.

    Args:
        processes: Their numbers.
    """
    total, left = 0, list(processes)
    while left:
        one = left.pop()
        left += children(one)
        with suppress(OSError), open(f"/proc/{one}/status", "rb") as file:
            total += sum(int(line.split()[1]) for line in file if line.startswith(_COUNTED))
    return total * 1024

"""What Linux tells of other processes, from proc(5)."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress

_PAGE = os.sysconf("SC_PAGE_SIZE")


def children(process: int) -> list[int]:
    """The children of all threads of a process; none if it has ended.

    Args:
        process: Its number.
    """
    found: list[int] = []
    with suppress(OSError):
        for task in os.listdir(f"/proc/{process}/task"):
            with open(f"/proc/{process}/task/{task}/children", encoding="ascii") as file:
                found += map(int, file.read().split())
    return found


def memory_of(processes: Iterable[int]) -> int:
    """Bytes of memory of some processes and all of their descendants.

    Counted are resident pages less those shared with others, as libraries are.

    Args:
        processes: Their numbers.
    """
    total, left = 0, list(processes)
    while left:
        one = left.pop()
        left += children(one)
        with suppress(OSError, IndexError, ValueError):
            with open(f"/proc/{one}/statm", encoding="ascii") as file:
                words = file.read().split()
            total += (int(words[1]) - int(words[2])) * _PAGE
    return total

"""Endpoints that must exist, because those with other numbers do.

Fast DDS numbers the endpoints of a process 1, 2, 3 and so on, publishers and subscriptions in one
row, and tells of the two kinds in two separate streams. When one stream lags behind, as it does
when the machine is busy, numbers are missing in between. Endpoints that were destroyed leave such
gaps for ever, so a gap is a reason to wait for a moment only.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

#: Bytes of an endpoint's address (GID): that of its process, then its number, then its kind.
PROCESS = slice(0, 12)
_NUMBER = slice(12, 15)


def has_gaps(addresses: Iterable[bytes]) -> bool:
    """Whether some process has an endpoint with a number below a known one, and it is not known.

    Args:
        addresses: The GIDs of all known endpoints.
    """
    numbers: defaultdict[bytes, set[int]] = defaultdict(set)
    for address in addresses:
        numbers[address[PROCESS]].add(int.from_bytes(address[_NUMBER], "big"))
    return any(len(known) < max(known) for known in numbers.values())

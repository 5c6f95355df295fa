"""Cell ids that depend on the source alone and survive edits.

An id is a hash of what opens a cell: its kind, its exercise, its first line. Two builds give the
same ids, both trees share them, and a sentence changed further down in a cell is one changed line
in each page instead of two.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable

Opening = tuple[str, str, "str | None", "str | None"]


def cell_ids(cells: Iterable[Opening]) -> list[str]:
    """Give every cell its id.

    Args:
        cells: Kind, source, exercise and check of each cell, in order.

    Returns:
        One id per cell, each different: cells that open alike are numbered.
    """
    seen: Counter[str] = Counter()
    ids = []
    for kind, source, exercise, check in cells:
        stem = _digest(kind, exercise or "", check or "", source.split("\n", 1)[0])
        seen[stem] += 1
        ids.append(stem if seen[stem] == 1 else f"{stem}-{seen[stem]}")
    return ids


def _digest(*parts: str) -> str:
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:10]

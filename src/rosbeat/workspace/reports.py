"""What was made for a learner because a page needs it and it was not there."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass


@dataclass(frozen=True)
class Report:
    """What catching up made, and what it left for the learner to decide.

    Attributes:
        made: What was made, in the order of the pages.
        attention: What stands in the way, each with what to do about it.
    """

    made: tuple[str, ...] = ()
    attention: tuple[str, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether everything that was asked for is there now."""
        return not self.attention

    def __str__(self) -> str:
        rows = [f"Please look: {one}" for one in self.attention]
        if self.made:
            made = "; ".join(self.made)
            rows.insert(0, f"Made for you, because it was not there yet: {made}.")
        rows = rows or ["Everything this page needs is there."]
        return "\n".join(textwrap.fill(row, 100, break_long_words=False, break_on_hyphens=False)
                         for row in rows)  # fmt: skip

    __repr__ = __str__

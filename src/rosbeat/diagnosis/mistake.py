"""What a mistake with a name is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Mistake:
    """A mistake that has a name.

    Attributes:
        id: Its name in records and tests, such as `topic-misspelled`.
        title: Its name for people, a few words in lower case.
        row: Its number in the table of thirty, or 0.
    """

    id: str
    title: str
    row: int = 0

    @property
    def heading(self) -> str:
        """Its title as a sentence begins, unless that begins with code: `super().__init__ ...`."""
        first = self.title.split()[0]
        return self.title[:1].upper() + self.title[1:] if first.isalpha() else self.title

"""Choose what a scenario feeds an answer: fixed on a page, from a secret seed in grading.

An answer and what observes it share a process, so evidence can be forged. A class is therefore
graded with a seed that is drawn for it alone: evidence that was made in advance does not fit, and
to make evidence that fits one has to compute what a right node does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import TypeVar

#: The seed of a page, whose inputs are those that are written in the exercise's module.
PAGE = 0
#: How often inputs are drawn anew until they are good; in practice a few times are enough.
_TRIES = 1_000
Item = TypeVar("Item")


class Draw:
    """Draw the inputs of one run.

    Args:
        seed: Which ones; `PAGE` gives each method's first or usual value.
    """

    def __init__(self, seed: int = PAGE) -> None:
        self.is_page = seed == PAGE
        self._random = Random(seed)

    def shuffled(self, items: Sequence[Item]) -> tuple[Item, ...]:
        """Return the items in another order."""
        drawn = list(items)
        if not self.is_page:
            self._random.shuffle(drawn)
        return tuple(drawn)

    def one_of(self, usual: Item, *others: Item) -> Item:
        """Return one of several values; the first one on the page."""
        return usual if self.is_page else self._random.choice((usual, *others))

    def number(self, usual: float, low: float, high: float, step: float = 1 / 64) -> float:
        """Return a number.

        Args:
            usual: The page's.
            low: The least that may be drawn.
            high: The largest that may be drawn.
            step: The distance of two numbers that may be drawn; a float32 holds multiples of 1/64
                exactly up to 262,144.
        """
        if self.is_page:
            return usual
        return low + step * self._random.randint(0, int((high - low) / step))

    def whole(self, usual: int, low: int, high: int) -> int:
        """Return a whole number from `low` to `high`; `usual` on the page."""
        return usual if self.is_page else self._random.randint(low, high)

    def until(self, make: Callable[[], Item], is_good: Callable[[Item], bool]) -> Item:
        """Return the first inputs drawn that are good, such as those that tell suspects apart.

        Args:
            make: Draws inputs.
            is_good: Tells whether they are good; not asked about the page's.

        Raises:
            AssertionError: If none of 1,000 was good.
        """
        for _ in range(_TRIES):
            made = make()
            if self.is_page or is_good(made):
                return made
        raise AssertionError(f"none of {_TRIES} draws was good: {made}")

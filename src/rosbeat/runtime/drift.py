"""A tendency in the random numbers, so that a random walk soon meets both of its limits.

A free walk needs hours to wander from one end of its range to the other, and may miss one of them
for ever. A check cannot wait for luck. So the numbers drift: up for a while, down for a while, then
freely. Each single number is one that could have been drawn anyway.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rclpy.node import Node

from rosbeat.runtime.feeding import BARE
from rosbeat.runtime.randomness import tilt

#: The node that makes the drift; a judge may want to tell it from the learner's.
NAME = "weather"
_AT_ONCE = 1e-6


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """A node that tilts what the nodes beside it draw with the functions of Python's `random`.

    NumPy's generators stay as they are, and so does a `random.Random` of a node's own.

    Args:
        phases: How long each lasts, in virtual seconds, and its exponent; see `tilt`. There is at
            least one, and the last one stays until the session's `run` returns.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """

    class Weather(Node):
        """Turns the tendency at the end of each phase."""

        def __init__(self) -> None:
            super().__init__(NAME, **BARE)
            self._left = list(phases)
            # A tilt lasts until the call of the session ends that set it, so not from here.
            self._next = self.create_timer(_AT_ONCE, self._turn)

        def _turn(self) -> None:
            self.destroy_timer(self._next)
            seconds, exponent = self._left.pop(0)
            tilt(exponent)
            if self._left:
                self._next = self.create_timer(seconds, self._turn)

    return Weather

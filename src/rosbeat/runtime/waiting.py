"""Waiting in a cell, with a deadline, for something that happens elsewhere."""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Event

from rosbeat.records import GraphSnapshot
from rosbeat.runtime import refusals
from rosbeat.runtime.interrupts import show_briefly
from rosbeat.runtime.lookout import Lookout
from rosbeat.runtime.outside import is_settled
from rosbeat.runtime.world import World

_LOOK_EVERY = 0.05
#: The graph is believed when it has not changed for so many seconds.
_QUIET = 0.2


def poll(
    done: Callable[[], object], deadline: float | None, meanwhile: Callable[[], object] = bool
) -> bool:
    """Wait until something is true.

    Args:
        done: Asked again and again.
        deadline: When to give up, on `time.monotonic`'s clock; None for never.
        meanwhile: Called before each question.

    Returns:
        Whether it came true.
    """
    pulse = Event()  # nobody sets it: it is a sleep that an Interrupt ends at once
    while True:
        meanwhile()
        if done():
            return True
        left = _LOOK_EVERY if deadline is None else deadline - time.monotonic()
        if left <= 0:
            return False
        pulse.wait(min(_LOOK_EVERY, left))


def wait_live(world: World, done: Callable[[], object], seconds: float | None) -> bool:
    """Wait while a session is live, and print what its nodes say.

    Args:
        world: The session.
        done: Asked again and again.
        seconds: How long at most, in seconds of wall time; None for ever.

    Returns:
        Whether it came true.
    """
    deadline = None if seconds is None else time.monotonic() + seconds
    world.console.begin()
    try:
        return poll(done, deadline, world.show_news)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped waiting; the session is still live.")
        world.hurry()
        raise
    finally:
        world.show_news()
        world.console.end()


def wait_for_nodes(world: World, names: list[str], seconds: float) -> None:
    """Wait until nodes of these full names are in the graph, with all that belongs to them.

    Raises:
        SessionError: If the domain is private, or they do not come.
    """
    if world.lookout is None:
        raise refusals.nobody_else_here()
    look = _Look(world, world.lookout, names)
    try:
        poll(look.is_enough, time.monotonic() + seconds)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped waiting; the session goes on.")
        raise
    missing = [name for name in names if name not in look.graph.nodes]
    if missing:
        raise refusals.nodes_did_not_come(missing, look.graph.nodes, seconds, world.domain_id or 0)


class _Look:
    """The graph as it was last seen, and since when it has been so."""

    def __init__(self, world: World, lookout: Lookout, names: list[str]) -> None:
        self._world, self._lookout, self._names = world, lookout, names
        self._since = time.monotonic()
        self.graph = GraphSnapshot()

    def is_enough(self) -> bool:
        """Look again; say whether all are there and nothing has changed for a moment.

        A node's name, its publishers and its subscriptions come one after the other.
        """
        before, self.graph = self.graph, self._world.graph()
        if self.graph.nodes != before.nodes or self.graph.endpoints != before.endpoints:
            self._since = time.monotonic()
        here = set(self._names) <= set(self.graph.nodes)
        return here and time.monotonic() - self._since >= _QUIET and is_settled(self._lookout)

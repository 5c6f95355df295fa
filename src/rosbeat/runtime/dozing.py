"""Callbacks that sleep: virtual time passes for the other nodes, and no real time.

On a page and in a check alike, a node that sleeps in a callback is a process that does nothing else
meanwhile. Its callback goes on where it was, in the one thread that there is, so the others run
within its call of `time.sleep`. What follows from that: a run ends no sooner than the callbacks
that it has begun, and begins no other of their nodes then; and of two nodes that sleep at once, the
one that fell asleep first cannot wake before the other.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

from rosbeat.errors import SessionError
from rosbeat.records import NANOSECONDS
from rosbeat.runtime.clock import SessionClock
from rosbeat.runtime.console import note
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.naps import virtual_sleep
from rosbeat.runtime.virtual_time import VirtualTimeExecutor

#: Virtual seconds that a callback may sleep on when a run is over.
LONGEST = 3600


class Sleepers(Protocol):
    """What is asked of a session's world."""

    clock: SessionClock
    virtual: VirtualTimeExecutor

    def states(self) -> list[NodeState]:
        """All nodes, in order of creation."""

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""

    def rest_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`."""


@contextmanager
def resting(world: Sleepers, state: NodeState) -> Iterator[None]:
    """Run none of a node's callbacks in this block: it sleeps in one of them.

    One that is paused meanwhile does not wake with the end of its sleep.
    """
    virtual = world.virtual
    calling, virtual.current = virtual.calling, None
    world.rest_node(state)
    state.asleep += 1
    try:
        yield
    finally:
        state.asleep -= 1
        if not (state.asleep or state.ended or state.paused):
            world.spin_node(state)
        virtual.current, virtual.calling = state, calling


def run_until(world: Sleepers, end: int, done: Callable[[], bool] | None = None) -> None:
    """Run nodes; a sleep in a callback takes virtual time.

    Args:
        world: The session's world. Where a check runs its nodes, it has seen to sleeps itself.
        end: When the run is to end, in nanoseconds; a callback that sleeps longer prolongs it.
        done: The run ends as soon as this is true.

    Raises:
        EndlessChainError: If callbacks cause one another for ever while no time passes.
    """
    if "sleep_until" in vars(world.clock):
        world.virtual.run_until(end, done)
        return
    doze = _Doze(world, end)
    try:
        with virtual_sleep(doze.nap, world.clock, _code_of(world)):
            world.virtual.run_until(end, done)
    finally:
        doze.let_go()
    if doze.last and world.virtual.now > end:
        note(f"{doze.last} slept beyond the end of this run, which so went on until {_now(world)}.")


class _Doze:
    def __init__(self, world: Sleepers, end: int) -> None:
        self.last = ""
        self._world, self._end = world, end
        self._latest = end + LONGEST * NANOSECONDS
        self._held: list[NodeState] = []

    def nap(self, seconds: float) -> None:
        """Sleep; outside of callbacks, as in the constructor of a node, it takes real time."""
        virtual = self._world.virtual
        state = virtual.current
        if state is None:
            time.sleep(seconds)
            return
        until = virtual.now + round(seconds * NANOSECONDS)
        with resting(self._world, state):
            virtual.run_nested(min(until, self._latest))
        if until > self._latest:
            raise _sleeps_on(state.name)
        self.last = state.name
        if virtual.now > self._end and state not in self._held:
            # What waits for it waits for the next run: else a node that sleeps longer than its
            # messages are apart would never come to an end.
            self._world.rest_node(state)
            self._held.append(state)
        if virtual.now > until:
            note(f"{state.name} woke late, at {_now(self._world)}, after one that slept longer.")

    def let_go(self) -> None:
        """The run is over: nodes that overslept its end may go on in the next."""
        for state in self._held:
            if state.node is not None and not (state.ended or state.paused):
                self._world.spin_node(state)


def _code_of(world: Sleepers) -> list[object]:
    """Classes and functions whose modules may have a `sleep` of their own."""
    found: list[object] = []
    for state in world.states():
        found += [type(state.node), *(getattr(e.entity, "callback", None) for e in state.entries)]
    return found


def _now(world: Sleepers) -> str:
    return f"{world.virtual.now / NANOSECONDS:g} s"


def _sleeps_on(name: str) -> SessionError:
    return SessionError(
        f"A callback of {name} does not wake up.",
        f"It sleeps on {LONGEST} s after the end of the run. A node runs one callback at a time, "
        "so this one does nothing else any more.",
        "To wait for something, return, and let a timer call you again.",
    )

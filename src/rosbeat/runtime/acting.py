"""The part of a session that actions ask."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from contextlib import suppress
from typing import Any
from weakref import WeakSet

from rclpy.node import Node

from rosbeat.runtime.actions import ActionEnd, wait_by_the_wall
from rosbeat.runtime.arrivals import Arrivals
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.live import LiveExecutor


class Acting:
    """What a session does for its actions; see `actions.Place`.

    Attributes:
        arrivals: Records what comes from outside; None in a private domain.
        live: The live executor while the session is live, else None.
    """

    arrivals: Arrivals | None
    live: LiveExecutor | None
    _states: dict[Node, NodeState]
    _made: WeakSet[Any]
    _goals = 0

    @abstractmethod
    def states(self) -> list[NodeState]:
        """All nodes that have not been destroyed, in order of creation."""

    @abstractmethod
    def state_of(self, node: Node | None) -> NodeState | None:
        """What is known of a node."""

    @abstractmethod
    def refuse_in_callback(self, call: str) -> None:
        """Nothing that waits for nodes may be called by a node."""

    @abstractmethod
    def wait_until(self, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run virtual time until `done` is true, at most so many seconds."""

    @abstractmethod
    def _sender(self, kind: str, name: str) -> Callable[[], None]:
        """What to call when something was sent in virtual time."""

    def action_made(
        self,
        node: Node,
        kind: str,
        entity: Any,  # noqa: ANN401
        name: str,
        options: dict[str, Any],
    ) -> None:
        """An action server or client was made."""
        state = self._states[node]
        state.actions.append(ActionEnd(self, state, kind, entity, name, options))
        self._made.add(entity)

    def destroy_actions(self) -> None:
        """Destroy every action server and client; destroying its node leaves it in the graph."""
        for entity in list(self._made):
            with suppress(Exception):  # destroyed already, or half-made
                entity.destroy()

    def sent(self, kind: str, name: str) -> None:
        """Something was sent to the `kind` entities called `name`."""
        self._sender(kind, name)()

    def wait(self, call: str, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run nodes until `done` is true; `call` is refused in a callback."""
        self.refuse_in_callback(call)
        if self.live is None:
            return self.wait_until(done, seconds)
        return wait_by_the_wall(done, seconds)

    def next_goal(self) -> int:
        """How many goals were sent in this session; 0 in a domain with other processes in it."""
        self._goals += 1
        return self._goals if self.arrivals is None else 0

    @abstractmethod
    def heard(self, state: NodeState, kind: str, name: str, source: str) -> None:
        """A callback of an action is about to run."""

    @abstractmethod
    def work_raised(self, state: NodeState, name: str, error: BaseException) -> None:
        """An exception left the work on a goal; the node goes on."""

"""Keep which nodes and entities a session has, and find them by node, name, entity or key."""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary, WeakSet

from rclpy.node import Node

from rosbeat.ros.errors import foreign_node, no_such_node
from rosbeat.ros.processes import Entry, NodeState, Process


class NodeRegistry:
    """Hold what is known of the nodes of a session, and of their entities.

    Attributes:
        processes: The simulated processes that have had nodes, as long as somebody holds them.
    """

    def __init__(self) -> None:
        self._states: dict[Node, NodeState] = {}
        self._entries: dict[Any, Entry] = {}
        self._keys: dict[int, Entry] = {}
        # A destroyed node cannot say its name.
        self._names: WeakKeyDictionary[Node, str] = WeakKeyDictionary()
        self.processes: WeakSet[Process] = WeakSet()

    def __contains__(self, node: Node) -> bool:
        return node in self._states

    def __getitem__(self, node: Node) -> NodeState:
        return self._states[node]

    # Finding.

    def states(self) -> list[NodeState]:
        """Return all nodes that have not been destroyed, in order of creation."""
        return list(self._states.values())

    def named(self, name: str) -> NodeState | None:
        """Return the node of this full name."""
        return next((state for state in self.states() if state.name == name), None)

    def state_of(self, node: Node | None) -> NodeState | None:
        """Return what is known of a node."""
        return self._states.get(node)

    def entry_of(self, entity: Any) -> Entry | None:  # noqa: ANN401 - any entity of rclpy
        """Return what is known of an entity."""
        return self._entries.get(entity)

    def entry_of_key(self, key: int) -> Entry | None:
        """Return the entity of a key in a wait set."""
        return self._keys.get(key)

    def name_of(self, node: Node) -> str | None:
        """Return the full name of a node that is or was here."""
        return self._names.get(node)

    def member(self, node: Node) -> NodeState:
        """Return what is known of a node; raise a NodeClassError if it is not of this session."""
        state = self.state_of(node)
        if state is None:
            raise foreign_node(node, self.name_of(node))
        return state

    def find(self, node: Node | str) -> NodeState:
        """Return a node, given itself or by name; raise a SessionError if there is no such node."""
        if isinstance(node, Node):
            return self.member(node)
        name = "/" + str(node).lstrip("/")
        state = self.named(name)
        if state is None:
            raise no_such_node(name, [other.name for other in self.states()])
        return state

    # Coming and going.

    def add_node(self, node: Node, process: Process, born_ns: int) -> None:
        """Register a new node, in a simulated process."""
        name = node.get_fully_qualified_name()
        state = NodeState(len(self._states), name, node, process, born_ns=born_ns)
        process.states.append(state)
        self.processes.add(process)
        self._states[node] = state
        self._names[node] = name

    def add_entry(self, entry: Entry) -> None:
        """Register an entity of a node."""
        entry.state.entries.append(entry)
        self._entries[entry.entity] = entry
        self._keys[entry.key] = entry

    def remove_node(self, node: Node) -> NodeState | None:
        """Forget a node, and not yet its entities; return what was known of it."""
        return self._states.pop(node, None)

    def remove_entries(self, state: NodeState) -> None:
        """Forget the entities of a node."""
        for entry in state.entries:
            self._entries.pop(entry.entity, None)
            self._keys.pop(entry.key, None)

"""How a session learns of nodes, without the nodes being changed.

rclpy offers no place to be told that a node, a publisher or a timer was made. The methods of `Node`
that make them are therefore wrapped once, when this module is first imported. A wrapper looks at
the node's own context: if that belongs to a session, the session's watcher is told; if not, the
original runs and nothing else happens. Nothing is kept here, so there is nothing to share.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial, wraps
from typing import Any, Protocol

from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.node import Node

from rosbeat.errors import NoSessionError, SessionError
from rosbeat.runtime.asking import asking, is_message_class
from rosbeat.runtime.launch import Launch
from rosbeat.runtime.stretching import as_written, stretched

ENTITY_METHODS = {
    "create_publisher": "publisher",
    "create_subscription": "subscription",
    "create_timer": "timer",
    "create_service": "service",
    "create_client": "client",
    "create_rate": "rate",
}


class Watcher(Protocol):
    """What a session does when its nodes change."""

    start: Launch

    @property
    def counts_limits(self) -> bool:
        """Whether the session, and not the middleware, counts deadlines and lifespans."""

    def node_begins(self, name: str, namespace: str) -> None:
        """A node of this name is about to be made."""

    def node_made(self, node: Node) -> None:
        """`Node.__init__` has returned."""

    def entity_begins(self, node: Node) -> None:
        """The node is about to make an entity."""

    def entity_made(self, node: Node, kind: str, entity: Any) -> None:  # noqa: ANN401
        """The node has made an entity of that kind."""

    def action_made(
        self,
        node: Node,
        kind: str,
        entity: Any,  # noqa: ANN401
        name: str,
        options: dict[str, Any],
    ) -> None:
        """The node has made an action server or client; see `actions`."""

    def node_ends(self, node: Node) -> None:
        """The node is about to be destroyed."""

    def logger_of(self, node: Node, original: Any) -> Any:  # noqa: ANN401
        """The logger that the node's code gets."""

    def explain_init(self) -> None:
        """The learner called `rclpy.init()`."""

    def explain_shutdown(self) -> None:
        """The learner called `rclpy.shutdown()`."""


class Unwatched:
    """Mixed into a node that is part of the session itself, so that its watcher is not told."""


def watcher_of(node: Node) -> Watcher | None:
    """The watcher of a node's session, or None if it is in no session or not yet a node."""
    if isinstance(node, Unwatched):
        return None
    # Not `node.context`: a class that forgot super().__init__() must fail with rclpy's own error.
    return getattr(node.__dict__.get("_context"), "watcher", None)


def _watch_birth(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def init(node: Node, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401
        context: Context | None = kwargs.get("context")
        watcher = getattr(context or _default_context(), "watcher", None)
        name = kwargs.get("node_name", args[0] if args else None)
        with asking("Node.__init__", node, *args, **kwargs):
            if watcher is None or not isinstance(name, str) or isinstance(node, Unwatched):
                _make_alone(partial(original, node, *args, **kwargs))
                return
            start = watcher.start
            kwargs["cli_args"] = [*(kwargs.get("cli_args") or ()), *start.arguments()] or None
            namespace = start.namespace or kwargs.get("namespace") or "/"
            watcher.node_begins(start.name or name, namespace)
            original(node, *args, **kwargs)
        watcher.node_made(node)

    return init


def _make_alone(make: Callable[[], None]) -> None:
    try:
        make()
    except NotInitializedException:
        if not in_kernel():
            raise
        raise NoSessionError(
            "A node was made, and no session is open.",
            "A node needs ROS to be running. On a page a session starts it, and the last session "
            "has been closed.",
            "Run the cell with `Session()` again; or call `rclpy.init()` first, as a program does. "
            "In a check, hand over the class itself, without brackets.",
        ) from None


def in_kernel() -> bool:
    """Whether this process is a Jupyter kernel."""
    return "ipykernel.kernelapp" in sys.modules


def _default_context() -> Context:
    from rclpy.utilities import get_default_context

    return get_default_context()


def _watch_entity(original: Callable[..., Any], kind: str) -> Callable[..., Any]:
    @wraps(original)
    def create(node: Node, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401
        watcher = watcher_of(node)
        with asking(original.__name__, *args, **kwargs):
            if watcher is None:
                return original(node, *args, **kwargs)
            _refuse_a_message(original.__name__, kwargs.get("msg_type", args[0] if args else None))
            watcher.entity_begins(node)
            if watcher.counts_limits:
                with stretched(kind, args, kwargs) as (longer, named):
                    entity = original(node, *longer, **named)
            else:
                entity = original(node, *args, **kwargs)
        watcher.entity_made(node, kind, entity)
        return entity

    return create


def _refuse_a_message(call: str, kind: object) -> None:
    """A message in the place of its class: rclpy takes it, and fails at the first use."""
    if not isinstance(kind, type) and is_message_class(type(kind)):
        name = type(kind).__name__
        raise SessionError(
            f"{call} was given a message of type {name}, and not the class {name}.",
            "rclpy notices nothing yet, and fails when the first message is to be sent.",
            "Hand over the class itself: nothing is sent at this line.",
        )


def _watch_end(original: Callable[[Node], None]) -> Callable[[Node], None]:
    @wraps(original)
    def destroy_node(node: Node) -> None:
        watcher = watcher_of(node)
        if watcher is not None:
            watcher.node_ends(node)
        original(node)

    return destroy_node


def _watch_logger(original: Callable[[Node], Any]) -> Callable[[Node], Any]:
    @wraps(original)
    def get_logger(node: Node) -> Any:  # noqa: ANN401
        watcher = watcher_of(node)
        return original(node) if watcher is None else watcher.logger_of(node, original(node))

    return get_logger


def _watch_infos(original: Callable[..., list[Any]]) -> Callable[..., list[Any]]:
    @wraps(original)
    def infos(node: Node, *args: Any, **kwargs: Any) -> list[Any]:  # noqa: ANN401
        told = original(node, *args, **kwargs)
        return told if watcher_of(node) is None else as_written(told)

    return infos


def _install() -> None:
    Node.__init__ = _watch_birth(Node.__init__)
    Node.destroy_node = _watch_end(Node.destroy_node)
    Node.get_logger = _watch_logger(Node.get_logger)
    Node._get_info_by_topic = _watch_infos(Node._get_info_by_topic)
    for method, kind in ENTITY_METHODS.items():
        setattr(Node, method, _watch_entity(getattr(Node, method), kind))


_install()  # at import, so exactly once in a process

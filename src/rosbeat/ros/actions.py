"""Actions in a session: what they are called, who hears them, and how they wait.

rclpy makes an action of three services and two topics, all of them inside of one waitable, so that
none is seen by the hooks of `recording`. The constructors of `ActionServer` and `ActionClient` are
wrapped once, and only an action of a session's node is touched: its calls that would wait run
virtual time, its goals get the same ids in every run, and an exception in its work is shown as any
other.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from functools import partial, wraps
from hashlib import sha256
from inspect import signature
from math import inf
from typing import Any, Protocol

from rclpy.action import ActionClient, ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.executors import await_or_execute
from rclpy.node import Node
from unique_identifier_msgs.msg import UUID

from rosbeat.errors import SessionError
from rosbeat.records import Endpoint
from rosbeat.ros.entities import NodeState, callback_name
from rosbeat.ros.faults import asking
from rosbeat.ros.graph import qos_of
from rosbeat.ros.recording import type_name, watcher_of

# What an action is made of: three services and two topics, with hidden names.


#: The last parts of their names, behind `/_action/`; and which option holds their QoS.
SERVICES = ("send_goal", "cancel_goal", "get_result")
FEEDBACK, STATUS = "feedback", "status"
_QOS_OF = {"send_goal": "goal", "cancel_goal": "cancel", "get_result": "result"}


def parts_of(
    node: str,
    kind: str,
    name: str,
    action: Any,  # noqa: ANN401
    options: Mapping[str, Any],
) -> list[Endpoint]:
    """One end of an action as endpoints: the action itself, then its five parts.

    Args:
        node: Full name of the node.
        kind: `action server` or `action client`.
        name: Full name of the action.
        action: Its class.
        options: The arguments of the server's or the client's constructor.
    """
    is_server = kind.endswith("server")
    types, end = _types(action), "pub" if is_server else "sub"
    goal = qos_of(options["goal_service_qos_profile"])
    found = [Endpoint(node, name, type_name(action), kind, goal)]
    for part in SERVICES:
        qos = qos_of(options[f"{_QOS_OF[part]}_service_qos_profile"])
        service = "server" if is_server else "client"
        found.append(Endpoint(node, f"{name}/_action/{part}", types[part], service, qos))
    for part in (FEEDBACK, STATUS):
        qos = qos_of(options[f"{part}_{end}_qos_profile"])
        topic = "publisher" if is_server else "subscription"
        found.append(Endpoint(node, f"{name}/_action/{part}", types[part], topic, qos))
    return found


def _types(action: Any) -> dict[str, str]:  # noqa: ANN401
    own = type_name(action)
    return {
        "send_goal": f"{own}_SendGoal",
        "cancel_goal": "action_msgs/srv/CancelGoal",
        "get_result": f"{own}_GetResult",
        FEEDBACK: f"{own}_FeedbackMessage",
        STATUS: "action_msgs/msg/GoalStatusArray",
    }


SERVER, CLIENT = "action server", "action client"
#: What a client sends requests with, in the order of `SERVICES`.
_SENDING = ("send_goal_async", "_cancel_goal_async", "_get_result_async")
_PART = f"/_action/{SERVICES[0]}"


class Place(Protocol):
    """What an action asks of its session."""

    def states(self) -> list[NodeState]:
        """All nodes, in order of creation."""

    def state_of(self, node: Node | None) -> NodeState | None:
        """What is known of a node."""

    def sent(self, kind: str, name: str) -> None:
        """Something was sent to the `kind` entities called `name`."""

    def wait(self, call: str, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run nodes until `done`; `call` is refused in a callback."""

    def work_raised(self, state: NodeState, name: str, error: BaseException) -> None:
        """An exception left the work on a goal; the node goes on."""

    def heard(self, state: NodeState, kind: str, name: str, source: str) -> None:
        """A callback of an action is about to run."""

    def next_goal(self) -> int:
        """How many goals were sent in this session; 0 in a domain with other processes in it."""


def wait_by_the_wall(done: Callable[[], bool], seconds: float | None) -> bool:
    """Wait until `done` is true while a session is live, at most so many seconds."""
    limit = inf if seconds is None else time.monotonic() + seconds
    while not done() and time.monotonic() < limit:
        time.sleep(0.005)
    return bool(done())


class ActionEnd:
    """One action server or client of a node.

    Args:
        place: The session.
        state: The node.
        kind: `action server` or `action client`.
        entity: rclpy's object.
        name: The action's full name.
        options: The arguments of its constructor.
    """

    def __init__(
        self,
        place: Place,
        state: NodeState,
        kind: str,
        entity: Any,  # noqa: ANN401 - one of the two
        name: str,
        options: dict[str, Any],
    ) -> None:
        self.kind, self.entity, self.name = kind, entity, name
        self._place, self._state, self._options = place, state, options
        self._prepare_server() if kind == SERVER else self._prepare_client()

    @property
    def exists(self) -> bool:
        """Whether it has not been destroyed by itself."""
        node = self._state.node
        return node is not None and any(one is self.entity for one in node.waitables)

    def endpoints(self) -> list[Endpoint]:
        """The action itself, and the services and topics that it is made of."""
        kind = self._options["action_type"]
        return parts_of(self._state.name, self.kind, self.name, kind, self._options)

    # A server.

    def _prepare_server(self) -> None:
        server, work = self.entity, self.entity._execute_goal

        async def execute(callback: Callable[..., Any], goal: ServerGoalHandle) -> None:
            await work(self._noting(callback), goal)

        execute.__name__ = callback_name(server._execute_callback)  # in errors
        server._execute_goal = execute
        server._rosbeat_end = self
        server.execute = partial(self._serve, server.execute)
        _tell(server, "_send_result_response", self._answered)

    async def _serve(self, execute: Callable[..., Any], taken: dict[str, Any]) -> None:
        self._place.heard(self._state, self.kind, "serve", self.name)
        await execute(taken)
        self._answered()

    def _noting(self, callback: Callable[..., Any]) -> Callable[..., Any]:
        """An exception that rclpy would swallow, with a traceback of its own files, is recorded."""

        async def noted(goal: ServerGoalHandle) -> Any:  # noqa: ANN401
            try:
                return await await_or_execute(callback, goal)
            except Exception as error:
                self._place.work_raised(self._state, callback_name(callback), error)
                self.entity._logger.error(f"Error raised in execute callback: {error}")
                return self.entity.action_type.Result()

        return noted

    def _answered(self) -> None:
        self.published(STATUS)  # of goals that were accepted
        for part in SERVICES:
            self._place.sent("client", f"{self.name}/_action/{part}")

    def published(self, topic: str) -> None:
        """The server has published one of the action's topics."""
        self._place.sent("subscription", f"{self.name}/_action/{topic}")

    # A client.

    def _prepare_client(self) -> None:
        client, place = self.entity, self._place
        self._chance = client._generate_random_uuid
        client._generate_random_uuid = self._next_id
        client.send_goal = self._send_goal
        client._get_result = lambda goal: self._result("get_result", client._get_result_async(goal))
        client._cancel_goal = lambda g: self._result("cancel_goal", client._cancel_goal_async(g))
        for method, part in zip(_SENDING, SERVICES, strict=True):
            _tell(client, method, partial(place.sent, "service", f"{self.name}/_action/{part}"))
        client.wait_for_server = self._wait_for_server
        client.execute = partial(self._hear, client.execute)

    async def _hear(self, execute: Callable[..., Any], taken: dict[str, Any]) -> None:
        # A status comes at no certain time: it is kept for those who come late, and sent to them
        # by a thread. Nobody is called for it.
        if set(taken) - {STATUS}:
            self._place.heard(self._state, self.kind, "hear", self.name)
        await execute(taken)

    def _next_id(self) -> UUID:
        number = self._place.next_goal()
        if not number:
            return self._chance()
        return UUID(uuid=list(sha256(f"{self.name} {number}".encode()).digest()[:16]))

    def _send_goal(self, goal: Any, **options: Any) -> Any:  # noqa: ANN401 - rclpy's own signature
        handle = self._result("send_goal", self.entity.send_goal_async(goal, **options))
        return None if handle is None else self.entity._get_result(handle)

    def _result(self, method: str, future: Any) -> Any:  # noqa: ANN401
        if not self._place.wait(f"client.{method}", future.done, None):
            raise _unanswered(self.name, method)
        return future.result()

    def _wait_for_server(self, timeout_sec: float | None = None) -> bool:
        client = self.entity
        if not client.server_is_ready():
            self._place.wait("client.wait_for_server", client.server_is_ready, timeout_sec)
        return bool(client.server_is_ready())


def action_of(entity: Any, state: NodeState) -> ActionEnd | None:  # noqa: ANN401
    """The action's end that an entity of rclpy's is; None if it is none."""
    return next((end for end in state.actions if end.entity is entity), None)


def _unanswered(action: str, method: str) -> SessionError:
    return SessionError(
        f"Nobody has answered {method} for the action {action}.",
        "Either no node of this session offers that action, or its work does not end. Outside a "
        "page the call would wait for ever.",
        "Add the node that offers the action first, and compare the two names.",
    )


def _tell(entity: Any, method: str, told: Callable[[], None]) -> None:  # noqa: ANN401
    """Let a method of one object also call `told` when it has returned."""
    original = getattr(entity, method)

    @wraps(original)
    def call(*given: Any, **named: Any) -> Any:  # noqa: ANN401
        result = original(*given, **named)
        told()
        return result

    setattr(entity, method, call)


# The hooks.


def _watch(original: Callable[..., None], kind: str) -> Callable[..., None]:
    order = signature(original)

    @wraps(original)
    def init(entity: Any, *given: Any, **named: Any) -> None:  # noqa: ANN401
        with asking(f"{type(entity).__name__}.__init__", *given, **named):
            original(entity, *given, **named)
        options = order.bind(entity, *given, **named)
        options.apply_defaults()
        node = options.arguments["node"]
        watcher = watcher_of(node)
        if watcher is not None:
            name = node.resolve_service_name(options.arguments["action_name"] + _PART)
            watcher.action_made(node, kind, entity, name.removesuffix(_PART), options.arguments)

    return init


def _publishing(original: Callable[..., None], topic: str) -> Callable[..., None]:
    @wraps(original)
    def publish(goal: ServerGoalHandle, *given: Any) -> None:  # noqa: ANN401
        original(goal, *given)
        end = getattr(goal._action_server, "_rosbeat_end", None)
        if end is not None:
            end.published(topic)

    return publish


def _install() -> None:
    ActionServer.__init__ = _watch(ActionServer.__init__, SERVER)
    ActionClient.__init__ = _watch(ActionClient.__init__, CLIENT)
    goal = ServerGoalHandle
    goal.publish_feedback = _publishing(goal.publish_feedback, FEEDBACK)
    goal._update_state = _publishing(goal._update_state, STATUS)


_install()  # at import, so exactly once in a process

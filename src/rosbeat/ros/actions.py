"""Run the actions of a session's nodes in virtual time, and record them.

rclpy implements an action as three services and two topics inside one waitable, where the hooks of
`recording` do not see them. This module therefore wraps the constructors of `ActionServer` and
`ActionClient`, and some private methods for which rclpy has no public counterpart. Within a
session, calls that wait for an action run virtual time, goals get the same ids in every run, and an
exception in an execute callback is shown like any other.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial, wraps
from hashlib import sha256
from inspect import signature
from typing import TYPE_CHECKING, Any

from rclpy.action import ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.executors import await_or_execute
from rclpy.task import Future
from unique_identifier_msgs.msg import UUID

from rosbeat.errors import SessionError
from rosbeat.records import NANOSECONDS, Endpoint
from rosbeat.ros.differences import let_rclpy_warn
from rosbeat.ros.exception_origin import asking
from rosbeat.ros.graph import qos_of
from rosbeat.ros.processes import NodeState, callback_name
from rosbeat.ros.recording import Entity, Message, core_of, type_name

if TYPE_CHECKING:
    from rosbeat.ros.ports import Sender

SERVER, CLIENT = "action server", "action client"
#: The services of an action, behind `/_action/`: their types, and the first word of QoS options.
SERVICES = {
    "send_goal": ("{}_SendGoal", "goal"),
    "cancel_goal": ("action_msgs/srv/CancelGoal", "cancel"),
    "get_result": ("{}_GetResult", "result"),
}
#: Its topics, and their types.
TOPICS = {"feedback": "{}_FeedbackMessage", "status": "action_msgs/msg/GoalStatusArray"}
_SEND_GOAL = "/_action/send_goal"


class ActionEnd:
    """Hold one action server or client of a node, with the `options` of its constructor."""

    def __init__(
        self,
        core: Sender,
        state: NodeState,
        kind: str,
        entity: Any,  # noqa: ANN401 - one of the two
        name: str,
        options: dict[str, Any],
    ) -> None:
        self.kind, self.entity, self.name = kind, entity, name
        self._core, self._state, self._options = core, state, options
        self._prepare_server() if kind == SERVER else self._prepare_client()

    @property
    def exists(self) -> bool:
        """Return whether it has not been destroyed by itself."""
        return any(one is self.entity for one in self._state.node.waitables)

    def endpoints(self) -> list[Endpoint]:
        """Return the action itself, and the services and topics that it is made of."""
        own, node = type_name(self._options["action_type"]), self._state.name
        is_server = self.kind == SERVER
        service, topic = ("server", "publisher") if is_server else ("client", "subscription")
        short = "pub" if is_server else "sub"

        def end(part: str, type_: str, kind: str, option: str) -> Endpoint:
            qos = qos_of(self._options[f"{option}_qos_profile"])
            return Endpoint(node, self.name + part, type_.format(own), kind, qos)

        return [
            end("", own, self.kind, "goal_service"),
            *(end(f"/_action/{part}", type_, service, f"{option}_service")
              for part, (type_, option) in SERVICES.items()),
            *(end(f"/_action/{part}", type_, topic, f"{part}_{short}")
              for part, type_ in TOPICS.items()),
        ]  # fmt: skip

    # A server.

    def _prepare_server(self) -> None:
        # Each accepted goal goes through this method, and its exceptions end there.
        server, work = self.entity, self.entity._execute_goal

        async def execute(callback: Callable[..., Any], goal: ServerGoalHandle) -> None:
            await work(self._noting(callback), goal)

        execute.__name__ = callback_name(server._execute_callback)  # in errors
        server._execute_goal = execute
        server._rosbeat_end = self
        server.execute = partial(self._serve, server.execute)
        server.add_to_wait_set = partial(self._look, server, server.add_to_wait_set)
        server.take_data = partial(self._take, server, server.take_data)

    @staticmethod
    def _look(server: ActionServer, add_to_wait_set: Callable[[Any], None], wait_set: Any) -> None:  # noqa: ANN401 - rclpy's
        """Let the time at which goals are forgotten come: rcl measures it by the node's clock."""
        server._node.get_clock().move()
        add_to_wait_set(wait_set)

    @staticmethod
    def _take(server: ActionServer, take: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        """Take what is ready, and forget goals whose results were kept for long enough.

        rcl forgets a goal when *more* time has passed (`rcl_action_expire_goals`). At the instant
        itself, which takes no time on a robot, it would find nothing and look again, forever.
        """
        if not server._is_goal_expired:
            return take()
        with server._node.get_clock().a_moment_later():
            return take()

    async def _serve(self, execute: Callable[..., Any], taken: dict[str, Any]) -> None:
        self._core.reports.heard(self._state, self.kind, "serve", self.name)
        await execute(taken)
        self.published("status")  # of goals that were accepted

    def _noting(self, callback: Callable[..., Any]) -> Callable[..., Any]:
        """Return a callback that records an exception, which rclpy would only log."""

        async def noted(goal: ServerGoalHandle) -> Message:
            try:
                return await await_or_execute(callback, goal)
            except Exception as error:
                self._core.reports.work_raised(self._state, callback_name(callback), error)
                # With the logger that rclpy itself would have used.
                self.entity._logger.error(f"Error raised in execute callback: {error}")
                return self.entity.action_type.Result()

        return noted

    def published(self, topic: str) -> None:
        """Note that the server has published on one of the action's topics."""
        self._core.sent("subscription", f"{self.name}/_action/{topic}", self._state)
        kept = self._options.get("result_timeout")
        if topic == "status" and isinstance(kept, int | float) and self._core.live is None:
            # A goal that has just ended is forgotten then.
            self._core.virtual.look_at(self._core.now() + round(kept * NANOSECONDS))

    # A client.

    def _prepare_client(self) -> None:
        client = self.entity
        # All the random numbers of a client are drawn here; its calls that wait end in the others.
        self._chance = client._generate_random_uuid
        for method in ("send_goal_async", "_cancel_goal_async", "_get_result_async"):
            setattr(client, method, self._sending(getattr(client, method)))
        client._generate_random_uuid = self._next_id
        client.send_goal = partial(self._send_goal, client.send_goal)
        client._get_result = partial(
            self._ask, "get_result", client._get_result, client._get_result_async
        )
        client._cancel_goal = partial(
            self._ask, "cancel_goal", client._cancel_goal, client._cancel_goal_async
        )
        client.wait_for_server = partial(self._wait_for_server, client.wait_for_server)
        client.execute = partial(self._hear, client.execute)

    def _sending(self, send: Callable[..., Future]) -> Callable[..., Future]:
        """Return a method that also lets executors look whether something has come."""

        @wraps(send)
        def sent(*given: Any, **options: Any) -> Future:  # noqa: ANN401 - rclpy's own
            future = send(*given, **options)
            self._core.virtual.hidden_event()
            return future

        return sent

    async def _hear(self, execute: Callable[..., Any], taken: dict[str, Any]) -> None:
        # A status is stored for late-joining clients, to whom a thread sends it at no certain time.
        # No callback is called for it.
        if set(taken) - {"status"}:
            self._core.reports.heard(self._state, self.kind, "hear", self.name)
        await execute(taken)

    def _next_id(self) -> UUID:
        number = self._core.next_goal()
        if not number:
            return self._chance()
        return UUID(uuid=list(sha256(f"{self.name} {number}".encode()).digest()[:16]))

    def _send_goal(self, send: Callable[..., Any], goal: Any, **options: Any) -> Any:  # noqa: ANN401 - rclpy's own signature
        if self._waits_by_itself():
            with self._waiting():
                return send(goal, **options)
        handle = self._result("send_goal", self.entity.send_goal_async(goal, **options))
        # The `_get_result` of `_prepare_client`, which `handle.get_result` calls.
        return None if handle is None else self.entity._get_result(handle)

    def _waits_by_itself(self) -> bool:
        """Return whether rclpy's own way waits in virtual time: in code of a node."""
        return self._core.live is None and self._core.virtual.in_callback

    def _waiting(self) -> AbstractContextManager[None]:
        return self._core.waiting_for(f"a response from the action {self.name}", self.entity)

    def _result(self, method: str, future: Future) -> Message:
        if not self._core.wait(f"client.{method}", future.done, None):
            raise SessionError(
                f"No action server has responded to {method} for the action {self.name}.",
                "Either no node of this session offers that action, or its execute callback does "
                "not return. On a robot, the call would wait forever.",
                "Add the node that offers the action first, and compare the two action names.",
            )
        return future.result()

    def _ask(
        self,
        method: str,
        wait: Callable[..., Any],
        send: Callable[..., Future],
        goal: Any,  # noqa: ANN401 - rclpy's own
    ) -> Message:
        if self._waits_by_itself():
            with self._waiting():
                return wait(goal)
        return self._result(method, send(goal))

    def _wait_for_server(self, wait: Callable[..., bool], timeout_sec: float | None = None) -> bool:
        client = self.entity
        if self._waits_by_itself():
            return bool(wait(timeout_sec))
        if not client.server_is_ready():
            self._core.wait("client.wait_for_server", client.server_is_ready, timeout_sec)
        return bool(client.server_is_ready())


def action_of(entity: Entity, state: NodeState) -> ActionEnd | None:
    """Return the action server or client that an entity of rclpy's is, or None."""
    return next((end for end in state.actions if end.entity is entity), None)


# The hooks.


def watch_action(original: Callable[..., None], kind: str) -> Callable[..., None]:
    """Wrap the constructor of an action's client or server, so that the session watches it."""
    order = signature(original)

    @wraps(original)
    def init(entity: Entity, *given: Any, **named: Any) -> None:  # noqa: ANN401 - passed on
        with asking(f"{type(entity).__name__}.__init__", *given, **named):
            original(entity, *given, **named)
        let_rclpy_warn(entity._logger)
        options = order.bind(entity, *given, **named)
        options.apply_defaults()
        node = options.arguments["node"]
        core = core_of(node)
        state = core.nodes.state_of(node) if core is not None else None
        if core is not None and state is not None:
            name = node.resolve_service_name(options.arguments["action_name"] + _SEND_GOAL)
            name = name.removesuffix(_SEND_GOAL)
            state.actions.append(ActionEnd(core, state, kind, entity, name, options.arguments))
            core.action_ends.add(entity)
            core.virtual.hand_over(state.process)

    return init


def watch_publishing(original: Callable[..., None], topic: str) -> Callable[..., None]:
    """Wrap a method of a goal's handle after which its server has published on a topic."""

    @wraps(original)
    def publish(goal: ServerGoalHandle, *given: Message) -> None:
        original(goal, *given)
        # A goal handle knows its server, and has no public name for it.
        end = getattr(goal._action_server, "_rosbeat_end", None)
        if end is not None:
            end.published(topic)

    return publish

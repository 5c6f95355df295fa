"""Implement `ros2 action`: list actions and send goals."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable

from ros2_command.errors import CommandError, note
from ros2_command.graph import Graph, open_graph
from ros2_command.messages import (
    FieldError,
    Style,
    fill,
    read_yaml,
    to_yaml,
    value_arguments,
    value_text,
)
from ros2_command.names import (
    Entries,
    absolute,
    check_name,
    full_type,
    show_entries,
    show_types,
    suggestion,
    type_class,
    types_of,
    wait_for_server,
)
from ros2_command.registry import Verb, argument, flag
from ros2_command.untyped import Untyped

#: Words for the values of `action_msgs/msg/GoalStatus.status`.
_STATUSES = ("UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")
#: Seconds that a server has to say that it cancels a goal.
_CANCEL_WITHIN = 5.0


def _actions(graph: Graph) -> Entries:
    from rclpy.action import get_action_names_and_types

    graph.settle()
    return sorted(get_action_names_and_types(graph.node))


def _list(args: Namespace) -> None:
    with open_graph() as graph:
        found = _actions(graph)
    show_entries(found, args.count_actions, args.show_types)


def _type(args: Namespace) -> None:
    with open_graph() as graph:
        name = args.action_name
        types = types_of(name, _actions(graph), f"Unknown action '{name}'", silent=True)
    print("\n".join(types))


def _info(args: Namespace) -> None:
    from rclpy import action

    check_name("action", args.action_name)
    name = absolute(args.action_name)
    with open_graph() as graph:
        known = dict(_actions(graph))
        clients = _nodes_with(graph, name, action.get_action_client_names_and_types_by_node)
        servers = _nodes_with(graph, name, action.get_action_server_names_and_types_by_node)
    print(f"Action: {args.action_name}")
    for word, nodes in (("clients", clients), ("servers", servers)):
        print(f"Action {word}: {len(nodes)}")
        for node, types in () if args.count else nodes:
            print(f"    {node} {show_types(types)}" if args.show_types else f"    {node}")
    if name not in known:  # the original is content with zeros, and so is the exit code
        note(suggestion(name, known))


def _nodes_with(graph: Graph, action: str, ask: Untyped) -> Entries:
    """Return the nodes that have a client or a server of an action, with its types."""
    found = []
    for node in graph.nodes():
        namespace, _, name = node.rpartition("/")
        types = dict(ask(graph.node, name, namespace or "/")).get(action)
        found += [(node, types)] if types else []
    return found


def _send_goal(args: Namespace) -> int:
    from rclpy.action import ActionClient

    check_name("action", args.action_name)
    kind = type_class(args.action_type, "action")
    goal = kind.Goal()
    try:
        fill(goal, read_yaml(value_text(args.goal, args.stdin)), stamps=False)
    except FieldError as error:
        said = f"Failed to populate message fields: {error.as_exception}"
        raise CommandError(said, *error.notes) from None
    with open_graph() as graph:
        client = ActionClient(graph.node, kind, args.action_name)
        try:
            print("Waiting for an action server to become available...")
            asked = full_type(args.action_type, "action")
            wait_for_server(
                graph, client.server_is_ready, "action", args.action_name, asked,
                lambda: _actions(graph),
            )  # fmt: skip
            return _follow(graph, client, goal, args.feedback)
        finally:
            client.destroy()


def _follow(graph: Graph, client: Untyped, goal: Untyped, feedback: bool) -> int:
    """Send a goal and wait for its end; Ctrl+C cancels it."""
    early: list[Untyped] = []  # feedback that came together with the word that the goal is accepted
    keep: Callable[[Untyped], None] = early.append

    def show(message: Untyped) -> None:
        print(f"Feedback:\n    {_yaml(message.feedback)}")

    def take(message: Untyped) -> None:
        keep(message)

    print(f"Sending goal:\n     {_yaml(goal)}")
    handle = _wait(graph, client.send_goal_async(goal, take if feedback else None))
    if not handle.accepted:
        print("Goal was rejected.")
        return 0
    try:
        print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
        keep = show
        for message in early:
            show(message)
        outcome = _wait(graph, handle.get_result_async())
    except KeyboardInterrupt:
        print("Canceling goal...")
        future = handle.cancel_goal_async()
        if not graph.spin_until(future.done, _CANCEL_WITHIN):
            raise CommandError("Failed to cancel goal: the server does not answer") from None
        if not future.result().goals_canceling:
            raise CommandError("Failed to cancel goal: the server refused") from None
        print("Goal canceled.")
        raise
    print(f"Result:\n    {_yaml(outcome.result)}")
    print(f"Goal finished with status: {_STATUSES[outcome.status]}")
    return 0


def _wait(graph: Graph, future: Untyped) -> Untyped:
    graph.spin_until(future.done)
    if (error := future.exception()) is not None:
        raise CommandError(f"The action server failed: {error}")
    return future.result()


def _yaml(message: Untyped) -> str:
    return to_yaml(message, Style(limit=None))


_TYPES = flag("-t", "--show-types", help="Additionally show the action type")
VERBS = {
    "info": Verb(
        "Print information about an action",
        _info,
        argument("action_name", help="Name of the ROS action to get info (e.g. '/fibonacci')"),
        _TYPES,
        flag("-c", "--count", help="Only display the number of action clients and action servers"),
    ),
    "list": Verb(
        "Output a list of action names",
        _list,
        _TYPES,
        flag("-c", "--count-actions", help="Only display the number of actions discovered"),
    ),
    "send_goal": Verb(
        "Send an action goal",
        _send_goal,
        argument("action_name", help="Name of the ROS action (e.g. '/fibonacci')"),
        argument("action_type",
                 help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')"),
        value_arguments("goal", "Goal request values in YAML format (e.g. '{order: 10}')"),
        flag("-f", "--feedback", help="Echo feedback messages for the goal"),
    ),
    "type": Verb(
        "Print a action's type",
        _type,
        argument("action_name", help="Name of the ROS action to get type (e.g. '/fibonacci')"),
    ),
}  # fmt: skip

"""`ros2 topic echo`."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from typing import Any

from ros2_command.errors import CommandError
from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.listening import compile_filter, subscribe
from ros2_command.lookup import topic_class
from ros2_command.message_text import Style, is_message_value, plain_to_yaml, to_csv, to_yaml
from ros2_command.names import absolute, check_name
from ros2_command.nearest import did_you_mean
from ros2_command.qos import add_qos_arguments, asked_profile, follow_publishers
from ros2_command.untyped import Untyped


def add_arguments(parser: ArgumentParser) -> None:
    """A topic, what to show of its messages, and when to stop."""
    add_graph_arguments(parser)
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    add("message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add_qos_arguments(parser, "subscribe", "sensor_data")
    add("--csv", action="store_true", help="Output all recursive fields separated by commas")
    add("--field", help="Echo a selected field of a message (e.g. 'pose.pose')")
    add("-f", "--full-length", action="store_true",
        help="Output all elements for arrays, bytes, and strings")  # fmt: skip
    add("-l", "--truncate-length", type=int, default=128,
        help="The length to truncate arrays, bytes, and strings to (default: 128)")  # fmt: skip
    add("--no-arr", action="store_true", help="Don't print array fields of messages")
    add("--no-str", action="store_true", help="Don't print string fields of messages")
    add("--flow-style", action="store_true", help="Print collections in the flow style")
    add("--no-lost-messages", action="store_true", help="Don't report when a message is lost")
    add("--raw", action="store_true", help="Echo the raw binary representation")
    add("--filter", metavar="FILTER", dest="filter_expr",
        help="Python expression that selects messages (the message is 'm')")  # fmt: skip
    add("--once", action="store_true", help="Print the first message received and then exit.")
    add("--timeout", metavar="N", type=float, help="Set a timeout in seconds for waiting")
    add("-i", "--include-message-info", action="store_true", help="Shows the associated info")


def main(args: Namespace) -> None:
    """Print messages until enough have come."""
    if args.field is not None and not args.field.strip("."):
        raise CommandError(f"Invalid field value '{args.field}'")
    wanted = compile_filter(args.filter_expr)
    check_name("topic", args.topic_name)
    with open_graph(args) as graph:
        # For one message any publisher will do; to hear all of them, all must be known first.
        name = absolute(args.topic_name)
        graph.settle(lambda: args.once and _is_published(graph, name))
        kind = topic_class(args.topic_name, args.message_type, graph)
        publishers = graph.publishers(name)
        if not publishers:
            print(f"Nobody publishes on '{args.topic_name}' yet. Waiting.", file=sys.stderr)
        profile = asked_profile(args, "sensor_data")
        follow_publishers(profile, args, publishers)
        _listen(args, graph, kind, profile, wanted)


def _is_published(graph: Graph, name: str) -> bool:
    return name in dict(graph.topics()) and bool(graph.publishers(name))


def _listen(
    args: Namespace, graph: Graph, kind: Untyped, profile: Untyped, wanted: Callable[[Any], bool]
) -> None:
    count = 0

    def show(message: Untyped, info: dict[str, Any]) -> None:
        nonlocal count
        if count and args.once:
            return
        if args.raw or wanted(message):
            count += 1
            sys.stdout.write(text_of(message, info, args))

    lost = None if args.no_lost_messages else _report_loss
    subscribe(graph, args.topic_name, kind, show, profile, args.raw, lost)
    graph.spin_until(lambda: bool(count and args.once), args.timeout)
    if not count and args.timeout is not None:
        raise CommandError(
            f"No message came on '{args.topic_name}' within {args.timeout:g} seconds"
        )


def _report_loss(event: Untyped) -> None:
    print(
        f"{event.total_count_change} message(s) lost, {event.total_count} in total",
        file=sys.stderr,
    )


def text_of(message: Untyped, info: dict[str, Any], args: Namespace) -> str:
    """What to print for a message.

    Args:
        message: The message, or its bytes with `--raw`.
        info: When it was sent and received.
        args: The options of this verb.
    """
    style = Style(
        None if args.full_length else args.truncate_length,
        args.no_arr, args.no_str, args.flow_style,
    )  # fmt: skip
    about = info if args.include_message_info else None
    if args.raw:
        return _info_yaml(about) + f"{message!r}\n---\n"
    value = selected(message, args.field) if args.field is not None else message
    if not is_message_value(value):
        if about is None:
            return f"{value}\n---\n"
        head = "---Got new message, message info:---"
        return f"{head}\n{about}\n---Message data:---\n{value}\n---\n"
    if args.csv:
        return _info_csv(about) + to_csv(value, style) + "\n"
    return _info_yaml(about) + to_yaml(value, style) + "---\n"


def _info_yaml(info: dict[str, Any] | None) -> str:
    return "" if info is None else plain_to_yaml(dict(sorted(info.items()))) + "---\n"


def _info_csv(info: dict[str, Any] | None) -> str:
    if info is None:
        return ""
    names = ("source_timestamp", "received_timestamp", "publication_sequence_number",
             "reception_sequence_number")  # fmt: skip
    return "".join(f"{info[name]}," for name in names)


def selected(message: Untyped, field: str) -> Untyped:
    """A field of a message, or of a message in it.

    Raises:
        CommandError: If there is none of that name.
    """
    value = message
    for name in field.split("."):
        known = value.get_fields_and_field_types() if is_message_value(value) else {}
        if name not in known:
            raise CommandError(
                f"Invalid field '{field}': '{type(value).__name__}' object has no attribute "
                f"'{name}'",
                did_you_mean(name, known, f"It has: {', '.join(known)}" if known else ""),
            )
        value = getattr(value, name)
    return value

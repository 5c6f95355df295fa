"""`ros2 topic pub`."""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser, ArgumentTypeError, Namespace

from ros2_command.errors import CommandError
from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.lookup import message_class, suggestion
from ros2_command.message_values import Stamper, fill, read_yaml, value_text
from ros2_command.names import absolute, check_name, check_node_name
from ros2_command.qos import add_qos_arguments, asked_profile
from ros2_command.untyped import Untyped


def _positive_float(text: str) -> float:
    value = float(text)
    if not value > 0:
        raise ArgumentTypeError("Value must be positive")
    return value


def nonnegative_int(text: str) -> int:
    """A whole number, zero or more, for argparse."""
    value = int(text)
    if value < 0:
        raise ValueError("Value must be positive or zero")
    return value


def add_arguments(parser: ArgumentParser) -> None:
    """A topic, a type, a value, and how often."""
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    add("message_type", help="Type of the ROS message (e.g. 'std_msgs/String')")
    add("values", nargs="?", help="Values to fill the message with in YAML format")
    add("--stdin", action="store_true", help="Read values from standard input")
    add("-r", "--rate", metavar="N", type=_positive_float, default=1.0,
        help="Publishing rate in Hz (default: 1)")  # fmt: skip
    add("-p", "--print", metavar="N", type=int, default=1, dest="print_every",
        help="Only print every N-th published message (default: 1)")  # fmt: skip
    times = parser.add_mutually_exclusive_group()
    times.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    times.add_argument("-t", "--times", type=nonnegative_int, default=0,
                       help="Publish this number of times and then exit")  # fmt: skip
    add("-w", "--wait-matching-subscriptions", type=nonnegative_int,
        help="Wait until finding the specified number of matching subscriptions. "
        "(default: 1 with --once or --times, else 0)")  # fmt: skip
    add("--max-wait-time-secs", type=_positive_float,
        help="Maximum seconds to wait for matching subscriptions")  # fmt: skip
    add("--keep-alive", metavar="N", type=float, default=0.1,
        help="Keep the node alive for N seconds after the last message (default: 0.1)")  # fmt: skip
    add("-n", "--node-name", help="Name of the created publishing node")
    add_qos_arguments(parser, "publish", "default")
    add_graph_arguments(parser, daemon=False)


def main(args: Namespace) -> None:
    """Publish a message, once, several times, or until Ctrl+C."""
    check_name("topic", args.topic_name)
    if args.node_name is not None:
        check_node_name(args.node_name)
    kind = message_class(args.message_type)
    values = read_yaml(value_text(args.values, args.stdin))
    if not isinstance(values, dict):
        raise CommandError("The passed value needs to be a dictionary in YAML format")
    message = kind()
    stampers = fill(message, values)
    times = 1 if args.once else args.times
    waited = args.wait_matching_subscriptions
    needed = (1 if times else 0) if waited is None else waited
    if args.max_wait_time_secs is not None and not needed:
        raise CommandError(
            "--max-wait-time-secs option is only effective with --wait-matching-subscriptions, "
            "--once or --times"
        )
    with open_graph(args, args.node_name) as graph:
        profile = asked_profile(args, "default")
        publisher = graph.node.create_publisher(kind, args.topic_name, profile)
        wait_for_subscriptions(graph, publisher, args, needed)
        _publish(graph, publisher, args, message, stampers, times)


def wait_for_subscriptions(graph: Graph, publisher: Untyped, args: Namespace, needed: int) -> None:
    """Wait until enough others listen.

    Raises:
        CommandError: If they do not come in time.
    """
    limit = args.max_wait_time_secs
    end = None if limit is None else time.monotonic() + limit

    def enough() -> bool:
        return int(publisher.get_subscription_count()) >= needed

    hinted = False
    while not enough():
        left = None if end is None else end - time.monotonic()
        if left is not None and left <= 0:
            raise CommandError(
                f"Timed out waiting for subscribers: Expected {needed} subcribers but only got "
                f"{publisher.get_subscription_count()} subscribers"
            )
        print(f"Waiting for at least {needed} matching subscription(s)...")
        graph.spin_until(enough, 1.0 if left is None else min(1.0, left))
        if not hinted and not graph.settle(enough).spin_until(enough, 0):
            hinted = True
            _hint(graph, args)


def _hint(graph: Graph, args: Namespace) -> None:
    """Say once why nobody may be listening: another topic, or another type."""
    name = absolute(args.topic_name)
    heard = {one: types for one, types in graph.topics() if graph.others(graph.subscriptions(one))}
    types = {one.topic_type for one in graph.others(graph.subscriptions(name))}
    if types:
        print(f"'{name}' is subscribed to with {', '.join(sorted(types))}.", file=sys.stderr)
    else:
        print(f"Nobody listens to '{name}'. {suggestion(name, heard)}", file=sys.stderr)


def _publish(
    graph: Graph, publisher: Untyped, args: Namespace, message: Untyped,
    stampers: list[Stamper], times: int,
) -> None:  # fmt: skip
    from rclpy.duration import Duration

    print("publisher: beginning loop")
    count, due = 0, time.monotonic()
    while not times or count < times:
        graph.spin_for(due - time.monotonic())
        for stamp in stampers:
            stamp(graph.node.get_clock().now().to_msg())
        count += 1
        if args.print_every and count % args.print_every == 0:
            print(f"publishing #{count}: {message!r}\n")
        publisher.publish(message)
        due += 1 / args.rate
    publisher.wait_for_all_acked(Duration(seconds=max(0.0, args.keep_alive)))
    time.sleep(max(0.0, args.keep_alive))

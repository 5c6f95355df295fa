"""Implement `ros2 topic`: list, echo, publish and measure topics."""

from __future__ import annotations

import sys
import time
from argparse import SUPPRESS, ArgumentTypeError, Namespace
from collections import deque
from collections.abc import Callable, Sequence
from functools import partial
from itertools import count
from typing import Any

from ros2_command.errors import CommandError, note
from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.messages import (
    Stamper,
    add_style_arguments,
    fill,
    is_message_value,
    plain_to_yaml,
    read_yaml,
    style_of,
    to_csv,
    to_yaml,
    value_arguments,
    value_text,
)
from ros2_command.names import (
    Entries,
    absolute,
    check_name,
    check_node_name,
    did_you_mean,
    is_hidden,
    of_type,
    show_entries,
    show_types,
    suggestion,
    topic_class,
    type_class,
    types_of,
    visible,
)
from ros2_command.qos import add_qos_arguments, asked_profile, chosen_profile
from ros2_command.registry import Argument, Verb, argument, flag, one_of
from ros2_command.untyped import Untyped

# Without a default, what stands before the verb counts, too.
_HIDDEN = argument(
    "--include-hidden-topics", action="store_true", default=SUPPRESS,
    help="Consider hidden topics as well",
)  # fmt: skip
_UNITS = (("B", 1, 0), ("KB", 1_000, 2), ("MB", 1_000_000, 2), ("GB", 1_000_000_000, 2))
_COUNT = flag("-c", "--count-topics", help="Only display the number of topics discovered")


def _list(args: Namespace) -> None:
    with open_graph(args) as graph:
        topics = visible(graph.settle().topics(), args.include_hidden_topics)
        details = _details(graph, topics) if args.verbose else []
    if details and not args.count_topics:
        print("\n".join(details))
    else:
        show_entries(topics, args.count_topics, args.show_types)


def _details(graph: Graph, topics: Entries) -> list[str]:
    lines = []
    for title, word, ask in (
        ("Published", "publisher", graph.publishers),
        ("Subscribed", "subscriber", graph.subscriptions),
    ):
        lines.append(f"{title} topics:")
        for name, types in topics:
            if count := len(graph.others(ask(name))):
                ending = "" if count == 1 else "s"
                lines.append(f" * {name} {show_types(types)} {count} {word}{ending}")
        lines.append("")
    return lines


def _type(args: Namespace) -> None:
    with open_graph(args) as graph:
        topics = graph.settle().topics()
    name = args.topic_name
    types = types_of(name, topics, f"Unknown topic '{name}'", silent=True)
    if is_hidden(name) and not args.include_hidden_topics:
        raise CommandError(
            "",
            f"The topic '{name}' is hidden: a part of its name begins with '_'.",
            f"Its type:  ros2 topic --include-hidden-topics type {name}",
        )
    print("\n".join(types))


def _find(args: Namespace) -> None:
    with open_graph(args) as graph:
        found = of_type(graph.settle().topics(), args.topic_type, args.include_hidden_topics)
    for line in [len(found)] if args.count_topics else found:
        print(line)


def _info(args: Namespace) -> None:
    with open_graph(args) as graph:
        topics = graph.settle().topics()
        name = args.topic_name
        types = types_of(name, topics, f"Unknown topic '{name}'")
        publishers = graph.others(graph.publishers(name))
        subscriptions = graph.others(graph.subscriptions(name))
    end = "\n\n" if args.verbose else "\n"
    print("Type:", types[0] if len(types) == 1 else types, end=end)
    for word, endpoints in (("Publisher", publishers), ("Subscription", subscriptions)):
        print(f"{word} count:", len(endpoints), end=end)
        for one in endpoints if args.verbose else ():
            print(one, end="\n\n")


def subscribe(
    graph: Graph,
    topic: str,
    kind: Untyped,
    callback: Callable[[Any, dict[str, Any]], None],
    profile: Untyped = None,
    raw: bool = False,
    lost: Callable[[Any], None] | None = None,
) -> None:
    """Subscribe to a topic.

    Args:
        graph: Where to subscribe.
        topic: The topic as typed.
        kind: The message class.
        callback: Gets each message and what is known about it.
        profile: The quality of service, that of sensor data by default.
        raw: Whether the callback wants the bytes.
        lost: Gets a report if messages were lost.
    """
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.qos import qos_profile_sensor_data

    graph.node.create_subscription(
        kind, topic, callback, profile or qos_profile_sensor_data, raw=raw,
        event_callbacks=SubscriptionEventCallbacks(message_lost=lost),
    )  # fmt: skip


def compile_filter(text: str | None) -> Callable[[Any], bool]:
    """Return a condition over `m`, a message or the field of it that is asked for.

    Raises:
        CommandError: If the text is no Python expression, or later, if it cannot be computed.
    """
    if text is None:
        return lambda message: True
    try:
        code = compile(text, "filter", "eval")
    except SyntaxError as error:
        raise CommandError(
            f"--filter {text!r} is not a Python expression: {error.msg}",
            "Write a condition over the message m, for example:  --filter 'm.data > 20'",
        ) from None

    def holds(value: Untyped) -> bool:
        try:
            return bool(eval(code, {"m": value}))
        except Exception as error:
            raise CommandError(f"--filter {text!r} failed: {error}") from None

    return holds


def _echo(args: Namespace) -> None:
    if args.field is not None and not args.field.strip("."):
        raise CommandError(f"Invalid field value '{args.field}'")
    wanted = compile_filter(args.filter_expr)
    check_name("topic", args.topic_name)
    name = absolute(args.topic_name)
    with open_graph(args) as graph:
        # For one message any publisher will do; to hear all of them, all must be known first.
        graph.settle(lambda: args.once and bool(_publishers(graph, name)))
        kind = topic_class(args.topic_name, args.message_type, graph)
        publishers = _publishers(graph, name)
        if not publishers and args.timeout is None:
            note(f"No node publishes on '{args.topic_name}' yet. Waiting.")
        profile = chosen_profile(args, publishers)
        shown = 0

        def show(message: Untyped, info: dict[str, Any]) -> None:
            nonlocal shown
            if shown and args.once:
                return
            value = message
            if args.field is not None and not args.raw:
                value = selected(message, args.field)
            # As upstream does: with --field, the filter's m is that field.
            if args.raw or wanted(value):
                shown += 1
                sys.stdout.write(_text_of(value, info, args))

        lost = None if args.no_lost_messages else _report_loss
        subscribe(graph, args.topic_name, kind, show, profile, args.raw, lost)
        graph.spin_until(lambda: bool(shown and args.once), args.timeout)


def _publishers(graph: Graph, name: str) -> list[Any]:
    return graph.publishers(name) if name in dict(graph.topics()) else []


def _report_loss(event: Untyped) -> None:
    print(
        f"A message was lost!!!\n\ttotal count change:{event.total_count_change}\n\t"
        f"total count: {event.total_count}---"
    )


def _text_of(value: Untyped, info: dict[str, Any], args: Namespace) -> str:
    style, about = style_of(args), info if args.include_message_info else None
    if args.raw:
        return _info_yaml(about) + f"{value!r}\n---\n"
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
    """Return a field of a message, or of a message in it.

    Raises:
        CommandError: If there is none of that name.
    """
    value, names = message, [name for name in field.split(".") if name]
    for name in names:
        known = value.get_fields_and_field_types() if is_message_value(value) else {}
        if name not in known:
            kind = type(value)
            plain = kind.__module__ == "builtins" or is_message_value(value)
            module = "" if plain else f"{kind.__module__}."
            raise CommandError(
                f"Invalid field '{'.'.join(names)}': '{module}{kind.__name__}' object has no "
                f"attribute '{name}'",
                did_you_mean(name, known, f"It has: {', '.join(known)}" if known else ""),
            )
        value = getattr(value, name)
    return value


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise ArgumentTypeError("value must be a positive integer")
    return int(text)


def _measured(name: str, about: str, window: int, *more: Argument) -> tuple[Argument, ...]:
    """Return the arguments of the verbs that measure a topic."""
    return (
        argument(name, help=about),
        argument(
            "--window", "-w", type=_positive, default=window, metavar="WINDOW",
            help=f"window size, in # of messages, for calculating rate (default: {window})",
        ),
        *more,
        partial(add_graph_arguments, daemon=False),
    )  # fmt: skip


class _Measurements:
    """Keep the last seconds that were measured, and report on them when there are new ones.

    Args:
        window: How many to keep.
    """

    def __init__(self, window: int) -> None:
        self._values: deque[float] = deque(maxlen=window)
        self._last: float | None = None
        self._news = False

    def _add(self, value: float) -> None:
        self._values.append(value)
        self._news = True

    def _news_of(self, name: str, average: Callable[[float], float], more: int = 0) -> str | None:
        """Return two lines, or None if nothing has come since the last report.

        Args:
            name: What is averaged.
            average: Makes what is printed of the mean of the values.
            more: How many messages there were besides one for each value.
        """
        from statistics import fmean, pstdev

        if not self._news:
            return None
        self._news = False
        return (
            f"average {name}: {average(fmean(self._values)):.3f}\n"
            f"\tmin: {min(self._values):.3f}s max: {max(self._values):.3f}s "
            f"std dev: {pstdev(self._values):.5f}s window: {len(self._values) + more}"
        )


class Rates(_Measurements):
    """Measure the intervals between messages."""

    def arrived(self, now: float) -> None:
        """Count a message that came at this time in seconds."""
        if self._last is not None:
            self._add(now - self._last)
        self._last = now

    def report(self) -> str | None:
        """Return two lines, or None if nothing has come since the last report."""
        return self._news_of("rate", lambda mean: 1 / mean if mean else 0.0, more=1)


class Delays(_Measurements):
    """Measure how long after their stamps messages arrive."""

    def arrived(self, now: float, stamp: float) -> None:
        """Count a message that came at this time and bears this stamp, both in seconds.

        The first one only starts the clock, as in the original; so does one from an earlier time.
        """
        if self._last is None or now < self._last:
            self._values.clear()
            self._news = False
        else:
            self._add(now - stamp)
        self._last = now

    def report(self) -> str | None:
        """Return two lines, or None if nothing has come since the last report."""
        return self._news_of("delay", lambda mean: mean)


class Bandwidth:
    """Measure bytes per second.

    Args:
        window: How many messages to keep.
    """

    def __init__(self, window: int) -> None:
        self._arrivals: deque[tuple[float, int]] = deque(maxlen=window)

    def arrived(self, now: float, size: int) -> None:
        """Count a message of so many bytes that came at this time in seconds."""
        self._arrivals.append((now, size))

    def report(self, now: float) -> str | None:
        """Return two lines, or None if there are too few messages."""
        if len(self._arrivals) < 2:
            return None
        if now <= self._arrivals[0][0]:  # time went back
            self._arrivals.clear()
            return None
        sizes = [size for _, size in self._arrivals]
        rate = sum(sizes) / (now - self._arrivals[0][0])
        unit, factor, digits = [one for one in _UNITS if rate >= one[1] or one[1] == 1][-1]

        def show(size: float) -> str:
            return f"{size / factor:.{digits}f} {unit}"

        return (
            f"{show(rate)}/s from {len(sizes)} messages\n\tMessage size "
            f"mean: {show(sum(sizes) / len(sizes))} min: {show(min(sizes))} max: {show(max(sizes))}"
        )


def _known_class(graph: Graph, topic: str) -> Untyped:
    """Return the message class of a topic; if it is not there yet, say so and wait for it."""
    check_name("topic", topic)
    name = absolute(topic)

    def there() -> bool:
        return name in dict(graph.topics())

    graph.settle(there)
    if not there():
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
        note(suggestion(name, dict(graph.topics())))
        graph.spin_until(there)
    return topic_class(topic, None, graph)


def _measure(graph: Graph, report: Callable[[], str | None]) -> None:
    """Print a report each second, for ever."""
    for _ in graph.ticks(1.0):
        if text := report():
            print(text)


def _hz(args: Namespace) -> None:
    wanted = compile_filter(args.filter_expr)
    rates = Rates(args.window)
    with open_graph(args) as graph:
        kind = _known_class(graph, args.topic_name)
        clock = time.monotonic if args.wall_time else graph.clock()

        def measure(message: Untyped, info: dict[str, Any]) -> None:
            if (now := clock()) and wanted(message):  # 0 is simulated time that has not begun
                rates.arrived(now)

        subscribe(graph, args.topic_name, kind, measure)
        _measure(graph, rates.report)


def _bw(args: Namespace) -> None:
    bandwidth = Bandwidth(args.window)
    with open_graph(args) as graph:
        kind, clock = _known_class(graph, args.topic), graph.clock()

        def measure(data: bytes, info: dict[str, Any]) -> None:
            if now := clock():
                bandwidth.arrived(now, len(data))

        subscribe(graph, args.topic, kind, measure, raw=True)
        print(f"Subscribed to [{args.topic}]")
        _measure(graph, lambda: bandwidth.report(clock()))


def _delay(args: Namespace) -> None:
    delays = Delays(args.window)
    with open_graph(args) as graph:
        kind, clock = _known_class(graph, args.topic), graph.node.get_clock()
        known = kind.get_fields_and_field_types()
        if known.get("header") != "std_msgs/Header":
            raise CommandError(
                "msg does not have header",
                f"Only a message with a std_msgs/Header knows when it was made. "
                f"This one has: {', '.join(known) or 'no fields'}.",
            )

        def compare(message: Untyped, info: dict[str, Any]) -> None:
            stamp = message.header.stamp
            if now := clock.now().nanoseconds:
                delays.arrived(now / 1e9, stamp.sec + stamp.nanosec / 1e9)

        subscribe(graph, args.topic, kind, compare)
        _measure(graph, delays.report)


def _positive_float(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise ArgumentTypeError("Expects a floating point number") from None
    if not value > 0:
        raise ArgumentTypeError("Value must be positive")
    return value


def nonnegative_int(text: str) -> int:
    """Read a whole number, zero or more, for argparse."""
    value = int(text)
    if value < 0:
        raise ValueError("Value must be positive or zero")
    return value


def _pub(args: Namespace) -> None:
    check_name("topic", args.topic_name)
    if args.node_name is not None:
        check_node_name(args.node_name)
    kind = type_class(args.message_type, "msg")
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
        profile = asked_profile(args)
        publisher = graph.node.create_publisher(kind, args.topic_name, profile)
        _wait_for_subscriptions(graph, publisher, args, needed)
        _publish(graph, publisher, args, message, stampers, times)


def _wait_for_subscriptions(graph: Graph, publisher: Untyped, args: Namespace, needed: int) -> None:
    limit = args.max_wait_time_secs
    end = None if limit is None else time.monotonic() + limit

    def enough() -> bool:
        return int(publisher.get_subscription_count()) >= needed

    for seconds in count():
        if enough():
            return
        left = None if end is None else end - time.monotonic()
        print(f"Waiting for at least {needed} matching subscription(s)...")
        if left is None or left > 0:
            graph.spin_until(enough, 1.0 if left is None else min(1.0, left))
        if not enough() and seconds + 1 == _HINT_AFTER:
            note(_why_nobody(graph, args.topic_name))
        if not enough() and limit is not None and seconds + 1 > limit:
            raise CommandError(
                f"Timed out waiting for subscribers: Expected {needed} subcribers but only got "
                f"{publisher.get_subscription_count()} subscribers",
                *([] if seconds + 1 >= _HINT_AFTER else [_why_nobody(graph, args.topic_name)]),
            )


#: Seconds after which a publisher without subscriptions says why that may be so.
_HINT_AFTER = 3


def _why_nobody(graph: Graph, topic: str) -> str:
    """Return why nobody may be listening: another topic, or another type."""
    name = absolute(topic)
    heard = {one: types for one, types in graph.topics() if graph.others(graph.subscriptions(one))}
    types = {one.topic_type for one in graph.others(graph.subscriptions(name))}
    if types:
        return f"'{name}' is subscribed to with {', '.join(sorted(types))}."
    return f"No node subscribes to '{name}'. {suggestion(name, heard)}"


def _publish(
    graph: Graph, publisher: Untyped, args: Namespace, message: Untyped,
    stampers: Sequence[Stamper], times: int,
) -> None:  # fmt: skip
    from rclpy.duration import Duration

    print("publisher: beginning loop")
    for number, _ in enumerate(graph.ticks(1 / args.rate), start=1):
        for stamp in stampers:
            stamp(graph.node.get_clock().now().to_msg())
        if args.print_every and number % args.print_every == 0:
            print(f"publishing #{number}: {message!r}\n")
        publisher.publish(message)
        if number == times:
            break
    publisher.wait_for_all_acked(Duration(seconds=max(0.0, args.keep_alive)))
    time.sleep(max(0.0, args.keep_alive))


VERBS = {
    "bw": Verb(
        "Display bandwidth used by topic",
        _bw, *_measured("topic", "Topic name to monitor for bandwidth utilization", 100),
    ),
    "delay": Verb(
        "Display delay of topic from timestamp in header",
        _delay, *_measured("topic", "Topic name to calculate the delay for", 10000),
    ),
    "echo": Verb(
        "Output messages from a topic",
        _echo,
        add_graph_arguments,
        argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')"),
        argument("message_type", nargs="?",
                 help="Type of the ROS message (e.g. 'std_msgs/msg/String')"),
        partial(add_qos_arguments, entity="subscribe", profile="sensor_data"),
        partial(
            add_style_arguments,
            field=argument("--field", help="Echo a selected field of a message (e.g. 'pose.pose')"),
        ),
        flag("--no-lost-messages", help="Don't report when a message is lost"),
        flag("--raw", help="Echo the raw binary representation"),
        argument("--filter", dest="filter_expr",
                 help="Python expression that selects messages ('m': the message or its field)"),
        flag("--once", help="Print the first message received and then exit."),
        argument("--timeout", metavar="N", type=_positive_float,
                 help="Set a timeout in seconds for waiting"),
        flag("--include-message-info", "-i", help="Shows the associated info"),
    ),
    "find": Verb(
        "Output a list of available topics of a given type",
        _find,
        add_graph_arguments,
        argument("topic_type",
                 help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')"),
        _COUNT,
        _HIDDEN,
    ),
    "hz": Verb(
        "Print the average publishing rate to screen",
        _hz,
        *_measured(
            "topic_name", "Name of the ROS topic to listen to (e.g. '/chatter')", 10000,
            argument("--filter", dest="filter_expr", metavar="EXPR",
                     help="only measure messages matching this Python expression"),
            flag("--wall-time", help="calculates rate using wall time"),
        ),
    ),
    "info": Verb(
        "Print information about a topic",
        _info,
        add_graph_arguments,
        argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')"),
        flag("--verbose", "-v",
             help="Prints detailed information like the node name, node namespace, topic type, "
             "topic type hash, topic endpoint type, GID and QoS Profile of the publishers and "
             "subscribers to this topic"),
    ),
    "list": Verb(
        "Output a list of available topics",
        _list,
        add_graph_arguments,
        flag("-t", "--show-types", help="Additionally show the topic type"),
        _COUNT,
        _HIDDEN,
        flag("-v", "--verbose", help="List full details about each topic"),
    ),
    "pub": Verb(
        "Publish a message to a topic",
        _pub,
        argument("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')"),
        argument("message_type", help="Type of the ROS message (e.g. 'std_msgs/String')"),
        value_arguments("values", "Values to fill the message with in YAML format"),
        argument("-r", "--rate", metavar="N", type=_positive_float, default=1.0,
                 help="Publishing rate in Hz (default: 1)"),
        argument("-p", "--print", metavar="N", type=int, default=1, dest="print_every",
                 help="Only print every N-th published message (default: 1)"),
        one_of(
            flag("-1", "--once", help="Publish one message and exit"),
            argument("-t", "--times", type=nonnegative_int, default=0,
                     help="Publish this number of times and then exit"),
        ),
        argument("-w", "--wait-matching-subscriptions", type=nonnegative_int,
                 help="Wait until finding the specified number of matching subscriptions. "
                 "(default: 1 with --once or --times, else 0)"),
        argument("--max-wait-time-secs", type=_positive_float,
                 help="Maximum seconds to wait for matching subscriptions"),
        argument("--keep-alive", metavar="N", type=_positive_float, default=0.1,
                 help="Keep the node alive for N seconds after the last message (default: 0.1)"),
        argument("-n", "--node-name", help="Name of the created publishing node"),
        partial(add_qos_arguments, entity="publish", profile="default"),
        partial(add_graph_arguments, daemon=False),
    ),
    "type": Verb(
        "Print a topic's type",
        _type,
        add_graph_arguments,
        argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')"),
    ),
}  # fmt: skip

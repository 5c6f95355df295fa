"""Implement `ros2 service`: list services, call them, and listen to calls."""

from __future__ import annotations

import sys
from argparse import SUPPRESS, Namespace
from functools import partial
from typing import Any

from ros2_command.errors import CommandError
from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.messages import (
    add_style_arguments,
    add_value_arguments,
    fill,
    plain_to_yaml,
    read_yaml,
    style_of,
    to_csv,
    to_plain,
    value_text,
)
from ros2_command.names import (
    Entries,
    absolute,
    check_name,
    full_type,
    of_type,
    pick,
    show_entries,
    type_class,
    visible,
    wait_for_server,
)
from ros2_command.qos import add_qos_arguments, asked_profile
from ros2_command.registry import Verb, argument, flag
from ros2_command.untyped import Untyped

_COUNT = flag("-c", "--count-services", help="Only display the number of services discovered")
# Without a default, what stands before the verb counts, too.
_HIDDEN = argument(
    "--include-hidden-services", action="store_true", default=SUPPRESS,
    help="Consider hidden services as well",
)  # fmt: skip


def _services(graph: Graph) -> Entries:
    """Return the services of other nodes."""
    own = f"/{graph.node_name}/"
    return [one for one in graph.settle().services() if not one[0].startswith(own)]


def _list(args: Namespace) -> None:
    with open_graph(args) as graph:
        found = visible(_services(graph), args.include_hidden_services)
    show_entries(found, args.count_services, args.show_types)


def _type(args: Namespace) -> None:
    with open_graph() as graph:
        services = _services(graph)
    _, types = pick(args.service_name, services, f"Unknown service '{args.service_name}'")
    print("\n".join(types))


def _find(args: Namespace) -> None:
    with open_graph() as graph:
        found = of_type(_services(graph), args.service_type, args.include_hidden_services)
    for line in [len(found)] if args.count_services else found:
        print(line)


def _info(args: Namespace) -> None:
    with open_graph(args) as graph:
        complaint = f"Unknown service '{args.service_name}'"
        name, types = pick(args.service_name, _services(graph), complaint)
        clients, servers = graph.node.count_clients(name), graph.node.count_services(name)
    print("Type:", types[0] if len(types) == 1 else types)
    print("Clients count:", clients)
    print("Services count:", servers)


def _call(args: Namespace) -> None:
    if args.rate is not None and not args.rate > 0:
        raise CommandError("rate must be greater than zero")
    check_name("service", args.service_name)
    kind = type_class(args.service_type, "srv")
    request = kind.Request()
    stampers = fill(request, read_yaml(value_text(args.values, args.stdin)))
    with open_graph() as graph:
        client = graph.node.create_client(kind, args.service_name)
        if not client.service_is_ready():
            print("waiting for service to become available...")
            asked = full_type(args.service_type, "srv")
            wait_for_server(
                graph, client.service_is_ready, "service", args.service_name, asked, graph.services
            )
        for _ in graph.ticks(1 / (args.rate or 1)):
            for stamp in stampers:
                stamp(graph.node.get_clock().now().to_msg())
            print(f"requester: making request: {request!r}\n")
            print(f"response:\n{ask(graph, client, request)!r}\n")
            if args.rate is None:
                break


def ask(graph: Graph, client: Untyped, request: Untyped, seconds: float | None = None) -> Untyped:
    """Send a request, and wait for the response.

    Raises:
        CommandError: If the service fails, or does not answer in time.
    """
    future = client.call_async(request)
    if not graph.spin_until(future.done, seconds):
        raise CommandError(f"The service '{client.srv_name}' did not answer in {seconds:g} seconds")
    if (error := future.exception()) is not None:
        raise CommandError(f"The call of '{client.srv_name}' failed: {error}")
    return future.result()


def _echo(args: Namespace) -> None:
    check_name("service", args.service_name)
    with open_graph(args) as graph:
        services = _services(graph)
        complaint = "Could not determine the type for the passed service"
        name = absolute(args.service_name)
        if args.service_type is None:
            name, types = pick(args.service_name, services, complaint)
            args.service_type = types[0]
        kind = type_class(args.service_type, "srv").Event
        topic, style = f"{name}/_service_event", style_of(args)
        if topic not in dict(graph.topics()):
            print(
                f"No node publishes the events of calls to '{name}' yet. A service or a client "
                "does after configure_introspection(). Waiting.",
                file=sys.stderr,
            )

        def show(message: Untyped) -> None:
            if args.csv:
                print(to_csv(message, style))
                return
            plain: dict[str, Any] = to_plain(message, style)
            plain["info"]["event_type"] = _EVENTS[message.info.event_type]
            print(plain_to_yaml(plain, style.flow) + "---")

        graph.node.create_subscription(kind, topic, show, asked_profile(args, "services_default"))
        graph.spin_until(lambda: False)


#: Words for the values of `service_msgs/msg/ServiceEventInfo.event_type`.
_EVENTS = ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")

VERBS = {
    "call": Verb(
        "Call a service",
        _call,
        argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')"),
        argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')"),
        partial(add_value_arguments, name="values",
                about="Values to fill the service request with in YAML format"),
        argument("-r", "--rate", metavar="N", type=float,
                 help="Repeat the call at a specific rate in Hz"),
    ),
    "echo": Verb(
        "Echo a service",
        _echo,
        add_graph_arguments,
        argument("service_name", help="Name of the ROS service to echo (e.g. '/add_two_ints')"),
        argument("service_type", nargs="?",
                 help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')"),
        partial(add_qos_arguments, entity="subscribe", profile="services_default"),
        add_style_arguments,
    ),
    "find": Verb(
        "Output a list of available services of a given type",
        _find,
        argument("service_type",
                 help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/Empty')"),
        _COUNT,
        _HIDDEN,
    ),
    "info": Verb(
        "Print information about a service",
        _info,
        add_graph_arguments,
        argument("service_name",
                 help="Name of the ROS service to get info (e.g. '/add_two_ints')"),
    ),
    "list": Verb(
        "Output a list of available services",
        _list,
        add_graph_arguments,
        flag("-t", "--show-types", help="Additionally show the service type"),
        _COUNT,
        _HIDDEN,
    ),
    "type": Verb(
        "Output a service's type",
        _type, argument("service_name", help="Name of the ROS service to get type"),
    ),
}  # fmt: skip

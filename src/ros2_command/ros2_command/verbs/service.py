"""Implement `ros2 service`: list services, call them, and listen to calls."""

from __future__ import annotations

from argparse import SUPPRESS, Namespace
from typing import Any

from ros2_command.errors import CommandError, note
from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.messages import (
    add_style_arguments,
    fill,
    plain_to_yaml,
    read_yaml,
    style_of,
    to_csv,
    to_plain,
    value_arguments,
    value_text,
)
from ros2_command.names import (
    Entries,
    check_name,
    class_in_graph,
    full_type,
    is_hidden,
    of_type,
    show_entries,
    show_types,
    type_class,
    types_of,
    visible,
    wait_for_server,
)
from ros2_command.registry import Verb, argument, flag
from ros2_command.untyped import Untyped

#: Seconds that the publisher of a service's events may take to be seen.
_LOOK_FOR_EVENTS = 0.5
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
    name = args.service_name
    types = types_of(name, services, f"Unknown service '{name}'", silent=True)
    if is_hidden(name) and not args.include_hidden_services:
        raise CommandError(
            "",
            f"The service '{name}' is hidden: a part of its name begins with '_'.",
            f"Its type:  ros2 service --include-hidden-services type {name}",
        )
    print("\n".join(types))


def _find(args: Namespace) -> None:
    with open_graph() as graph:
        found = of_type(_services(graph), args.service_type, args.include_hidden_services)
    for line in [len(found)] if args.count_services else found:
        print(line)


def _info(args: Namespace) -> None:
    with open_graph(args) as graph:
        name = args.service_name
        services = visible(_services(graph), args.include_hidden_services)
        types = types_of(name, services, f"Unknown service '{name}'")
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
    fill(request, read_yaml(value_text(args.values, args.stdin)), stamps=False)
    with open_graph() as graph:
        client = graph.node.create_client(kind, args.service_name)
        if not client.service_is_ready():
            print("waiting for service to become available...")
            asked = full_type(args.service_type, "srv")
            wait_for_server(
                graph, client.service_is_ready, "service", args.service_name, asked, graph.services
            )
        for _ in graph.ticks(1 / (args.rate or 1)):
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
    from rclpy.qos import QoSPresetProfiles

    name, style = args.service_name, style_of(args)
    check_name("service", name)
    with open_graph() as graph:
        kind = _service_class(graph, args).Event
        topic = f"{name}/_service_event"

        def show(message: Untyped) -> None:
            if args.csv:
                print(to_csv(message, style))
                return
            plain: dict[str, Any] = to_plain(message, style)
            plain["info"]["event_type"] = _EVENTS[message.info.event_type]
            print(plain_to_yaml(plain, style.flow) + "---")

        profile = QoSPresetProfiles.get_from_short_key("services_default")
        events = graph.node.create_subscription(kind, topic, show, profile)
        if not graph.spin_until(events.get_publisher_count, _LOOK_FOR_EVENTS):
            print(
                f"No publishers on topic '{topic}'; is service introspection on the client or "
                "server enabled?"
            )
            note("It is after configure_introspection(...) of a service or a client.")
        graph.spin_until(lambda: False)


def _service_class(graph: Graph, args: Namespace) -> Untyped:
    """Return the class of the service that is to be listened to.

    Raises:
        CommandError: If it cannot be known, or this terminal cannot load it.
    """
    name = args.service_name
    if args.service_type is not None:
        return class_in_graph(args.service_type, "srv", "")
    types = types_of(name, _services(graph), f"Cannot find type for '{name}'")
    if len(types) > 1:
        raise CommandError(
            f"More than one type associated with service '{name}'",
            f"They are {show_types(types)}. Give the one that you want after the service.",
        )
    return class_in_graph(types[0], "srv", f"The service '{name}'")


#: Words for the values of `service_msgs/msg/ServiceEventInfo.event_type`.
_EVENTS = ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")

VERBS = {
    "call": Verb(
        "Call a service",
        _call,
        argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')"),
        argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')"),
        value_arguments("values", "Values to fill the service request with in YAML format"),
        argument("-r", "--rate", metavar="N", type=float,
                 help="Repeat the call at a specific rate in Hz"),
    ),
    "echo": Verb(
        "Echo a service",
        _echo,
        argument("service_name", help="Name of the ROS service to echo (e.g. '/add_two_ints')"),
        argument("service_type", nargs="?",
                 help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')"),
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

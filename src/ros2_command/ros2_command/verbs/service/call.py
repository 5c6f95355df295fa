"""`ros2 service call`."""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser, Namespace

from ros2_command.errors import CommandError
from ros2_command.graph import Graph, open_graph
from ros2_command.lookup import show_types, suggestion, type_hint
from ros2_command.message_types import find_type, is_service
from ros2_command.message_values import fill, read_yaml, value_text
from ros2_command.names import absolute, check_name
from ros2_command.untyped import Untyped


def add_arguments(parser: ArgumentParser) -> None:
    """A service, its type, a request, and how often."""
    add = parser.add_argument
    add("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    add("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    add("values", nargs="?", help="Values to fill the service request with in YAML format")
    add("--stdin", action="store_true", help="Read values from standard input")
    add("-r", "--rate", metavar="N", type=float, help="Repeat the call at a specific rate in Hz")


def main(args: Namespace) -> None:
    """Call a service and print its response."""
    if args.rate is not None and not args.rate > 0:
        raise CommandError("rate must be greater than zero")
    check_name("service", args.service_name)
    kind = service_class(args.service_type)
    request = kind.Request()
    stampers = fill(request, read_yaml(value_text(args.values, args.stdin)))
    with open_graph() as graph:
        client = graph.node.create_client(kind, args.service_name)
        wait_for_service(graph, client, args)
        while True:
            due = time.monotonic() + (1 / args.rate if args.rate else 0)
            for stamp in stampers:
                stamp(graph.node.get_clock().now().to_msg())
            print(f"requester: making request: {request!r}\n")
            print(f"response:\n{ask(graph, client, request)!r}\n")
            if args.rate is None:
                return
            graph.spin_for(due - time.monotonic())


def service_class(name: str) -> Untyped:
    """The class of a service type.

    Raises:
        CommandError: If there is none of that name, or it is not a service's.
    """
    found = find_type(name, "srv")
    if found is None:
        raise CommandError("The passed service type is invalid", type_hint(name, "srv"))
    if not is_service(found):
        raise CommandError("The passed type is not a service", type_hint(name, "srv"))
    return found


def wait_for_service(graph: Graph, client: Untyped, args: Namespace) -> None:
    """Wait until somebody offers the service, and say so.

    Raises:
        CommandError: If it is offered with another type.
    """
    if client.service_is_ready():
        return
    print("waiting for service to become available...")
    graph.settle(client.service_is_ready)
    if client.service_is_ready():
        return
    name = absolute(args.service_name)
    asked = "/".join([args.service_type.split("/")[0], "srv", args.service_type.split("/")[-1]])
    found = {one: types for one, types in graph.services() if types != [asked] or one != name}
    if name in found:
        others = [one for one in found[name] if one != asked]
        raise CommandError(
            f"The service '{name}' has the type {show_types(others)}, not {asked}",
            "A call with another type is never answered.",
        )
    print(f"Nobody offers '{name}'. {suggestion(name, found)}", file=sys.stderr)
    graph.spin_until(client.service_is_ready)


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

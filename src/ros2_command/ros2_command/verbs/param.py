"""Implement `ros2 param`: access other nodes' parameters through their parameter services."""

from __future__ import annotations

import re
import sys
from argparse import Namespace
from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import Any

from ros2_command.errors import CommandError, note
from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.names import absolute, check_node, did_you_mean
from ros2_command.registry import Verb, argument, flag
from ros2_command.untyped import Untyped
from ros2_command.verbs.service import ask

#: How long a node may take to answer, in seconds.
PATIENCE = 5.0
TIMED_OUT = "Wait for service timed out waiting for parameter services for node "
#: Words for the values of `rcl_interfaces/msg/ParameterType`, and the field that holds each.
KINDS = (
    ("not set", ""),
    ("boolean", "bool_value"),
    ("integer", "integer_value"),
    ("double", "double_value"),
    ("string", "string_value"),
    ("byte array", "byte_array_value"),
    ("boolean array", "bool_array_value"),
    ("integer array", "integer_array_value"),
    ("double array", "double_array_value"),
    ("string array", "string_array_value"),
)


class RemoteParameters:
    """Ask one node for its parameters.

    Args:
        graph: Where the node is.
        node: Its full name.
        typed: Its name as typed, if somebody did.
    """

    def __init__(self, graph: Graph, node: str, typed: str = "") -> None:
        self._graph, self.node, self._typed = graph, node, typed or node

    def client(self, service: str) -> Untyped:
        """Return a client of one of the parameter services."""
        from rcl_interfaces import srv

        words = "".join(word.capitalize() for word in service.split("_"))
        return self._graph.node.create_client(getattr(srv, words), f"{self.node}/{service}")

    def call(self, service: str, **fields: Untyped) -> Untyped:
        """Call one of the parameter services.

        Raises:
            CommandError: If the node does not offer it, or does not answer.
        """
        client = self.client(service)
        if not self._graph.spin_until(client.service_is_ready, PATIENCE):
            raise CommandError(
                f"{TIMED_OUT}{self._typed}", f"'{self.node}' does not offer its parameters."
            )
        return ask(self._graph, client, client.srv_type.Request(**fields), PATIENCE)

    def names(self, prefixes: Sequence[str] = ()) -> list[str]:
        """Return the declared names, sorted."""
        return sorted(self.call("list_parameters", prefixes=list(prefixes)).result.names)

    def values(self, names: Sequence[str]) -> list[Any]:
        """Return values as messages; fewer than asked for if a parameter is undeclared."""
        return list(self.call("get_parameters", names=list(names)).values)

    def all_values(self) -> dict[str, Any]:
        """Return the values of all parameters that have one, as messages, by name."""
        names = self.names()
        values = self.values(names)
        if len(values) == len(names):
            return dict(zip(names, values, strict=True))
        # A parameter that was declared without a value spoils the answer for all of them.
        return {name: one for name in names for one in self.values([name])}

    def set(self, *parameters: Untyped) -> list[Any]:
        """Set parameters, each a `rcl_interfaces/msg/Parameter`, and return what became of each."""
        return list(self.call("set_parameters", parameters=list(parameters)).results)

    def hint(self, name: str) -> str:
        """Return a line with the nearest name if a parameter is not declared, else nothing."""
        known = self.names()
        has = f"It has: {', '.join(known)}"
        return "" if name in known else did_you_mean(name, known, has)


def open_node(graph: Graph, args: Namespace) -> RemoteParameters:
    """Return the node that the arguments name.

    Raises:
        CommandError: If it is not in the graph; the nearest name is suggested.
    """
    name = absolute(args.node_name)

    def there() -> bool:
        return name in graph.nodes(hidden=True)

    graph.settle(there)
    graph.spin_until(there, float(args.timeout)) if not graph.nodes() else None
    check_node(name, graph.nodes(args.include_hidden_nodes), "Node not found")
    return RemoteParameters(graph, name, args.node_name)


def plain_value(value: Untyped) -> Untyped:
    """Return the Python value of a `rcl_interfaces/msg/ParameterValue`; None if it is not set."""
    if not value.type:
        return None
    plain = getattr(value, KINDS[value.type][1])
    return list(plain) if hasattr(plain, "__len__") and not isinstance(plain, str) else plain


def _get(args: Namespace) -> None:
    with open_graph(args) as graph:
        node = open_node(graph, args)
        found = node.values([args.parameter_name])
        hint = "" if found else node.hint(args.parameter_name)
    if not found:
        raise CommandError("Parameter not set", hint)
    kind, value = KINDS[found[0].type][0].capitalize(), plain_value(found[0])
    if args.hide_type:
        print(value)
    elif value is None:
        print("Parameter not set.")
    elif kind.endswith(" array"):
        print(f"{kind.removesuffix(' array')} values are: {value}")
    else:
        print(f"{kind} value is: {value}")


def _set(args: Namespace) -> None:
    from rcl_interfaces.msg import Parameter

    change = Parameter(name=args.parameter_name, value=value_message(args.value))
    with open_graph(args) as graph:
        node = open_node(graph, args)
        _report("Set parameter successful", "Setting parameter failed", node, change)


def _report(good: str, bad: str, node: RemoteParameters, change: Untyped) -> None:
    """Set or delete a parameter, and tell what became of it, as the node says it.

    A refusal is an answer, so the exit code is 0, as in the original.
    """
    (result,) = node.set(change)
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"{good}{reason}")
    else:
        print(f"{bad}{reason}", file=sys.stderr)
        note(node.hint(change.name))


def value_message(text: str) -> Untyped:
    """Return a text, read as YAML, as a `rcl_interfaces/msg/ParameterValue`.

    Raises:
        CommandError: If it is a mapping, or a number that is too large.
    """
    from rclpy.parameter import get_parameter_value

    try:
        return get_parameter_value(text)
    except (AssertionError, OverflowError, ValueError):
        raise CommandError(
            f"{text!r} cannot be the value of a parameter",
            "A value is a number, a text, true, false, or a list of one of these.",
        ) from None


def _delete(args: Namespace) -> None:
    from rcl_interfaces.msg import Parameter

    change = Parameter(name=args.parameter_name)  # a value of no type
    with open_graph(args) as graph:
        node = open_node(graph, args)
        _report("Deleted parameter successfully", "Deleting parameter failed", node, change)


def _describe(args: Namespace) -> None:
    with open_graph(args) as graph:
        node = open_node(graph, args)
        found = node.call("describe_parameters", names=args.parameter_names).descriptors
        hints = [] if found else list(map(node.hint, args.parameter_names))
    for one in found:
        print("\n".join(_description(one)))
    if any(hints):
        note("A node describes either all of the parameters that it is asked for, or none.", *hints)


def _description(about: Untyped) -> list[str]:
    ranges = [*about.floating_point_range, *about.integer_range][:1]
    lines = [f"Parameter name: {about.name}", f"  Type: {KINDS[about.type][0]}"]
    lines += [f"  Description: {about.description}"] if about.description else []
    lines += ["  Constraints:"]
    lines += ["    Read only: true"] if about.read_only else []
    for one in ranges:
        lines += [f"    Min value: {one.from_value}", f"    Max value: {one.to_value}"]
        lines += [f"    Step: {one.step}"] if one.step else []
    extra = about.additional_constraints
    return lines + ([f"    Additional constraints: {extra}"] if extra else [])


def _list(args: Namespace) -> int:
    try:
        matches = re.compile(args.filter[0] if args.filter else "").match
    except re.error as error:
        raise CommandError(f"--filter {args.filter[0]!r} is not a pattern: {error}") from None
    with open_graph(args) as graph:
        nodes = graph.settle().nodes(args.include_hidden_nodes)
        if args.node_name is not None:
            nodes = [absolute(args.node_name)]
            check_node(nodes[0], graph.nodes(args.include_hidden_nodes), "Node not found")
        nodes = sorted(set(nodes), key=lambda name: name.rpartition("/")[::-1])
        asked = {node: {"prefixes": args.param_prefixes} for node in nodes}
        names = {
            node: sorted(filter(matches, answer.result.names)) if answer else answer
            for node, answer in _ask_all(graph, "list_parameters", asked).items()
        }
        types = {}
        if args.param_type:
            asked = {node: {"names": own} for node, own in names.items() if own}
            types = _ask_all(graph, "describe_parameters", asked)
    for node in nodes:
        if node not in names:
            place, _, base = node.rpartition("/")
            print(f"{TIMED_OUT}NodeName(name={base!r}, namespace={place or '/'!r}, "
                  f"full_name={node!r})")  # fmt: skip
        elif names[node] is None:
            _say_that_it_hangs(node)
        else:
            _show_names(names[node], types.get(node), "" if args.node_name else node)
    return int(None in names.values())


def _ask_all(graph: Graph, service: str, fields: Mapping[str, Any]) -> dict[str, Any]:
    """Ask several nodes at once, so that one that does not answer costs the others nothing.

    Args:
        graph: Where the nodes are.
        service: The parameter service.
        fields: Those of the request, by the full name of the node.

    Returns:
        The response of each node that offers the service; None if it does not answer.
    """
    clients = {node: RemoteParameters(graph, node).client(service) for node in fields}
    known = dict(graph.services())
    offered = [one for one in clients.values() if one.srv_name in known]
    graph.spin_until(lambda: all(one.service_is_ready() for one in offered), PATIENCE)
    futures = {
        node: one.call_async(one.srv_type.Request(**fields[node]))
        for node, one in clients.items()
        if one.service_is_ready()
    }
    graph.spin_until(lambda: all(one.done() for one in futures.values()), PATIENCE)
    return {
        node: one.result() if one.done() and one.exception() is None else None
        for node, one in futures.items()
    }


def _say_that_it_hangs(node: str) -> None:
    print(
        f"Exception while calling service of node '{node}': it did not answer in {PATIENCE:g} "
        "seconds",
        file=sys.stderr,
    )
    note("A callback of that node that does not return keeps it from answering.")


def _show_names(names: Sequence[str], types: Untyped, heading: str) -> None:
    if names and heading:
        print(f"{heading}:")
    endings = [f" (type: {KINDS[one.type][0]})" for one in types.descriptors] if types else []
    for name, ending in zip_longest(names, endings, fillvalue=""):
        print(f"  {name}{ending}")


def _dump(args: Namespace) -> None:
    import yaml

    with open_graph(args) as graph:
        node = open_node(graph, args)
        values = node.all_values()
    parameters = nested({name: _dumpable(value) for name, value in values.items()})
    print(
        yaml.safe_dump(
            {node.node: {"ros__parameters": parameters}},
            default_flow_style=False,
        )
    )  # fmt: skip


def _dumpable(value: Untyped) -> Untyped:
    plain = plain_value(value)
    is_bytes = isinstance(plain, list) and any(isinstance(one, bytes) for one in plain)
    return b"".join(plain) if is_bytes else plain


def nested(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return parameters with dots in their names as dictionaries in dictionaries."""
    tree: dict[str, Any] = {}
    for name, value in parameters.items():
        *path, last = name.split(".")
        place = tree
        for part in path:
            inner = place.setdefault(part, {})
            if not isinstance(inner, dict):  # `a` and `a.b` are both parameters
                place, last = tree, name
                break
            place = inner
        place[last] = value
    return tree


def _load(args: Namespace) -> None:
    with open_graph(args) as graph:
        node = open_node(graph, args)
        parameters = read_parameters(args.parameter_file, node.node, not args.no_use_wildcard)
        results = node.set(*parameters)
    for one, result in zip(parameters, results, strict=True):
        reason = f": {result.reason}" if result.reason else ""
        if result.successful:
            print(f"Set parameter {one.name} successful{reason}")
        else:
            print(f"Set parameter {one.name} failed{reason}", file=sys.stderr)


def read_parameters(path: str, node: str, wildcard: bool) -> list[Any]:
    """Read what a parameter file has for a node, as `rcl_interfaces/msg/Parameter`.

    Args:
        path: The file.
        node: Full name of the node.
        wildcard: Whether the section `/**`, for all nodes, counts, too; the node's own has the
            last word.

    Raises:
        CommandError: If the file cannot be read, or has nothing for the node.
        OSError: If there is no such file.
    """
    import yaml

    how = f"A file that fits can be had with:  ros2 param dump {node}"
    try:
        with open(path, encoding="utf-8") as file:
            sections = yaml.safe_load(file)
    except (yaml.YAMLError, UnicodeError) as error:
        raise CommandError(f"{path} is not valid YAML: {error}", how) from None
    if not isinstance(sections, dict):
        raise CommandError(f"{path} is not a valid ROS parameter file", how)
    # A section may be named with or without the leading slash.
    wanted = [*(["/**"] if wildcard else []), node.removeprefix("/"), node]
    found = [sections[one] for one in wanted if one in sections]
    if not found:
        others = f"It has nothing for {node}, only for: {', '.join(map(str, sections))}"
        raise CommandError("Param file does not contain selected parameters", others, how)
    values: dict[str, Any] = {}
    for one in found:
        if not isinstance(one, dict) or not isinstance(one.get("ros__parameters"), dict):
            raise CommandError(f"{path} is not a valid ROS parameter file for node {node}", how)
        values |= flat(one["ros__parameters"])
    return [_parameter(name, value) for name, value in values.items()]


def flat(tree: dict[str, Any]) -> dict[str, Any]:
    """Return dictionaries in dictionaries as parameters with dots in their names."""
    values: dict[str, Any] = {}
    for name, value in tree.items():
        inner = flat(value) if isinstance(value, dict) else None
        values |= {name: value} if inner is None else {f"{name}.{k}": v for k, v in inner.items()}
    return values


def _parameter(name: str, value: Untyped) -> Untyped:
    from rclpy.parameter import Parameter

    plain = [bytes([one]) for one in value] if isinstance(value, bytes) else value
    try:
        return Parameter(name, value=plain).to_parameter_msg()
    except (TypeError, ValueError, AssertionError, OverflowError):
        raise CommandError(
            f"{value!r} cannot be the value of the parameter '{name}'",
            "A value is a number, a text, true, false, or a list of one of these.",
        ) from None


_HIDDEN = flag("--include-hidden-nodes", help="Consider hidden nodes as well")
_NODE = (add_graph_arguments, argument("node_name", help="Name of the ROS node"), _HIDDEN)
_TIMEOUT = argument(
    "--timeout", metavar="N", type=int, default=1,
    help="Wait for N seconds until node becomes available (default 1 seconds)",
)  # fmt: skip
_PARAMETER = (*_NODE, argument("parameter_name", help="Name of the parameter"))
VERBS = {
    "delete": Verb("Delete parameter", _delete, *_PARAMETER, _TIMEOUT),
    "describe": Verb(
        "Show descriptive information about declared parameters",
        _describe,
        *_NODE,
        argument("parameter_names", nargs="+", help="Names of the parameters"),
        _TIMEOUT,
    ),
    "dump": Verb(
        "Show all of the parameters of a node in a YAML file format", _dump, *_NODE, _TIMEOUT
    ),
    "get": Verb(
        "Get parameter",
        _get,
        *_PARAMETER,
        flag("--hide-type", help="Hide the type information"),
        _TIMEOUT,
    ),
    "list": Verb(
        "Output a list of available parameters",
        _list,
        add_graph_arguments,
        argument("node_name", nargs="?", help="Name of the ROS node"),
        argument("--filter", nargs=1,
                 help="Only list parameters that begin with a match of the regex"),
        _HIDDEN,
        argument("--param-prefixes", nargs="+", default=[],
                 help="Only list parameters with the provided prefixes"),
        flag("--param-type", help="Print parameter types"),
    ),
    "load": Verb(
        "Load parameter file for a node",
        _load,
        *_NODE,
        argument("parameter_file", help="Parameter file"),
        flag("--no-use-wildcard",
             help="Do not load parameters in the '/**' namespace into the node"),
        _TIMEOUT,
    ),
    "set": Verb(
        "Set parameter",
        _set, *_PARAMETER, argument("value", help="Value of the parameter"), _TIMEOUT,
    ),
}  # fmt: skip

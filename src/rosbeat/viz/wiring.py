"""Find who talks to whom: a snapshot of the ROS graph as vertices and edges, with what is wrong."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from rosbeat.records import (
    ACTION_PART,
    INFRASTRUCTURE_TOPICS,
    Endpoint,
    GraphSnapshot,
    is_hidden,
)
from rosbeat.viz.words import count, listing, sentence_case

_OTHER = {"publisher": "subscription", "subscription": "publisher"}
_NOBODY = {"publisher": "nobody subscribes", "subscription": "nobody publishes"}
_QOS = "QoS does not match"
_TYPE = "types differ"
_OFFERS = {
    "server": "service",
    "client": "service",
    "action server": "action",
    "action client": "action",
}


@dataclass(frozen=True)
class Edge:
    """Hold one arrow: a publisher's node to a topic, or a topic to a subscription's node.

    Attributes:
        source: Key of the node or topic where it begins.
        target: Key of the topic or node where it ends.
        fault: Why nothing passes: empty if something does.
        has_head: Whether it ends in a head.
    """

    source: str
    target: str
    fault: str = ""
    has_head: bool = True


@dataclass(frozen=True)
class Offer:
    """Hold a service or an action.

    Attributes:
        word: `service` or `action`.
        name: Its full name.
        type_name: Its type.
        servers: The nodes that offer it; one, if all is well.
        clients: The nodes that use it.
    """

    word: str
    name: str
    type_name: str
    servers: tuple[str, ...] = ()
    clients: tuple[str, ...] = ()

    @property
    def key(self) -> str:
        """Return its key among the edges of a picture; a topic may have the same name."""
        return f"{self.word} {self.name}"

    @property
    def edges(self) -> list[Edge]:
        """Return its arrows: from who uses it to who offers it."""
        used = [Edge(node_key(name), self.key) for name in self.clients]
        return used + [Edge(self.key, node_key(name)) for name in self.servers]


@dataclass(frozen=True)
class Wiring:
    """Hold what a graph picture shows.

    Attributes:
        nodes: Names of the nodes shown, in order of creation.
        topics: Names of the topics shown with their types, in order of first use.
        edges: The arrows. A topic may have the name of a node, so ends are keys made by
            `node_key` and `topic_key`.
        hidden: Names of nodes left out because a part of their name begins with `_`.
        offers: Services and actions that a node offers or uses, those of every node left out.
        processes: The nodes shown that share a process, for each process with more than one.
    """

    nodes: tuple[str, ...]
    topics: dict[str, tuple[str, ...]]
    edges: tuple[Edge, ...]
    hidden: tuple[str, ...] = ()
    offers: tuple[Offer, ...] = ()
    processes: tuple[tuple[str, ...], ...] = ()

    def around(self, topic: str) -> tuple[list[Edge], list[Edge]]:
        """Return the edges into a topic and those out of it."""
        key = topic_key(topic)
        into = [edge for edge in self.edges if edge.target == key]
        return into, [edge for edge in self.edges if edge.source == key]

    def faults(self, topic: str) -> tuple[str, ...]:
        """Return what is wrong around a topic, each kind once."""
        into, out = self.around(topic)
        return tuple(dict.fromkeys(edge.fault for edge in into + out if edge.fault))


def node_key(name: str) -> str:
    """Return the key of a node among edges."""
    return f"node {name}"


def topic_key(name: str) -> str:
    """Return the key of a topic among edges."""
    return f"topic {name}"


def short_type(type_name: str) -> str:
    """Return a type without its package: `Float32`."""
    return type_name.rsplit("/", 1)[-1]


def wiring(graph: GraphSnapshot, infrastructure: bool = False) -> Wiring:
    """Return the part of a graph that a picture shows, with what every node brings if wanted."""
    names = tuple(dict.fromkeys([*graph.nodes, *(end.node for end in graph.endpoints)]))
    nodes = tuple(name for name in names if not is_hidden(name))
    ends = [end for end in graph.endpoints if end.kind in _OTHER]
    if not infrastructure:
        ends = [one for one in ends if one.name not in INFRASTRUCTURE_TOPICS]
        ends = [one for one in ends if ACTION_PART not in one.name]
    shown = [end for end in ends if end.node in nodes]
    types: dict[str, tuple[str, ...]] = {}
    for end in shown:
        types[end.name] = tuple(dict.fromkeys((*types.get(end.name, ()), end.type_name)))
    hidden, processes = tuple(filter(is_hidden, names)), shared(graph.processes, nodes)
    return Wiring(nodes, types, _edges(shown, ends), hidden, _offers(graph, nodes), processes)


def _edges(shown: Iterable[Endpoint], every: list[Endpoint]) -> tuple[Edge, ...]:
    found: dict[tuple[str, str], str] = {}
    for end in shown:
        ends = (node_key(end.node), topic_key(end.name))
        pair = ends if end.kind == "publisher" else (ends[1], ends[0])
        fault = _fault(end, every)
        # Two endpoints of one node on one topic are one arrow; it is broken only if both are.
        found[pair] = fault if found.get(pair, fault) else ""
    return tuple(Edge(source, target, fault) for (source, target), fault in found.items())


def _fault(end: Endpoint, every: list[Endpoint]) -> str:
    others = [one for one in every if one.name == end.name and one.kind == _OTHER[end.kind]]
    if end.matched > 0:
        return ""
    if not others:
        return _NOBODY[end.kind]
    if end.matched < 0:
        return ""
    return _QOS if any(one.type_name == end.type_name for one in others) else _TYPE


def _offers(graph: GraphSnapshot, nodes: Collection[str]) -> tuple[Offer, ...]:
    """Return the services and actions of some nodes, in order of first use."""
    found: dict[tuple[str, str], list[Endpoint]] = {}
    for end in graph.endpoints:
        if end.kind in _OFFERS and end.node in nodes and not _is_brought(end, graph.nodes):
            found.setdefault((_OFFERS[end.kind], end.name), []).append(end)
    return tuple(
        Offer(
            *(word, name, ends[0].type_name),
            tuple(dict.fromkeys(one.node for one in ends if one.kind.endswith("server"))),
            tuple(dict.fromkeys(one.node for one in ends if one.kind.endswith("client"))),
        )
        for (word, name), ends in found.items()
    )


def _is_brought(end: Endpoint, nodes: Iterable[str]) -> bool:
    """Return whether it belongs to an action, or to those that every node brings along."""
    package = end.type_name.split("/")[0]
    brought = package in ("rcl_interfaces", "type_description_interfaces")
    return ACTION_PART in end.name or (brought and end.name.rpartition("/")[0] in nodes)


def shared(
    processes: Iterable[Iterable[str]], nodes: Collection[str]
) -> tuple[tuple[str, ...], ...]:
    """Return the nodes of each process, as far as several of them are among `nodes`."""
    taken: set[str] = set()
    found: list[tuple[str, ...]] = []
    for process in processes:
        # Nodes of one name have one place in a picture, so it is in one process.
        names = [name for name in dict.fromkeys(process) if name in nodes and name not in taken]
        taken.update(names)
        found.append(tuple(names))
    return tuple(names for names in found if len(names) > 1)


# The same in words.


def describe(shown: Wiring) -> str:
    """Tell the wiring in whole sentences."""
    head = f"{count(len(shown.nodes), 'node')} and {count(len(shown.topics), 'topic')}."
    said = [sentence_case(head), *(_say_topic(shown, topic) for topic in shown.topics)]
    said += map(_say_offer, shown.offers)
    edges = [*shown.edges, *(edge for offer in shown.offers for edge in offer.edges)]
    busy = {end for edge in edges for end in (edge.source, edge.target)}
    alone = [name for name in shown.nodes if node_key(name) not in busy]
    if alone:
        verb = "uses" if len(alone) == 1 else "use"
        said.append(f"{listing(alone)} {verb} no topic.")
    said += say_shared(shown.processes)
    if shown.hidden:
        said.append(f"Left out: {count(len(shown.hidden), 'hidden node')}.")
    return " ".join(said)


def say_shared(processes: Iterable[tuple[str, ...]]) -> list[str]:
    """Tell which nodes share a process, in whole sentences."""
    return [f"{listing(names)} share one process." for names in processes]


def _say_offer(one: Offer) -> str:
    article = "an" if one.word == "action" else "a"
    return (
        f"{one.name} ({short_type(one.type_name)}) is {article} {one.word}: offered by "
        f"{listing(one.servers) or 'nobody'}, used by {listing(one.clients) or 'nobody'}."
    )


def _say_topic(shown: Wiring, topic: str) -> str:
    into, out = shown.around(topic)
    types = listing(map(short_type, shown.topics[topic]))
    writers = listing(edge.source.removeprefix("node ") for edge in into) or _outside(out)
    readers = listing(edge.target.removeprefix("node ") for edge in out) or _outside(into)
    said = [f"{topic} ({types}): published by {writers}, subscribed to by {readers}."]
    for fault in shown.faults(topic):
        if fault in _NOBODY.values():
            said.append(f"There, {fault}, so no message passes.")
        else:
            ends = [edge.source for edge in into if edge.fault == fault]
            ends += [edge.target for edge in out if edge.fault == fault]
            said.append(f"There, {fault} for {listing(one.removeprefix('node ') for one in ends)}.")
    return " ".join(said)


def _outside(edges: list[Edge]) -> str:
    """Return who is on the other side when no node of the graph is."""
    return "another process" if any(not edge.fault for edge in edges) else "nobody"

"""Who talks to whom: a snapshot of the ROS graph as vertices and edges, with what is wrong."""

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
from rosbeat.viz.offers import Offer, offers_of, say_offers
from rosbeat.viz.words import count, listing, sentence_case

_OTHER = {"publisher": "subscription", "subscription": "publisher"}
_NOBODY = {"publisher": "nobody subscribes", "subscription": "nobody publishes"}
_QOS = "QoS does not match"
_TYPE = "types differ"


@dataclass(frozen=True)
class Edge:
    """One arrow: a publisher's node to a topic, or a topic to a subscription's node.

    Attributes:
        source: Name of the node or topic where it begins.
        target: Name of the topic or node where it ends.
        fault: Why nothing passes: empty if something does.
    """

    source: str
    target: str
    fault: str = ""


@dataclass(frozen=True)
class Wiring:
    """What a graph picture shows.

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
        """The edges into a topic and those out of it."""
        key = topic_key(topic)
        into = [edge for edge in self.edges if edge.target == key]
        return into, [edge for edge in self.edges if edge.source == key]

    def faults(self, topic: str) -> tuple[str, ...]:
        """What is wrong around a topic, each kind once."""
        into, out = self.around(topic)
        return tuple(dict.fromkeys(edge.fault for edge in into + out if edge.fault))


def node_key(name: str) -> str:
    """The key of a node among edges."""
    return f"node {name}"


def topic_key(name: str) -> str:
    """The key of a topic among edges."""
    return f"topic {name}"


def wiring(graph: GraphSnapshot, infrastructure: bool = False) -> Wiring:
    """The part of a graph that a picture shows.

    Args:
        graph: The graph.
        infrastructure: Whether to show the topics that every node brings along, too.
    """
    owners = [*graph.nodes, *(end.node for end in graph.endpoints)]
    names = tuple(dict.fromkeys(owners))
    nodes = tuple(name for name in names if not is_hidden(name))
    skipped = frozenset() if infrastructure else INFRASTRUCTURE_TOPICS
    ends = [end for end in graph.endpoints if end.kind in _OTHER and end.name not in skipped]
    if not infrastructure:
        ends = [end for end in ends if ACTION_PART not in end.name]
    shown = [end for end in ends if end.node in nodes]
    hidden, offers = tuple(filter(is_hidden, names)), offers_of(graph, nodes)
    processes = shared(graph.processes, nodes)
    return Wiring(nodes, _topics(shown), _edges(shown, ends), hidden, offers, processes)


def shared(
    processes: Iterable[Iterable[str]], nodes: Collection[str]
) -> tuple[tuple[str, ...], ...]:
    """The nodes that share a process, as far as they are shown.

    Args:
        processes: Full names of the nodes of each process.
        nodes: Full names of the nodes that are shown.
    """
    taken: set[str] = set()
    found: list[tuple[str, ...]] = []
    for process in processes:
        # Nodes of one name have one place in a picture, so it is in one process.
        names = [name for name in dict.fromkeys(process) if name in nodes and name not in taken]
        taken.update(names)
        found.append(tuple(names))
    return tuple(names for names in found if len(names) > 1)


def say_shared(processes: Iterable[tuple[str, ...]]) -> list[str]:
    """Which nodes share a process, in whole sentences."""
    return [f"{listing(names)} share one process." for names in processes]


def describe(shown: Wiring) -> str:
    """The wiring in whole sentences."""
    head = f"{count(len(shown.nodes), 'node')} and {count(len(shown.topics), 'topic')}."
    said = [sentence_case(head), *(_topic_words(shown, topic) for topic in shown.topics)]
    said += say_offers(shown.offers)
    busy = {end for edge in shown.edges for end in (edge.source, edge.target)}
    busy |= {node_key(name) for offer in shown.offers for name in offer.nodes}
    alone = [name for name in shown.nodes if node_key(name) not in busy]
    if alone:
        verb = "uses" if len(alone) == 1 else "use"
        said.append(f"{listing(alone)} {verb} no topic.")
    said += say_shared(shown.processes)
    if shown.hidden:
        said.append(f"Left out: {count(len(shown.hidden), 'hidden node')}.")
    return " ".join(said)


def _topics(ends: Iterable[Endpoint]) -> dict[str, tuple[str, ...]]:
    types: dict[str, tuple[str, ...]] = {}
    for end in ends:
        types[end.name] = tuple(dict.fromkeys((*types.get(end.name, ()), end.type_name)))
    return types


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


def _topic_words(shown: Wiring, topic: str) -> str:
    into, out = shown.around(topic)
    types = listing(name.rsplit("/", 1)[-1] for name in shown.topics[topic])
    writers = listing(edge.source.removeprefix("node ") for edge in into) or _outside(out)
    readers = listing(edge.target.removeprefix("node ") for edge in out) or _outside(into)
    said = [f"{topic} ({types}): published by {writers}, subscribed to by {readers}."]
    said += [f"There, {_because(fault, into + out)}." for fault in shown.faults(topic)]
    return " ".join(said)


def _outside(edges: list[Edge]) -> str:
    """Who is on the other side when no node of the graph is: what passes goes to others."""
    return "another process" if any(not edge.fault for edge in edges) else "nobody"


def _because(fault: str, edges: list[Edge]) -> str:
    if fault in _NOBODY.values():
        return f"{fault}, so no message passes"
    ends = (
        edge.source if edge.target.startswith("topic ") else edge.target
        for edge in edges
        if edge.fault == fault
    )
    return f"{fault} for {listing(end.removeprefix('node ') for end in ends)}"

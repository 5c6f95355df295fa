"""Services and actions in a graph picture: who offers them, and who uses them."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from rosbeat.records import ACTION_PART, Endpoint, GraphSnapshot
from rosbeat.viz.words import listing

_WORDS = {
    "server": "service",
    "client": "service",
    "action server": "action",
    "action client": "action",
}


@dataclass(frozen=True)
class Offer:
    """A service or an action.

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
    def nodes(self) -> tuple[str, ...]:
        """All nodes that have to do with it."""
        return self.servers + self.clients

    @property
    def key(self) -> str:
        """Its key among the edges of a picture; a topic may have the same name."""
        return f"{self.word} {self.name}"

    @property
    def kind(self) -> str:
        """What stands below its name: the word and the type without its package."""
        return f"{self.word} {self.type_name.rsplit('/', 1)[-1]}"


def offers_of(graph: GraphSnapshot, nodes: Collection[str]) -> tuple[Offer, ...]:
    """The services and actions of some nodes, in order of first use.

    Args:
        graph: The graph.
        nodes: The nodes that are shown.
    """
    found: dict[tuple[str, str], list[Endpoint]] = {}
    for end in graph.endpoints:
        if end.kind in _WORDS and end.node in nodes and not _brought(end, graph.nodes):
            found.setdefault((_WORDS[end.kind], end.name), []).append(end)
    return tuple(
        Offer(word, name, ends[0].type_name, _nodes(ends, "server"), _nodes(ends, "client"))
        for (word, name), ends in found.items()
    )


def _brought(end: Endpoint, nodes: Iterable[str]) -> bool:
    """Whether it belongs to an action, or to those that every node brings along."""
    package = end.type_name.split("/")[0]
    brought = package in ("rcl_interfaces", "type_description_interfaces")
    own = brought and end.name.rpartition("/")[0] in nodes
    return ACTION_PART in end.name or own


def _nodes(ends: Iterable[Endpoint], side: str) -> tuple[str, ...]:
    return tuple(dict.fromkeys(end.node for end in ends if end.kind.endswith(side)))


def say_offers(offers: Iterable[Offer]) -> list[str]:
    """Services and actions in whole sentences."""
    return [
        f"{one.name} ({one.type_name.rsplit('/', 1)[-1]}) is {_article(one.word)}: offered by "
        f"{listing(one.servers) or 'nobody'}, used by {listing(one.clients) or 'nobody'}."
        for one in offers
    ]


def _article(word: str) -> str:
    return f"an {word}" if word == "action" else f"a {word}"

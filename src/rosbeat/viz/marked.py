"""A graph with the causes of an explanation marked where they are.

A note stands on the arrow where nothing passes, so that the words are where the cause is; the
arrow is dashed. A node that does not run is dashed, has a cross, and says why below its name. A
topic that nobody uses is dashed. Two topics that are almost the same have a note between them.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from rosbeat.diagnosis.silence import LINK, NEAR, NODE, TOPIC, TWINS, Explanation, Mark
from rosbeat.viz.wiring import Edge, Wiring, node_key, topic_key, wiring

_FAULT = "marked"


@dataclass(frozen=True)
class Marked:
    """What a graph picture shows, and what is marked in it.

    Attributes:
        plain: The nodes, topics and arrows without marks.
        wiring: The nodes, topics and arrows; arrows lead through the notes.
        notes: Words of each note by its key.
        stopped: Words below the names of nodes that do not run, by the node's name.
        twins: Words below a name that several nodes have, by the name.
        unused: Names of topics that nobody uses.
    """

    plain: Wiring
    wiring: Wiring
    notes: dict[str, tuple[str, ...]] = field(default_factory=dict)
    stopped: dict[str, tuple[str, ...]] = field(default_factory=dict)
    twins: dict[str, tuple[str, ...]] = field(default_factory=dict)
    unused: dict[str, tuple[str, ...]] = field(default_factory=dict)


def marked(source: Explanation, infrastructure: bool = False) -> Marked:
    """Mark the causes in the graph of an explanation.

    Args:
        source: The explanation.
        infrastructure: Whether to show the topics that every node brings along, too.
    """
    plain = wiring(source.graph, infrastructure or source.topic in _brought(source))
    made = Marked(plain, plain)
    for mark in source.marks:
        made = _with(made, mark)
    return made


def _brought(source: Explanation) -> set[str]:
    """The topic that is asked about, if it is one that every node brings along."""
    return {source.topic} & (set(source.graph.topics(True)) - set(source.graph.topics()))


def _with(made: Marked, mark: Mark) -> Marked:
    if mark.kind == NODE:
        return replace(made, stopped={**made.stopped, mark.subject: mark.words})
    if mark.kind == TWINS:
        return replace(made, twins={**made.twins, mark.subject: mark.words})
    if mark.kind == TOPIC:
        topics = {**made.wiring.topics, mark.subject: ()}
        shown = replace(made.wiring, topics=topics)
        return replace(made, wiring=shown, unused={**made.unused, mark.subject: mark.words})
    add = {LINK: _on_the_link, NEAR: _between}
    return add[mark.kind](made, mark)


def _on_the_link(made: Marked, mark: Mark) -> Marked:
    """Lead the arrow through a note."""
    ends = (node_key(mark.subject), topic_key(mark.other))
    link = ends if mark.side == "publisher" else ends[::-1]
    old = next((one for one in made.wiring.edges if (one.source, one.target) == link), None)
    if old is None:
        return made  # a hidden node
    edges = [one for one in made.wiring.edges if one is not old]
    return _noted(made, mark, edges, *link)


def _between(made: Marked, mark: Mark) -> Marked:
    ends = topic_key(mark.subject), topic_key(mark.other)
    return _noted(made, mark, list(made.wiring.edges), *ends)


def _noted(made: Marked, mark: Mark, edges: list[Edge], source: str, target: str) -> Marked:
    key = note_key(source, target)
    edges += [Edge(source, key, _FAULT), Edge(key, target, _FAULT)]
    shown = replace(made.wiring, edges=tuple(edges))
    return replace(made, wiring=shown, notes={**made.notes, key: mark.words})


def note_key(source: str, target: str) -> str:
    """The key of a note among edges."""
    return f"note {source} > {target}"


def has_head(edge: Edge) -> bool:
    """Whether an arrow ends here: not in a note, and not between two topics."""
    note = edge.source.removeprefix("note ").split(" > ")
    between_topics = len(note) == 2 and all(end.startswith("topic ") for end in note)
    return not edge.target.startswith("note ") and not between_topics


def say(source: Explanation) -> str:
    """What is marked, in whole sentences."""
    if not source.marks:
        return source.title
    return " ".join((source.title, *map(_words, source.marks)))


def _words(mark: Mark) -> str:
    words = " ".join(mark.words)
    if mark.kind == NODE:
        return f"{mark.subject} has a cross: {words}."
    if mark.kind == TWINS:
        return f"{mark.subject} stands for several nodes: {words}."
    if mark.kind in (LINK, NEAR):
        return f"Between {mark.subject} and {mark.other} is a broken line: {words}."
    return f"{mark.subject} is dashed: {words}."

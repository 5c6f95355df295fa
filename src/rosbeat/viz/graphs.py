"""Draw the graph of nodes and topics: who publishes, who listens, where the cause of a silence is.

Nodes are ellipses and topics are rectangles, as rqt_graph draws them. The causes of an explanation
are marked where they are. Words stand on the arrow where nothing passes; the arrow is dashed. A
node that does not run is dashed, has a cross, and says why below its name. A topic that nobody uses
is dashed. Two topics whose names are almost the same have words between them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace

from rosbeat.diagnosis.findings import LINK, NEAR, NODE, TOPIC, TWINS, Mark
from rosbeat.diagnosis.silence import Explanation
from rosbeat.errors import PictureError, called_as
from rosbeat.records import (
    ACTION_PART,
    INFRASTRUCTURE_TOPICS,
    Endpoint,
    GraphSnapshot,
    is_hidden,
)
from rosbeat.viz import arguments, theme
from rosbeat.viz.canvas import (
    BROKEN,
    PLAIN,
    ROOM,
    Canvas,
    blank,
    cornered,
    line_height,
    smooth,
    text_width,
    wrap,
)
from rosbeat.viz.layout import (
    Layering,
    Placement,
    Point,
    layering,
    needed,
    place,
)
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import count, listing, sentence_case

#: Widest line of a name in CSS pixels, tried in this order.
_LIMITS = (200.0, 150.0, 115.0, 95.0)
_TOPIC_PADDING, _NOTE_PADDING = (13.0, 7.0), (5.0, 5.0)
#: Begins the key of a note.
_NOTE = "note "
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


# Who talks to whom: vertices and edges, with what is wrong.


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


# What is written in boxes, and how large that makes them.


@dataclass(frozen=True)
class Line:
    """Hold one line of text in a box."""

    words: str
    colour: str = theme.INK


@dataclass(frozen=True)
class Label:
    """Hold what is written in one box.

    Attributes:
        lines: From top to bottom.
        shape: `node` (an ellipse), `topic` (a rectangle) or `note` (words without a box).
        strong: Whether it is highlighted.
        broken: Whether nothing passes here.
        dashed: Whether it does not run, or is not there.
    """

    lines: tuple[Line, ...]
    shape: str
    strong: bool = False
    broken: bool = False
    dashed: bool = False

    @property
    def is_node(self) -> bool:
        """Return whether the box is that of a node."""
        return self.shape == "node"

    @property
    def size(self) -> Point:
        """Return width and height of the box in CSS pixels."""
        width = max(text_width(line.words, self._weight(line)) for line in self.lines)
        height = line_height() * len(self.lines)
        if self.is_node:
            # An ellipse around a text is wider and higher than the text: (1/a)² + (1/b)² = 1.
            return width * 1.2 + 14, height * 1.8 + 6
        padding = _NOTE_PADDING if self.shape == "note" else _TOPIC_PADDING
        return width + 2 * padding[0], height + 2 * padding[1]

    def draw(self, canvas: Canvas, x: float, y: float) -> None:
        """Draw box and text with the middle at (`x`, `y`), in CSS pixels."""
        if self.is_node:
            fill = theme.NODE_FILL_STRONG if self.strong else theme.NODE_FILL
            edge, radius = theme.ALERT if self.dashed else theme.BLUE, None
        else:
            fill = theme.TOPIC_FILL_STRONG if self.strong else theme.TOPIC_FILL
            edge, radius = theme.ALERT if self.broken else theme.TOPIC_EDGE, 4.0
        if self.shape != "note":
            width, dash = 2.6 if self.strong else 1.3, "--" if self.dashed else "-"
            canvas.shape((x, y), self.size, radius, fill, edge, width, dash)
        if self.dashed and self.is_node:
            # A cross on the rim, at the upper right.
            at = (x + self.size[0] / 2 * 0.62, y + self.size[1] / 2 * 0.78)
            canvas.mark(*at, theme.Style(theme.ALERT, "X", ""), 12, theme.CARD, 1.2, layer=5)
        for rank, line in enumerate(self.lines):
            middle = y + ((len(self.lines) - 1) / 2 - rank) * line_height()
            canvas.text(x, middle, line.words, line.colour, "center", self._weight(line))

    def _weight(self, line: Line) -> str:
        """Return the weight of a line: only the name in a highlighted box is bold."""
        return "bold" if self.strong and line.colour == theme.INK else "normal"


def _label(
    shape: str,
    name: str,
    limit: float,
    strong: bool,
    types: Iterable[str] = (),
    wrong: Collection[str] = (),
    dashed: bool = False,
) -> Label:
    """Return a label with a name broken at `limit` CSS pixels, its types, and what is wrong."""
    lines = [Line(row) for row in wrap(name, limit)]
    lines += [Line(one, theme.MUTED) for one in types]
    lines += [Line(row, theme.ALERT_TEXT) for one in wrong for row in wrap(one, limit)]
    return Label(tuple(lines), shape, strong, bool(wrong), dashed)


# The causes of an explanation, marked in its graph.


@dataclass(frozen=True)
class Marked:
    """Hold what a graph picture shows, and what is marked in it.

    Attributes:
        plain: The nodes, topics and arrows without marks.
        wiring: The nodes, topics and arrows; arrows lead through the notes.
        words: What is wrong with a node or topic, and the words of a note, by its key.
        dashed: Keys of nodes that do not run, and of topics that nobody uses.
    """

    plain: Wiring
    wiring: Wiring
    words: dict[str, tuple[str, ...]] = field(default_factory=dict)
    dashed: frozenset[str] = frozenset()

    @property
    def notes(self) -> list[str]:
        """Return the keys of the notes."""
        return [key for key in self.words if key.startswith(_NOTE)]

    def edges(self) -> list[Edge]:
        """Return all arrows: along topics, and from clients to those who offer what they use."""
        return [*self.wiring.edges, *(edge for one in self.wiring.offers for edge in one.edges)]


def marked(source: Explanation, infrastructure: bool = False) -> Marked:
    """Mark the causes in the graph of an explanation."""
    # The topic that is asked about is shown even if every node brings it along.
    brought = set(source.graph.topics(True)) - set(source.graph.topics())
    plain = wiring(source.graph, infrastructure or source.topic in brought)
    made = Marked(plain, plain)
    for mark in source.marks:
        made = _with(made, mark)
    return made


def _with(made: Marked, mark: Mark) -> Marked:
    if mark.kind == NEAR:
        return _noted(made, mark, topic_key(mark.subject), topic_key(mark.other))
    if mark.kind == LINK:
        ends = (node_key(mark.subject), topic_key(mark.other))
        return _noted(made, mark, *(ends if mark.side == "publisher" else ends[::-1]))
    is_topic, shown = mark.kind == TOPIC, made.wiring
    key = topic_key(mark.subject) if is_topic else node_key(mark.subject)
    if is_topic:
        shown = replace(shown, topics={**shown.topics, mark.subject: ()})
    words = {**made.words, key: made.words.get(key, ()) + mark.words}
    dashed = made.dashed if mark.kind == TWINS else made.dashed | {key}
    return Marked(made.plain, shown, words, dashed)


def _noted(made: Marked, mark: Mark, source: str, target: str) -> Marked:
    """Lead an arrow through a note, or put a note between two topics."""
    edges = [one for one in made.wiring.edges if (one.source, one.target) != (source, target)]
    if mark.kind == LINK and len(edges) == len(made.wiring.edges):
        return made  # a hidden node
    key = f"{_NOTE}{source} > {target}"
    edges.append(Edge(source, key, "marked", has_head=False))
    edges.append(Edge(key, target, "marked", has_head=mark.kind == LINK))
    shown = replace(made.wiring, edges=tuple(edges))
    return replace(made, wiring=shown, words={**made.words, key: mark.words})


# The picture.


@called_as("viz.graph(ros)")
def graph(
    source: arguments.Observed | GraphSnapshot | Explanation,
    highlight: str | Iterable[str] = (),
    infrastructure: bool = False,
) -> Picture:
    """Draw which nodes publish to which topics and which nodes subscribe.

    Which nodes share a process is written below.

    Services and actions have boxes, too, with what they are below their names; an arrow leads from
    who uses one to who offers it. What every node brings along is left out.

    An arrow is dashed where nothing passes: nobody is on the other side, the qualities of service
    do not match, or the types differ. Nodes whose name has a part that begins with `_` are left
    out. Of an explanation the causes are marked where they are, in words, and its topic is drawn
    boldly.

    Args:
        source: A session, what it observed, a graph, or what `ros.explain` returned.
        highlight: Name of a node or topic, or several, to draw boldly.
        infrastructure: Whether to show `/rosout`, `/parameter_events` and `/clock`, too.

    Raises:
        PictureError: If there is no node, or a highlighted name is not in the graph.
    """
    if isinstance(source, Explanation):
        shown, words = marked(source, infrastructure), f"{say(source)} "
    else:
        plain = wiring(arguments.snapshot(source), infrastructure)
        shown, words = Marked(plain, plain), ""
    if not shown.plain.nodes:
        raise PictureError(
            "There is no node to draw.",
            "The graph was taken before a node was added, or all of its nodes are hidden.",
            "Add a node to the session first.",
        )
    offered = (offer.name for offer in shown.wiring.offers)
    known = (*shown.wiring.nodes, *shown.wiring.topics, *offered)
    strong = {
        arguments.known_name(name, known, "node or topic") for name in arguments.names_in(highlight)
    }
    if isinstance(source, Explanation):
        strong |= {source.topic} & set(shown.wiring.topics)
    arranged = arrange(shown, strong)
    width, height = arranged.size
    # Boxes that just fit may be wider by an error of rounding.
    width = max(theme.WIDTH, round(width + 2 * theme.MARGIN, 3))
    note = " ".join(say_shared(shown.plain.processes))
    with blank(height, width, note=note) as canvas:
        _draw(canvas, shown, arranged)
    return Picture(canvas.figure, words + describe(shown.plain), "Nodes and topics")


@dataclass(frozen=True)
class Arrangement:
    """Hold a placement with its labels, and whether it flows down instead of to the right."""

    labels: dict[str, Label]
    placement: Placement
    down: bool

    @property
    def size(self) -> Point:
        """Return width and height, in CSS pixels."""
        return self.at((self.placement.length, self.placement.breadth))

    def at(self, point: Point) -> Point:
        """Return how far a point of the placement is from the left and from the top."""
        return point[::-1] if self.down else point


def arrange(shown: Marked, strong: Collection[str] = ()) -> Arrangement:
    """Place a graph from left to right if it fits the page, else downwards.

    What is highlighted does not count, so that a graph has one direction; only the words of marks
    may need so much room that it has another.

    Args:
        shown: The graph.
        strong: Full names of nodes and topics whose names are bold.
    """
    plan = _plan(shown)
    down = not any(_fits(plan, _labels(shown, (), limit)) for limit in _LIMITS)
    for limit in _LIMITS:
        labels = _labels(shown, strong, limit)
        made = Arrangement(labels, place(plan, _sizes(labels, down), 0.0 if down else ROOM), down)
        if made.size[0] <= ROOM + 1e-6 if down else _fits(plan, labels):
            break
    return made


def _fits(plan: Layering, labels: dict[str, Label]) -> bool:
    return needed(plan, _sizes(labels, down=False)) <= ROOM


def _plan(shown: Marked) -> Layering:
    starts = {node_key(name): 0 for name in shown.wiring.nodes}
    starts.update((topic_key(name), 1) for name in shown.wiring.topics)
    starts.update(dict.fromkeys(shown.notes, 1))
    starts.update((offer.key, 1) for offer in shown.wiring.offers)
    links = [(edge.source, edge.target) for edge in shown.edges()]
    return layering(starts, links)


def _sizes(labels: dict[str, Label], down: bool) -> dict[str, Point]:
    """Return every label's size along and across the flow."""
    sizes = {name: label.size for name, label in labels.items()}
    return {name: size[::-1] for name, size in sizes.items()} if down else sizes


def _labels(shown: Marked, strong: Collection[str], limit: float) -> dict[str, Label]:
    labels: dict[str, Label] = {}
    for key in shown.notes:
        lines = [Line(one, theme.ALERT_TEXT) for one in shown.words[key]]
        labels[key] = Label(tuple(lines), "note")
    for name in shown.wiring.nodes:
        key = node_key(name)
        wrong, dashed = shown.words.get(key, ()), key in shown.dashed
        labels[key] = _label("node", name, limit, name in strong, (), wrong, dashed)
    for name, types in shown.wiring.topics.items():
        key, short = topic_key(name), map(short_type, types)
        wrong, dashed = shown.plain.faults(name) or shown.words.get(key, ()), key in shown.dashed
        labels[key] = _label("topic", name, limit, name in strong, short, wrong, dashed)
    for offer in shown.wiring.offers:
        kind = f"{offer.word} {short_type(offer.type_name)}"
        labels[offer.key] = _label("topic", offer.name, limit, offer.name in strong, [kind])
    return labels


def _draw(canvas: Canvas, shown: Marked, arranged: Arrangement) -> None:
    placed, left = arranged.placement, (canvas.width - arranged.size[0]) / 2

    def at(point: Point) -> Point:
        x, y = arranged.at(point)
        return left + x, canvas.top - y

    for edge in shown.edges():
        link, stroke = (edge.source, edge.target), BROKEN if edge.fault else PLAIN
        is_forward = link in placed.routes
        points = [*map(at, placed.routes[link] if is_forward else placed.returns[link])]
        path = smooth(points, arranged.down) if is_forward else cornered(points)
        canvas.arrow(path, stroke, edge.has_head)
    for name, box in placed.boxes.items():
        arranged.labels[name].draw(canvas, *at((box.along, box.across)))


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


def say(source: Explanation) -> str:
    """Tell what is marked, in whole sentences."""
    return " ".join((source.title, *map(_say_mark, source.marks)))


def _say_mark(mark: Mark) -> str:
    words = " ".join(mark.words)
    if mark.kind == NODE:
        return f"{mark.subject} has a cross: {words}."
    if mark.kind == TWINS:
        return f"{mark.subject} stands for several nodes: {words}."
    if mark.kind in (LINK, NEAR):
        return f"Between {mark.subject} and {mark.other} is a broken line: {words}."
    return f"{mark.subject} is dashed: {words}."

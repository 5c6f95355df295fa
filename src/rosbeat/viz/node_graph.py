"""The node and topic graph: who publishes what, and who listens.

Nodes are ellipses and topics are rectangles, as rqt_graph draws them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from rosbeat.diagnosis.silence import Explanation
from rosbeat.errors import PictureError
from rosbeat.records import GraphSnapshot
from rosbeat.viz import arrows, frames, sources, theme
from rosbeat.viz.canvas import Canvas, blank
from rosbeat.viz.clusters import Clustering, Rim, clustered, enclosed
from rosbeat.viz.labels import Label, node_label, topic_label
from rosbeat.viz.layers import Layering, layering
from rosbeat.viz.marked import Marked, has_head, marked, say
from rosbeat.viz.notes import Note
from rosbeat.viz.picture import Picture
from rosbeat.viz.placement import Box, Placement, needed, place
from rosbeat.viz.wiring import Edge, describe, node_key, topic_key, wiring

#: Widest line of a name in CSS pixels and font size in points, tried in this order.
_FITS = ((200.0, 10.0), (150.0, 10.0), (115.0, 10.0), (115.0, 9.0), (95.0, 8.5))
_ROOM = theme.WIDTH - 2 * theme.MARGIN


@dataclass(frozen=True)
class _Layout:
    """A placement with its labels, and whether it flows down instead of to the right."""

    labels: dict[str, Label | Note]
    placement: Placement
    down: bool

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the picture in CSS pixels."""
        extent = (self.placement.length, self.placement.breadth)
        width, height = reversed(extent) if self.down else extent
        return max(theme.WIDTH, width + 2 * theme.MARGIN), height + 2 * theme.MARGIN

    def point(self, along: float, across: float) -> tuple[float, float]:
        """Canvas coordinates of a point of the placement; the picture is centred."""
        width, height = self.size
        if self.down:
            return (width - self.placement.breadth) / 2 + across, height - theme.MARGIN - along
        return (width - self.placement.length) / 2 + along, height - theme.MARGIN - across


def graph(
    source: sources.Observed | GraphSnapshot | Explanation,
    highlight: str | Iterable[str] = (),
    infrastructure: bool = False,
) -> Picture:
    """Draw which nodes publish to which topics and which nodes subscribe.

    Nodes that share a process have a frame around them, with what only they use.

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

    Returns:
        The picture.

    Raises:
        PictureError: If there is no node, or a highlighted name is not in the graph.
    """
    shown = _shown(source, infrastructure)
    if not shown.plain.nodes:
        raise PictureError(
            "There is no node to draw.",
            "The graph was taken before a node was added, or all of its nodes are hidden.",
            "Add a node to the session first.",
        )
    names = [highlight] if isinstance(highlight, str) else list(highlight)
    offered = (offer.name for offer in shown.wiring.offers)
    known = (*shown.wiring.nodes, *shown.wiring.topics, *offered)
    strong = {sources.known_name(name, known, "node or topic") for name in names}
    if isinstance(source, Explanation):
        strong |= {source.topic} & set(shown.wiring.topics)
    layout = _layout(shown, strong)
    width, height = layout.size
    with blank(height, width) as canvas:
        _draw(canvas, shown, layout)
    words = f"{say(source)} " if isinstance(source, Explanation) else ""
    return Picture(canvas.figure, words + describe(shown.plain), "Nodes and topics")


def _shown(source: sources.Observed | GraphSnapshot | Explanation, infrastructure: bool) -> Marked:
    if isinstance(source, Explanation):
        return marked(source, infrastructure)
    plain = wiring(sources.snapshot(source), infrastructure)
    return Marked(plain, plain)


def _layout(shown: Marked, strong: set[str]) -> _Layout:
    """The first layout that fits: from left to right if possible, else from top to bottom."""
    starts = {node_key(name): 0 for name in shown.wiring.nodes}
    starts.update((topic_key(name), 1) for name in shown.wiring.topics)
    starts.update(dict.fromkeys(shown.notes, 1))
    starts.update((offer.key, 1) for offer in shown.wiring.offers)
    plan = _framed(shown, layering(starts, [(edge.source, edge.target) for edge in _edges(shown)]))
    tries = [(down, *fit) for down in (False, True) for fit in _FITS]
    for down, limit, size in tries:
        layout = _attempt(plan, _labels(shown, strong, limit, size), down)
        if layout and layout.size[0] <= theme.WIDTH:
            return layout
    return layout or _forced(plan, _labels(shown, strong, *_FITS[-1]))


def _framed(shown: Marked, plan: Layering) -> Layering:
    """The columns with a cluster for every process of several nodes, if there is one."""
    if not shown.wiring.processes:
        return plan
    groups = [list(map(node_key, names)) for names in shown.wiring.processes]
    others = [*map(topic_key, shown.wiring.topics), *shown.notes]
    others += [offer.key for offer in shown.wiring.offers]
    return clustered(plan, enclosed(groups, [*plan.chains, *plan.back], others))


def _rimmed(plan: Layering, down: bool) -> Layering:
    """The columns with room in their frames for the label, which is on the upper edge, left."""
    if not isinstance(plan, Clustering):
        return plan
    width = frames.least_width()
    if down:
        # Arrows come in over the upper edge, too, so the boxes stand beside the label.
        return replace(plan, rim=Rim((16.0, width - 8), (10.0, 10.0)))
    return replace(plan, rim=Rim((10.0, 16.0), (10.0, 10.0), (width, 0.0)))


def _edges(shown: Marked) -> list[Edge]:
    """All arrows: along topics, and from clients to those who offer what they use."""
    edges = list(shown.wiring.edges)
    for offer in shown.wiring.offers:
        edges += [Edge(node_key(name), offer.key) for name in offer.clients]
        edges += [Edge(offer.key, node_key(name)) for name in offer.servers]
    return edges


def _attempt(plan: Layering, labels: dict[str, Label | Note], down: bool) -> _Layout | None:
    sizes = {name: _extent(label, down) for name, label in labels.items()}
    plan = _rimmed(plan, down)
    if not down and needed(plan, sizes) > _ROOM:
        return None
    return _Layout(labels, place(plan, sizes, 0.0 if down else _ROOM), down)


def _extent(label: Label | Note, down: bool) -> tuple[float, float]:
    """A label's size along and across the flow."""
    width, height = label.size
    return (height, width) if down else (width, height)


def _forced(plan: Layering, labels: dict[str, Label | Note]) -> _Layout:
    sizes = {name: label.size for name, label in labels.items()}
    return _Layout(labels, place(_rimmed(plan, down=False), sizes, _ROOM), down=False)


def _labels(shown: Marked, strong: set[str], limit: float, size: float) -> dict[str, Label | Note]:
    labels: dict[str, Label | Note] = {key: Note(words) for key, words in shown.notes.items()}
    for name in shown.wiring.nodes:
        stopped, twins = shown.stopped.get(name, ()), shown.twins.get(name, ())
        wrong = (stopped + twins, bool(stopped))
        labels[node_key(name)] = node_label(name, limit, size, name in strong, *wrong)
    for name, types in shown.wiring.topics.items():
        unused = shown.unused.get(name, ())
        said = shown.plain.faults(name) or unused
        look = (limit, size, name in strong, bool(unused))
        labels[topic_key(name)] = topic_label(name, types, said, *look)
    for offer in shown.wiring.offers:
        look = (limit, size, offer.name in strong, False)
        labels[offer.key] = topic_label(offer.name, (offer.kind,), (), *look)
    return labels


def _draw(canvas: Canvas, shown: Marked, layout: _Layout) -> None:
    place_of = layout.placement
    for frame in place_of.frames:
        _draw_frame(canvas, frame, layout)
    for edge in _edges(shown):
        stroke, head = arrows.BROKEN if edge.fault else arrows.PLAIN, has_head(edge)
        link = (edge.source, edge.target)
        if link in place_of.routes:
            points = [layout.point(*point) for point in place_of.routes[link]]
            arrows.draw(canvas, arrows.curve(points, layout.down), stroke, head)
        else:
            points = [layout.point(*point) for point in place_of.returns[link]]
            arrows.draw(canvas, arrows.cornered(points), stroke, head)
    for name, box in place_of.boxes.items():
        layout.labels[name].draw(canvas, *layout.point(box.along, box.across))


def _draw_frame(canvas: Canvas, frame: Box, layout: _Layout) -> None:
    half = frame.length / 2, frame.breadth / 2
    first = layout.point(frame.along - half[0], frame.across - half[1])
    last = layout.point(frame.along + half[0], frame.across + half[1])
    frames.draw(canvas, first[0], last[1], last[0], first[1])
